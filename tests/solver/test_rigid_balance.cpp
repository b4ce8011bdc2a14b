// Free components that touch something are in balance as a whole after every step, however stiff they are and however
// few the iterations: weight and contact forces give them the momentum that they have.
#include <doctest/doctest.h>

#include "contact_scenes.h"

namespace test_rigid_balance {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real gravity = 9.81;

/// Of the weight. A motion must gain 1e-11 of the energies of inertia and contact: what is out of balance by 3.2e-6
/// does where contact does not resist, and by √51 times as much where it does, with k = 50 m/h². Figures below are
/// nearer where nothing in the scene is left to so little.
constexpr Real worth_no_motion = 2.4e-5;

/// The vertices of a body among all.
struct Range {
  Index first = 0, count = 0;
};

Range range_of(const Simulation& simulation, BodyId id) {
  return {simulation.vertex(id, 0), simulation.body(id).mesh.vertex_count()};
}

/// What a step of implicit Euler has left of the balance of a body, over its weight: weight + contact − M Δv/h, and the
/// same of torques about its middle, with its size as the arm.
struct Left {
  Real force = 0;
  Real torque = 0;
};

Left left_of(const Simulation& simulation, const Positions& velocities_before, Range range) {
  const State& state = simulation.state();
  Positions forces(range.count, 3);
  Real weight = 0;
  for (Index i = 0; i < range.count; ++i) {
    const Real mass = state.masses[static_cast<std::size_t>(range.first + i)];
    weight += mass * gravity;
    const Vec3 change = row(state.velocities, range.first + i) - row(velocities_before, range.first + i);
    forces.row(i) = (-mass * gravity * Vec3::UnitZ() - mass / simulation.settings().time_step * change).transpose();
  }
  for (const ContactPoint& each : simulation.contacts()) {
    const Index i = each.vertex - range.first;
    if (i >= 0 && i < range.count) forces.row(i) += each.force.transpose();
  }
  const auto places = state.positions.middleRows(range.first, range.count);
  const Vec3 middle = mean(places);
  Vec3 torque = Vec3::Zero();
  for (Index i = 0; i < range.count; ++i) torque += (row(places, i) - middle).cross(row(forces, i));
  const Real size = (places.colwise().maxCoeff() - places.colwise().minCoeff()).norm();
  return {forces.colwise().sum().norm() / weight, torque.norm() / (weight * size)};
}

/// The most that any of so many steps has left of the balance of a body.
Left most_left(Simulation& simulation, const std::vector<BodyId>& bodies, int steps) {
  Left most;
  for (int i = 0; i < steps; ++i) {
    const Positions before = simulation.state().velocities;
    simulation.step();
    for (const BodyId body : bodies) {
      const Left left = left_of(simulation, before, range_of(simulation, body));
      most.force = std::max(most.force, left.force);
      most.torque = std::max(most.torque, left.torque);
    }
  }
  return most;
}

SolverSettings ten_iterations() {
  return {.iterations = 10, .threads = 1};
}

/// Vertices in a row, flat on the plane z = 0 of a slope and a hair more than r above it, along neither axis.
BodyId add_row(Simulation& simulation, Index count, const Slope& slope, Real r) {
  Mesh mesh;
  mesh.vertices.resize(count, 3);
  const Vec3 along = (slope.down + 0.7 * slope.normal.cross(slope.down)).normalized();
  for (Index i = 0; i < count; ++i) {
    mesh.vertices.row(i) = (1.0005 * r * slope.normal + 0.1 * i * along).transpose();
    if (i > 0) mesh.edges.push_back({i - 1, i});
  }
  const BodyId body = simulation.add_body(std::move(mesh), Mass::per_vertex(0.02));
  if (count > 1) simulation.add(body, EdgeSpring{.stiffness = 1e4});
  return body;
}

BodyId add_box(Simulation& simulation, const Vec3& corner) {
  Mesh box = bar({.cells = {3, 3, 3}, .size = {0.2, 0.2, 0.2}});
  box.vertices.rowwise() += corner.transpose();
  const BodyId body = simulation.add_body(std::move(box), Mass::density(1000));
  simulation.add(body, TetrahedronStrain{.stiffness = 1e6});
  return body;
}

/// An edge that is to have a direction in space: a translation leaves it as it is, a rotation does not.
struct Aligned {
  static constexpr std::string_view name = "aligned";
  static constexpr int vertices = 2;
  static constexpr int rows = 1;
  static constexpr int fields = 3;
  static constexpr bool translation_invariant = true;
  static void project(const Real* field, const Real*, Real* p) { std::copy_n(field, 3, p); }
};

/// Turns the edges of a sheet towards those of the same sheet turned about y.
ConstraintSet aligned(const Mesh& mesh, Real angle) {
  auto batch = std::make_unique<Batch<Aligned>>(200);
  const std::array<Real, 2> difference = {-1, 1};
  const Mat3 turn = Eigen::AngleAxis<Real>(angle, Vec3::UnitY()).toRotationMatrix();
  for (Index i = 1; i < mesh.vertex_count(); ++i) {
    const std::array<Index, 2> ends = {i - 1, i};
    const Vec3 goal = turn * (row(mesh.vertices, i) - row(mesh.vertices, i - 1));
    batch->add(ends, difference, 1, {goal.data(), 3});
  }
  ConstraintSet set;
  set.count = batch->shape().count;
  set.batches.push_back(std::move(batch));
  return set;
}

/// How often the objective has risen in a step of ten iterations, but where friction was refreshed, and from the last
/// global solve to the end. Without friction a refresh is none.
Index rises(Simulation& simulation, Real friction) {
  const std::span<const Real> history = simulation.objective_history();
  Index count = 0;
  for (std::size_t k = 1; k < history.size(); ++k) {
    if (friction > 0 && (k == 3 || k == 8)) continue;
    if (history[k] > history[k - 1] * (1 + 1e-12)) ++count;
  }
  if (friction == 0 && simulation.evaluate().objective() > history.back() * (1 + 1e-12)) ++count;
  return count;
}

}  // namespace

