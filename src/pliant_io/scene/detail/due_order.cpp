#include "pliant_io/scene/detail/due_order.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/event_options.h"

namespace pliant {

void DueOrder::add(const Node& node) {
  const auto event = static_cast<Index>(whens_.size());
  whens_.push_back(read_when(node));
  if (whens_.back().is_step()) {
    by_step_.emplace(whens_.back().step(), event);
  } else {
    by_time_.emplace(whens_.back().time(), event);
  }
}

std::vector<Index> DueOrder::next(Real time_step) {
  std::vector<Index> due;
  if (by_step_.empty() && by_time_.empty()) return due;
  // A number of steps, which may be beyond all integers.
  Real step = std::numeric_limits<Real>::infinity();
  if (!by_step_.empty()) step = static_cast<Real>(by_step_.begin()->first);
  if (!by_time_.empty()) {
    const Real wait = std::ceil((by_time_.begin()->first - time_) / time_step - 1e-9);
    step = std::min(step, step_ + std::max(wait, Real(0)));
  }
  step = std::max(step, step_);
  time_ += (step - step_) * time_step;
  step_ = step;
  while (!by_step_.empty() && static_cast<Real>(by_step_.begin()->first) <= step_) take(by_step_, due);
  while (!by_time_.empty() && is_due(by_time_.begin()->first, time_step)) take(by_time_, due);
  if (due.empty()) take(by_time_, due);  // never for want of digits
  std::ranges::sort(due);
  return due;
}

When DueOrder::read_when(const Node& node) {
  EventTime given;
  node.require_object();
  const std::string_view key = node.require_one_of({"step", "time"});
  EventTime::visit(given, OptionReader{node});
  if (key == "step" && given.step < 0) {
    node.fail(fmt::format("step {} is before the start; steps count from 0", given.step));
  }
  if (given.time < 0) node.fail(fmt::format("{} s is before the start; times count from 0", given.time));
  return key == "step" ? When::at_step(given.step) : When::at_time(given.time);
}

/// With the rounding of a clock that does not count its steps one by one.
bool DueOrder::is_due(Real time, Real time_step) const {
  return (time - time_) / time_step <= 1e-9 * (1 + step_);
}

}  // namespace pliant
