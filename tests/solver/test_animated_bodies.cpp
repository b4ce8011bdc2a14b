// Bodies that go where they are told: what is free is pushed and carried by them, and passes through none of them.
#include <cmath>
#include <cstring>
#include <numbers>

#include <doctest/doctest.h>

#include "pliant/collision/crossings.h"
#include "pliant/core/error.h"
#include "pliant/timeline/animated_body.h"
#include "tests/pairs/pair_scene.h"
#include "tests/pairs/parts.h"
#include "tests/scene/whole_scenes.h"

namespace test_animated_bodies {

using namespace pliant;
using namespace pliant_tests;

namespace {

struct Rig {
  Simulation simulation;
  Timeline timeline = {};
  BodyId cloth = {};
  BodyId figure = {};
  GroupId held = {};

  StepReport step() { return timeline.step(simulation); }
  Positions places(BodyId id) const {
    const Body& body = simulation.body(id);
    return simulation.state().positions.middleRows(body.first_vertex, body.mesh.vertex_count());
  }
};

/// A curtain of n² vertices that hangs in the plane y = 0 by its upper border, and behind it a ball that goes through
/// that plane, 0.9 m in all, at a speed [m/s].
Rig ball_and_curtain(Real speed, const SolverSettings& settings = {.threads = 1}, Real density = 1) {
  const Index n = runs_whole_scenes ? 17 : 9;
  Rig rig{Simulation(settings)};
  rig.simulation.add(Gravity{});
  rig.cloth = add_cloth(rig.simulation, sheet_mesh(n, 1, {-0.5, 0, -0.5}, Plane::xz));
  rig.simulation.add(rig.cloth, Position{.on = [&] {
                       std::vector<Index> border;
                       for (Index i = n * (n - 1); i < n * n; ++i) border.push_back(i);
                       return border;
                     }()});
  Mesh ball = sphere({.subdivisions = 2, .radius = 0.2});
  ball.vertices.rowwise() += Vec3(0.01, -0.3, -0.02).transpose();
  rig.figure = rig.simulation.add_body(std::move(ball), Mass::area_density(density), {.name = "ball"});
  const auto path = straight_path(MoveKind::offset, Vec3(0, 0.9, 0), 0.9 / speed);
  rig.held = animate(rig.simulation, rig.timeline, rig.figure, path);
  rig.simulation.set_contact({.friction = 0.3, .surfaces = true});
  return rig;
}

/// Crossings with the cloth or within it; what is held may cross itself.
Index crossings_of_cloth(const Rig& rig) {
  std::vector<Triangle> triangles;
  for (const Body& body : rig.simulation.bodies()) {
    for (Triangle each : surface_triangles(body.mesh)) {
      for (Index& vertex : each) vertex += body.first_vertex;
      triangles.push_back(each);
    }
  }
  const Index end_of_cloth = rig.simulation.body(rig.cloth).mesh.vertex_count();
  Index count = 0;
  visit_crossings({rig.simulation.state().positions, triangles}, [&](const Crossing& crossing) {
    const Index corner = triangles[static_cast<std::size_t>(crossing.triangle)][0];
    if (crossing.edge[0] < end_of_cloth || corner < end_of_cloth) ++count;
  });
  return count;
}

/// How far the vertices of the figure are from the targets of the last step [m].
Real largest_lag(const Rig& rig) {
  const Positions x = rig.places(rig.figure);
  Real largest = 0;
  for (Index i = 0; i < static_cast<Index>(x.rows()); ++i) {
    largest = std::max(largest, (row(x, i) - rig.simulation.target(rig.held, i)).norm());
  }
  return largest;
}

bool same_bits(const Positions& a, const Positions& b) {
  return a.rows() == b.rows() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(Real)) == 0;
}

Index steps_of(Real seconds) {
  return runs_whole_scenes ? static_cast<Index>(std::lround(seconds * 60)) : 4;
}

/// A floor of n² vertices on which a wave of 0.06 m runs along x, a period a second.
class Wave final : public PointAnimation {
 public:
  explicit Wave(Positions flat) : flat_(std::move(flat)) {}

  Index point_count() const override { return static_cast<Index>(flat_.rows()); }
  Real duration() const override { return 10; }
  void sample(Real elapsed, Positions& positions) override {
    positions = flat_;
    for (Index i = 0; i < point_count(); ++i) {
      positions(i, 2) +=
          0.03 * std::min<Real>(1, 2 * elapsed) * std::sin(2 * std::numbers::pi * (flat_(i, 0) - elapsed));
    }
  }

