// Energy projection: what is kept, what is left alone, and that it stays calm.
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

namespace test_energy_projection {

using namespace pliant;
using namespace pliant_tests;

TEST_CASE("an oscillator keeps its energy up to hω = 1, and gains none beyond") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const Real h_omega : {0.03, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0}) {
      CAPTURE(h_omega);
      Simulation kept = two_masses(keeping(oscillator_settings(integrator, h_omega / omega)), omega);
      Simulation lossy = two_masses(oscillator_settings(integrator, h_omega / omega), omega);
      const Real begin = total(kept);
      Real largest = 0;
      Real least = begin;
      for (int i = 0; i < 1000; ++i) {
        kept.step();
        lossy.step();
        largest = std::max(largest, std::abs(stretch(kept)));
        least = std::min(least, total(kept));
      }
      CHECK(largest <= amplitude * (1 + 1e-3));  // what a step of BDF2 gains, the next one is not given
      CHECK(total(lossy) < 0.999 * begin);
      if (h_omega <= 1) CHECK(least > (1 - 1e-10) * begin);
      if (h_omega <= 1) CHECK(total(kept) == doctest::Approx(begin).epsilon(1e-10));
    }
  }
}

TEST_CASE("a share gives back that share of what a step loses") {
  const SolverSettings settings = oscillator_settings(Integrator::implicit_euler, 0.05);
  for (int steps = 1; steps < 9; ++steps) {
    CAPTURE(steps);
    const auto loss_with = [&](Real share) {
      Simulation simulation = two_masses(settings, omega);
      advance(simulation, steps);
      const Real before = total(simulation);
      simulation.set_settings(keeping(settings, share));
      simulation.step();
      return before - total(simulation);
    };
    const Real all = loss_with(0);
    CHECK(all > 0);
    CHECK(loss_with(0.25) == doctest::Approx(0.75 * all).epsilon(1e-9));
    CHECK(loss_with(0.5) == doctest::Approx(0.5 * all).epsilon(1e-9));
    CHECK(std::abs(loss_with(1)) < 1e-9 * all);
  }
}

TEST_CASE("damping damps at its own rate, whatever the integrator would lose") {
  constexpr Real rate = 0.3;
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    Simulation simulation = two_masses(keeping(oscillator_settings(integrator, 0.01, rate)), omega);
    const Real begin = total(simulation);
    advance(simulation, 500);
    CHECK(std::log(begin / total(simulation)) / (2 * 5.0) == doctest::Approx(rate).epsilon(0.02));
  }
}

TEST_CASE("a swinging rope keeps the sum of its energies") {
  const Real scale = 0.8 * 9.81;  // from the height of the pin to where it could fall [J]
  for (const auto& [integrator, tolerance] : {std::pair{Integrator::implicit_euler, 1e-9}, {Integrator::bdf2, 2e-2}}) {
    const SolverSettings settings{.integrator = integrator, .iterations = 100, .threads = 1};
    Simulation kept = swinging_rope(keeping(settings));
    Simulation lossy = swinging_rope(settings);
    const Real begin = total(kept);
    for (int i = 0; i < 600; ++i) {
      kept.step();
      lossy.step();
      REQUIRE(std::abs(total(kept) - begin) < tolerance * scale);
      REQUIRE(total(kept) - begin - surplus(kept) < 1e-9 * scale);
    }
    CHECK(total(lossy) - begin < -0.05 * scale);
  }
}

TEST_CASE("free bodies fly as without, and keep their angular momenta") {
  SolverSettings settings = oscillator_settings(Integrator::implicit_euler, 1.0 / 60);
  settings.iterations = 50;
  Simulation kept = flying_bodies(keeping(settings));
  Simulation plain = flying_bodies(settings);
  for (Simulation* simulation : {&kept, &plain}) add_gravity(*simulation);
  const State begin = kept.state();
  advance(kept, 300);
  advance(plain, 300);
  for (const Body& body : kept.bodies()) {
    const Index first = body.first_vertex;
    const Index end = first + body.mesh.vertex_count();
    const auto center = [&](const State& state) {
      Vec3 sum = Vec3::Zero();
      for (Index i = first; i < end; ++i) sum += state.masses[static_cast<std::size_t>(i)] * row(state.positions, i);
      return sum;  // each body has 1 kg
    };
    const auto spin = [&](const State& state) {
      const Momenta momenta = momenta_of(state, first, end);
      return Vec3(momenta.angular - center(state).cross(momenta.linear));
    };
    CHECK((center(kept.state()) - center(plain.state())).norm() < 1e-10 * center(kept.state()).norm());
    CHECK((momenta_of(kept.state(), first, end).linear - momenta_of(plain.state(), first, end).linear).norm() < 1e-10);
    CHECK((spin(kept.state()) - spin(begin)).norm() < 1e-9 * spin(begin).norm());
    CHECK((spin(plain.state()) - spin(begin)).norm() > 0.1 * spin(begin).norm());
  }
}

