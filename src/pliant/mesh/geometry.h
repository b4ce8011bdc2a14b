#pragma once
// Lengths, areas, volumes and normals of elements, and the check that every mesh passes before it is simulated.
#include <span>
#include <string_view>
#include <vector>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// Area of the triangle x0 x1 x2 [m²], ≥ 0.
Real triangle_area(const Vec3& x0, const Vec3& x1, const Vec3& x2);

/// Signed volume of a tetrahedron [m³]: det(x1 − x0, x2 − x0, x3 − x0)/6.
Real tetrahedron_volume(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3);

/// Length of each edge [m].
std::vector<Real> edge_lengths(const Positions& x, std::span<const Edge> edges);

/// Area of each triangle [m²].
std::vector<Real> triangle_areas(const Positions& x, std::span<const Triangle> triangles);

/// Signed volume of each tetrahedron [m³].
std::vector<Real> tetrahedron_volumes(const Positions& x, std::span<const Tetrahedron> tetrahedra);

/// Unit normal of each triangle by the right-hand rule, triangles × 3; zero for a triangle without area.
Positions triangle_normals(const Positions& x, std::span<const Triangle> triangles);

/// A third of the area of the triangles at each vertex [m²]; zero for a vertex without triangles.
std::vector<Real> vertex_areas(const Positions& x, std::span<const Triangle> triangles);

/// The smallest box with sides along the axes that holds the vertices.
struct BoundingBox {
  Vec3 min = Vec3::Zero();
  Vec3 max = Vec3::Zero();

  /// The "size" of a mesh that tolerances are relative to [m].
  Real diagonal() const { return (max - min).stableNorm(); }
};

/// The box of at least one position; of none, the empty box at the origin.
BoundingBox bounding_box(const Positions& x);

/// Coordinates up to here leave areas and volumes finite [m].
inline constexpr Real coordinate_limit = 1e100;

/// Whether an element has no extent: its measure is under 1e-12 of that power of its own longest edge; the ends of an
/// edge agree to rounding.
bool has_no_extent(const Positions& x, const Edge& edge);
bool has_no_extent(const Positions& x, const Triangle& triangle);
bool has_no_extent(const Positions& x, const Tetrahedron& tetrahedron);

/// Refuses a mesh that cannot be simulated. `name` is what the message calls the mesh: a body's name or its file.
/// Indices in messages count from 0.
/// @throws Error (input) naming the first vertex or element and the remedy: no vertices; a coordinate not finite or
///   past coordinate_limit; an index out of range, also in Mesh::faces; a vertex repeated within an element; an edge,
///   triangle or tetrahedron without length, area or volume; an inverted tetrahedron.
void check_mesh(const Mesh& mesh, std::string_view name);

}  // namespace pliant
