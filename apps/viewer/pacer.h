#pragma once
// When steps are due.
#include <chrono>

namespace pliant_viewer {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Lets simulated time keep up with the clock where the machine can, and is at most `most_behind` steps behind where it
/// cannot: what is beyond that is forgotten, so that it does not have to be made up for.
class Pacer {
 public:
  static constexpr double most_behind = 4;  // [steps]
  static constexpr double unlimited = 1e6;  // speeds from here on: as fast as the machine can

  /// Simulated seconds in a second, > 0.
  void set_speed(double speed) { speed_ = speed; }
  double speed() const { return speed_; }
  /// Begins anew: the first step is due now.
  void start(Clock::time_point now);
  /// How long to wait for the next step of length h [s]; zero: it is due.
  Seconds wait(Clock::time_point now, double h);
  /// To be told after a step.
  void took_step() { --steps_behind_; }
  /// Steps that are due [steps].
  double steps_behind() const { return steps_behind_; }

 private:
  double speed_ = 1;
  Clock::time_point last_{};
  double steps_behind_ = 1;
};

}  // namespace pliant_viewer
