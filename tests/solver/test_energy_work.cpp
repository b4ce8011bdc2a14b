// Energy projection: what is done on a body from outside counts as work.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include <doctest/doctest.h>

#include "../simulation/everything.h"
#include "../simulation/run.h"
#include "energy_rig.h"
#include "motions.h"
#include "pliant/constraints/batch.h"
#include "pliant/core/error.h"
#include "pliant/forces/builtin.h"
#include "pliant/solver/global/system_matrix.h"

namespace test_energy_work {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// A group that calls itself external, and is otherwise like the one it has.
struct External final : ConstraintGroup {
  explicit External(std::unique_ptr<ConstraintGroup> group) : inner(std::move(group)) {
    set_stiffness(inner->stiffness());
  }
  std::string_view type() const override { return inner->type(); }
  GroupShape shape() const override { return inner->shape(); }
  std::span<const Index> stencil() const override { return inner->stencil(); }
  std::span<const Real> reduction() const override { return inner->reduction(); }
  std::span<const Real> rest_measure() const override { return inner->rest_measure(); }
  Real project(const Positions& positions, std::span<Real> out, Index begin, Index end) const override {
    return inner->project(positions, out, begin, end);
  }
  bool is_external() override { return true; }
  std::unique_ptr<ConstraintGroup> inner;
};

}  // namespace

TEST_CASE("what an external group does is work, and its energy none of the body's") {
  const auto energy_left = [](bool is_external, Real share) {
    Pulled pulled = mass_on_moved_pin(keeping(oscillator_settings(Integrator::implicit_euler, 0.05), share));
    Simulation& simulation = pulled.simulation;
    const GroupId springs = simulation.groups().begin()->first;
    if (is_external) {
      simulation.remove(springs);
      auto batch = std::make_unique<Batch<EdgeSpringProjection>>(omega * omega);
      batch->add(std::array<Index, 2>{0, 1}, std::array<Real, 2>{-1, 1}, 1, std::array<Real, 1>{1});
      ConstraintSet set;
      set.count = 1;
      set.batches.push_back(std::make_unique<External>(std::move(batch)));
      simulation.add_set(BodyId{0}, std::move(set), "edge_spring");
    }
    Positions velocities = Positions::Zero(2, 3);
    velocities(1, 0) = 0.1;
    simulation.set_state(Positions(simulation.state().positions), velocities);
    const Real begin = total(simulation);
    advance(simulation, 40);
    return total(simulation) / begin;
  };
  CHECK(energy_left(false, 1) == doctest::Approx(1).epsilon(1e-9));
  CHECK(energy_left(true, 1) < 0.3);  // damped by the step
}

TEST_CASE("a constant force is worth as much as the same weight, and leaves no drift in 20,000 steps") {
  constexpr Real weight = 9.81;
  constexpr Real unit = weight * weight / (omega * omega);  // (mg)²/k [J]
  constexpr int window = 1000;
  const auto energies = [=](Integrator integrator, Real h_omega, bool is_gravity) {
    Simulation simulation = mass_on_moved_pin(keeping(oscillator_settings(integrator, h_omega / omega))).simulation;
    if (is_gravity) {
      simulation.add(Gravity{Vec3(weight, 0, 0)});
    } else {
      simulation.add(TestForce{.vertices = {1}, .force = Vec3(weight, 0, 0)});
    }
    std::vector<Real> sums;
    for (int i = 0; i < 20 * window; ++i) {
      simulation.step();
      const State& state = simulation.state();
      const Real stretched = state.positions(1, 0) - 1;
      const Real speed = state.velocities(1, 0);
      sums.push_back((speed * speed / 2 + omega * omega / 2 * stretched * stretched - weight * stretched) / unit);
    }
    return sums;
  };
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const Real h_omega : {0.1, 0.3, 0.6, 1.0}) {
      CAPTURE(h_omega);
      const std::vector<Real> pushed = energies(integrator, h_omega, false);
      const std::vector<Real> falling = energies(integrator, h_omega, true);
      for (const std::vector<Real>& sums : {pushed, falling}) {
        if (integrator == Integrator::implicit_euler) {
          CHECK(std::ranges::all_of(sums, [](Real energy) { return std::abs(energy) < 1e-9; }));
          continue;
        }
        for (auto first = sums.begin() + window; first != sums.end(); first += window) {  // its start takes a while
          CHECK(std::abs(std::accumulate(first, first + window, Real(0)) / window) < 1e-9);
        }
      }
    }
  }
}