TEST_CASE("a stiff box that turns about its middle axis turns over, and neither stops nor speeds up") {
  const auto tumbling = [](Real share) {
    Simulation simulation(keeping({.iterations = 60, .threads = 1}, share));
    Mesh mesh = bar({.cells = {4, 3, 2}, .size = {1, 0.6, 0.25}});
    BodyOptions options{.velocities = Positions(mesh.vertices.rows(), 3)};
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      const Vec3 arm = row(mesh.vertices, i) - Vec3(0.5, 0.3, 0.125);
      options.velocities.row(i) = Vec3(0.02, 3, 0.02).cross(arm).transpose();
    }
    const BodyId box = simulation.add_body(std::move(mesh), Mass::total(1), options);
    simulation.add(box, TetrahedronStrain{.stiffness = 1e6});
    const Real energy = total(simulation);
    const Real spin = momenta_of(simulation.state()).angular.norm();
    Real least = 1;  // of the cosine between the long edge and how it lay
    for (int i = 0; i < 900; ++i) {
      simulation.step();
      CHECK(total(simulation) < (1 + 1e-6) * energy);
      CHECK(momenta_of(simulation.state()).angular.norm() < (1 + 1e-6) * spin);
      const Positions& x = simulation.state().positions;
      least = std::min(least, (row(x, 4) - row(x, 0)).normalized().x());
    }
    return std::pair(total(simulation) / energy, least);
  };
  const auto [kept, least] = tumbling(1);
  CHECK(kept > 0.98);
  CHECK(least < -0.9);
  CHECK(tumbling(0).first < 0.3);
}

TEST_CASE("each component keeps its own energy, also where their constraints are mixed") {
  // Two ropes in one mesh, their vertices in turn: one shaken, the other at rest.
  const auto ropes = [](bool is_shaken, bool is_moving) {
    Mesh mesh;
    mesh.vertices.resize(20, 3);
    for (Index i = 0; i < 20; ++i) {
      mesh.vertices.row(i) = Vec3(0.1 * (i / 2), i % 2, 0).transpose();
      if (i >= 2) mesh.edges.push_back({i - 2, i});
    }
    BodyOptions options{.velocities = Positions::Zero(20, 3)};
    for (Index i = 0; i < 20; ++i) {
      if (is_shaken && i % 2 == 0) options.velocities(i, 2) = std::sin(2.0 * i);
      if (is_moving && i % 2 == 1) options.velocities(i, 2) = 0.1 * i;
    }
    Simulation simulation(keeping({.iterations = 20, .threads = 1}));
    const BodyId body = simulation.add_body(std::move(mesh), Mass::per_vertex(0.1), options);
    simulation.add(body, EdgeSpring{.stiffness = 1e3});
    return simulation;
  };
  Simulation both = ropes(true, true);
  Simulation one = ropes(true, false);
  Simulation other = ropes(false, true);
  const Positions rest = one.state().positions;
  for (Simulation* simulation : {&both, &one, &other}) advance(*simulation, 120);
  for (Index i = 0; i < 20; ++i) {
    CAPTURE(i);
    const Simulation& alone = i % 2 == 0 ? one : other;
    CHECK((row(both.state().positions, i) - row(alone.state().positions, i)).norm() < 1e-9);
    if (i % 2 == 1) CHECK(row(one.state().positions, i) == row(rest, i));
  }
}

TEST_CASE("energies past all numbers leave no surplus behind") {
  Simulation simulation(keeping({.iterations = 4, .threads = 1}));
  BodyOptions options{.velocities = Positions::Constant(2, 3, 1e5)};
  const BodyId rod = simulation.add_body(chain({.links = 1}), Mass::per_vertex(1e300), options);
  simulation.add(rod, EdgeSpring{});
  simulation.add(rod, Position{.on = {0}});
  for (int i = 0; i < 3; ++i) {
    simulation.step();
    for (const Real energy : simulation.state().energy_surplus) CHECK((energy >= 0 && std::isfinite(energy)));
  }
  CHECK_NOTHROW(simulation.restore(State(simulation.state())));
}

TEST_CASE("an explicit spring gains no energy") {
  Simulation simulation(keeping({.time_step = 0.05, .iterations = 20, .threads = 1}));
  const BodyId rope = simulation.add_body(chain({.links = 3, .direction = {1, 0, 0}}), Mass::per_vertex(1));
  simulation.add(rope, EdgeSpring{.stiffness = 100});
  simulation.add(rope, Position{.on = {0}});
  simulation.add(rope, MouseSpring{.vertices = {3}, .anchor = {3, 1, 0}});
  const Real begin = total(simulation);
  for (int i = 0; i < 2000; ++i) {
    simulation.step();
    REQUIRE(total(simulation) < 1.2 * begin);
  }
}

