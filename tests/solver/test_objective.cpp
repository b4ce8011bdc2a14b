// What each iteration of a step promises.
#include <doctest/doctest.h>

#include "../core/random.h"
#include "../simulation/everything.h"
#include "../simulation/run.h"
#include "pliant/core/error.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/topology.h"
#include "pliant/solver/local/local_step.h"

namespace test_objective {

using namespace pliant;
using namespace pliant_tests;

namespace {

struct NamedSimulation {
  std::string name;
  Simulation simulation;
};

/// A sheet crumpled at random, free to fall apart or spring back.
Simulation crumpled(const SolverSettings& settings, Orientation orientation) {
  Random random;
  Simulation simulation(settings);
  const Mesh mesh = torus({.major_segments = 12, .minor_segments = 8});
  const BodyId body =
      simulation.add_body(mesh, Mass::total(1), {.start = mesh.vertices + random.positions(mesh.vertex_count(), 0.2)});
  simulation.add(body, EdgeSpring{.stiffness = 1e4});
  simulation.add(body, Bending{.stiffness = 1, .orientation = orientation});
  simulation.add(body, HingeBending{.stiffness = 1, .orientation = orientation});
  return simulation;
}

/// A bar turned inside out at random.
Simulation inverted(const SolverSettings& settings) {
  Random random;
  Simulation simulation(settings);
  const Mesh mesh = bar({.cells = {4, 2, 2}});
  const BodyId body =
      simulation.add_body(mesh, Mass::density(1000), {.start = random.positions(mesh.vertex_count(), 0.5)});
  simulation.add(body, TetrahedronStrain{.stiffness = 1e6, .min_stretch = 0.8, .max_stretch = 1.2});
  simulation.add(body, Position{.on = {0, 1}});
  add_gravity(simulation);
  return simulation;
}

std::vector<NamedSimulation> varied_simulations(const SolverSettings& settings) {
  std::vector<NamedSimulation> all;
  all.push_back({"everything", everything(settings, 8)});
  all.push_back({"crumpled, absolute", crumpled(settings, Orientation::absolute)});
  all.push_back({"crumpled, signed", crumpled(settings, Orientation::signed_)});
  all.push_back({"inverted", inverted(settings)});
  return all;
}

std::vector<ConstraintGroup*> batches_of(const Simulation& simulation) {
  std::vector<ConstraintGroup*> batches;
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) batches.push_back(batch.get());
  }
  return batches;
}

Real rounding_of_linear_forces(const Simulation& simulation) {
  const Positions& q = simulation.state().positions;
  LocalStep local;
  local.set_groups(simulation.state().vertex_count(), batches_of(simulation));
  const std::vector<Real> weights(simulation.state().masses.size(), 0);
  const std::vector<char> none(weights.size(), 0);
  Positions forces = q;
  ThreadPool threads(1);
  return local.run(q, q, weights, none, forces, threads).rounding;
}

/// Down to 1e-24 J, the square of what a position is rounded by, and to what the rounding of linear forces makes.
/// @return the moves that were taken back
Index check_descent(Simulation& simulation) {
  const StepReport report = simulation.step();
  std::vector<Real> history(simulation.objective_history().begin(), simulation.objective_history().end());
  history.push_back(simulation.evaluate().objective());
  const Real rounding = 1e-24 + rounding_of_linear_forces(simulation);
  REQUIRE(history.size() == static_cast<std::size_t>(simulation.settings().iterations) + 1);
  for (std::size_t k = 1; k < history.size(); ++k) CHECK(history[k] <= history[k - 1] * (1 + 1e-12) + rounding);
  return report.backtracks;
}

}  // namespace

TEST_CASE("the objective never rises, in no iteration of no step") {
  for (const Acceleration acceleration :
       {Acceleration::none, Acceleration::lbfgs, Acceleration::anderson, Acceleration::chebyshev}) {
    Index backtracks = 0;
    for (const Real time_step : {1.0 / 240, 1.0 / 60, 1.0}) {
      for (const Start start : {Start::prediction, Start::positions, Start::adaptive}) {
        const SolverSettings settings{
            .time_step = time_step, .iterations = 25, .acceleration = acceleration, .start = start};
        for (auto& varied : varied_simulations(settings)) {
          CAPTURE(varied.name);
          CAPTURE(time_step);
          CAPTURE(static_cast<int>(acceleration));
          for (int step = 0; step < 20; ++step) backtracks += check_descent(varied.simulation);
        }
      }
    }
    CHECK((backtracks > 0) == (acceleration != Acceleration::none));  // crumpled bodies need them
  }
}

/// s = q + h v + h² M⁻¹ f of the step that comes next.
Positions prediction(const Simulation& simulation) {
  const State& state = simulation.state();
  const Real h = simulation.settings().time_step;
  Positions f = Positions::Zero(state.vertex_count(), 3);
  for (const auto& [id, force] : simulation.forces()) force->add_to(f, state.view(), h);
  const Eigen::Map<const Eigen::VectorXd> masses(state.masses.data(), state.vertex_count());
  return state.positions + h * state.velocities + h * h * masses.cwiseInverse().asDiagonal() * f;
}

