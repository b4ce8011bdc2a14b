#pragma once
// Where a surface has edges at rest, as a crate does, its shading has them too.
#include <cstdint>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant_render {

/// Corners of triangles with vertices of their own wherever normals should differ.
struct ShadedCorners {
  std::vector<std::uint32_t> numbers;  ///< three for each triangle: a vertex, or past the last one a copy
  std::vector<std::uint32_t> copies;   ///< the vertex of each copy
};
/// Each vertex is copied for each smooth part of the surface around it but the first. Parts are apart where triangles
/// meet at more than 50 degrees at rest.
ShadedCorners split_at_hard_edges(const pliant::Positions& rest, const std::vector<pliant::Triangle>& triangles);

}  // namespace pliant_render
