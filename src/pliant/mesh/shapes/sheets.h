#pragma once
// Shapes that are made of rows of vertices in a plane: the grid, the net, the pillow.
#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

/// The plane of a sheet: the columns run along the first axis, the rows along the second.
enum class Plane { xy, xz, yz };
constexpr std::array<std::string_view, 3> choice_names(Plane) {
  return {"xy", "xz", "yz"};
}

/// How a grid's cells are cut into triangles.
enum class Diagonals {
  forward,      ///< all from (i, j) to (i + 1, j + 1)
  backward,     ///< all from (i + 1, j) to (i, j + 1)
  alternating,  ///< forward where i + j is even, else backward
  crossed,      ///< both, with one more vertex in the middle of each cell
};
constexpr std::array<std::string_view, 4> choice_names(Diagonals) {
  return {"forward", "backward", "alternating", "crossed"};
}

struct GridOptions {
  static constexpr std::string_view shape = "grid";
  static constexpr std::string_view summary =
      "A rectangle of triangles with a corner at the origin, row 0 along the first axis; vertex (i, j) is j·columns + "
      "i.";

  Index columns = 11;                        ///< vertices along the first axis, ≥ 2
  Index rows = 11;                           ///< vertices along the second axis, ≥ 2
  std::array<Real, 2> size{1, 1};            ///< extent along the two axes [m], > 0
  Plane plane = Plane::xz;                   ///< of the two axes
  Diagonals diagonals = Diagonals::forward;  ///< of the cells

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"columns", "", "vertices along the first axis", Range{2}}, self.columns);
    field(OptionInfo{"rows", "", "vertices along the second axis", Range{2}}, self.rows);
    field(OptionInfo{"size", "m", "extent along the two axes", positive}, self.size);
    field(OptionInfo{"plane", "", "of the two axes: `xy`, `xz` or `yz`"}, self.plane);
    field(OptionInfo{"diagonals", "", "of the cells: `forward`, `backward`, `alternating`, or `crossed` in the middle"},
          self.diagonals);
  }
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

/// Which cords cross a net's cells.
enum class NetDiagonals { none, both };
constexpr std::array<std::string_view, 2> choice_names(NetDiagonals) {
  return {"none", "both"};
}

struct NetOptions {
  static constexpr std::string_view shape = "net";
  static constexpr std::string_view summary = "Knots and cords: the vertices of a grid, with edges alone as elements.";

  Index columns = 11;                           ///< knots along the first axis, ≥ 2
  Index rows = 11;                              ///< knots along the second axis, ≥ 2
  std::array<Real, 2> size{1, 1};               ///< extent along the two axes [m], > 0
  Plane plane = Plane::xz;                      ///< of the two axes
  NetDiagonals diagonals = NetDiagonals::none;  ///< cords across the cells, or none

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"columns", "", "knots along the first axis", Range{2}}, self.columns);
    field(OptionInfo{"rows", "", "knots along the second axis", Range{2}}, self.rows);
    field(OptionInfo{"size", "m", "extent along the two axes", positive}, self.size);
    field(OptionInfo{"plane", "", "of the two axes: `xy`, `xz` or `yz`"}, self.plane);
    field(OptionInfo{"diagonals", "", "`none`: knots and cords; `both`: cords across the cells as well"},
          self.diagonals);
  }
};

/// Knots and cords: the vertices of a grid and, as elements, edges alone. `both` is the classic cloth of masses and
/// springs. Edges: those of the rows, row by row, then those between the rows, then the diagonals, cell by cell:
/// (i, j) to (i + 1, j + 1) and (i + 1, j) to (i, j + 1).
Mesh net(const NetOptions& options);

struct PillowOptions {
  static constexpr std::string_view shape = "pillow";
  static constexpr std::string_view summary =
      "Two flat faces sewn together at their border: a closed surface with outward normals.";

  Index columns = 17;                  ///< vertices of a face along the first axis, ≥ 3
  Index rows = 17;                     ///< vertices of a face along the second axis, ≥ 3
  std::array<Real, 2> size{0.5, 0.5};  ///< extent along the two axes [m], > 0
  Plane plane = Plane::xz;             ///< of the seam
  Real gap = 0.02;                     ///< between the two flat faces [m], > 0; only their border meets

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"columns", "", "vertices of a face along the first axis", Range{3}}, self.columns);
    field(OptionInfo{"rows", "", "vertices of a face along the second axis", Range{3}}, self.rows);
    field(OptionInfo{"size", "m", "extent along the two axes", positive}, self.size);
    field(OptionInfo{"plane", "", "of the seam: `xy`, `xz` or `yz`"}, self.plane);
    field(OptionInfo{"gap", "m", "between the two flat faces; only their border meets", positive}, self.gap);
  }
};

/// Two flat faces, sewn together at their border: one closed surface, normals outward. The front has the vertices of a
/// grid, (i, j) at j·columns + i; the back shares the border, and its inner vertices follow in the same order. The
/// border lies in the plane, the inner vertices of the front half the gap towards the plane's normal (+z in `xy`, −y
/// in `xz`, +x in `yz`), those of the back half the gap the other way. Diagonals alternate, but a corner's cell is cut
/// through the corner, since the two faces would share the triangle otherwise. Face groups: "front", "back".
Mesh pillow(const PillowOptions& options);

}  // namespace pliant
