#include "pliant/solver/applied_forces.h"

namespace pliant {

void AppliedForces::evaluate(const State& state, Real h, const LocalGroups& order, WorkingState& work) {
  sum_.setZero(state.positions.rows(), 3);
  for (Force* force : forces_) force->add_to(sum_, state.view(), h);
  order.gather(sum_, work.forces);
}

void AppliedForces::evaluate_apart(const State& state, Real h, const LocalGroups& order, WorkingState& work) {
  sum_.setZero(state.positions.rows(), 3);
  add(state.view(), h, false);
  order.gather(sum_, work.not_conservative);
  add(state.view(), h, true);
  order.gather(sum_, work.forces);
}

void AppliedForces::evaluate_conservative(const State& state, const Positions& q, const Positions& v, Real h,
                                          const LocalGroups& order, Positions& forces) {
  order.scatter(q, positions_);
  order.scatter(v, velocities_);
  sum_.setZero(state.positions.rows(), 3);
  add({positions_, velocities_, state.masses, state.step, state.time}, h, true);
  order.gather(sum_, forces);
}

void AppliedForces::add(const StateView& state, Real h, bool is_conservative) {
  for (Force* force : forces_) {
    if (force->is_conservative() == is_conservative) force->add_to(sum_, state, h);
  }
}

}  // namespace pliant
