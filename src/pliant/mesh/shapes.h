#pragma once
// Meshes from a few numbers. Every function throws Error (input) that names the option when one is out of its range or
// when the shape would have more than max_shape_vertices.
#include <array>

#include "pliant/mesh/mesh.h"

namespace pliant {

/// A shape with more vertices than this is refused, as a slip of the keyboard.
inline constexpr Index max_shape_vertices = 100'000'000;

/// The plane of a grid: the columns run along the first axis, the rows along the second.
enum class Plane { xy, xz, yz };

/// How a grid's cells are cut into triangles.
enum class Diagonals {
  forward,      ///< all from (i, j) to (i + 1, j + 1)
  backward,     ///< all from (i + 1, j) to (i, j + 1)
  alternating,  ///< forward where i + j is even, else backward
  crossed,      ///< both, with one more vertex in the middle of each cell
};

struct GridOptions {
  Index columns = 11;              ///< vertices along the first axis, ≥ 2
  Index rows = 11;                 ///< vertices along the second axis, ≥ 2
  std::array<Real, 2> size{1, 1};  ///< extent along the two axes [m], > 0
  Plane plane = Plane::xz;
  Diagonals diagonals = Diagonals::forward;
};

/// A rectangle with a corner at the origin, row 0 along the first axis: in `xz`, row 0 is the lowest and the last row
/// hangs a curtain. Vertex (i, j) has index j·columns + i; `crossed` appends the cells' middles, row by row.
///
///        c --- d      cell (i, j): a = (i, j), b = (i + 1, j), c = (i, j + 1), d = (i + 1, j + 1)
///        |   / |      forward: {a, b, d}, {a, d, c}      backward: {a, b, c}, {b, d, c}
///        | /   |      crossed, e in the middle: {a, b, e}, {b, d, e}, {d, c, e}, {c, a, e}
///        a --- b
///
/// Texture coordinates run from (0, 0) to (1, 1). Normals are +z in `xy`, −y in `xz`, +x in `yz`.
Mesh grid(const GridOptions& options);

struct TorusOptions {
  Index major_segments = 48;  ///< around the axis, ≥ 3
  Index minor_segments = 24;  ///< around the tube, ≥ 3
  Real major_radius = 0.5;    ///< R, from the centre to the tube's middle [m], > r
  Real minor_radius = 0.2;    ///< r, of the tube [m], > 0
};

/// A torus about the z axis. With α = 2πa/major_segments and β = 2πb/minor_segments, vertex a·minor_segments + b is
/// ((R + r cos β) cos α, (R + r cos β) sin α, r sin β). Triangles: {X(a, b), X(a + 1, b), X(a + 1, b + 1)} and
/// {X(a, b), X(a + 1, b + 1), X(a, b + 1)}, normals outward.
Mesh torus(const TorusOptions& options);

struct SphereOptions {
  Index subdivisions = 3;  ///< 0 is the icosahedron, each more cuts every triangle into four, 0 to 11
  Real radius = 0.5;       ///< of the sphere through the vertices [m], > 0
};

/// A sphere about the origin: 10·4ⁿ + 2 vertices, 20·4ⁿ triangles, normals outward.
Mesh sphere(const SphereOptions& options);

/// Whether a cylinder has lids.
enum class Caps { open, closed };

struct CylinderOptions {
  Index segments = 24;  ///< vertices around the axis, ≥ 3
  Index rows = 11;      ///< vertices along the axis, ≥ 2
  Real radius = 0.25;   ///< [m], > 0
  Real height = 1;      ///< [m], > 0
  Caps caps = Caps::open;
};

/// A cylinder about the z axis from z = 0 up, normals outward. Vertex row·segments + a lies at angle 2πa/segments; the
/// lids are fans about two more vertices, the bottom's and the top's middle.
Mesh cylinder(const CylinderOptions& options);

/// How a bar's box-shaped cells are cut into tetrahedra.
enum class TetrahedronCut {
  five,  ///< a middle tetrahedron and four corners; the parity of i + j + k alternates, so the cells' faces match
  six,   ///< Kuhn's cut: all six share the diagonal from (i, j, k) to (i + 1, j + 1, k + 1)
};

struct BarOptions {
  std::array<Index, 3> cells{10, 2, 2};   ///< along x, y, z, ≥ 1 each
  std::array<Real, 3> size{1, 0.2, 0.2};  ///< extent along x, y, z [m], > 0 each
  TetrahedronCut cut = TetrahedronCut::six;
};

/// A box of tetrahedra with a corner at the origin. Vertex (i, j, k) has index (k (ny + 1) + j)(nx + 1) + i. All
/// tetrahedra have a positive volume. The mesh has no triangles; see boundary_triangles for its surface.
Mesh bar(const BarOptions& options);

struct ChainOptions {
  Index links = 10;          ///< edges, ≥ 1; vertices are one more
  Real length = 1;           ///< of the whole chain [m], > 0
  Vec3 direction{0, 0, -1};  ///< from the first vertex, at the origin; of any length but 0
};

/// A straight line of edges: vertex i is i·length/links along the direction, edge i joins the vertices i and i + 1.
Mesh chain(const ChainOptions& options);

}  // namespace pliant
