// Something stiff and heavy that falls onto a collider with all its weight on few light vertices: they are held back at
// once, and what they hang on is still to come.
#include <doctest/doctest.h>

#include "contact_scenes.h"

namespace test_impacts {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real gravity = 9.81;

/// A box of half a kilogram that falls on one of its corners.
struct FallingBox {
  Simulation simulation;
  GroupId cardboard{};

  FallingBox(Real speed, std::array<Index, 3> cells, SolverSettings settings,
             const std::vector<PlaneCollider>& planes = {PlaneCollider{}})
      : simulation(settings) {
    Mesh box = bar({.cells = cells, .size = {0.2, 0.2, 0.14}});
    const Mat3 turn = Eigen::AngleAxis<Real>(0.35, Vec3(0.9, 0.5, 0.2).normalized()).toRotationMatrix();
    box.vertices = (box.vertices * turn.transpose()).eval();
    box.vertices.col(2).array() += 0.1 - box.vertices.col(2).minCoeff();
    const BodyId body = simulation.add_body(std::move(box), Mass::total(0.5));
    cardboard = simulation.add(body, TetrahedronStrain{.stiffness = 2e5});
    simulation.add(Gravity{.acceleration = Vec3(0, 0, -gravity)});
    for (const PlaneCollider& plane : planes) simulation.add(plane);
    simulation.set_contact({.distance = 0.005, .surfaces = false});
    const State& state = simulation.state();
    Positions velocities = state.velocities;
    velocities.rowwise() = Eigen::RowVector3d(0.3, 0, -speed);
    simulation.set_state(state.positions, velocities);
  }

  Real energy() {
    simulation.evaluate();
    const State& state = simulation.state();
    Real sum = simulation.elastic_energy(cardboard);
    for (Index v = 0; v < state.vertex_count(); ++v) {
      const Real height = state.positions(v, 2);
      sum += state.masses[at(v)] * (row(state.velocities, v).squaredNorm() / 2 + gravity * height);
    }
    return sum;
  }

  /// Of an edge of the box, as a share of its length at rest.
  Real largest_strain() const {
    const Mesh& mesh = simulation.body(BodyId{0}).mesh;
    Real largest = 0;
    for (const auto& corners : mesh.tetrahedra) {
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const auto length = [&](const Positions& x) { return (row(x, corners[i]) - row(x, corners[j])).norm(); };
          largest = std::max(largest, std::abs(length(simulation.state().positions) / length(mesh.vertices) - 1));
        }
      }
    }
    return largest;
  }

  Real stiffest_contact() const {
    const std::vector<Real>& factors = simulation.state().contact.stiffening;
    return factors.empty() ? 1 : *std::ranges::max_element(factors);
  }
};

SolverSettings usual_settings(Integrator integrator, int threads = 1) {
  return {.integrator = integrator, .iterations = 20, .acceleration = Acceleration::lbfgs, .threads = threads};
}

/// What a box shows in its first second.
struct Extremes {
  Real energy = 0, strain = 0, rise = 0;  // [J], of an edge, of its middle [m/s]

  explicit Extremes(FallingBox& box) {
    for (int i = 0; i < 60; ++i) {
      box.simulation.step();
      energy = std::max(energy, box.energy());
      strain = std::max(strain, box.largest_strain());
      rise = std::max(rise, box.simulation.state().velocities.col(2).mean());
    }
  }
};

}  // namespace

TEST_CASE("impacts: a stiff box that falls on a corner keeps its shape and gains no energy") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const Real speed : {1.0, 1.5, 2.0, 2.5, 3.0}) {
      CAPTURE(static_cast<int>(integrator));
      CAPTURE(speed);
      FallingBox box(speed, {3, 3, 2}, usual_settings(integrator));
      const Real before = box.energy();
      const Extremes found(box);
      CHECK(found.energy < 1.001 * before);
      CHECK(found.strain < 0.2);
      CHECK(box.energy() < 0.8 * before);
    }
  }
}

TEST_CASE("impacts: the same in substeps, and where a corner meets two planes at once") {
  const std::vector<PlaneCollider> ground = {PlaneCollider{}};
  const std::vector<PlaneCollider> groove = {{.position = Vec3(0, 0, -0.1), .normal = Vec3(1, 0, 2)},
                                             {.position = Vec3(0, 0, -0.1), .normal = Vec3(-1, 0, 2)}};
  for (const auto& planes : {ground, groove}) {
    for (const Index substeps : {1, 2, 4}) {
      CAPTURE(planes.size());
      CAPTURE(substeps);
      SolverSettings settings = usual_settings(Integrator::bdf2);
      settings.substeps = substeps;
      FallingBox box(2, {3, 3, 2}, settings, planes);
      const Real before = box.energy();
      const Extremes found(box);
      CHECK(found.energy < 1.001 * before);
      CHECK(found.strain < 0.2);
      CHECK(box.energy() < 0.8 * before);
    }
  }
}

