#pragma once
#include "pliant/mesh/mass.h"
#include "pliant/mesh/mesh.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// A body's mesh: {"file": ...}, {"shape": ..., options} or {"vertices": ..., "triangles": ...}. Loose vertices that
/// are left out are told in `warnings`.
Mesh read_mesh(const Node& node, std::vector<std::string>& warnings);

/// Scales, then turns, then moves.
void apply_transform(const Node& node, Positions& positions);

/// One of the ways to say a mass; the keys are the names of class Mass. `mesh` is what maps refer to.
Mass read_mass(const Node& node, const Mesh& mesh);

/// The same mass where it is said for vertices. Where it is shared by elements, a loose vertex gets a thousandth of the
/// mean of the others, so that it can be simulated and changes nothing; that is told in `warnings`.
Mass with_loose_vertices(Mass mass, const Node& node, const Mesh& mesh, std::vector<std::string>& warnings);

}  // namespace pliant
