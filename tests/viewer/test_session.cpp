#include <random>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/materials/material_groups.h"
#include "viewer/session.h"

namespace test_session {

using namespace pliant_viewer;
using pliant::Parameter;
using pliant::ParameterKind;

namespace {

constexpr std::string_view sheet_text = R"({
  "pliant": 1,
  "settings": { "iterations": 10 },
  "bodies": [ {
    "name": "sheet",
    "mesh": { "shape": "grid", "columns": 12, "rows": 12, "size": [1, 1], "plane": "xz" },
    "mass": { "area_density": 0.3 },
    "constraints": [
      { "type": "position", "name": "hooks", "on": [132, 143] },
      { "type": "triangle_strain", "name": "stretch", "stiffness": 500 },
      { "type": "hinge", "name": "bend", "stiffness": 0.001 }
    ]
  } ],
  "forces": [ { "type": "wind", "velocity": [0, 0.5, 0], "drag": 1 } ],
  "moves": [ { "group": "hooks", "index": 0, "time": 0.5, "over": 1, "offset": [0.2, 0, 0] } ]
})";

Session make_session(const std::string& more = "") {
  return Session([more] {
    pliant::SceneOverrides overrides;
    if (!more.empty()) overrides.set.push_back(more);
    return pliant::parse_scene(sheet_text, {}, "sheet", overrides);
  });
}

Vec3f position(const Session& session, Index vertex) {
  return session.simulation().state().positions.row(vertex).transpose().cast<float>();
}

void steps(Session& session, int count) {
  for (int i = 0; i < count; ++i) session.step();
}

/// Vertex 66 as a point of the triangle of it and its neighbors.
Pull pull_at_middle(const Session& session, Real stiffness) {
  Pull pull{{{66, 67, 78}, {0.4F, 0.3F, 0.3F}}, {}, stiffness};
  std::vector<Vec3f> all;
  for (Index i = 0; i < session.simulation().state().vertex_count(); ++i) all.push_back(position(session, i));
  pull.target = pull.point.position(all);
  return pull;
}

Vec3f grip(const Session& session, const Pull& pull) {
  Vec3f sum = Vec3f::Zero();
  for (int i = 0; i < 3; ++i) {
    sum +=
        pull.point.weights[i] * position(session, static_cast<Index>(pull.point.vertices[static_cast<std::size_t>(i)]));
  }
  return sum;
}

const Slider& slider(const std::vector<Slider>& list, std::string_view key) {
  const auto found = std::ranges::find(list, key, &Slider::key);
  REQUIRE(found != list.end());
  return *found;
}

const Parameter& find(const std::vector<Slider>& list, std::string_view key) {
  return slider(list, key).parameter;
}

}  // namespace

TEST_CASE("a pulled point of a triangle follows the mouse, and comes back when it is let go") {
  Session session = make_session("forces[0].velocity=[0,0,0]");
  session.set("settings.iterations", {30, 0, 0});
  steps(session, 300);
  session.move_pin(132, position(session, 132));  // the scene's move no longer acts
  steps(session, 300);
  Pull pull = pull_at_middle(session, 1e5);
  const Vec3f home = pull.target;
  session.grab(pull);
  const Vec3f to = home + Vec3f(0.1F, -0.3F, 0.1F);
  session.pull_to(to);
  steps(session, 60);
  CHECK((grip(session, pull) - to).norm() < 0.02F);
  CHECK(session.pull()->target == to);
  session.let_go();
  CHECK_FALSE(session.pull().has_value());
  steps(session, 1500);
  // A sheet between two hooks can come to rest in more than one fold; which one depends on the way it came.
  const Vec3f rest = grip(session, pull);
  CHECK((rest - home).norm() < 0.15F);
  steps(session, 100);
  CHECK((grip(session, pull) - rest).norm() < 1e-4F);
}

