#include "pliant/timeline/timeline.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "pliant/simulation/transaction.h"

namespace pliant {
namespace {

const Group& group_of(const Simulation& simulation, GroupId id) {
  const auto found = simulation.groups().find(id);
  if (found == simulation.groups().end())
    fail_input(fmt::format("group {} does not exist; give one that was added and not removed", static_cast<Index>(id)));
  return found->second;
}

/// Where a group has its targets, by their numbers.
class PointFinder {
 public:
  explicit PointFinder(const Group& group) : points_(group.points) {}

  /// The place of a number, tried at `hint` first.
  std::optional<Index> operator()(Index number, Index hint) {
    const auto i = static_cast<std::size_t>(hint);
    if (i < points_.size() && points_[i] == number) return hint;
    if (order_.empty()) {
      for (std::size_t k = 0; k < points_.size(); ++k) order_.emplace_back(points_[k], static_cast<Index>(k));
      std::ranges::sort(order_);
    }
    const auto found = std::ranges::lower_bound(order_, std::pair(number, Index{0}));
    if (found == order_.end() || found->first != number) return std::nullopt;
    return found->second;
  }

 private:
  const std::vector<Index>& points_;
  std::vector<std::pair<Index, Index>> order_;  // number and place, made once it is needed
};

[[noreturn]] void fail_no_point(const Group& group, Index number) {
  if (number >= 0 && number < group.next_point) {
    fail_input(fmt::format("constraint {} of the group '{}' was released; leave it out", number, group.name));
  }
  fail_input(fmt::format("index {} is out of range; the group has constraints 0 to {}", number, group.next_point - 1));
}

/// The entry of a key and an event, or the end.
template <class Waiting, class Key>
auto find_in(Waiting& waiting, Key key, Index event) {
  const auto [first, last] = waiting.equal_range(key);
  const auto found = std::find_if(first, last, [event](const auto& entry) { return entry.second == event; });
  return found == last ? waiting.end() : found;
}

Real stiffness_at(const StiffnessRamp& ramp, Real elapsed) {
  Real share = elapsed / ramp.duration;
  if (ramp.ease == Ease::smooth) share *= share * (3 - 2 * share);
  return ramp.from * std::pow(ramp.to / ramp.from, share);
}

void check_ramp(const Simulation& simulation, const StiffnessRamp& ramp) {
  const Group& group = group_of(simulation, ramp.group);
  if (!simulation.stiffness(ramp.group)) {
    fail_input(fmt::format("the group '{}' has no stiffness; hard pins have none", group.name));
  }
  for (const Real stiffness : {ramp.from, ramp.to}) {
    if (stiffness > 0 && std::isfinite(stiffness)) continue;
    fail_input(fmt::format("the stiffness {} is out of range; give a finite number above 0", stiffness));
  }
  if (!(ramp.duration > 0) || !std::isfinite(ramp.duration)) {
    fail_input(fmt::format("the duration {} s of a ramp is out of range; give a finite number above 0", ramp.duration));
  }
}

}  // namespace

template <class F>
void Timeline::all_or_nothing(Simulation& simulation, F&& f) {
  Transaction transaction(simulation);
  const std::vector<Motion> motions = motions_;
  const ColliderMotions collider_motions = collider_motions_;
  const std::map<GroupId, Ramp> ramps = ramps_;
  const std::size_t event_count = events_.size();
  const std::size_t applied_count = applied_.size();
  try {
    f();
  } catch (...) {
    motions_ = motions;
    collider_motions_ = collider_motions;
    ramps_ = ramps;
    for (std::size_t i = applied_count; i < applied_.size(); ++i) wait(applied_[i]);
    applied_.resize(applied_count);
    for (std::size_t i = event_count; i < events_.size(); ++i) take_from_waiting(static_cast<Index>(i));
    events_.erase(events_.begin() + static_cast<std::ptrdiff_t>(event_count), events_.end());
    running_ = -1;
    throw;
  }
  transaction.commit();
}

Index Timeline::add(When when, Edit edit, std::string name) {
  if (when.step() < 0) fail_input(fmt::format("step {} is before the start; steps count from 0", when.step()));
  if (!std::isfinite(when.time())) fail_input("the time is not finite; give a finite number");
  if (when.time() < 0) fail_input(fmt::format("{} s is before the start; times count from 0", when.time()));
  const auto event = static_cast<Index>(events_.size());
  if (name.empty()) name = fmt::format("event {}", event);
  events_.push_back({when, std::move(edit), std::move(name)});
  wait(event);
  return event;
}

void Timeline::wait(Index event) {
  const When& when = events_[static_cast<std::size_t>(event)].when;
  if (when.is_step()) {
    by_step_.emplace(when.step(), event);
  } else {
    by_time_.emplace(when.time(), event);
  }
}

bool Timeline::is_waiting(Index event) const {
  const When& when = events_[static_cast<std::size_t>(event)].when;
  return when.is_step() ? find_in(by_step_, when.step(), event) != by_step_.end()
                        : find_in(by_time_, when.time(), event) != by_time_.end();
}

void Timeline::take_from_waiting(Index event) {
  const When& when = events_[static_cast<std::size_t>(event)].when;
  if (when.is_step()) {
    if (const auto found = find_in(by_step_, when.step(), event); found != by_step_.end()) by_step_.erase(found);
  } else {
    if (const auto found = find_in(by_time_, when.time(), event); found != by_time_.end()) by_time_.erase(found);
  }
}

void Timeline::start(Simulation& simulation, GroupId id, std::shared_ptr<Path> path, std::vector<Index> numbers) {
  const Group& group = group_of(simulation, id);
  if (group.points.empty()) {
    fail_input(fmt::format("the group '{}' has no targets to be moved; only positions and drags have", group.name));
  }
  Motion motion{id, std::move(path), {}};
  PointFinder find_point(group);
  const std::vector<Index>& moved = numbers.empty() ? group.points : numbers;
  for (const Index number : moved) {
    const auto place = static_cast<Index>(motion.indices.size());
    const std::optional<Index> index = find_point(number, place);
    if (!index) fail_no_point(group, number);
    motion.state.numbers.points.push_back({number, place, simulation.target(id, *index)});
    motion.indices.push_back(*index);
  }
  motion.state.event = running_;
  motion.state.order = running_ < 0 ? begun_outside_++ : begun_++;
  motion.state.numbers.begin = simulation.state().time;
  motion.before.resize(motion.indices.size());
  motion.path->begin(simulation, id, motion.state.numbers);
  leave(id, std::move(numbers));
  simulation.note_change();
  if (motion.path->duration() > 0) {
    motions_.push_back(std::move(motion));
    return;
  }
  motion.path->go_to(simulation, motion.state.numbers, 0);
  for (std::size_t i = 0; i < motion.indices.size(); ++i) {
    simulation.set_target(id, motion.indices[i], motion.path->at(motion.state.numbers.points[i]));
  }
}

void Timeline::start(Simulation& simulation, ColliderId collider, std::shared_ptr<Path> path) {
  const Index order = running_ < 0 ? begun_outside_++ : begun_++;
  collider_motions_.start(simulation, collider, std::move(path), running_, order);
  simulation.note_change();
}

void Timeline::leave(GroupId group, std::vector<Index> numbers) {
  std::ranges::sort(numbers);
  for (Motion& motion : motions_) {
    if (motion.group != group) continue;
    std::erase_if(motion.state.numbers.points, [&](const MotionPoint& point) {
      return numbers.empty() || std::ranges::binary_search(numbers, point.number);
    });
    motion.indices.assign(motion.state.numbers.points.size(), -1);
  }
  std::erase_if(motions_, [](const Motion& motion) { return motion.state.numbers.points.empty(); });
}

void Timeline::stop(Simulation& simulation, GroupId group, const std::vector<Index>& numbers) {
  group_of(simulation, group);
  leave(group, numbers);
  if (numbers.empty()) ramps_.erase(group);
  simulation.note_change();
}

void Timeline::stop(Simulation& simulation, ColliderId collider) {
  collider_motions_.stop(simulation, collider);
  simulation.note_change();
}

void Timeline::ramp_stiffness(const Simulation& simulation, GroupId id, Real to, Real duration, Ease ease) {
  group_of(simulation, id);
  const StiffnessRamp ramp{id, simulation.stiffness(id).value_or(1), to, simulation.state().time, duration, ease};
  check_ramp(simulation, ramp);
  ramps_.insert_or_assign(id, Ramp{ramp});
}

Timeline::Clock Timeline::clock(const Simulation& simulation, std::int64_t step, Real time) {
  return {step, time + 1e-9 * simulation.settings().time_step};
}

Timeline::Clock Timeline::clock(const Simulation& simulation) {
  return clock(simulation, simulation.state().step, simulation.state().time);
}

bool Timeline::is_due(const Clock& clock) const {
  return (!by_step_.empty() && by_step_.begin()->first <= clock.step) ||
         (!by_time_.empty() && by_time_.begin()->first <= clock.latest);
}

std::vector<Index> Timeline::due_events(const Clock& clock) const {
  std::vector<Index> due;
  for (const auto& [step, event] : by_step_) {
    if (step > clock.step) break;
    due.push_back(event);
  }
  for (const auto& [time, event] : by_time_) {
    if (time > clock.latest) break;
    due.push_back(event);
  }
  std::ranges::sort(due);
  return due;
}

void Timeline::run_due(Simulation& simulation, std::int64_t step, Real time) {
  // An edit may add events that are due at once, or change the time step.
  for (Clock now = clock(simulation, step, time); is_due(now); now = clock(simulation, step, time)) {
    for (const Index event : due_events(now)) run(simulation, event);
  }
}

void Timeline::act_due(Simulation& simulation, std::int64_t step, Real time) {
  if (is_due(clock(simulation, step, time))) all_or_nothing(simulation, [&] { run_due(simulation, step, time); });
}

void Timeline::move_colliders(Simulation& simulation) {
  collider_motions_.prepare(simulation);
  collider_motions_.go_on(simulation);
  collider_motions_.end_what_arrived();
}

void Timeline::move_all(Simulation& simulation) {
  prepare(simulation);
  go_on(simulation);
  end_what_arrived(simulation);
}

std::optional<std::int64_t> Timeline::next_due(const Simulation& simulation) const {
  constexpr Real far = 1e15;  // steps
  const Clock now = clock(simulation);
  Real next = std::numeric_limits<Real>::infinity();
  if (!by_step_.empty()) next = static_cast<Real>(by_step_.begin()->first);
  if (!by_time_.empty()) {
    const Real wait = std::ceil((by_time_.begin()->first - now.latest) / simulation.settings().time_step);
    next = std::min(next, static_cast<Real>(now.step) + wait);
  }
  if (std::isinf(next)) return std::nullopt;
  return std::max(now.step, static_cast<std::int64_t>(std::min(next, far)));
}

Index Timeline::skip_due(const Simulation& simulation) {
  const std::vector<Index> due = due_events(clock(simulation));
  for (const Index event : due) take_from_waiting(event);
  return static_cast<Index>(due.size());
}

void Timeline::run(Simulation& simulation, Index event) {
  // Copied: an edit may add events, which moves those that there are.
  const Edit edit = events_[static_cast<std::size_t>(event)].edit;
  const std::string name = events_[static_cast<std::size_t>(event)].name;
  take_from_waiting(event);
  applied_.push_back(event);
  running_ = event;
  begun_ = 0;
  try {
    edit(simulation, *this);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    fail_input(fmt::format("{}: {}", name, error.what()));
  }
  running_ = -1;
}

StepReport Timeline::step(Simulation& simulation) {
  StepReport report;
  if (is_due(clock(simulation))) {
    all_or_nothing(simulation, [&] {
      run_due(simulation, simulation.state().step, simulation.state().time);
      prepare(simulation);
      go_on(simulation);
      report = simulation.step();
    });
  } else {
    prepare(simulation);
    try {
      go_on(simulation);
      report = simulation.step();
    } catch (...) {
      go_back(simulation);
      throw;
    }
  }
  end_what_arrived(simulation);
  return report;
}

/// Finds the targets of a motion anew where others of its group have gone; a released one leaves.
void Timeline::find_targets(const Group& group, Motion& motion) {
  std::vector<MotionPoint>& points = motion.state.numbers.points;
  PointFinder find_point(group);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Index hint = motion.indices[i] >= 0 ? motion.indices[i] : points[i].place;
    const std::optional<Index> index = find_point(points[i].number, hint);
    if (!index) continue;
    points[kept] = points[i];
    motion.indices[kept++] = *index;
  }
  points.resize(kept);
  motion.indices.resize(kept);
}

