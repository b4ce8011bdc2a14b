#include "pliant/solver/balanced_guess.h"

#include <algorithm>

namespace pliant {

void BalancedGuess::move(const WorkingState& work, const IntegratorCoefficients& form, Real h,
                         std::span<const Index> component_of_vertex, std::size_t components,
                         std::span<const char> is_pinned, Positions& q) {
  const State& begin = work.begin;
  const Real eta = form.inertia_step();
  const auto without_forces = [&](Index i) { return (form.position(i) + eta * form.velocity(i)).eval(); };
  sums_.assign(components, {});
  for (Index i = 0; i < begin.positions.rows(); ++i) {
    if (is_pinned[at(i)] != 0) continue;
    const IntegratorCoefficients::RowVec3 d = q.row(i) - without_forces(i);
    const Real weight = begin.masses[at(i)] * eta * eta / h;
    Sums& of = sums_[at(component_of_vertex[at(i)])];
    of.accelerated += weight * d.dot(begin.velocities.row(i) - begin.previous_velocities.row(i));
    of.forced += begin.masses[at(i)] * d.squaredNorm();
  }
  for (Index i = 0; i < begin.positions.rows(); ++i) {
    if (is_pinned[at(i)] != 0) continue;
    const Sums& of = sums_[at(component_of_vertex[at(i)])];
    if (!(of.forced > 0) || of.accelerated >= of.forced) continue;
    const IntegratorCoefficients::RowVec3 from = without_forces(i);
    q.row(i) = from + std::max(of.accelerated / of.forced, Real{0}) * (q.row(i) - from);
  }
}

}  // namespace pliant