TEST_CASE("the strongest drag, yanked about, stays finite and comes back, at any time step") {
  for (const Real h : {1.0 / 60, 1.0}) {
    for (const Real stiffness : {1e3, 1e9}) {
      CAPTURE(h);
      CAPTURE(stiffness);
      Session session = make_session("forces[0].velocity=[0,0,0]");
      session.set("settings.time_step", {h, 0, 0});
      session.move_pin(132, position(session, 132));
      steps(session, 100);
      Pull pull = pull_at_middle(session, stiffness);
      session.grab(pull);
      std::mt19937 random(5);
      std::uniform_real_distribution<float> anywhere(-20, 20);
      for (int i = 0; i < 120; ++i) {
        session.pull_to({anywhere(random), anywhere(random), anywhere(random)});
        session.step();
      }
      REQUIRE(session.simulation().state().positions.allFinite());
      session.let_go();
      steps(session, h < 0.5 ? 1500 : 200);
      // Edges have about their length again: nothing hangs where the mouse has been.
      const pliant::Positions& x = session.simulation().state().positions;
      CHECK((x.row(0) - x.row(11)).norm() < 1.3);
      CHECK((x.row(0) - x.row(132)).norm() < 1.3);
      CHECK(session.simulation().state().velocities.rowwise().norm().maxCoeff() < 3);
    }
  }
}

TEST_CASE("pins are set, moved and taken away, those of the scene as well") {
  Session session = make_session();
  steps(session, 10);
  CHECK(session.is_pinned(132));
  CHECK_FALSE(session.is_pinned(5));
  session.pin(5);
  session.pin(5);
  const Vec3f held = position(session, 5);
  steps(session, 20);
  CHECK((position(session, 5) - held).norm() < 1e-6F);
  session.move_pin(5, held + Vec3f(0, -0.2F, 0.1F));
  session.move_pin(6, held);  // none
  steps(session, 2);
  CHECK((position(session, 5) - held - Vec3f(0, -0.2F, 0.1F)).norm() < 1e-5F);
  session.unpin(5);
  session.unpin(5);
  steps(session, 20);
  CHECK((position(session, 5) - held).norm() > 1e-3F);

  // The scene moves this one from 0.5 s on; the user takes it over.
  session.move_pin(132, {0, -0.5F, 1});
  steps(session, 60);
  CHECK((position(session, 132) - Vec3f(0, -0.5F, 1)).norm() < 1e-5F);
  session.unpin(132);
  CHECK_FALSE(session.is_pinned(132));
  CHECK(session.is_pinned(143));
  session.unpin(143);
  steps(session, 30);
  CHECK(position(session, 143).z() < 0.95F);
}

TEST_CASE("an event that can no longer act, since its pin was taken away, is left out and said") {
  Session session = make_session();
  session.unpin(132);
  steps(session, 60);
  CHECK(session.simulation().state().step == 60);
  CHECK(session.note().find("hooks") != std::string::npos);
}

TEST_CASE("a restart begins anew, with the values that were set or as the scene has them") {
  Session session = make_session();
  session.set("settings.iterations", {25, 0, 0});
  session.set("group:stretch.stiffness", {800, 0, 0});
  session.set("force:wind.velocity", {1, 2, 3});
  session.set("force:wind.model", {1, 0, 0});
  session.set("no such.thing", {1, 2, 3});
  session.pin(5);
  session.grab(pull_at_middle(session, 100));
  steps(session, 30);
  session.restart(true);
  CHECK(session.simulation().state().step == 0);
  CHECK(session.is_pinned(5));
  CHECK_FALSE(session.pull().has_value());
  CHECK(session.simulation().settings().iterations == 25);
  std::vector<Slider> list = session.sliders();
  CHECK(find(list, "group:stretch.stiffness").value[0] == 800);
  CHECK(find(list, "force:wind.velocity").value == pliant::Vec3(1, 2, 3));
  CHECK(find(list, "force:wind.model").value[0] == 1);
  session.restart(false);
  CHECK_FALSE(session.is_pinned(5));
  list = session.sliders();
  CHECK(session.simulation().settings().iterations == 10);
  CHECK(find(list, "group:stretch.stiffness").value[0] == 500);
  CHECK(find(list, "force:wind.model").value[0] == 0);
}

