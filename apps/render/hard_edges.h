#pragma once
// Where a surface has edges at rest, as a crate does, its shading has them too.
#include <cstdint>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant_render {

/// Corners of triangles with vertices of their own wherever normals or texture coordinates differ.
struct ShadedCorners {
  std::vector<std::uint32_t> numbers;       ///< three for each triangle: a vertex, or past the last one a copy
  std::vector<std::uint32_t> copies;        ///< the vertex of each copy
  std::vector<std::uint32_t> normals_from;  ///< of each copy: the vertex or copy whose normal it has, or itself
};
/// Each vertex is copied for each smooth part of the surface around it but the first, and for each texture coordinate
/// of a part but the first. Parts are apart where triangles meet at more than 50 degrees at rest.
/// texture: the row of each corner in the list of texture coordinates, three for each triangle, or none.
ShadedCorners split_at_hard_edges(const pliant::Positions& rest, const std::vector<pliant::Triangle>& triangles,
                                  const std::vector<pliant::Index>& texture = {});

}  // namespace pliant_render
