#pragma once
// A divergence in the words of who made the simulation: names of bodies, groups and forces, numbers as the body has
// them.
#include <string>

#include "pliant/solver/divergence.h"

namespace pliant {

class Simulation;

std::string message_of(const DivergenceCause& cause, const Simulation& simulation);

}  // namespace pliant