TEST_CASE("rigid balance: a sheet that sticks or slides on a slope, in every step of ten iterations") {
  for (const Acceleration acceleration :
       {Acceleration::automatic, Acceleration::none, Acceleration::anderson, Acceleration::chebyshev}) {
    for (const Real degrees : {10.0, 17.0, 30.0}) {
      CAPTURE(degrees);
      SolverSettings settings = ten_iterations();
      settings.acceleration = acceleration;
      Simulation simulation(settings);
      const Slope slope(degrees);
      const BodyId sheet = add_sheet(simulation, {.vertices = 16}, slope.normal);
      simulation.add(Gravity{});
      simulation.add(PlaneCollider{.normal = slope.normal, .friction = 0.3});
      const Left left = most_left(simulation, {sheet}, 60);
      CHECK(simulation.contacts().size() == 256);
      CHECK(left.force < worth_no_motion);
      CHECK(left.torque < 1e-5);
    }
  }
}

TEST_CASE("rigid balance: a sheet on a turntable") {
  Simulation simulation(ten_iterations());
  const BodyId sheet = add_sheet(simulation, {.vertices = 8, .size = 0.2, .center = {0.5, 0, 0}}, Vec3::UnitZ());
  simulation.add(Gravity{});
  simulation.add(PlaneCollider{.angular_velocity = {0, 0, 2}, .friction = 0.3});
  const Left left = most_left(simulation, {sheet}, 60);
  CHECK(left.force < 1e-5);
  CHECK(left.torque < 1e-5);
}

TEST_CASE("rigid balance: a stiff box that falls on an edge and tumbles down a slope") {
  Simulation simulation(ten_iterations());
  const BodyId box = add_box(simulation, {-0.1, -0.1, 0.15});
  simulation.add(Gravity{});
  simulation.add(PlaneCollider{.normal = Slope(20).normal, .friction = 0.3});
  const Left left = most_left(simulation, {box}, 90);
  CHECK(left.force < 1e-5);
  CHECK(left.torque < 1e-5);
}

