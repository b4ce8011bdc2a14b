#pragma once
// What a program does to the simulation that it shows.
#include <functional>

#include "pliant/simulation/simulation.h"

namespace pliant_viewer {

/// Called on the simulation's thread. What before_step throws ends the step.
struct ProgramHooks {
  std::function<void(pliant::Simulation&)> before_step{};
  std::function<void(pliant::Simulation&)> restarted{};
  std::function<void(pliant::Simulation&)> rebuilt{};
};

}  // namespace pliant_viewer
