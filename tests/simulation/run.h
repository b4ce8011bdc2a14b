#pragma once
// What tests of whole simulations share.
#include "pliant/forces/gravity.h"
#include "pliant/simulation/simulation.h"

namespace pliant_tests {

using pliant::Real;

inline void advance(pliant::Simulation& simulation, int steps) {
  for (int i = 0; i < steps; ++i) simulation.step();
}

inline void add_gravity(pliant::Simulation& simulation, const pliant::Vec3& g = {0, 0, -9.81}) {
  simulation.add(pliant::Gravity{g});
}

/// Iterates until no vertex has a larger residual force [N]; the number of iterations is only a way out.
inline pliant::SolverSettings converged(Real tolerance, Real time_step = 1.0 / 60) {
  return {.time_step = time_step, .iterations = 200000, .tolerance = tolerance, .threads = 1};
}

inline Real largest_difference(const pliant::Positions& a, const pliant::Positions& b) {
  return (a - b).cwiseAbs().maxCoeff();
}

}  // namespace pliant_tests