TEST_CASE("impacts: ground that comes up throws a box no faster than twice its speed") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    CAPTURE(static_cast<int>(integrator));
    FallingBox box(0, {3, 3, 2}, usual_settings(integrator), {{.velocity = Vec3(0, 0, 2)}});
    const Extremes found(box);
    CHECK(found.strain < 0.2);
    CHECK(found.rise > 1.5);
    CHECK(found.rise < 4);
  }
}

TEST_CASE("impacts: contact becomes as stiff as it must within a step, and no stiffer than the body") {
  FallingBox box(2, {3, 3, 2}, usual_settings(Integrator::bdf2));
  while (box.stiffest_contact() == 1) {
    REQUIRE(box.simulation.state().step < 60);
    box.simulation.step();
  }
  CHECK(box.stiffest_contact() > 4);
  const Real mass = 0.5, h = box.simulation.settings().time_step;
  for (int i = 0; i < 60; ++i) {
    box.simulation.step();
    // Y of a corner has at most the stiffnesses of all its tetrahedra, whose heights are of a cell at least.
    CHECK(box.stiffest_contact() * 50 * mass / 48 / (h * h) < 50 * 2e5 * 0.2);
  }
}

TEST_CASE("impacts: a box that falls on a sheet on the ground, where surfaces touch too") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    CAPTURE(static_cast<int>(integrator));
    FallingBox box(2, {3, 3, 2}, usual_settings(integrator));
    Simulation& simulation = box.simulation;
    Mesh mesh = grid({.columns = 13, .rows = 13, .size = {0.6, 0.6}, .plane = Plane::xy});
    mesh.vertices.rowwise() += Eigen::RowVector3d(-0.3, -0.3, 0.006);
    const BodyId sheet = simulation.add_body(std::move(mesh), Mass::area_density(0.2));
    const GroupId stretch = simulation.add(sheet, TriangleStrain{.stiffness = 200});
    simulation.set_contact({.distance = 0.005, .surfaces = true});
    const auto energy = [&] { return box.energy() + simulation.elastic_energy(stretch); };
    const Real at_first = energy();
    Real most = 0, strain = 0;
    for (int i = 0; i < 60; ++i) {
      simulation.step();
      most = std::max(most, energy());
      strain = std::max(strain, box.largest_strain());
    }
    CHECK(most < 1.1 * at_first);  // a step that is not converged may hold more for a moment
    CHECK(energy() < 0.8 * at_first);
    CHECK(strain < 0.3);
  }
}

TEST_CASE("impacts: a stiff box that begins inside the ground is led out, and keeps its shape") {
  for (const Real depth : {0.5, 3.0}) {
    CAPTURE(depth);
    FallingBox box(0, {3, 3, 2}, usual_settings(Integrator::bdf2));
    Positions x = box.simulation.state().positions;
    x.col(2).array() -= x.col(2).minCoeff() + depth * 0.005;
    box.simulation.set_state(x, Positions::Zero(x.rows(), 3));
    Real strain = 0;
    for (int i = 0; i < 60; ++i) {
      box.simulation.step();
      strain = std::max(strain, box.largest_strain());
    }
    CHECK(box.simulation.state().positions.col(2).minCoeff() > 0);
    CHECK(strain < 0.1);
  }
}

TEST_CASE("impacts: the same bits with any number of threads, and from each state") {
  Positions first;
  for (const int threads : {1, 2, 5}) {
    FallingBox box(2, {8, 8, 4}, usual_settings(Integrator::bdf2, threads));
    FallingBox resumed(2, {8, 8, 4}, usual_settings(Integrator::bdf2));
    for (int i = 0; i < 20; ++i) {
      resumed.simulation.restore(box.simulation.state());
      resumed.simulation.step();
      box.simulation.step();
      CHECK(resumed.simulation.state().positions == box.simulation.state().positions);
    }
    if (threads == 1) first = box.simulation.state().positions;
    CHECK(box.simulation.state().positions == first);
  }
}

}  // namespace test_impacts