TEST_CASE("what rests stays at rest") {
  SolverSettings settings = converged(1e-10);
  Simulation simulation(settings);
  const BodyId sheet = simulation.add_body(grid({.columns = 8, .rows = 8}), Mass::area_density(0.1));
  simulation.add(sheet, EdgeSpring{.stiffness = 500});
  simulation.add(sheet, Position{.on = {0, 7}});
  add_gravity(simulation);
  advance(simulation, 2000);
  const Positions before = simulation.state().positions;
  REQUIRE(kinetic(simulation) < 1e-12);
  simulation.set_settings(keeping(settings));
  advance(simulation, 300);
  CHECK(kinetic(simulation) < 1e-9);
  CHECK(largest_difference(simulation.state().positions, before) < 1e-6);
}

TEST_CASE("few iterations: a stiff beam swings as it should, and what they gain stays bounded") {
  struct Swing {
    Real mean = 0;  // of the kinetic energy
    Real most = 0;
    Real surplus = 0;
  };
  const auto swing = [](Index iterations, Index substeps, Real share) {
    Simulation simulation(keeping({.substeps = substeps, .iterations = iterations, .threads = 1}, share));
    const BodyId beam = simulation.add_body(bar({.cells = {10, 2, 2}, .size = {1, 0.2, 0.2}}), Mass::density(400));
    simulation.add(beam, TetrahedronStrain{.stiffness = 5e6});
    simulation.add(beam, Position{.on = {0, 1, 2}});
    add_gravity(simulation);
    Swing result;
    for (int i = 0; i < 600; ++i) {
      simulation.step();
      result.mean += kinetic(simulation) / 600;
      result.most = std::max(result.most, kinetic(simulation));
      result.surplus = std::max(result.surplus, surplus(simulation));
    }
    return result;
  };
  const Swing fine = swing(10, 20, 1);
  CHECK(swing(10, 20, 0).most == doctest::Approx(fine.most).epsilon(0.1));  // so it is right
  CHECK(swing(1, 1, 0).most < 0.1 * fine.most);
  for (const Index iterations : {1, 10}) {
    const Swing coarse = swing(iterations, 1, 1);
    CHECK(coarse.most == doctest::Approx(fine.most).epsilon(0.1));
    CHECK(coarse.mean > 0.4 * fine.mean);
    CHECK(coarse.mean < 1.2 * fine.mean);
    CHECK(coarse.surplus < fine.most);
  }
  CHECK(swing(10, 1, 1).surplus > 0);
}

TEST_CASE("everything at once stays calm, at any stiffness and time step") {
  for (const Real h : {0.001, 1.0 / 60, 0.2, 5.0}) {
    for (const Index iterations : {1, 10}) {
      CAPTURE(h);
      CAPTURE(iterations);
      Simulation simulation = everything({.time_step = h, .iterations = iterations, .threads = 1}, 6);
      if (h > 0.1) simulation.remove(simulation.find_force("mouse_spring").value());  // which is explicit
      for (const auto& [id, group] : simulation.groups()) {
        if (const auto stiffness = simulation.stiffness(id)) simulation.set_stiffness(id, 1000 * *stiffness);
      }
      const auto largest = [&](int steps) {
        Real most = 0;
        for (int i = 0; i < steps; ++i) {
          simulation.step();
          most = std::max(most, kinetic(simulation));
        }
        return most;
      };
      simulation.set_settings(keeping(simulation.settings()));
      const Real first = largest(200);
      CHECK(largest(200) < 3 * first);
    }
  }
}

TEST_CASE("energy projection is switched on and off while it runs") {
  const SolverSettings settings{.iterations = 40, .threads = 1};
  Simulation simulation = swinging_rope(settings);
  advance(simulation, 60);
  const Real before = total(simulation);
  simulation.set_settings(keeping(settings));
  advance(simulation, 60);
  CHECK(total(simulation) == doctest::Approx(before).epsilon(1e-9));
  simulation.set_settings(settings);
  advance(simulation, 60);
  CHECK(total(simulation) < before - 0.01);
  CHECK(simulation.state().energy_surplus.empty());
}

TEST_CASE("a surplus that no step has made is refused") {
  Simulation simulation = swinging_rope(keeping({.iterations = 4, .threads = 1}));
  advance(simulation, 3);
  State state = simulation.state();
  REQUIRE(state.energy_surplus.size() == 9);
  const auto refusal = [&] {
    try {
      simulation.restore(state);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string("(taken)");
  };
  CHECK(refusal() == "(taken)");
  for (const Real wrong : {-1.0, std::nan(""), std::numeric_limits<Real>::infinity()}) {
    state.energy_surplus[2] = wrong;
    CHECK(refusal().find("energy surplus") != std::string::npos);
  }
  state.energy_surplus = {0, 0};
  CHECK(refusal().find("energy surplus") != std::string::npos);
  state.energy_surplus.clear();
  CHECK(refusal() == "(taken)");
}

}  // namespace test_energy_projection
