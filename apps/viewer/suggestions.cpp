#include "viewer/suggestions.h"

#include <algorithm>

namespace pliant_viewer {
namespace {

/// The diagonal of the box around all bodies [m].
Real extent_of(const pliant::Simulation& simulation) {
  const pliant::Positions& x = simulation.state().positions;
  return x.rows() == 0 ? 0 : (x.colwise().maxCoeff() - x.colwise().minCoeff()).norm();
}

}  // namespace

Real suggest_pull_stiffness(const pliant::Simulation& simulation) {
  constexpr Real weight_at_stretch = 3 * 9.81;  // [m/s²]: the spring holds three times the weight
  constexpr Real stretch = 0.1;                 // of the bodies' size
  Real mass = 0;
  for (const Real of_vertex : simulation.state().masses) mass += of_vertex;
  if (mass == 0) return 1;
  const Real size = extent_of(simulation);
  return std::clamp<Real>(mass * weight_at_stretch / (stretch * std::max<Real>(size, 1e-3)), 1e-3, 1e9);
}

Real suggest_collider_speed(const pliant::Simulation& simulation) {
  constexpr Real sizes_in_a_second = 3;
  return sizes_in_a_second * std::max<Real>(extent_of(simulation), 1e-3);
}

}  // namespace pliant_viewer
