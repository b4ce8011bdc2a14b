#pragma once
// Energy projection as a part of the step: it evaluates what EnergyBalance weighs, and moves positions and velocities.
#include "pliant/solver/integration/energy_balance.h"
#include "pliant/solver/step_context.h"

namespace pliant {

class EnergyProjection {
 public:
  /// To be called when the layout of the system has changed.
  void set_system(const System& system);

  /// Keeps the energy that a step begins with. Refers to the masses of `work` until project() has returned.
  void begin(const StepContext& step, const WorkingState& work);
  /// Moves positions and velocities of `work`, as the step has left them, onto the energy that they should have, and
  /// writes the surplus that it has to leave. Overwrites the residual. Throws Error(diverged) as
  /// check_finite() does. Allocates only where sizes have changed.
  void project(const StepContext& step, WorkingState& work);

 private:
  void evaluate_end(const StepContext& step, const WorkingState& work);
  void evaluate_elastic(const StepContext& step, const Positions& q);
  void add_external_groups(const System& system, const Positions& q);

  EnergyBalance balance_;
  std::vector<Real> elastic_;  // V of each component [J]
  Positions elastic_forces_;   // −∇V
  Positions outside_;          // what else acts
  Positions conservative_;     // forces at the end
  Positions direction_;
  std::vector<Real> slots_;  // of a constraint
};

}  // namespace pliant
