#pragma once
#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

/// How a bar's box-shaped cells are cut into tetrahedra.
enum class TetrahedronCut {
  five,  ///< a middle tetrahedron and four corners; the parity of i + j + k alternates, so the cells' faces match
  six,   ///< Kuhn's cut: all six share the diagonal from (i, j, k) to (i + 1, j + 1, k + 1)
};
constexpr std::array<std::string_view, 2> choice_names(TetrahedronCut) {
  return {"five", "six"};
}

struct BarOptions {
  static constexpr std::string_view shape = "bar";
  static constexpr std::string_view summary = "A box of tetrahedra with a corner at the origin.";

  std::array<Index, 3> cells{10, 2, 2};      ///< cubes along x, y, z, each ≥ 1
  std::array<Real, 3> size{1, 0.2, 0.2};     ///< extent along x, y, z [m], > 0
  TetrahedronCut cut = TetrahedronCut::six;  ///< tetrahedra of a cell

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"cells", "", "along x, y, z", Range{1}}, self.cells);
    field(OptionInfo{"size", "m", "extent along x, y, z", positive}, self.size);
    field(OptionInfo{"cut", "", "tetrahedra of a cell: `five` or `six`"}, self.cut);
  }
};

/// A box of tetrahedra with a corner at the origin. Vertex (i, j, k) has index (k (ny + 1) + j)(nx + 1) + i. All
/// tetrahedra have a positive volume. The mesh has no triangles; see boundary_triangles for its surface.
Mesh bar(const BarOptions& options);

}  // namespace pliant