/// Lets motions go whose targets are no more, and notes where the others are.
void Timeline::prepare(const Simulation& simulation) {
  const auto is_gone = [&](GroupId group) { return !simulation.groups().contains(group); };
  std::erase_if(motions_, [&](const Motion& motion) { return is_gone(motion.group); });
  std::erase_if(ramps_, [&](const auto& entry) { return is_gone(entry.first) || !simulation.stiffness(entry.first); });
  for (Motion& motion : motions_) {
    find_targets(simulation.groups().at(motion.group), motion);
    for (std::size_t i = 0; i < motion.indices.size(); ++i) {
      motion.before[i] = simulation.target(motion.group, motion.indices[i]);
    }
  }
  for (auto& [id, ramp] : ramps_) ramp.before = *simulation.stiffness(id);
  collider_motions_.prepare(simulation);
}

void Timeline::go_on(Simulation& simulation) {
  const Real end_of_step = simulation.state().time + simulation.settings().time_step;
  for (Motion& motion : motions_) {
    const Real duration = motion.path->duration();
    const Real elapsed = end_of_step - motion.state.numbers.begin;
    motion.has_arrived = is_past(elapsed, duration);
    motion.path->go_to(simulation, motion.state.numbers, motion.has_arrived ? duration : elapsed);
    for (std::size_t i = 0; i < motion.indices.size(); ++i) {
      simulation.set_target(motion.group, motion.indices[i], motion.path->at(motion.state.numbers.points[i]));
    }
  }
  const bool may_keep_factor = simulation.settings().acceleration != Acceleration::chebyshev;
  for (auto& [id, ramp] : ramps_) {
    const Real elapsed = end_of_step - ramp.numbers.begin;
    ramp.has_arrived = is_past(elapsed, ramp.numbers.duration);
    const Real stiffness = ramp.has_arrived ? ramp.numbers.to : stiffness_at(ramp.numbers, elapsed);
    simulation.set_stiffness(id, stiffness);
    if (!may_keep_factor || ramp.has_arrived) continue;
    for (const auto& batch : simulation.groups().at(id).set.batches) {
      if (batch->shape().count > 0) batch->set_passing_stiffness(stiffness);
    }
  }
  collider_motions_.go_on(simulation);
}