TEST_CASE("a restart keeps both ends of a range, wherever they went") {
  // min ≤ max holds after each change, but not in every order of the two.
  for (const auto& [low, high] : {std::pair{0.5, 0.8}, {1.2, 1.5}}) {
    Session session = make_session();
    const std::string min = "group:stretch.min_stretch", max = "group:stretch.max_stretch";
    session.set(low < 1 ? min : max, {low < 1 ? low : high, 0, 0});
    session.set(low < 1 ? max : min, {low < 1 ? high : low, 0, 0});
    CHECK_THROWS_AS(session.set(min, {high + 0.1, 0, 0}), pliant::Error);
    session.restart(true);
    const std::vector<Slider> list = session.sliders();
    CHECK(find(list, min).value[0] == low);
    CHECK(find(list, max).value[0] == high);
    steps(session, 3);
  }
}

TEST_CASE("pins that become soft stay where they were moved, and can be hard again") {
  Session session = make_session();
  const Vec3f up = position(session, 143) + Vec3f(0, 0, 0.1F);
  session.move_pin(143, up);
  session.set("group:hooks.hold", {1, 0, 0});
  CHECK(find(session.sliders(), "group:hooks.stiffness").value[0] == 1e5);
  steps(session, 60);
  CHECK((position(session, 143) - up).norm() < 1e-3F);
  CHECK((position(session, 143) - up).norm() > 0);  // a soft pin gives way
  session.set("group:hooks.hold", {0, 0, 0});
  session.step();
  CHECK((position(session, 143) - up).norm() < 1e-6F);
}

TEST_CASE("a restart that fails leaves the scene as it is") {
  bool is_broken = false;
  Session session([&] {
    if (is_broken) pliant::fail_input("the file has gone");
    return pliant::parse_scene(sheet_text, {}, "sheet");
  });
  steps(session, 5);
  is_broken = true;
  CHECK_THROWS_AS(session.restart(true), pliant::Error);
  CHECK(session.simulation().state().step == 5);
  session.step();
}

TEST_CASE("what was set of contact and of a body's own is set again after a restart, though the scene has none") {
  Session session = make_session();
  CHECK(find(session.sliders(), "contact.surfaces").value[0] == 0);
  session.set("contact.surfaces", {1, 0, 0});
  session.set("contact:sheet.friction", {0.8, 0, 0});
  session.set("contact:sheet.self", {0, 0, 0});
  const pliant::BodyContact expected{.friction = 0.8, .self = false};
  CHECK(session.simulation().contact(pliant::BodyId{0}) == expected);
  session.restart(true);
  CHECK(session.simulation().contact().surfaces);
  CHECK(session.simulation().contact(pliant::BodyId{0}) == expected);
  session.restart(false);
  CHECK_FALSE(session.simulation().contact().surfaces);
  CHECK(session.simulation().contact(pliant::BodyId{0}) == pliant::BodyContact{});
}

TEST_CASE("parameters have the names, units and ranges of their types, and refuse what these refuse") {
  Session session = make_session();
  session.grab(pull_at_middle(session, 100));
  session.pin(5);
  const std::vector<Slider> list = session.sliders();
  const Parameter& bend = find(list, "group:bend.stiffness");
  CHECK(bend.unit == "N·m");
  CHECK(slider(list, "group:bend.stiffness").heading == "hinge \"bend\"");
  CHECK(bend.value[0] == doctest::Approx(0.001));
  CHECK(find(list, "settings.time_step").unit == "s");
  CHECK(find(list, "settings.start").choices == std::vector<std::string>{"prediction", "positions", "adaptive"});
  CHECK(find(list, "force:gravity.acceleration").kind == ParameterKind::vector);
  CHECK(find(list, "force:wind.gust_strength").range.max == 1);
  CHECK(find(list, "group:stretch.min_stretch").value[0] == 1);
  CHECK(find(list, "group:hooks.hold").choices == std::vector<std::string>{"hard", "soft"});
  // Hard pins have no stiffness, and what the user holds is not the scene's.
  for (const Slider& each : list) {
    CHECK(each.key != "group:hooks.stiffness");
    CHECK(each.parameter.name.find("mouse") == std::string::npos);
    CHECK(each.parameter.name.find("hand") == std::string::npos);
  }
  CHECK_THROWS_AS(session.set("settings.time_step", {0, 0, 0}), pliant::Error);
  CHECK_THROWS_AS(session.set("settings.iterations", {2.5, 0, 0}), pliant::Error);
  CHECK_THROWS_AS(session.set("settings.start", {7, 0, 0}), pliant::Error);
  CHECK_THROWS_AS(session.set("group:bend.stiffness", {-1, 0, 0}), pliant::Error);
  CHECK_THROWS_AS(session.set("force:wind.gust_strength", {2, 0, 0}), pliant::Error);
  CHECK(find(session.sliders(), "force:wind.gust_strength").value[0] == 0);
}

