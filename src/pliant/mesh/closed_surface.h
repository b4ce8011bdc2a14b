#pragma once
// What has an inside: surfaces without border, turned outward.
#include <span>
#include <string_view>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

struct ClosedSurface {
  std::vector<Triangle> triangles;  ///< those of the mesh in its order, normals away from what is inside
  std::vector<Index> part;          ///< of each triangle: its connected part, numbered by their first triangles
  Real volume = 0;                  ///< enclosed; what several parts enclose counts for each of them [m³]
  Real area = 0;                    ///< [m²]
  Index part_count = 0;
  Index cavity_count = 0;  ///< parts whose normals point to the middle of a hole inside another part
  Index turned_count = 0;  ///< triangles whose direction in the mesh was the other one
};

/// The triangles of a mesh, each part of which is turned as its first triangle asks, then outward. A part that lies
/// inside another one and is turned against it is the wall of a cavity, and stays so. Parts may touch and overlap.
///
/// `name` is what messages call the mesh. Throws Error(input): no triangles; elements of other kinds, vertices in no
/// triangle; an open surface, with the length, the place and the first vertices of a loop; an edge of more than two
/// triangles; a one-sided surface; one that encloses nothing.
/// @pre check_mesh(mesh).
ClosedSurface closed_surface(const Mesh& mesh, std::string_view name);

/// 4π times the winding number of triangles about a place (Van Oosterom & Strackee 1983).
Real solid_angle(const Positions& x, std::span<const Triangle> triangles, const Vec3& place);

}  // namespace pliant
