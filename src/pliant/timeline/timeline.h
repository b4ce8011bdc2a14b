#pragma once
// What happens at given times while a simulation runs: edits of any kind, motions of targets and of colliders.
//
//     Timeline timeline;
//     timeline.add(When::at_time(1), [=](Simulation& s) { s.set_stiffness(skin, 500); });
//     timeline.add(When::at_step(90), [=](Simulation& s, Timeline& t) {
//       t.start(s, pins, rigid_path({{.time = 2, .rotate = {.axis = {0, 0, 1}, .degrees = 90}}}));
//     });
//     for (int i = 0; i < 300; ++i) timeline.step(simulation);
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <type_traits>

#include "pliant/timeline/collider_motions.h"

namespace pliant {

class Timeline;

/// A step or a time. A step n is due before the step n → n + 1; a time t before the first step with t ≤ tₙ + 1e-9 h.
class When {
 public:
  static When at_step(std::int64_t n) { return {n, 0}; }
  static When at_time(Real t) { return {std::nullopt, t}; }  ///< [s]

  bool is_step() const { return step_.has_value(); }
  std::int64_t step() const { return step_.value_or(0); }
  Real time() const { return time_; }

 private:
  When(std::optional<std::int64_t> step, Real time) : step_(step), time_(time) {}
  std::optional<std::int64_t> step_;
  Real time_;
};

/// A way of a group's stiffness from one value to another, by equal ratios in equal times.
struct StiffnessRamp {
  GroupId group{};
  Real from = 1;
  Real to = 1;
  Real begin = 0;     ///< tₙ [s]
  Real duration = 0;  ///< [s], > 0
  Ease ease = Ease::linear;
};

/// Where a timeline stands, as plain numbers: what a checkpoint holds of it.
struct TimelineState {
  struct Motion {
    Index event = -1;  ///< that began it; -1: it was begun outside of events
    Index order = 0;   ///< among those that began there
    MotionNumbers numbers;
  };
  std::vector<Index> applied;  ///< events in the order in which they acted
  std::vector<Motion> motions;
  std::vector<ColliderMotionNumbers> collider_motions;
  std::vector<StiffnessRamp> ramps;
};

/// Events still to come, motions under way.
class Timeline {
 public:
  using Edit = std::function<void(Simulation&, Timeline&)>;

  /// Adds an event and returns its number: 0, 1, ... Events due before the same step act in the order of their adding.
  /// What an edit does must follow from the simulation's make-up, not from its positions or velocities: a checkpoint
  /// does it again elsewhere. `name` is what messages call it; default "event 0", ... Throws Error(input) on a negative
  /// step or time, and on one that is not finite.
  Index add(When when, Edit edit, std::string name = {});
  template <class F>
  requires std::is_invocable_v<F, Simulation&> Index add(When when, F edit, std::string name = {}) {
    return add(when, Edit([edit](Simulation& simulation, Timeline&) { edit(simulation); }), std::move(name));
  }

  /// Lets targets of a group go along a path from now on: those with these numbers (Group::points), or all. A later
  /// motion of the same target takes over from where an earlier one has come; a jump is made at once. At the end of
  /// each step, t, targets are where the path is after t − tₙ, with tₙ from when it began. A target that is released or
  /// removed leaves its motion. Throws Error(input) when the group has no such target or the path does not fit.
  void start(Simulation& simulation, GroupId group, std::shared_ptr<Path> path, std::vector<Index> numbers = {});
  /// Lets a collider go along a path from now on, in place of its velocities: at the end of each step it is where the
  /// path is then, and it turns as the path does, about its position unless the path has a center. A jump is made in
  /// one step. With the velocities that it has it goes on behind the end.
  void start(Simulation& simulation, ColliderId collider, std::shared_ptr<Path> path);
  void stop(Simulation& simulation, ColliderId collider);
  /// Ends the motion of a collider and lets none begin: events that would move it, or stop it, act without that. For
  /// whoever moves it by hand. A checkpoint does not know of it.
  void leave_alone(const Simulation& simulation, ColliderId collider) {
    collider_motions_.leave_alone(simulation, collider);
  }
  /// Leaves targets where they are now; without numbers all of the group, whose ramp ends as well.
  void stop(Simulation& simulation, GroupId group, const std::vector<Index>& numbers = {});
  /// Lets the stiffness of a group go to another value in a time [s] > 0. Factorizes at each doubling.
  void ramp_stiffness(const Simulation& simulation, GroupId group, Real to, Real duration, Ease ease = Ease::linear);
  void stop_ramp(GroupId group) { ramps_.erase(group); }

