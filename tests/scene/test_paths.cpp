// Where moved targets are: straight ways, turns, keyframes, what they follow.
#include <numbers>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant_io/mesh/follow_cache.h"
#include "timeline_rig.h"

namespace test_paths {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real pi = std::numbers::pi;
constexpr Real not_a_number = std::numeric_limits<Real>::quiet_NaN();

Real distance(const Vec3& a, const Vec3& b) {
  return (a - b).norm();
}

/// Where the first pin, which begins at (0, 0, 1), is at the end of each step of 0.1 s.
std::vector<Vec3> way(std::shared_ptr<Path> path, int steps) {
  Rig rig;
  rig.timeline.start(rig.simulation, rig.pins, std::move(path));
  std::vector<Vec3> places;
  for (int i = 0; i < steps; ++i) {
    rig.advance(1);
    places.push_back(rig.vertex(12));
    CHECK(rig.vertex(12) == rig.pin(0));
  }
  return places;
}

}  // namespace

TEST_CASE("a straight path begins and ends exactly, and eases where it is told to") {
  const std::vector<Vec3> linear = way(straight_path(MoveKind::target, Vec3(1, 0, 1), 0.4), 6);
  const std::vector<Vec3> smooth = way(straight_path(MoveKind::offset, Vec3(1, 0, 0), 0.4, Ease::smooth), 6);
  const std::array<Real, 6> share = {0.25, 0.5, 0.75, 1, 1, 1};
  for (std::size_t i = 0; i < 6; ++i) {
    const Real s = share[i];
    CHECK(distance(linear[i], {s, 0, 1}) < 1e-15);
    CHECK(distance(smooth[i], {s * s * (3 - 2 * s), 0, 1}) < 1e-15);
  }
  CHECK(linear[3] == Vec3(1, 0, 1));
  CHECK(smooth[3] == Vec3(1, 0, 1));
}

TEST_CASE("a turn goes along the circle, over any angle") {
  for (const Real degrees : {90.0, -30.0, 720.0, 0.0}) {
    CAPTURE(degrees);
    const Rotation turn{.axis = {0, 2, 0}, .degrees = degrees};
    const std::vector<Vec3> places = way(rigid_path({{.time = 0.8, .rotate = turn}}, Vec3(0, 0, 0)), 10);
    for (std::size_t i = 0; i < places.size(); ++i) {
      const Real angle = degrees * pi / 180 * std::min<Real>(1, 0.125 * static_cast<Real>(i + 1));
      CHECK(distance(places[i], {std::sin(angle), 0, std::cos(angle)}) < 1e-14);  // z turns into x about y
      CHECK(std::abs(places[i].norm() - 1) < 1e-15);
    }
  }
}

TEST_CASE("without a center, pins turn about their mean, as one rigid body") {
  Rig rig;
  rig.timeline.start(rig.simulation, rig.pins, rigid_path({{.time = 0.5, .rotate = {{0, 0, 1}, 180}}}));
  rig.advance(2);
  CHECK(distance(rig.pin(0), Vec3(0.5 - 0.5 * std::cos(0.4 * pi), -0.5 * std::sin(0.4 * pi), 1)) < 1e-15);
  CHECK(distance(rig.pin(0), rig.pin(1)) == doctest::Approx(1).epsilon(1e-15));
  rig.advance(3);
  CHECK(distance(rig.pin(0), {1, 0, 1}) < 1e-15);
  CHECK(distance(rig.pin(1), {0, 0, 1}) < 1e-15);
}

TEST_CASE("keyframes are hit, linear and smooth, with several axes") {
  const std::vector<Keyframe> keys = {{.time = 0, .translate = {0, 0.1, 0}},
                                      {.time = 0.2, .translate = {1, 0, 0}, .rotate = {{1, 0, 0}, 90}},
                                      {.time = 0.5, .translate = {0, 2, 0}, .rotate = {{0, 1, 1}, 50}},
                                      {.time = 0.6}};
  const Vec3 start(0, 0, 1);
  const Vec3 center(0, 0, 0.5);
  for (const Ease ease : {Ease::linear, Ease::smooth}) {
    const std::vector<Vec3> places = way(rigid_path(keys, center, ease), 8);
    for (std::size_t k = 1; k < keys.size(); ++k) {
      const Vec3 w = keys[k].rotate.vector();
      const Vec3 turned = w.norm() > 0 ? Vec3(Eigen::AngleAxis<Real>(w.norm(), w.normalized()) * (start - center))
                                       : Vec3(start - center);
      const auto step = static_cast<std::size_t>(std::lround(10 * keys[k].time)) - 1;
      CHECK(distance(places[step], center + keys[k].translate + turned) < 1e-14);
    }
    CHECK(distance(places.back(), start) < 1e-15);
  }
}

