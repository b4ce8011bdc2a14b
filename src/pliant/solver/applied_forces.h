#pragma once
// The forces of a simulation in a step. A force reads and writes in the order of the simulation; here, and nowhere else
// in a step, positions and forces go from one order to the other.
#include "pliant/forces/force.h"
#include "pliant/solver/working_state.h"

namespace pliant {

class AppliedForces {
 public:
  /// They must outlive their use here.
  void set(std::vector<Force*> forces) { forces_ = std::move(forces); }
  std::span<Force* const> forces() const { return forces_; }

  /// f at the beginning of a step of length h [s] into `work.forces`.
  void evaluate(const State& state, Real h, const LocalGroups& order, WorkingState& work);
  /// The same, and those that are not conservative by themselves into `work.not_conservative`.
  void evaluate_apart(const State& state, Real h, const LocalGroups& order, WorkingState& work);

  /// Those that are conservative where a step has arrived, at the time of its beginning: they may change from step to
  /// step. Writes m × 3 [N] in the solver's order, in which q and v are as well.
  void evaluate_conservative(const State& state, const Positions& q, const Positions& v, Real h,
                             const LocalGroups& order, Positions& forces);

 private:
  void add(const StateView& state, Real h, bool is_conservative);

  std::vector<Force*> forces_;
  Positions sum_, positions_, velocities_;  // in the order of the simulation
};

}  // namespace pliant
