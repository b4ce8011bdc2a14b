// Many pins at a time: set, let go, moved and turned together.
#include <cmath>
#include <numbers>

#include "pliant/core/error.h"
#include "tests/support/changed_session.h"
#include "tests/support/temporary_folder.h"

namespace test_session_pins {

using namespace pliant_tests;

const std::vector<Index> row = {27, 28, 29, 30, 31, 32, 33, 34, 35};

/// Where they are, one row each.
Eigen::MatrixXd places(const Session& session, const std::vector<Index>& vertices) {
  return positions(session)(vertices, Eigen::all);
}

Eigen::MatrixXd moved(const Eigen::MatrixXd& from, const RigidMotion& motion) {
  Eigen::MatrixXd to = from;
  for (Eigen::Index i = 0; i < to.rows(); ++i) to.row(i) = motion(from.row(i).transpose()).transpose();
  return to;
}

TEST_CASE("many vertices, of several bodies, are pinned and let go as one change each") {
  Session session(make_scene);
  steps(session, 20);
  const std::vector<Index> both = {30, 31, 32, 30, 80, 90, 91};  // one twice, one that the scene pins, two of the scarf
  const Eigen::MatrixXd held = places(session, both);
  session.pin(both);
  CHECK(session.undone_next() == "pin 5 vertices");
  CHECK(session.changes().pins.size() == 5);
  for (const Index vertex : both) CHECK(session.is_pinned(vertex));
  steps(session, 30);
  Eigen::MatrixXd now = places(session, both);
  now.row(4) = held.row(4);  // the scene moves this one
  CHECK((now - held).cwiseAbs().maxCoeff() < 1e-9);

  session.pin(both);
  CHECK(session.undone_next() == "pin 5 vertices");  // nothing was left to pin
  session.undo();
  for (const Index vertex : {30, 31, 32, 90, 91}) CHECK_FALSE(session.is_pinned(vertex));
  CHECK(session.is_pinned(80));
  steps(session, 5);
  session.redo();
  for (const Index vertex : both) CHECK(session.is_pinned(vertex));

  session.unpin({31, 32, 80, 90, 44});
  CHECK(session.undone_next() == "unpin 4 vertices");
  for (const Index vertex : {31, 32, 80, 90}) CHECK_FALSE(session.is_pinned(vertex));
  CHECK(session.is_pinned(30));
  CHECK(session.is_pinned(91));
  session.undo();
  for (const Index vertex : both) CHECK(session.is_pinned(vertex));
  CHECK(session.changes().released.empty());
}

TEST_CASE("vertices that are not there are refused, and nothing is pinned then") {
  Session session(make_scene);
  CHECK_THROWS_AS(session.pin({30, 5000}), pliant::Error);
  CHECK_THROWS_AS(session.pin(std::vector<Index>{-1}), pliant::Error);
  CHECK_FALSE(session.is_pinned(30));
  CHECK(session.undone_next().empty());
  session.unpin({5000, -1});
  session.hold_pins({5000, 30});
  session.move_held({.translation = {1, 0, 0}});
  session.drop_held();
  steps(session, 3);
  CHECK(session.undone_next().empty());
}

TEST_CASE("pins are turned and moved together from where they were taken, and stay there") {
  Session session(make_scene);
  session.pin(row);
  steps(session, 30);
  const Eigen::MatrixXd before = places(session, row);
  session.hold_pins(row);
  const RigidMotion far{.center = {0, 0, 0.3F}, .rotation = {0, 0, 1}, .translation = {0, 0.4F, 0}};
  const RigidMotion motion{
      .center = {0.1F, 0, 0.4F}, .rotation = Vec3f(0.3F, -0.5F, 0.2F), .translation = {0.05F, -0.1F, 0.15F}};
  session.move_held(far);
  steps(session, 2);
  session.move_held({.translation = {std::nanf(""), 0, 0}});  // is no motion
  session.move_held(motion);
  steps(session, 2);
  const Eigen::MatrixXd wanted = moved(before, motion);
  CHECK((places(session, row) - wanted).cwiseAbs().maxCoeff() < 1e-9);
  for (Eigen::Index i = 1; i < wanted.rows(); ++i) {  // nothing is stretched
    CHECK((wanted.row(i) - wanted.row(0)).norm() == doctest::Approx((before.row(i) - before.row(0)).norm()));
  }
  session.drop_held();
  session.move_held(far);  // nothing is held any longer
  CHECK(session.undone_next() == "pin 9 vertices");
  steps(session, 20);
  CHECK((places(session, row) - wanted).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("a quarter of a turn about z takes x to y") {
  const RigidMotion motion{
      .center = {1, 1, 0}, .rotation = {0, 0, std::numbers::pi_v<float> / 2}, .translation = {0, 0, 2}};
  CHECK((motion({2, 1, 5}) - Eigen::Vector3d(1, 2, 7)).norm() < 1e-6);
  CHECK((RigidMotion{}({2, 1, 5}) - Eigen::Vector3d(2, 1, 5)).norm() == 0);
}

TEST_CASE("a pin of the scene that is taken in hand is no longer moved by it") {
  for (const int begin : {5, 20}) {  // before its motion, and during that
    CAPTURE(begin);
    Session session(make_scene);
    steps(session, begin);
    session.hold_pins({72, 80});
    const Eigen::MatrixXd before = places(session, {72, 80});
    for (int i = 0; i < 20; ++i) {
      session.move_held({.translation = {0, 0.01F, 0}});
      session.step();
    }
    CHECK((places(session, {72, 80}) - moved(before, {.translation = {0, 0.01F, 0}})).cwiseAbs().maxCoeff() < 1e-6);
    session.drop_held();
    steps(session, 30);
    CHECK((places(session, {72, 80}) - moved(before, {.translation = {0, 0.01F, 0}})).cwiseAbs().maxCoeff() < 1e-6);
  }
}

TEST_CASE("pins that were taken in hand and not moved are no change") {
  Session session(make_scene);
  session.pin(row);
  session.undo();
  session.hold_pins({72, 80});
  session.drop_held();
  CHECK(session.redone_next() == "pin 9 vertices");
  CHECK(session.undone_next().empty());
}

TEST_CASE("a body of which all is pinned, some by the scene and the rest by hand, can be moved and let go") {
  Session session(make_scene);
  std::vector<Index> sheet;
  for (Index i = 0; i < 81; ++i) sheet.push_back(i);
  session.pin(sheet);
  CHECK(session.undone_next() == "pin 79 vertices");
  const auto of_sheet = [&] {
    return std::ranges::count_if(session.pinned_vertices(), [](const PinnedVertex& pin) { return pin.vertex < 81; });
  };
  CHECK(of_sheet() == 81);
  CHECK(session.figures() == std::vector<char>{0, 0});
  session.unpin(sheet);
  CHECK(of_sheet() == 0);
}

TEST_CASE("what is moved together before the first step begins there, is taken back as one change, and saved") {
  const TemporaryFolder folder;
  Session session(make_scene);
  session.pin(row);
  const Eigen::MatrixXd before = places(session, row);
  std::vector<Index> all = row;
  all.push_back(80);
  session.hold_pins(all);
  const RigidMotion motion{.rotation = {0.4F, 0, 0}, .translation = {0, 0.2F, 0}};
  session.move_held(motion);
  session.drop_held();
  CHECK(session.undone_next() == "move 10 vertices");
  steps(session, 10);
  session.restart(true);
  session.step();
  CHECK((places(session, row) - moved(before, motion)).cwiseAbs().maxCoeff() < 1e-6);
  session.restart(true);
  const auto file = folder.path() / "moved.json";
  session.save(file, session.scene().view);
  Session again([&] { return pliant::load_scene(file); });
  steps(session, 20);
  steps(again, 20);
  CHECK(positions(again) == positions(session));
  session.undo();
  session.restart(true);
  session.step();
  CHECK((places(session, row) - before).cwiseAbs().maxCoeff() < 1e-9);
}

TEST_CASE("pins of one group of the scene that are moved before the first step begin there, read again as well") {
  const TemporaryFolder folder;
  Session session(make_scene);
  const Eigen::MatrixXd before = places(session, {72, 80});
  session.hold_pins({72, 80});
  const RigidMotion motion{.center = {0.2F, 0, 0.9F}, .rotation = {0.1F, 0.7F, 0}, .translation = {0.05F, 0, 0.1F}};
  session.move_held(motion);
  session.drop_held();
  session.restart(true);
  steps(session, 5);
  CHECK((places(session, {72, 80}) - moved(before, motion)).cwiseAbs().maxCoeff() < 1e-12);
  session.restart(true);
  const auto file = folder.path() / "moved.json";
  session.save(file, session.scene().view);
  Session again([&] { return pliant::load_scene(file); });
  steps(session, 30);
  steps(again, 30);
  CHECK(positions(again) == positions(session));
}

TEST_CASE("moves of pins that the scene no longer has are forgotten, the others stay") {
  bool is_changed = false;
  Session session([&] {
    pliant::SceneOverrides overrides;
    if (is_changed) overrides.set.push_back("bodies[scarf].constraints[0].on=[0]");
    return pliant::parse_scene(sheet_text, {}, "sheet", overrides);
  });
  const std::vector<Index> corners = {81, 86, 99, 104};
  const Eigen::MatrixXd before = places(session, corners);
  session.hold_pins(corners);
  session.move_held({.translation = {0, 0.1F, 0}});
  session.drop_held();
  CHECK(session.undone_next() == "move 4 vertices");
  is_changed = true;
  session.restart(true);
  CHECK(session.note().empty());
  steps(session, 3);
  CHECK_FALSE(session.is_pinned(104));
  CHECK(session.is_pinned(81));
  CHECK(places(session, {81})(0, 1) - before(0, 1) == doctest::Approx(0.1));
}

TEST_CASE("a body that was pinned by hand as a whole is the hand's in the scene that was saved, too") {
  const TemporaryFolder folder;
  Session session(make_scene);
  const std::vector<Index> scarf = [] {
    std::vector<Index> list;
    for (Index i = 81; i < 105; ++i) list.push_back(i);
    return list;
  }();
  session.pin(scarf);
  const auto file = folder.path() / "held.json";
  session.save(file, session.scene().view);
  Session again([&] { return pliant::load_scene(file); });
  CHECK(again.figures() == std::vector<char>{0, 0});
  CHECK(again.pinned_vertices().size() == 2 + 24);
  CHECK(again.materials().size() == 2);
  again.unpin(scarf);
  CHECK(again.pinned_vertices().size() == 2);
}

TEST_CASE("what can be moved by its pin is listed with where it is held, but for what the scene holds as a whole") {
  Session session(make_scene);
  session.pin(row);
  session.hold_pins(row);
  session.move_held({.translation = {0, 0, 1}});
  std::vector<std::uint32_t> vertices;
  for (const PinnedVertex& pin : session.pinned_vertices()) {
    vertices.push_back(pin.vertex);
    if (pin.vertex >= 27 && pin.vertex <= 35)
      CHECK(pin.target.z() == doctest::Approx(place(session, static_cast<Index>(pin.vertex)).z() + 1));
  }
  CHECK(vertices == std::vector<std::uint32_t>{27, 28, 29, 30, 31, 32, 33, 34, 35, 72, 80, 81, 86, 99, 104});

  Session figure([] {
    return pliant::parse_scene(R"({ "pliant": 1, "bodies": [
      { "name": "figure", "mesh": { "shape": "grid", "columns": 3, "rows": 3 }, "mass": { "total": 1 },
        "constraints": [ { "type": "position", "on": "all" } ] },
      { "name": "cloth", "mesh": { "shape": "grid", "columns": 3, "rows": 3 }, "mass": { "total": 1 } } ] })",
                               {}, "figure");
  });
  CHECK(figure.pinned_vertices().empty());
  figure.pin({9, 10, 11, 12, 13, 14, 15, 16, 17});
  CHECK(figure.pinned_vertices().size() == 9);  // all of the cloth, but by hand
  CHECK(figure.figures() == std::vector<char>{1, 0});
}

}  // namespace test_session_pins
