#pragma once
// Surfaces of colliders as meshes, for pictures and exports. Contact does not use them.
#include "pliant/collision/colliders/collider.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

/// Everything within `rounding` [m] of a box with these half sizes [m] about the origin: a box with round edges, a
/// capsule where two of the half sizes are 0, a sphere where all are. The vertices lie on the surface, the triangles
/// are closed and outward, with 64 around a circle. Without rounding: a box of 12 triangles.
Mesh rounded_box(const Vec3& half_size, Real rounding);

/// A normal of the shape for each corner of the triangles of its surface, 3 × triangles rows: the same at all corners
/// of a vertex where the shape is round, that of each face along a sharp edge.
Positions corner_normals(const ColliderShape& shape, const Mesh& surface);

}  // namespace pliant
