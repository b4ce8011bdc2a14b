#include "pliant/forces/gravity.h"

#include "pliant/core/error.h"

namespace pliant {

Gravity::Gravity(const Vec3& acceleration) : acceleration_(acceleration) {
  if (!acceleration_.allFinite()) fail_input("gravity: the acceleration is not finite; give three finite numbers");
}

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
