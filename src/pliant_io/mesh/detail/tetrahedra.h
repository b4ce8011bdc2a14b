#pragma once
// What the readers of tetrahedra share.
#include <cstdint>
#include <string>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// Adds a tetrahedron of vertices in range, its last two swapped where its volume would be negative: formats differ in
/// their order. What is wrong with it, as an error message without its place, or nothing; numbers in it count from
/// `first_number`.
std::string add_tetrahedron(Mesh& mesh, Tetrahedron tetrahedron, std::int64_t first_number);

/// Mesh generators save the borders of what they mesh as elements of a lower dimension: tetrahedra put faces and edges
/// out, faces put edges out.
void keep_highest_dimension(Mesh& mesh);

}  // namespace pliant
