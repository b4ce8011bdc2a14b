#pragma once
// By what the stiffness of a body's groups is multiplied, vertex by vertex.
#include "pliant/simulation/simulation.h"
#include "pliant_io/scene/detail/json_node.h"
#include "pliant_io/scene/scene.h"

namespace pliant {

/// {"cloth.bend": [one number a vertex]} or {"cloth.bend": {"map": ..., "from": a, "to": b}}, of groups on a body that
/// is there; those of a group that is switched off are kept with it. Throws Error(input) on a group that the body does
/// not have, and on other than one factor above 0 for each vertex.
void read_stiffness_factors(const Node& node, BodyId body, std::map<std::string, DisabledPart>& disabled,
                            Simulation& simulation);

}  // namespace pliant
