#pragma once
// The numbers of a simulation, from a checkpoint.
#include <vector>

#include "pliant/simulation/simulation.h"
#include "pliant_io/scene/detail/json_values.h"

namespace pliant {

/// What a batch of constraints has: its stiffness and its parameters, and whether it stands beside the factor.
struct BatchNumbers {
  ConstraintGroup* batch = nullptr;
  Real stiffness = 0;
  std::vector<Real> parameters;
  bool is_beside_factor = false;
};

/// Of all groups. Refuses what does not fit those of the simulation.
std::vector<BatchNumbers> read_groups(const Node& list, const Simulation& simulation);
/// Gives each batch its numbers.
void set_numbers(const std::vector<BatchNumbers>& all);

/// `fresh`: of the simulation, which says how many vertices there are, with which masses. Whether colliders and
/// contacts are those of the simulation, Simulation::restore() says.
State read_state(const Node& node, const State& fresh);

}  // namespace pliant
