#pragma once
// What the parts of a step outside the solver need of it.
#include "pliant/core/thread_pool.h"
#include "pliant/solver/applied_forces.h"
#include "pliant/solver/contact_solver.h"
#include "pliant/solver/system.h"

namespace pliant {

struct StepContext {
  const SolverSettings& settings;
  Real time_step;  ///< of the substep [s]
  System& system;
  AppliedForces& forces;
  ContactSolver& contact;
  ThreadPool& threads;
  const State& state;  ///< that the substep began with, in the order of the simulation
};

}  // namespace pliant