TEST_CASE("the work of a moved pin counts") {
  // A pin that moves evenly for half a period leaves the mass with twice its speed, one that does so for a whole period
  // leaves it at rest.
  constexpr int steps_a_period = 200;
  for (const Hold hold : {Hold::hard, Hold::soft}) {
    for (const int steps : {steps_a_period / 2, steps_a_period}) {
      CAPTURE(steps);
      Pulled pulled = mass_on_moved_pin(keeping({.time_step = 1.0 / steps_a_period, .iterations = 30}));
      Simulation& simulation = pulled.simulation;
      if (hold == Hold::soft) simulation.replace(pulled.pin, Position{.on = {0}, .hold = hold, .stiffness = 1e5});
      for (int i = 1; i <= steps; ++i) {
        simulation.set_target(pulled.pin, 0, Vec3(0.01 * i, 0, 0));
        simulation.step();
      }
      advance(simulation, steps_a_period);
      constexpr Real speed = 0.01 * steps_a_period;
      const Real expected = steps == steps_a_period ? 0 : 2 * speed * speed;
      // The vertex of a soft pin swings about it by itself.
      CHECK(std::abs(total(simulation) - expected) < (hold == Hold::hard ? 0.1 : 0.3) * speed * speed);
    }
  }
}

TEST_CASE("what brakes is not given back") {
  const auto left_after = [](Real share, Real drag, Real time_step, int steps) {
    Simulation simulation(keeping({.time_step = time_step, .iterations = 20, .threads = 1}, share));
    Mesh mesh = grid({.columns = 8, .rows = 8, .size = {1, 1}});
    BodyOptions options{.velocities = Positions::Zero(mesh.vertices.rows(), 3)};
    options.velocities.col(1).setConstant(5);  // across the sheet, which stands upright
    const BodyId sheet = simulation.add_body(std::move(mesh), Mass::area_density(0.1), options);
    simulation.add(sheet, EdgeSpring{.stiffness = 200});
    simulation.add(sheet, Position{.on = {0}, .hold = Hold::soft, .stiffness = 1e-6});  // so that all of it counts
    simulation.add(Wind{.velocity = {0, 0, 0}, .drag = drag});
    REQUIRE(kinetic(simulation) == doctest::Approx(1.25));
    advance(simulation, steps);
    return kinetic(simulation);
  };
  // x = h c/m is 1/30, 1/60 and 3.3. What the steps leave of e^(-2xn) differs by x² a step.
  const auto difference = [&](Real h, int steps) {
    return std::log(left_after(1, 2, h, steps) / left_after(0, 2, h, steps));
  };
  const Real coarse = difference(1.0 / 600, 60);
  CHECK(std::abs(coarse) < 0.1);
  CHECK(std::abs(difference(1.0 / 1200, 120)) < 0.6 * std::abs(coarse));
  CHECK(left_after(0, 2, 1.0 / 600, 60) < 0.1);
  CHECK(left_after(1, 20, 1.0 / 60, 600) < 1e-9);
}

TEST_CASE("a push gives its work along the way of the steps, and nothing before or after") {
  for (const Index substeps : {1, 4, 40}) {
    for (const int frames : {1, 5, 20}) {
      CAPTURE(substeps);
      CAPTURE(frames);
      Pulled pulled = mass_on_moved_pin(keeping({.time_step = 0.01, .substeps = substeps, .iterations = 20}));
      Simulation& simulation = pulled.simulation;
      for (const auto& [id, group] : simulation.groups()) {
        if (simulation.stiffness(id)) simulation.set_stiffness(id, 1e-6);
      }
      Positions velocities = Positions::Zero(2, 3);
      velocities(1, 1) = 1;
      simulation.set_state(Positions(simulation.state().positions), velocities);
      simulation.add(TestForce{.vertices = {1}, .force = Vec3(0, 60, 0), .frames = {10, 10 + frames}});
      advance(simulation, 10);
      CHECK(kinetic(simulation) == doctest::Approx(0.5).epsilon(1e-6));
      advance(simulation, frames);
      // Implicit Euler goes the way of the new velocity: at most F h (v + Δv) a substep, where a mass that is free
      // gains m Δv²/2 less.
      const Real gain = 60 * 0.01 / static_cast<Real>(substeps);
      Real most = 0.5;
      for (Index i = 0; i < substeps * frames; ++i) most += gain * (std::sqrt(2 * most) + gain);
      const Real free_speed = 1 + 60 * 0.01 * frames;
      const Real gained = kinetic(simulation);
      CHECK(gained > (1 - 1e-4) * free_speed * free_speed / 2);
      CHECK(gained < (1 + 1e-4) * most);
      CHECK(most < (1 + 0.3 / static_cast<Real>(substeps)) * free_speed * free_speed / 2);
      advance(simulation, 10);
      CHECK(kinetic(simulation) == doctest::Approx(gained).epsilon(1e-4));
    }
  }
}