void Timeline::go_back(Simulation& simulation) {
  for (const Motion& motion : motions_) {
    for (std::size_t i = 0; i < motion.indices.size(); ++i) {
      simulation.set_target(motion.group, motion.indices[i], motion.before[i]);
    }
  }
  for (const auto& [id, ramp] : ramps_) {
    simulation.set_stiffness(id, ramp.before);
  }
  collider_motions_.go_back(simulation);
}

/// A ramp that is ended before the next step leaves a stiffness that does not pass any longer.
void Timeline::end_what_arrived(Simulation& simulation) {
  std::erase_if(motions_, [](const Motion& motion) { return motion.has_arrived; });
  std::erase_if(ramps_, [](const auto& entry) { return entry.second.has_arrived; });
  for (const auto& [id, ramp] : ramps_) simulation.set_stiffness(id, *simulation.stiffness(id));
  collider_motions_.end_what_arrived();
}

TimelineState Timeline::state() const {
  TimelineState state;
  state.applied = applied_;
  for (const Motion& motion : motions_) state.motions.push_back(motion.state);
  state.collider_motions = collider_motions_.numbers();
  for (const auto& [id, ramp] : ramps_) state.ramps.push_back(ramp.numbers);
  return state;
}

void Timeline::replay(Simulation& simulation, const TimelineState& state) {
  const bool has_same_past =
      applied_.size() <= state.applied.size() && std::equal(applied_.begin(), applied_.end(), state.applied.begin());
  if (!has_same_past) fail_input("replay: this timeline has begun already, and otherwise; make a new one");
  all_or_nothing(simulation, [&, past = applied_.size()] {
    for (const Index event : std::span(state.applied).subspan(past)) {
      if (event < 0 || static_cast<std::size_t>(event) >= events_.size() || !is_waiting(event)) {
        fail_input(fmt::format("replay: event {} is not of this timeline; make it as it was", event));
      }
      run(simulation, event);
    }
    std::vector<Motion> motions;
    for (const TimelineState::Motion& saved : state.motions) {
      const auto found = std::ranges::find_if(motions_, [&](const Motion& motion) {
        return motion.state.event == saved.event && motion.state.order == saved.order;
      });
      if (found == motions_.end()) {
        fail_input(fmt::format("replay: motion {} of event {} was not begun; begin those outside of events first",
                               saved.order, saved.event));
      }
      found->path->check(simulation, saved.numbers);
      Motion& motion = motions.emplace_back(*found);
      motion.state = saved;
      motion.indices.assign(saved.numbers.points.size(), -1);
      motion.before.resize(saved.numbers.points.size());
    }
    motions_ = std::move(motions);
    collider_motions_.restore(simulation, state.collider_motions);
    ramps_.clear();
    for (const StiffnessRamp& ramp : state.ramps) {
      check_ramp(simulation, ramp);
      ramps_.emplace(ramp.group, Ramp{ramp});
    }
  });
}

}  // namespace pliant
