#pragma once
// A tube around a smooth curve through given points: a hose, a cord, a ring, a knot.
#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

/// How the ends of a tube are: both without lids, both with one, or each joined to the other.
enum class TubeEnds { open, closed, joined };
constexpr std::array<std::string_view, 3> choice_names(TubeEnds) {
  return {"open", "closed", "joined"};
}

/// What a tube is made of: triangles of its surface, or tetrahedra that fill it.
enum class TubeInside { hollow, solid };
constexpr std::array<std::string_view, 2> choice_names(TubeInside) {
  return {"hollow", "solid"};
}

struct TubeOptions {
  static constexpr std::string_view shape = "tube";
  static constexpr std::string_view summary =
      "A tube around a smooth curve through given points: a hose, a cord, a ring, a knot.";

  /// Which the curve goes through, in this order [m]: two or more, three or more where it is joined
  Points points{std::vector<Vec3>{Vec3(0, 0, 0), Vec3(0, 0, 1)}};
  Index segments = 12;                     ///< vertices around the curve, ≥ 3
  Index rows = 41;                         ///< vertices along the curve, ≥ 2, where it is joined ≥ 3
  Real radius = 0.02;                      ///< of the circle through the vertices [m], > 0
  TubeEnds ends = TubeEnds::open;          ///< open, closed or joined
  TubeInside inside = TubeInside::hollow;  ///< hollow or solid

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"points", "m",
                     "which its curve goes through: two or more, of a ring three; default: from the origin 1 m up"},
          self.points);
    field(OptionInfo{"segments", "", "vertices around the curve", Range{3}}, self.segments);
    field(OptionInfo{"rows", "", "vertices along the curve", Range{2}}, self.rows);
    field(OptionInfo{"radius", "m", "of the circle through the vertices", positive}, self.radius);
    field(OptionInfo{"ends", "", "`open`, `closed` by lids, or `joined` to each other: a ring"}, self.ends);
    field(OptionInfo{"inside", "", "`hollow`: triangles; `solid`: filled with tetrahedra"}, self.inside);
  }
};

/// A tube around the centripetal Catmull-Rom spline through the points (C. Yuksel, S. Schaefer, J. Keyser: On the
/// Parameterization of Catmull-Rom Curves, 2009). Its rows lie at equal distances along the curve, and do not turn
/// about it more than they must; where the ends are joined, what is left of a turn is shared out.
///
/// Vertex row·segments + a lies at angle 2πa/segments, counterclockwise as seen against the curve; normals are outward.
/// Behind these are the middles: of the first and the last row where the ends are closed, of every row where it is
/// solid. A solid tube has lids, unless it is joined, and tetrahedra alone.
Mesh tube(const TubeOptions& options);

}  // namespace pliant