TEST_CASE("the residual is the largest gradient of the objective on a vertex that is not pinned") {
  constexpr Real difference = 1e-6;
  for (auto& varied : varied_simulations({.iterations = 3})) {
    Simulation& simulation = varied.simulation;
    CAPTURE(varied.name);
    advance(simulation, 3);
    const Positions s = prediction(simulation);
    simulation.step();
    const Real residual = simulation.evaluate().residual;

    const Real h = simulation.settings().time_step;
    std::vector<ConstraintGroup*> batches = batches_of(simulation);
    for (const auto& [id, force] : simulation.forces()) {
      for (ConstraintGroup* group : force->groups()) batches.push_back(group);
    }
    std::vector<char> is_pinned(simulation.state().masses.size(), 0);
    for (const ConstraintGroup* batch : batches) {
      for (const Index vertex : batch->pinned_vertices()) is_pinned[static_cast<std::size_t>(vertex)] = 1;
    }
    std::vector<Real> weights;
    for (const Real mass : simulation.state().masses) weights.push_back(mass / (h * h));
    LocalStep local;
    local.set_groups(simulation.state().vertex_count(), batches);
    ThreadPool threads(1);
    Positions q = simulation.state().positions;
    Positions unused = q;
    const auto objective_at = [&](Real& coordinate, Real x) {
      const Real before = std::exchange(coordinate, x);
      const LocalResult found = local.run(q, s, weights, is_pinned, unused, threads);
      coordinate = before;
      return found.inertia + found.elastic;
    };
    Real largest = 0;
    for (Index i = 0; i < q.rows(); ++i) {
      if (is_pinned[static_cast<std::size_t>(i)]) continue;
      Vec3 gradient;
      for (int axis = 0; axis < 3; ++axis) {
        Real& x = q(i, axis);
        gradient[axis] = (objective_at(x, x + difference) - objective_at(x, x - difference)) / (2 * difference);
      }
      largest = std::max(largest, gradient.norm());
    }
    CHECK(residual == doctest::Approx(largest).epsilon(1e-5));
  }
}

TEST_CASE("after a replaced state there is no inertia term, and a refused step leaves none behind") {
  Simulation simulation = everything({}, 5);
  advance(simulation, 5);
  CHECK(simulation.evaluate().inertia > 0);
  const Positions q = simulation.state().positions;
  simulation.set_state(q, simulation.state().velocities);
  CHECK(simulation.evaluate().inertia == 0);
}

TEST_CASE("a tolerance ends the iterations early, and the step is converged to it") {
  Simulation simulation = everything({.iterations = 100000, .tolerance = 1e-6}, 4);
  for (int step = 0; step < 3; ++step) {
    const StepReport report = simulation.step();
    CHECK(report.reached_tolerance);
    CHECK(report.iterations < 100000);
    CHECK(report.residual <= 1e-6);
    CHECK(simulation.evaluate().residual == doctest::Approx(report.residual).epsilon(1e-12));
  }
  Simulation few = everything({.iterations = 7, .tolerance = 1e-6}, 6);
  const StepReport report = few.step();
  CHECK_FALSE(report.reached_tolerance);
  CHECK(report.iterations == 7);
}

TEST_CASE("what evaluate() finds after a step has the friction of surfaces that slid in it") {
  Simulation simulation({.iterations = 1000, .tolerance = 1e-8, .threads = 1});
  add_gravity(simulation);
  simulation.set_contact({.distance = 0.01, .friction = 0.3, .surfaces = true});
  const BodyId table = simulation.add_body(grid({.columns = 5, .rows = 5, .plane = Plane::xy}), Mass::per_vertex(0.01));
  simulation.add(table, Position{});
  Mesh sheet = grid({.columns = 4, .rows = 4, .size = {0.3, 0.3}, .plane = Plane::xy});
  sheet.vertices.rowwise() += Vec3(0.31, 0.32, 0.00999).transpose();
  const Positions velocities = Vec3(1, 0, 0).transpose().replicate(sheet.vertex_count(), 1);
  const BodyId cloth = simulation.add_body(sheet, Mass::area_density(0.2), {.velocities = velocities});
  simulation.add(cloth, TriangleStrain{.stiffness = 1e3});
  for (int step = 0; step < 3; ++step) {
    const StepReport report = simulation.step();
    CHECK(report.contact.active > 0);
    const Evaluation evaluation = simulation.evaluate();
    CHECK(evaluation.residual == doctest::Approx(report.residual).epsilon(1e-6));
    CHECK(evaluation.objective() == doctest::Approx(simulation.objective_history().back()).epsilon(1e-9));
  }
}

