#pragma once
// The key "solid" of a body: a lattice of tetrahedra inside its surface.
#include <string>
#include <vector>

#include "pliant/mesh/mesh.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// Makes the body's surface a solid. `node`: the value of the key; `body`: the object that has it. What is read
/// otherwise than one might expect is told in `warnings`.
void read_solid(const Node& node, const Node& body, const std::string& name, Mesh& mesh,
                std::vector<std::string>& warnings);

/// Rows for the surface's vertices alone, completed for those of the lattice: each has the departure of the nearest
/// vertex of the surface from `rest`. Rows of any other number are returned as they are.
Positions completed_rows(const Mesh& mesh, Positions rows, const Positions& rest);

}  // namespace pliant
