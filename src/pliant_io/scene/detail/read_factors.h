#pragma once
// By what the stiffness of a body's groups is multiplied, vertex by vertex.
#include "pliant/simulation/simulation.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// {"cloth.bend": [one number a vertex]} or {"cloth.bend": {"map": ..., "from": a, "to": b}}, of groups on a body that
/// is there. Throws Error(input) on a group that it does not have, unless those are passed over, and on other than one
/// factor above 0 for each vertex.
void read_stiffness_factors(const Node& node, BodyId body, bool passes_over, Simulation& simulation);

}  // namespace pliant
