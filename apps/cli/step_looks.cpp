#include "step_looks.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "motion_advice.h"

namespace pliant_cli {

namespace {

using pliant::change_gap;
using pliant::look_after_change;

/// The step of the last change after which the motion has begun by now; 0: none, or it was long ago.
std::int64_t begun_change(const pliant::State& state) {
  const std::int64_t passed = state.step - state.changed_step;
  if (passed >= look_after_change) return state.changed_step;
  const bool follows_another = passed < 0;  // and is followed later for that
  return follows_another ? state.changed_step - change_gap : 0;
}

}  // namespace

StepLooks::StepLooks(const pliant::State& state, std::int64_t steps) : steps_(steps), followed_(begun_change(state)) {}

bool StepLooks::is_second(std::int64_t step) const {
  return first_ && step >= first_->step + second_look;
}

bool StepLooks::is_due_after_change(const pliant::State& state) const {
  if (state.step >= steps_) return false;
  if (first_) return is_second(state.step);
  const std::int64_t change = begun_change(state);
  if (change <= followed_ || state.step < change + look_after_change) return false;
  return looked_at_change_ == 0 || state.step >= looked_at_change_ + std::max(change_gap, looked_at_change_ / 10);
}

bool StepLooks::is_due(const pliant::State& state) const {
  if (state.step >= steps_) return false;
  if (first_ || is_due_after_change(state)) return is_due_after_change(state);
  std::int64_t looked_at = 30;
  while (looked_at < state.step) looked_at *= 10;
  return state.step == looked_at;
}

bool StepLooks::is_waiting(const pliant::State& state) const {
  return state.step < steps_ && (is_undecided() || (state.changed_step > followed_ && state.changed_step > 0));
}

void StepLooks::look(pliant::Simulation& simulation) {
  const pliant::State& state = simulation.state();
  const std::int64_t step = state.step;
  const bool follows_event = first_ ? first_->follows_event : is_due_after_change(state);
  if (!first_ && follows_event) {
    followed_ = begun_change(state);
    looked_at_change_ = step;
  }
  const std::optional<pliant::StepError> error = find_step_error(simulation);
  if (!error) return end();
  StepLook look{step, follows_event, *error, exact_text(simulation, *error), ""};
  const std::string when = follows_event ? fmt::format(" in step {}, after an event", step) : "";
  look.warning = far_from_converged_text(simulation, *error, when);
  if (!first_ && !look.warning.empty() && step + second_look < steps_) {
    first_ = std::move(look);
    return;
  }
  std::optional<StepLook> first = std::exchange(first_, std::nullopt);
  count(first && first->error.share < look.error.share ? *std::move(first) : std::move(look));
}

void StepLooks::end() {
  if (first_) count(*std::exchange(first_, std::nullopt));
}

void StepLooks::count(StepLook look) {
  if (!worst_ || worst_->error.share < look.error.share) worst_ = std::move(look);
}

}  // namespace pliant_cli
