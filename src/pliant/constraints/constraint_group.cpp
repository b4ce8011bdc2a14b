#include "pliant/constraints/constraint_group.h"

#include <cmath>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {

void ConstraintGroup::begin_step(const StateView&, Real) {}

std::span<const Index> ConstraintGroup::held_vertices() const {
  return {};
}

std::span<Real> ConstraintGroup::targets() {
  return {};
}

void ConstraintGroup::set_stiffness(Real stiffness) {
  if (!(stiffness > 0) || !std::isfinite(stiffness)) {
    fail_input(
        fmt::format("stiffness: {} is not a positive finite number; give one, or remove the constraints", stiffness));
  }
  stiffness_ = stiffness;
}

}  // namespace pliant
