#pragma once
// What was done to a session since its scene was opened, and what came of it, step by step.
#include <exception>
#include <utility>
#include <vector>

#include "pliant/simulation/simulation.h"
#include "viewer/action.h"

namespace pliant_viewer {

/// Of the bits of positions and velocities.
std::uint32_t state_checksum(const pliant::Simulation& simulation);

class SessionLog {
 public:
  static constexpr std::int64_t checksum_period = 60;  // [steps]

  /// Notes an action when it ends, unless it throws, or is a part of another one.
  class Scope {
   public:
    Scope(SessionLog& log, Action action) : log_(log), action_(std::move(action)) {
      ++log_.depth_;
      log_.make_room();
    }
    ~Scope() {
      if (--log_.depth_ > 0) return;
      const bool is_forgotten = std::exchange(log_.forgets_this_, false);
      if (!is_forgotten && std::uncaught_exceptions() == exceptions_) log_.add(std::move(action_));
    }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    SessionLog& log_;
    Action action_;
    int exceptions_ = std::uncaught_exceptions();
  };

  /// Forgets all, and an action that is under way.
  void clear();
  void took_step(const pliant::Simulation& simulation);

  std::int64_t steps() const { return steps_; }
  const std::vector<TimedAction>& actions() const { return actions_; }
  const std::vector<StepChecksum>& checksums() const { return checksums_; }

 private:
  void make_room();
  void add(Action action);  // there is room: it does not throw

  std::vector<TimedAction> actions_;
  std::vector<StepChecksum> checksums_;
  std::int64_t steps_ = 0;
  int depth_ = 0;
  bool forgets_this_ = false;
};

}  // namespace pliant_viewer
