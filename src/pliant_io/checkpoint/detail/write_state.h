#pragma once
// The numbers of a simulation, for a checkpoint.
#include <nlohmann/json.hpp>

#include "pliant/simulation/simulation.h"

namespace pliant {

nlohmann::json state_json(const State& state);
/// Stiffness and parameters of each batch of each group.
nlohmann::json groups_json(const Simulation& simulation);

}  // namespace pliant
