#pragma once
// When steps are due.
#include <chrono>

namespace pliant_viewer {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Keeps simulated time in step with the clock where the machine is fast enough. Where it is not, the simulation falls
/// at most `most_behind` steps behind: a longer lag is forgotten, so that it never has to be made up for.
class Pacer {
 public:
  static constexpr double most_behind = 4;  // [steps]
  static constexpr double unlimited = 1e6;  // speeds from here on mean: as fast as possible

  /// Simulated seconds per second, > 0.
  void set_speed(double speed) { speed_ = speed; }
  double speed() const { return speed_; }
  /// Starts over: the first step is due now.
  void start(Clock::time_point now);
  /// How long to wait for the next step of length h [s]; zero when it is due.
  Seconds wait(Clock::time_point now, double h);
  /// Call after each step.
  void took_step() { --steps_behind_; }
  /// Steps that are due [steps].
  double steps_behind() const { return steps_behind_; }

 private:
  double speed_ = 1;
  Clock::time_point last_{};
  double steps_behind_ = 1;
};

}  // namespace pliant_viewer