TEST_CASE("every step iterates at least once, whatever the tolerance") {
  Simulation simulation({.tolerance = 1e6, .start = Start::positions});
  const BodyId cloth = simulation.add_body(grid({.columns = 4, .rows = 4}), Mass::per_vertex(1e-3));
  simulation.add(cloth, EdgeSpring{});
  add_gravity(simulation);
  const Real begin = simulation.state().positions.col(2).mean();
  for (int step = 0; step < 60; ++step) {
    const StepReport report = simulation.step();
    CHECK(report.iterations == 1);
    CHECK(report.reached_tolerance);
  }
  CHECK(simulation.state().positions.col(2).mean() - begin == doctest::Approx(-9.81 / 2).epsilon(0.03));
}

TEST_CASE("both starts lead to the same converged step, and differ before") {
  const auto run = [](Start start, Index iterations) {
    Simulation simulation = everything({.iterations = iterations, .tolerance = 1e-9, .start = start}, 4);
    simulation.step();
    return simulation.state().positions;
  };
  CHECK(largest_difference(run(Start::prediction, 100000), run(Start::positions, 100000)) < 1e-9);
  CHECK(largest_difference(run(Start::prediction, 1), run(Start::positions, 1)) > 1e-5);
}

TEST_CASE("before the first step, evaluate() gives the energy of the start alone") {
  Simulation simulation = crumpled({}, Orientation::absolute);
  const Evaluation evaluation = simulation.evaluate();
  CHECK(evaluation.inertia == 0);
  CHECK(evaluation.elastic > 0);
  Real sum = 0;
  for (const auto& [id, group] : simulation.groups()) sum += simulation.elastic_energy(id);
  CHECK(sum == doctest::Approx(evaluation.elastic).epsilon(1e-13));
}

TEST_CASE("the back ends agree") {
  const auto run = [](Backend backend) {
    Simulation simulation = everything({.iterations = 10, .backend = backend, .precision = Precision::double_}, 10);
    advance(simulation, 10);
    CHECK(simulation.backend() == (backend == Backend::eigen ? "eigen" : "cholmod"));
    return simulation.state().positions;
  };
  const Positions eigen = run(Backend::eigen);
  try {
    const Positions cholmod = run(Backend::cholmod);
    CHECK(largest_difference(cholmod, eigen) < 1e-10);
  } catch (const Error& error) {
    MESSAGE("skipped: ", std::string(error.what()));
  }
}

TEST_CASE("an unloaded body at rest stays, wherever it is and however it is turned") {
  std::vector<Mesh> meshes = {grid({.columns = 8, .rows = 6}), torus({.major_segments = 12, .minor_segments = 8}),
                              sphere({.subdivisions = 2}), bar({.cells = {4, 2, 2}})};
  meshes.back().triangles = boundary_triangles(meshes.back().tetrahedra);
  Random random;
  for (const Mesh& mesh : meshes) {
    for (const Orientation orientation : {Orientation::absolute, Orientation::signed_}) {
      for (int place = 0; place < 3; ++place) {
        Simulation simulation({.iterations = 2, .threads = 1});
        Positions start = mesh.vertices;
        if (place == 1) start.rowwise() += Eigen::RowVector3d(3, -2, 1);
        if (place == 2) start = (start * random.rotation()).rowwise() + Eigen::RowVector3d(-0.3, 0.2, 0.5);
        const BodyId body = simulation.add_body(mesh, Mass::total(1), {.start = start});
        simulation.add(body, EdgeSpring{.stiffness = 1e3});
        simulation.add(body, TriangleStrain{.stiffness = 100});
        simulation.add(body, TetrahedronStrain{.stiffness = 1e5});
        simulation.add(body, Bending{.stiffness = 0.1, .orientation = orientation});
        simulation.add(body, HingeBending{.stiffness = 0.1, .orientation = orientation});
        advance(simulation, 600);
        const Real size = bounding_box(start).diagonal();
        CAPTURE(mesh.vertex_count());
        CAPTURE(place);
        CHECK((simulation.state().positions - start).rowwise().norm().maxCoeff() < 1e-12 * size);
      }
    }
  }
}

TEST_CASE("strain alone keeps an unloaded body at rest to the last bit: rounding has no torque") {
  Random random;
  for (const Mesh& mesh : {grid({.columns = 8, .rows = 6}), torus({.major_segments = 12, .minor_segments = 8}),
                           bar({.cells = {4, 2, 2}})}) {
    for (const Real stiffness : {1e3, 1e7}) {
      Simulation simulation({.iterations = 3, .threads = 1});
      const Positions start = (mesh.vertices * random.rotation()).rowwise() + Eigen::RowVector3d(-0.3, 0.2, 0.5);
      const BodyId body = simulation.add_body(mesh, Mass::total(1), {.start = start});
      simulation.add(body, TriangleStrain{.stiffness = stiffness});
      simulation.add(body, TetrahedronStrain{.stiffness = 100 * stiffness});
      advance(simulation, 100);
      CHECK(simulation.state().positions == start);
    }
  }
}

}  // namespace test_objective