TEST_CASE("smooth keyframes keep a parabola between them, and begin and end at rest") {
  // With velocities of a parabola at all inner keys, only the first and the last piece may leave it.
  std::vector<Keyframe> keys;
  for (const Real t : {0.0, 0.1, 0.4, 0.6}) keys.push_back({.time = t, .translate = {t * t, 0, 0}});
  const std::vector<Vec3> places = way(rigid_path(keys, {}, Ease::smooth), 6);
  for (const Real t : {0.2, 0.3})
    CHECK(places[static_cast<std::size_t>(std::lround(10 * t)) - 1][0] == doctest::Approx(t * t).epsilon(1e-13));
  const std::vector<Vec3> two = way(rigid_path({{.time = 0.4, .translate = {1, 0, 0}}}, {}, Ease::smooth), 3);
  CHECK(two[0][0] == doctest::Approx(0.15625).epsilon(1e-14));
  CHECK(two[1][0] == doctest::Approx(0.5).epsilon(1e-14));
}

TEST_CASE("a first key later than 0 begins where the points are, one alone at 0 is a jump") {
  const std::vector<Vec3> late = way(rigid_path({{.time = 0.4, .translate = {0, 4, 0}}}), 2);
  CHECK(distance(late[0], {0, 1, 1}) < 1e-15);
  CHECK(way(rigid_path({{.time = 0, .translate = {0, 4, 0}}}), 1)[0] == Vec3(0, 4, 1));
}

TEST_CASE("paths that are refused") {
  CHECK(contains(error_of([] { straight_path(MoveKind::target, {}, 1); }), "no point"));
  CHECK(contains(error_of([] { straight_path(MoveKind::target, Vec3(0, 0, 0), -1); }),
                 "the duration -1 s is out of range"));
  CHECK(contains(error_of([] { straight_path(MoveKind::target, Vec3(0, 0, 0), not_a_number); }), "s is out of range"));
  CHECK(contains(error_of([] { straight_path(MoveKind::target, Vec3(0, not_a_number, 0)); }), "not finite"));
  CHECK(contains(error_of([] { rigid_path({}); }), "the list is empty"));
  CHECK(contains(error_of([] { rigid_path({{.time = 1}, {.time = 1}}); }), "keyframes[1]: the time 1 s"));
  CHECK(contains(error_of([] { rigid_path({{.time = -1}}); }), "keyframes[0]: the time -1 s"));
  CHECK(contains(error_of([] { rigid_path({{.time = 1, .rotate = {{0, 0, 0}, 5}}}); }), "axis of length 0"));
  CHECK(contains(error_of([] { rigid_path({{.time = 1}}, Vec3(not_a_number, 0, 0)); }), "not finite"));
  Rig rig;
  const auto start = [&](std::shared_ptr<Path> path, std::vector<Index> numbers = {}) {
    return error_of([&] { rig.timeline.start(rig.simulation, rig.pins, std::move(path), numbers); });
  };
  CHECK(contains(start(straight_path(MoveKind::target, std::vector<Vec3>(3, Vec3(0, 0, 0)))), "3 points for 2"));
  CHECK(contains(start(straight_path(MoveKind::target, Vec3(0, 0, 0)), {2}), "index 2 is out of range"));
  CHECK(contains(start(straight_path(MoveKind::target, Vec3(0, 0, 0)), {-1}), "index -1 is out of range"));
  CHECK(contains(start(follow_body(rig.body)), "cannot follow the body that it holds"));
  CHECK(contains(start(follow_body(BodyId{7})), "body 7 does not exist"));
  const BodyId other = rig.simulation.add_body(chain({.links = 2}), Mass::total(1));
  CHECK(contains(start(follow_body(other, {3})), "vertex 3 is out of range"));
  CHECK(contains(start(follow_body(other, {0, 1, 2})), "3 vertices for 2"));
  CHECK(error_of([&] { rig.timeline.start(rig.simulation, rig.springs, follow_body(other)); }).find("no targets") !=
        std::string::npos);
}

namespace {

/// Two pinned vertices above a free body of two vertices, which falls.
struct Pair {
  Pair() {
    simulation = Simulation({.time_step = 0.1, .iterations = 2, .threads = 1});
    const BodyId held = simulation.add_body(mesh_of({{0, 0, 1}, {1, 0, 1}}), Mass::total(1));
    moving = simulation.add_body(mesh_of({{0.9, 0, 0}, {0.2, 0, 0.5}, {50, 0, 0}}), Mass::total(1),
                                 {.velocities = Vec3(0, 1, 0).transpose().replicate(3, 1)});
    pins = simulation.add(held, Position{});
  }
  Vec3 place(Index vertex) const { return row(simulation.state().positions, vertex); }

