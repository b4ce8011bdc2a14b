#pragma once
// Now and then a run looks at how far its next step is from converged, and tells the worst of what it saw.
#include <optional>
#include <string>

#include "pliant/simulation/step_error.h"

namespace pliant_cli {

inline constexpr std::int64_t second_look = 5;  ///< steps

/// How far a step is from converged, in numbers and in words.
struct StepLook {
  std::int64_t step = 0;  ///< the number of steps before it
  bool follows_event = false;
  pliant::StepError error;
  std::string text;     ///< "20 iterations leave 'shirt' 0.78 mm from where a step ends, ..."
  std::string warning;  ///< far_from_converged_text(); empty: not far
};

/// Of a step that is far from converged and the second_look-th after it, if there is one, the better counts: a
/// single step of an impact can be far from converged without being seen.
class StepLooks {
 public:
  /// `steps`: how many there will be. Changes before the state of now are not followed.
  StepLooks(const pliant::State& state, std::int64_t steps);

  /// Whether the next step is to be looked at: the 30th, the 300th, the 3,000th, and the tenth after what holds or
  /// drives bodies has changed. Seldom, since it takes many iterations: the latter at most once in change_gap steps,
  /// and in a tenth of those taken.
  bool is_due(const pliant::State& state) const;
  /// The same of changes alone, and of the second look that may follow.
  bool is_due_after_change(const pliant::State& state) const;
  /// Whether a step was far from converged, and the second one is still to come.
  bool is_undecided() const { return first_.has_value(); }
  /// Whether that is so, or a change is still to be looked at.
  bool is_waiting(const pliant::State& state) const;

  /// Looks at the next step, due or not, and leaves the state as it is.
  /// @throws Error (interrupted) when it is given up (Simulation::set_stop)
  void look(pliant::Simulation& simulation);
  /// To be called when there are no more steps.
  void end();

  const std::optional<StepLook>& worst() const { return worst_; }

 private:
  bool is_second(std::int64_t step) const;
  void count(StepLook look);

  std::int64_t steps_;
  std::int64_t followed_ = 0;          // the step before which that was that was looked at last
  std::int64_t looked_at_change_ = 0;  // the step of that look; 0: none
  std::optional<StepLook> first_;      // far from converged, until it is seen whether a later one is too
  std::optional<StepLook> worst_;
};

}  // namespace pliant_cli
