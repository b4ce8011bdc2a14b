#pragma once
// What tests of energy projection share: energies, and small scenes that swing.
#include <numbers>
#include <numeric>

#include "../simulation/run.h"
#include "motions.h"
#include "pliant/forces/builtin.h"

namespace pliant_tests {

using namespace pliant;

inline constexpr Real omega = 2 * std::numbers::pi;

inline Real kinetic(const Simulation& simulation) {
  const State& state = simulation.state();
  Real energy = 0;
  for (Index i = 0; i < state.vertex_count(); ++i) {
    energy += state.masses[static_cast<std::size_t>(i)] / 2 * state.velocities.row(i).squaredNorm();
  }
  return energy;
}

/// Kinetic, elastic and potential energy [J].
inline Real total(Simulation& simulation) {
  Real energy = kinetic(simulation) + simulation.evaluate().elastic;
  for (const auto& [id, force] : simulation.forces()) energy += force->potential(simulation.state().view());
  return energy;
}

/// What energy projection has let bodies have too much and is to take back [J].
inline Real surplus(const Simulation& simulation) {
  const std::vector<Real>& noted = simulation.state().energy_surplus;
  return std::accumulate(noted.begin(), noted.end(), Real(0));
}

inline SolverSettings keeping(const SolverSettings& settings, Real share = 1) {
  SolverSettings kept = settings;
  kept.energy_projection = share;
  return kept;
}

/// A rope that is let go from the horizontal, pinned at one end.
inline Simulation swinging_rope(const SolverSettings& settings) {
  Simulation simulation(settings);
  const BodyId rope = simulation.add_body(chain({.links = 8, .direction = {1, 0, 0}}), Mass::per_vertex(0.1));
  simulation.add(rope, EdgeSpring{.stiffness = 2e3});
  simulation.add(rope, Position{.on = {0}});
  add_gravity(simulation);
  return simulation;
}

/// A mass on a spring whose other end is pinned; the rest is up to the test.
struct Pulled {
  Simulation simulation;
  GroupId pin;
};
inline Pulled mass_on_moved_pin(const SolverSettings& settings) {
  Pulled pulled{Simulation(settings), {}};
  const BodyId body = pulled.simulation.add_body(chain({.links = 1, .direction = {1, 0, 0}}), Mass::per_vertex(1));
  pulled.simulation.add(body, EdgeSpring{.stiffness = omega * omega});
  pulled.pin = pulled.simulation.add(body, Position{.on = {0}});
  return pulled;
}

}  // namespace pliant_tests