TEST_CASE("a load on cords that go taut and slack leaves no more than its work") {
  // A slack rope between two pins, with gravity; a load comes and goes. Steps of BDF2 that draw cords taut gain a lot.
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const Index iterations : {5, 30}) {
      CAPTURE(iterations);
      Simulation simulation(keeping({.integrator = integrator, .iterations = iterations, .threads = 1}));
      const BodyId rope = simulation.add_body(chain({.links = 12, .direction = {1, 0, 0}}), Mass::per_vertex(0.02));
      simulation.add(rope, EdgeStrain{.stiffness = 4000, .min_stretch = 0, .max_stretch = 1.2});
      simulation.add(rope, Position{.on = {0, 12}});
      add_gravity(simulation);
      const TestForce load{.vertices = {5, 6, 7}, .force = Vec3(0, 2, -12), .frames = {60, 180}};
      simulation.add(rope, load);
      const Real begin = total(simulation);
      Real work = 0;
      Real most_work = 0;
      Real most_surplus = 0;
      for (int i = 0; i < 360; ++i) {
        const Positions before = simulation.state().positions;
        const bool is_active = load.is_active(simulation.state().step);
        simulation.step();
        const Positions way = simulation.state().positions - before;
        for (const Index v : {5, 6, 7}) work += is_active ? row(way, v).dot(Vec3(0, 2, -12)) : 0;
        most_work = std::max(most_work, work);
        most_surplus = std::max(most_surplus, surplus(simulation));
        REQUIRE(total(simulation) - begin - work - surplus(simulation) < 1e-9 * (1 + most_work));
      }
      CHECK(most_work > 1);
      CHECK(most_surplus < most_work);
    }
  }
}

TEST_CASE("a surface with signed bending that is turned inside out gains nothing") {
  Simulation simulation(keeping({.iterations = 20, .threads = 1}));
  Mesh mesh = torus({.major_segments = 12, .minor_segments = 8, .major_radius = 0.5, .minor_radius = 0.2});
  BodyOptions options{.velocities = Positions(mesh.vertices.rows(), 3)};
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    options.velocities.row(i) = 6 * Vec3(std::sin(9.0 * i), std::cos(7.0 * i), std::sin(5.0 * i + 1)).transpose();
  }
  const BodyId ring = simulation.add_body(std::move(mesh), Mass::total(1), options);
  simulation.add(ring, EdgeSpring{.stiffness = 100});
  simulation.add(ring, Bending{.stiffness = 0.3, .orientation = Orientation::signed_});
  const Real begin = total(simulation);
  for (int i = 0; i < 300; ++i) {
    simulation.step();
    REQUIRE(total(simulation) - surplus(simulation) < (1 + 1e-9) * begin);
  }
  CHECK(total(simulation) > 0.5 * begin);
}

TEST_CASE("a couple turns a free box as much as its torques say, and a share of what is lost of that comes back") {
  const auto turned = [](Real share) {
    Simulation simulation(keeping({.iterations = 60, .threads = 1}, share));
    const BodyId box = simulation.add_body(bar({.cells = {2, 2, 2}}), Mass::total(1));
    simulation.add(box, TetrahedronStrain{.stiffness = 1e5});
    const Index end = simulation.body(box).mesh.vertex_count() - 1;
    simulation.add(box, TestForce{.vertices = {0}, .force = Vec3(0, 0.2, 0)});
    simulation.add(box, TestForce{.vertices = {end}, .force = Vec3(0, -0.2, 0)});
    Real expected = 0;
    for (int i = 0; i < 60; ++i) {
      const Positions& x = simulation.state().positions;
      expected += 0.2 / 60 * (row(x, 0) - row(x, end)).cross(Vec3::UnitY()).norm();
      simulation.step();
    }
    return momenta_of(simulation.state()).angular.norm() / expected;
  };
  const Real without = turned(0);
  CHECK(without < 0.97);
  CHECK(turned(1) == doctest::Approx(1).epsilon(0.01));
  CHECK(turned(0.5) == doctest::Approx((1 + without) / 2).epsilon(0.01));
}

TEST_CASE("a drag on a pinned vertex does nothing") {
  const auto run = [](bool has_drag) {
    Pulled pulled = mass_on_moved_pin(keeping({.iterations = 20, .threads = 1}));
    if (has_drag) {
      pulled.simulation.add(BodyId{0}, Drag{.stencils = {{0}}, .stiffness = 500, .targets = Vec3(-3, 0, 0)});
    }
    for (int i = 1; i <= 60; ++i) {
      pulled.simulation.set_target(pulled.pin, 0, Vec3(0.02 * i, 0, 0));
      pulled.simulation.step();
    }
    return kinetic(pulled.simulation);
  };
  CHECK(run(false) > 0.1);
  CHECK(run(true) == doctest::Approx(run(false)).epsilon(1e-9));
}

}  // namespace test_energy_work