TEST_CASE("a material is chosen where the body is; a restart keeps the choice, or forgets it") {
  Session session = make_session();
  const std::vector<BodyMaterial> before = session.materials();
  REQUIRE(before.size() == 1);
  CHECK(before.front().name == "sheet");
  CHECK(before.front().material.empty());
  const auto has = [&](const char* name) {
    return std::ranges::find(before.front().choices, name, &MaterialChoice::name) != before.front().choices.end();
  };
  CHECK(has("cotton"));
  CHECK_FALSE(has("foam"));
  steps(session, 5);
  const Vec3f place = position(session, 5);
  session.set("group:bend.stiffness", {0.002, 0, 0});
  session.set_material("sheet", "silk");
  CHECK(position(session, 5) == place);
  CHECK(session.materials().front().material == "silk");
  const pliant::SolverSettings good = pliant::settings_for_materials();
  CHECK(session.simulation().settings().integrator == good.integrator);
  CHECK(session.simulation().settings().acceleration == good.acceleration);
  CHECK(session.simulation().settings().iterations == good.iterations);
  CHECK(session.simulation().settings().start == good.start);
  const double damping = pliant::builtin_material("silk").surface.damping;
  CHECK(session.simulation().settings().damping == doctest::Approx(damping));
  session.set("settings.iterations", {35, 0, 0});
  session.set("group:sheet.bend.stiffness", {1e-4, 0, 0});
  steps(session, 3);
  session.restart(true);
  CHECK(session.materials().front().material == "silk");
  CHECK(session.simulation().settings().iterations == 35);
  CHECK(find(session.sliders(), "group:sheet.bend.stiffness").value[0] == 1e-4);
  // Of another material what was set of the last one's groups does not hold.
  session.set_material("sheet", "wool");
  session.restart(true);
  const double bending = std::get<pliant::SheetMaterial>(pliant::builtin_material("wool").of).bending;
  CHECK(find(session.sliders(), "group:sheet.bend.stiffness").value[0] == bending);
  CHECK(session.simulation().settings().iterations == 35);
  CHECK(session.simulation().settings().damping == doctest::Approx(pliant::builtin_material("wool").surface.damping));
  CHECK_THROWS_AS(session.set_material("sheet", "foam"), pliant::Error);
  CHECK_THROWS_AS(session.set_material("towel", "wool"), pliant::Error);
  CHECK(session.materials().front().material == "wool");
  session.restart(false);
  CHECK(session.materials().front().material.empty());
  CHECK(session.simulation().settings().iterations == 10);
  CHECK(find(session.sliders(), "group:bend.stiffness").value[0] == 0.001);
}

TEST_CASE("threads lie as the scene has them, also after a material without threads") {
  Session session([] {
    pliant::SceneOverrides overrides;
    overrides.set = {R"(bodies[0].material={"name": "silk", "direction": [0, 0, 1], "angle": 30})",
                     "bodies[0].constraints=[]", "moves=[]"};
    return pliant::parse_scene(sheet_text, {}, "sheet", overrides);
  });
  const auto angle = [&] { return find(session.sliders(), "group:sheet.warp.angle").value[0]; };
  CHECK(angle() == 30);
  session.set_material("sheet", "steel_sheet");
  session.set_material("sheet", "wool");
  CHECK(angle() == 30);
  session.set_material("sheet", "steel_sheet");
  session.restart(true);
  session.set_material("sheet", "wool");
  CHECK(angle() == 30);
}

}  // namespace test_session
