#pragma once
// A step that would leave the finite numbers is refused, and its cause is named.
#include <string>
#include <string_view>

#include "pliant/core/error.h"
#include "pliant/solver/step_context.h"

namespace pliant {

/// What a refused step fails on, in the numbers of the simulation.
struct DivergenceCause {
  std::int64_t step = 0;                   ///< that was refused, from 1
  Real time = 0;                           ///< at its end [s]
  Index vertex = 0;                        ///< that would leave
  const Force* force = nullptr;            ///< that is behind it, by itself or by a group that it brings
  const ConstraintGroup* group = nullptr;  ///< else that whose constraint is behind it
  Index constraint = 0;                    ///< of that group
  std::string remark{};                    ///< where it is neither: what is wrong, and the remedy
};

/// Error(diverged). A solver knows no names of bodies and groups; who does can put the cause into words again.
class Divergence : public Error {
 public:
  explicit Divergence(DivergenceCause cause);
  const DivergenceCause& cause() const { return cause_; }

 private:
  DivergenceCause cause_;
};

/// The message with these words for the vertex ("vertex 3"), the force ("the force `wind`") and the constraint.
std::string message_of(const DivergenceCause& cause, std::string_view vertex, std::string_view force,
                       std::string_view constraint);

/// Throws Divergence: the first vertex that would leave, and what is behind it. One solve takes the whole body along,
/// so the cause is looked for before that, in the order of the step.
[[noreturn]] void report_divergence(const StepContext& step, const WorkingState& work);

/// Does so where the positions have diverged.
void check_finite(const StepContext& step, const WorkingState& work);

}  // namespace pliant
