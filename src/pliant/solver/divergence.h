#pragma once
// A step that would leave the finite numbers is refused, and its cause is named.
#include "pliant/solver/step_context.h"

namespace pliant {

/// Throws Error(diverged) that names the first vertex that would leave for there, and the force or constraint behind
/// it. One solve takes the whole body along, so the cause is looked for before that, in the order of the step.
[[noreturn]] void report_divergence(const StepContext& step, const WorkingState& work);

/// Does so where the positions have diverged.
void check_finite(const StepContext& step, const WorkingState& work);

}  // namespace pliant