  Simulation simulation;
  Timeline timeline;
  BodyId moving{};
  GroupId pins{};
};

}  // namespace

TEST_CASE("pins follow the nearest vertices of a body, one step behind, in their distance") {
  Pair pair;
  pair.timeline.start(pair.simulation, pair.pins, follow_body(pair.moving));
  for (int step = 0; step < 5; ++step) {
    const Vec3 leader0 = pair.place(3);
    const Vec3 leader1 = pair.place(2);
    pair.timeline.step(pair.simulation);
    CHECK(distance(pair.place(0), leader0 + Vec3(-0.2, 0, 0.5)) < 1e-15);
    CHECK(distance(pair.place(1), leader1 + Vec3(0.1, 0, 1)) < 1e-15);
  }
  pair.timeline.stop(pair.simulation, pair.pins);
  const Vec3 place = pair.place(0);
  pair.timeline.step(pair.simulation);
  CHECK(pair.place(0) == place);
  CHECK(pair.timeline.is_over());
}

TEST_CASE("pins follow given vertices, exactly") {
  Pair pair;
  pair.timeline.start(pair.simulation, pair.pins, follow_body(pair.moving, {2, 0}, Attach::exact));
  pair.timeline.step(pair.simulation);
  CHECK(pair.place(0) == Vec3(50, 0, 0));
  CHECK(pair.place(1) == Vec3(0.9, 0, 0));
  pair.timeline.start(pair.simulation, pair.pins, follow_body(pair.moving, {1}, Attach::exact), {1});
  const Vec3 leader = pair.place(3);
  pair.timeline.step(pair.simulation);
  CHECK(pair.place(1) == leader);
  CHECK(pair.place(0) != Vec3(50, 0, 0));  // still follows
}

TEST_CASE("the nearest vertex is found as by trying all") {
  std::uint32_t seed = 5;
  const auto random = [&seed] { return static_cast<Real>((seed = seed * 1664525U + 1013904223U) >> 8U) / 16777216; };
  Mesh leaders;
  leaders.vertices.resize(300, 3);
  for (Index i = 0; i < 300; ++i) leaders.vertices.row(i) << std::round(9 * random()), random(), random() / 3;
  Mesh followers;
  followers.vertices.resize(200, 3);
  for (Index i = 0; i < 200; ++i) followers.vertices.row(i) << 12 * random() - 1, 2 * random() - 0.5, random();
  Simulation simulation;
  const BodyId held = simulation.add_body(followers, Mass::total(1));
  const BodyId moving = simulation.add_body(leaders, Mass::total(1));
  const GroupId pins = simulation.add(held, Position{});
  Timeline timeline;
  timeline.start(simulation, pins, follow_body(moving));
  const TimelineState state = timeline.state();
  REQUIRE(state.motions.size() == 1);
  for (Index i = 0; i < 200; ++i) {
    Index best = 0;
    (leaders.vertices.rowwise() - followers.vertices.row(i)).rowwise().squaredNorm().minCoeff(&best);
    CHECK(state.motions[0].numbers.points[static_cast<std::size_t>(i)].vertex == best);
  }
}

TEST_CASE("pins follow an animation, linear between its frames, and stay where it ends") {
  std::vector<Positions> frames(3, Positions::Zero(2, 3));
  frames[0] << 0, 0, 0, 1, 0, 0;
  frames[1] << 0, 2, 0, 1, 4, 0;
  frames[2] << 0, 2, 3, 1, 4, 5;
  const auto cache = [&] { return PointCache::from_frames(frames, {7, 7.2, 7.5}); };
  const std::vector<Vec3> nearest = way(follow_cache(cache()), 7);  // (0, 0, 1) above vertex 0
  CHECK(distance(nearest[0], {0, 1, 1}) < 1e-13);
  CHECK(distance(nearest[1], {0, 2, 1}) < 1e-13);
  CHECK(distance(nearest[3], {0, 2, 3}) < 1e-13);
  CHECK(distance(nearest[4], {0, 2, 4}) < 1e-13);
  CHECK(distance(nearest[6], {0, 2, 4}) < 1e-13);
  const std::vector<Vec3> exact = way(follow_cache(cache(), {1}, Attach::exact), 2);
  CHECK(distance(exact[1], {1, 4, 0}) < 1e-13);
  Rig rig;
  CHECK(contains(error_of([&] {
                   rig.timeline.start(rig.simulation, rig.pins, follow_cache(cache(), {0, 2}));
                 }),
                 "vertex 2 is out of range"));
}

}  // namespace test_paths