  /// Lets due events act, moves targets, takes one step. When this throws, simulation and timeline are as before: what
  /// was due still is. Allocates nothing in a step without events.
  StepReport step(Simulation& simulation);

  /// Lets the events act that are due before that step at that time [s], and no others, without a step: what pins and
  /// forces a recorded run had then is found again by calling this for all of its steps in turn, from 0 on, whatever
  /// step and time the simulation is at. Motions that begin are not followed, see
  /// move_colliders and move_all. When this throws, simulation and timeline are as before.
  void act_due(Simulation& simulation, std::int64_t step, Real time);
  /// Sets where the next step takes the colliders that are on their way, without a step. With act_due before it, at the
  /// step and the time that the simulation is at, colliders of a recorded run are found again.
  void move_colliders(Simulation& simulation);

  /// The same of all that is on its way: targets of groups and stiffnesses as well as colliders.
  void move_all(Simulation& simulation);

  /// Takes away the events that are due at the next step, for whoever changed the simulation by hand so that one of
  /// them can no longer act. Returns how many there were. A checkpoint does not know of it.
  Index skip_due(const Simulation& simulation);

  /// The step before which the next waiting event is due, if the time step stays; none where none waits.
  std::optional<std::int64_t> next_due(const Simulation& simulation) const;
  std::size_t event_count() const { return events_.size(); }
  /// Whether something is still to come or under way.
  bool is_over() const {
    return by_step_.empty() && by_time_.empty() && motions_.empty() && collider_motions_.empty() && ramps_.empty();
  }

  TimelineState state() const;
  /// For a timeline and a simulation just made as those were that the state was taken of, or copied from them at an
  /// earlier time: lets the same events act in the same order, without steps, and takes up motions and ramps. With the
  /// numbers of the groups, their stiffnesses and the state restored after it, the steps that follow have the bits of
  /// the first run. Throws Error(input), with both as they were, on a state that is not of this timeline.
  void replay(Simulation& simulation, const TimelineState& state);

 private:
  struct Event {
    When when;
    Edit edit;
    std::string name;
  };
  struct Motion {
    GroupId group{};
    std::shared_ptr<Path> path;
    TimelineState::Motion state;
    std::vector<Index> indices{};  // of the targets in the group, as found last
    std::vector<Vec3> before{};    // their places before the step under way
    bool has_arrived = false;      // with that step
  };
  struct Ramp {
    StiffnessRamp numbers;
    Real before = 0;
    bool has_arrived = false;
  };

  /// The step before which events are due, and the latest time of those [s].
  struct Clock {
    std::int64_t step;
    Real latest;
  };
  static Clock clock(const Simulation& simulation, std::int64_t step, Real time);
  static Clock clock(const Simulation& simulation);
  bool is_due(const Clock& clock) const;
  std::vector<Index> due_events(const Clock& clock) const;
  void run_due(Simulation& simulation, std::int64_t step, Real time);
  void run(Simulation& simulation, Index event);
  void wait(Index event);
  bool is_waiting(Index event) const;
  void take_from_waiting(Index event);
  /// Calls f; when it throws, simulation and timeline are as before.
  template <class F>
  void all_or_nothing(Simulation& simulation, F&& f);

  void leave(GroupId group, std::vector<Index> numbers);
  static void find_targets(const Group& group, Motion& motion);
  void prepare(const Simulation& simulation);
  void go_on(Simulation& simulation);
  void go_back(Simulation& simulation);
  void end_what_arrived(Simulation& simulation);

  std::vector<Event> events_;
  std::multimap<std::int64_t, Index> by_step_;  // waiting
  std::multimap<Real, Index> by_time_;
  std::vector<Index> applied_;
  std::vector<Motion> motions_;
  ColliderMotions collider_motions_;
  std::map<GroupId, Ramp> ramps_;
  Index running_ = -1;  // event
  Index begun_ = 0;     // motions by it
  Index begun_outside_ = 0;
};

}  // namespace pliant
