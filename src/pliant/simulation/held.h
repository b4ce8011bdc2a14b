#pragma once
// What pins hold.
#include <vector>

#include "pliant/simulation/simulation.h"

namespace pliant {

/// Of each vertex of the simulation, whether a hard pin holds it: not 0 then.
std::vector<char> held_vertices(const Simulation& simulation);

/// The vertices that a group of positions holds, hard or soft, in the order of its targets, with their indices in the
/// simulation.
std::vector<Index> vertices_of_pins(const Group& group);

/// Whether hard pins hold every vertex of a body, as of one that is animated. held: as held_vertices returns it.
bool is_held(const Body& body, const std::vector<char>& held);

}  // namespace pliant