TEST_CASE("rigid balance: a vertex, a spring and a row of springs, which need not turn about themselves") {
  constexpr Real r = 0.02;
  const Slope slope(17);
  for (const Index count : {1, 2, 7}) {
    CAPTURE(count);
    Simulation simulation(ten_iterations());
    simulation.set_contact({.distance = r, .surfaces = false});
    const BodyId body = add_row(simulation, count, slope, r);
    simulation.add(Gravity{});
    simulation.add(PlaneCollider{.normal = slope.normal, .friction = 0.3});
    const Positions begin = simulation.state().positions;
    const Left left = most_left(simulation, {body}, 60);
    CHECK(left.force < 1e-5);
    const Positions way = simulation.state().positions - begin;
    const Real exact = slope.acceleration(0.3) * 61 / 120;  // h² n(n+1)/2 a
    for (Index i = 0; i < count; ++i) {
      CHECK(slope.down.dot(row(way, i)) == doctest::Approx(exact).epsilon(2e-3));
      CHECK(std::abs(Vec3::UnitY().dot(row(way, i))) < 1e-6);
    }
  }
}

TEST_CASE("rigid balance: several bodies at once, each by itself, beside a pinned one") {
  Simulation simulation(ten_iterations());
  const BodyId first = add_sheet(simulation, {.vertices = 10, .velocity = {1, 0, 0}}, Vec3::UnitZ());
  const BodyId second =
      add_sheet(simulation, {.vertices = 6, .velocity = {0, -0.5, 0}, .center = {5, 5, 0}}, Vec3::UnitZ());
  const BodyId pinned = add_sheet(simulation, {.vertices = 8, .center = {-5, 0, 0.3}}, Vec3::UnitZ());
  simulation.add(pinned, Position{.on = {0, 7}});
  const BodyId box = add_box(simulation, {3, 0, 0.1});
  simulation.add(Gravity{});
  simulation.add(PlaneCollider{.friction = 0.3});
  const Index corner = simulation.vertex(pinned, 0);
  const Vec3 pin = row(simulation.state().positions, corner);
  const Vec3 begin = row(simulation.state().positions, 0);
  const Left left = most_left(simulation, {first, second, box}, 60);
  CHECK(left.force < worth_no_motion);
  CHECK(left.torque < 1e-5);
  constexpr Real h = 1.0 / 60;
  Real exact = 0;
  for (Real speed = 1 - 0.3 * gravity * h; speed > 0; speed -= 0.3 * gravity * h) exact += speed * h;
  CHECK(row(simulation.state().positions, 0).x() - begin.x() == doctest::Approx(exact).epsilon(1e-3));
  CHECK(row(simulation.state().positions, corner) == pin);
  const Range range = range_of(simulation, pinned);
  CHECK(simulation.state().positions.middleRows(range.first, range.count).col(2).minCoeff() > 0);
  CHECK(simulation.state().positions.middleRows(range.first, range.count).col(2).minCoeff() < 0.1);
}

TEST_CASE("rigid balance: two sheets, one of which flutters and throws both up in the iterations") {
  Simulation simulation(ten_iterations());
  const BodyId sheet =
      add_sheet(simulation, {.vertices = 6, .velocity = {0, -0.5, 0}, .center = {5, 5, 0}}, Vec3::UnitZ());
  const BodyId pinned = add_sheet(simulation, {.vertices = 8, .center = {-5, 0, 0.3}}, Vec3::UnitZ());
  simulation.add(pinned, Position{.on = {0, 7}});
  simulation.add(Gravity{});
  simulation.add(PlaneCollider{.friction = 0.3});
  const Left left = most_left(simulation, {sheet}, 60);
  CHECK(left.force < 1e-5);
  CHECK(left.torque < 1e-5);
}

