#include "pliant/forces/gravity.h"

namespace pliant {

void Gravity::add_to(Positions& forces, const StateView& state, Real) {
  for (Index i = 0; i < forces.rows(); ++i) {
    forces.row(i) += state.masses[static_cast<std::size_t>(i)] * acceleration_.transpose();
  }
}

Real Gravity::potential(const StateView& state) const {
  Real energy = 0;
  for (Index i = 0; i < state.positions.rows(); ++i) {
    energy -= state.masses[static_cast<std::size_t>(i)] * state.positions.row(i).dot(acceleration_.transpose());
  }
  return energy;
}

}  // namespace pliant
