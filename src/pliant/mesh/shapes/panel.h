#pragma once
// A piece of cloth between four sides, which may be curved: a panel of a dress, a gore of a canopy, a sail.
#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"
#include "pliant/mesh/shapes/sheets.h"

namespace pliant {

struct PanelOptions {
  static constexpr std::string_view shape = "panel";
  static constexpr std::string_view summary =
      "A piece of cloth between four sides, which may be curved: a panel of a dress, a gore of a canopy, a sail.";

  Index columns = 21;  ///< vertices along the bottom and the top, ≥ 2
  Index rows = 21;     ///< vertices along the left and the right, ≥ 2
  /// Which the lower and the upper side go through, from left to right [m]: two or more, the first and the last are
  /// corners of the panel
  Points bottom{std::vector<Vec3>{Vec3(0, 0, 0), Vec3(1, 0, 0)}};
  Points top{std::vector<Vec3>{Vec3(0, 0, 1), Vec3(1, 0, 1)}};
  /// Which the other sides go through between the corners, from below [m]; none: straight
  Points left{};
  Points right{};
  Diagonals diagonals = Diagonals::alternating;  ///< of the cells

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"columns", "", "vertices along the bottom and the top", Range{2}}, self.columns);
    field(OptionInfo{"rows", "", "vertices along the left and the right", Range{2}}, self.rows);
    field(OptionInfo{"bottom", "m",
                     "which it goes through, from the left corner to the right one; default: from the origin along x"},
          self.bottom);
    field(OptionInfo{"top", "m", "the same of the upper side; default: from 1 m above the origin along x"}, self.top);
    field(OptionInfo{"left", "m", "which it goes through between its corners, from below; default: straight"},
          self.left);
    field(OptionInfo{"right", "m", "the same of the right side; default: straight"}, self.right);
    field(OptionInfo{"diagonals", "", "of the cells: `forward`, `backward`, `alternating`, or `crossed` in the middle"},
          self.diagonals);
  }
};

/// A grid whose sides are smooth curves (`smooth_curve`) with vertices at equal distances; a point that is given twice
/// in a row is a corner in its side. Inside is the Coons patch (S. Coons: Surfaces for Computer-Aided Design of Space
/// Forms, 1967) of the four sides: in a plane where they are. Vertices, triangles and their sense as of `grid`.
///
///          top          Vertex groups "bottom", "top", "left", "right". Texture coordinates are the places in the
///        o-----o        plane that faces the panel as a whole, v from the middle of its bottom to the middle of its
///  left /       \ right top, so that the threads of a panel run straight, as if it were cut from cloth; both on one
///      o---------o      scale, for which the larger extent is 1.
///        bottom
///
/// Throws Error (input) where sides have too few points, or where the panel would fold over itself.
Mesh panel(const PanelOptions& options);

}  // namespace pliant