TEST_CASE("rigid balance: what the air pushes on is left to the iterations, what lies beside it is not") {
  for (const Index iterations :
       {10, 40}) {  // ten are too few for the one in the air: it slides on at centimeters a second
    CAPTURE(iterations);
    SolverSettings settings = ten_iterations();
    settings.iterations = iterations;
    Simulation simulation(settings);
    const BodyId sheet = add_sheet(simulation, {.vertices = 10}, Slope(17).normal);
    const BodyId dragged = add_sheet(simulation, {.vertices = 10, .center = {0, 5, 0.2}}, Slope(17).normal);
    simulation.add(dragged, Wind{.velocity = {0, 0, 0}, .drag = 2});
    simulation.add(Gravity{});
    simulation.add(PlaneCollider{.normal = Slope(17).normal, .friction = 0.5});
    CHECK(most_left(simulation, {sheet}, 240).force < worth_no_motion);
    if (iterations == 10) continue;
    const Range range = range_of(simulation, dragged);
    Vec3 force = Vec3::Zero();
    for (const ContactPoint& each : simulation.contacts()) {
      if (each.vertex >= range.first) force += each.force;
    }
    CHECK((force / (0.2 * gravity) - Vec3::UnitZ()).norm() < 1e-5);
    CHECK(simulation.state().velocities.rowwise().norm().maxCoeff() < 1e-6);
  }
}

TEST_CASE("rigid balance: what a rotation does not leave as it is, is only translated") {
  Simulation simulation(ten_iterations());
  const BodyId sheet = add_sheet(simulation, {.vertices = 8}, Vec3::UnitZ());
  simulation.add_set(sheet, aligned(simulation.body(sheet).mesh, 0.1), "aligned");
  simulation.add(Gravity{});
  simulation.add(PlaneCollider{.friction = 0.0});
  Index risen = 0;
  Left left;
  for (int i = 0; i < 60; ++i) {
    left = most_left(simulation, {sheet}, 1);
    CHECK(left.force < 1e-5);
    risen += rises(simulation, 0);
  }
  CHECK(risen == 0);
  CHECK(left.torque > 1e-3);  // from the directions in space
  CHECK(simulation.contacts().size() < 64);
}

TEST_CASE("rigid balance: the objective never rises") {
  for (const Real friction : {0.0, 0.3}) {
    CAPTURE(friction);
    Simulation simulation(ten_iterations());
    add_sheet(simulation, {.vertices = 12, .velocity = {0.5, 0, 0}}, Slope(17).normal);
    add_box(simulation, {0.5, 2, 0.1});
    simulation.add(Gravity{});
    simulation.add(PlaneCollider{.normal = Slope(17).normal, .friction = friction});
    Index risen = 0;
    for (int i = 0; i < 60; ++i) {
      simulation.step();
      CHECK(simulation.objective_history().size() == 10);
      risen += rises(simulation, friction);
    }
    CHECK(risen == 0);
  }
}

TEST_CASE("rigid balance: the same bits for any number of threads") {
  const auto run = [](Index threads) {
    SolverSettings settings = ten_iterations();
    settings.threads = threads;
    Simulation simulation(settings);
    add_sheet(simulation, {.vertices = 30}, Slope(16).normal);
    add_sheet(simulation, {.vertices = 24, .center = {0, 3, 0}}, Slope(16).normal);
    add_box(simulation, {0, -2, 0.1});
    simulation.add(Gravity{});
    simulation.add(PlaneCollider{.normal = Slope(16).normal, .angular_velocity = {0, 0, 0.5}, .friction = 0.3});
    for (int i = 0; i < 20; ++i) simulation.step();
    return simulation.state();
  };
  const State one = run(1);
  for (const Index threads : {2, 3, 8}) {
    CAPTURE(threads);
    const State other = run(threads);
    CHECK(std::ranges::equal(one.positions.reshaped(), other.positions.reshaped()));
    CHECK(std::ranges::equal(one.velocities.reshaped(), other.velocities.reshaped()));
  }
}

}  // namespace test_rigid_balance