 private:
  Positions flat_;
};

/// A sheet 2 cm above a larger one that is told where to go.
Rig sheet_on(std::shared_ptr<Path> path, Real friction, const SolverSettings& settings = {.threads = 1}) {
  Rig rig{Simulation(settings)};
  rig.simulation.add(Gravity{});
  rig.cloth = add_cloth(rig.simulation, sheet_mesh(9, 0.4, {-0.2, -0.2, 0.02}));
  rig.figure = rig.simulation.add_body(sheet_mesh(runs_whole_scenes ? 21 : 11, 1.2, {-0.6, -0.6, 0}),
                                       Mass::area_density(1), {.name = "floor"});
  if (path == nullptr) path = play(std::make_shared<Wave>(rig.simulation.body(rig.figure).mesh.vertices));
  rig.held = animate(rig.simulation, rig.timeline, rig.figure, std::move(path));
  rig.simulation.set_contact({.distance = 0.015, .friction = friction, .surfaces = true});
  return rig;
}

/// By how much a sheet has turned about z since it began [rad], at most half a turn.
Real turn_of(const Rig& rig) {
  const Positions x = rig.places(rig.cloth);
  const Positions& rest = rig.simulation.body(rig.cloth).mesh.vertices;
  const Vec3 across = row(x, 8) - row(x, 0);
  const Vec3 before = row(rest, 8) - row(rest, 0);
  return std::atan2(before.x() * across.y() - before.y() * across.x(), before.x() * across.x());
}

}  // namespace

TEST_CASE("animated bodies: a ball goes through the plane of a curtain, which swings out of its way") {
  for (const Index substeps : {1, 3}) {
    CAPTURE(substeps);
    Rig rig = ball_and_curtain(1, {.substeps = substeps, .threads = 1});
    Index active = 0;
    for (Index i = 0; i < steps_of(1.2); ++i) {
      const ContactReport contact = rig.step().contact;
      active += contact.active;
      CHECK(contact.lag == 0);
      CHECK(largest_lag(rig) == 0);
      REQUIRE(crossings_of_cloth(rig) == 0);
    }
    if (!runs_whole_scenes) continue;
    CHECK(active > 100);
    CHECK(rig.places(rig.cloth).col(1).maxCoeff() > 0.3);
    CHECK((rig.places(rig.figure) - rig.simulation.body(rig.figure).mesh.vertices).col(1).minCoeff() ==
          doctest::Approx(0.9).epsilon(1e-14));
  }
}

TEST_CASE("animated bodies: one that is held up reports its lag, and makes up for it") {
  Rig rig = ball_and_curtain(54);  // its whole way in one step
  Real largest = 0;
  for (Index i = 0; i < steps_of(0.6); ++i) {
    const Real lag = rig.step().contact.lag;
    CHECK(lag == doctest::Approx(largest_lag(rig)));
    largest = std::max(largest, lag);
    REQUIRE(crossings_of_cloth(rig) == 0);
  }
  if (!runs_whole_scenes) return;
  CHECK(largest > 0.001);
  CHECK(largest < 0.5);
  CHECK(largest_lag(rig) == 0);
}

TEST_CASE("animated bodies: what one would run into within a step is taken along from its start") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    Rig rig = ball_and_curtain(8, {.integrator = integrator, .threads = 1});  // 0.13 m a step, of a curtain at rest
    Real farthest = 0;
    for (Index i = 0; i < steps_of(0.4); ++i) {
      CHECK(rig.step().contact.lag == 0);
      farthest = std::max(farthest, rig.places(rig.cloth).col(1).maxCoeff());
      REQUIRE(crossings_of_cloth(rig) == 0);
    }
    if (runs_whole_scenes) CHECK(farthest > 0.7);
  }
}

TEST_CASE("animated bodies: however fast one goes, nothing passes through it") {
  for (const Index iterations : {1, 10}) {
    CAPTURE(iterations);
    Rig rig = ball_and_curtain(10, {.iterations = iterations, .threads = 1});
    for (Index i = 0; i < steps_of(0.5); ++i) {
      rig.step();
      REQUIRE(crossings_of_cloth(rig) == 0);
    }
  }
}

