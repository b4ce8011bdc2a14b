#pragma once
// What a program does to the simulation that it shows.
#include <cstdint>
#include <functional>

#include "pliant/simulation/simulation.h"

namespace pliant_viewer {

/// Called on the simulation's thread: all before a step, the last two if there was a restart, or the simulation was
/// made anew, since the one before. What they throw ends the step.
struct ProgramHooks {
  std::function<void(pliant::Simulation&)> before_step{};
  std::function<void(pliant::Simulation&)> restarted{};
  std::function<void(pliant::Simulation&)> rebuilt{};
};

class HookCaller {
 public:
  void set(ProgramHooks hooks) { hooks_ = std::move(hooks); }
  /// Before a step, given how many restarts and rebuilds there were. Whatever they throw comes as a std::exception.
  void call(std::uint64_t restarts, std::uint64_t rebuilds, pliant::Simulation& simulation);

 private:
  ProgramHooks hooks_;
  std::uint64_t restarts_ = 0, rebuilds_ = 0;  // that were told
};

}  // namespace pliant_viewer