TEST_CASE("animated bodies: what they weigh changes nothing") {
  Rig light = ball_and_curtain(1, {.threads = 1}, 0.01);
  Rig heavy = ball_and_curtain(1, {.threads = 1}, 100);
  for (Index i = 0; i < steps_of(0.7); ++i) light.step(), heavy.step();
  CHECK(same_bits(light.places(light.cloth), heavy.places(heavy.cloth)));
}

TEST_CASE("animated bodies: the same bits for any number of threads") {
  Positions expected;
  for (const Index threads : {1, 2, 3, 8}) {
    CAPTURE(threads);
    Rig rig = ball_and_curtain(3, {.threads = threads});
    for (Index i = 0; i < steps_of(0.4); ++i) rig.step();
    if (threads == 1) expected = rig.simulation.state().positions;
    CHECK(same_bits(rig.simulation.state().positions, expected));
  }
}

TEST_CASE("animated bodies: a turning floor takes a sheet along by friction alone" *
          doctest::skip(!runs_whole_scenes)) {
  const Real speed = 0.8;  // rad/s
  for (const Real friction : {0.5, 0.0}) {
    CAPTURE(friction);
    Rig rig = sheet_on(steady_path(Vec3::Zero(), {0, 0, speed}, Vec3(0, 0, 0)), friction);
    Real before = 0;
    for (Index i = 0; i < steps_of(3); ++i) {
      if (i == steps_of(2)) before = turn_of(rig);
      CHECK(rig.step().contact.lag == 0);
    }
    CHECK(crossings_of_cloth(rig) == 0);
    const Real turned = turn_of(rig) - before;  // in the last second
    if (friction > 0) {
      CHECK(turned == doctest::Approx(speed).epsilon(0.02));
      CHECK(rig.places(rig.cloth).leftCols(2).colwise().mean().norm() < 0.005);
    } else {
      CHECK(std::abs(turned) < 0.02);
    }
  }
}

TEST_CASE("animated bodies: a wave that runs through the floor lifts a sheet") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    Rig rig = sheet_on(nullptr, 0.3, {.integrator = integrator, .substeps = 2, .threads = 1});
    Wave wave(rig.simulation.body(rig.figure).mesh.vertices);
    Real lowest = 1;
    Real highest = 0;
    for (Index i = 0; i < steps_of(3); ++i) {
      CHECK(rig.step().contact.lag == 0);
      Positions expected;
      wave.sample(rig.simulation.state().time, expected);
      REQUIRE((rig.places(rig.figure) - expected).cwiseAbs().maxCoeff() < 1e-14);
      REQUIRE(crossings_of_cloth(rig) == 0);
      const Real height = rig.places(rig.cloth).col(2).mean();
      lowest = std::min(lowest, height);
      highest = std::max(highest, height);
    }
    if (!runs_whole_scenes) continue;
    CHECK(highest - lowest > 0.03);
    CHECK(highest < 0.06);
  }
}

TEST_CASE("animated bodies: a still one holds, and one that is let go falls") {
  Rig rig = sheet_on(steady_path(Vec3::Zero()), 0.3);
  const Positions before = rig.places(rig.figure);
  for (Index i = 0; i < steps_of(1); ++i) rig.step();
  CHECK(same_bits(rig.places(rig.figure), before));
  CHECK(rig.simulation.groups().at(rig.held).name == "floor.animation");
  rig.simulation.remove(rig.held);
  for (Index i = 0; i < 4; ++i) rig.step();
  CHECK(rig.places(rig.figure).col(2).maxCoeff() < -0.001);
}

TEST_CASE("animated bodies: an animation plays again and again, or fits not at all") {
  Rig rig = sheet_on(steady_path(Vec3::Zero()), 0.3);
  const auto wave = std::make_shared<Wave>(rig.simulation.body(rig.figure).mesh.vertices);
  const auto endless = repeated(wave);
  Positions once, again;
  wave->sample(0.25, once);
  endless->sample(30.25, again);
  CHECK(same_bits(once, again));
  CHECK(endless->duration() == Path::endless);
  CHECK(endless->point_count() == wave->point_count());
  const auto other = std::make_shared<Wave>(sheet_mesh(4, 1, Vec3::Zero()).vertices);
  const std::size_t groups = rig.simulation.groups().size();
  CHECK_THROWS_AS(animate(rig.simulation, rig.timeline, rig.figure, play(other)), Error);
  CHECK(rig.simulation.groups().size() == groups);
  CHECK_THROWS_AS(steady_path({0, 0, std::nan("")}), Error);
}

}  // namespace test_animated_bodies
