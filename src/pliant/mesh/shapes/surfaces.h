#pragma once
// Round surfaces of triangles: the torus, the sphere, the cylinder, the capsule.
#include "pliant/core/options.h"
#include "pliant/mesh/mesh.h"

namespace pliant {

struct TorusOptions {
  static constexpr std::string_view shape = "torus";
  static constexpr std::string_view summary = "A closed surface about the z axis.";

  Index major_segments = 48;  ///< vertices around the axis, ≥ 3
  Index minor_segments = 24;  ///< vertices around the tube, ≥ 3
  /// R, from the center to the tube's middle [m], > 0
  Real major_radius = 0.5;
  Real minor_radius = 0.2;  ///< r, of the tube [m], above 0 and less than R

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"major_segments", "", "vertices around the axis", Range{3}}, self.major_segments);
    field(OptionInfo{"minor_segments", "", "vertices around the tube", Range{3}}, self.minor_segments);
    field(OptionInfo{"major_radius", "m", "R, from the center to the tube's middle", positive}, self.major_radius);
    field(OptionInfo{"minor_radius", "m", "r, of the tube, less than R", positive}, self.minor_radius);
  }
};

/// A torus about the z axis. With α = 2πa/major_segments and β = 2πb/minor_segments, vertex a·minor_segments + b is
/// ((R + r cos β) cos α, (R + r cos β) sin α, r sin β). Triangles: {X(a, b), X(a + 1, b), X(a + 1, b + 1)} and
/// {X(a, b), X(a + 1, b + 1), X(a, b + 1)}, normals outward.
Mesh torus(const TorusOptions& options);

struct SphereOptions {
  static constexpr std::string_view shape = "sphere";
  static constexpr std::string_view summary = "A closed surface about the origin.";

  Index subdivisions = 3;  ///< 0 to 11: 0 is the icosahedron; each more cuts every triangle into four
  Real radius = 0.5;       ///< of the sphere through the vertices [m], > 0

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"subdivisions", "", "0 is the icosahedron; each more cuts every triangle into four", Range{0, 11}},
          self.subdivisions);
    field(OptionInfo{"radius", "m", "of the sphere through the vertices", positive}, self.radius);
  }
};

/// A sphere about the origin: 10·4ⁿ + 2 vertices, 20·4ⁿ triangles, normals outward.
Mesh sphere(const SphereOptions& options);

/// Whether a cylinder has lids.
enum class Caps { open, closed };
constexpr std::array<std::string_view, 2> choice_names(Caps) {
  return {"open", "closed"};
}

struct CylinderOptions {
  static constexpr std::string_view shape = "cylinder";
  static constexpr std::string_view summary = "A surface about the z axis, from z = 0 up.";

  Index segments = 24;     ///< vertices around the axis, ≥ 3
  Index rows = 11;         ///< vertices along the axis, ≥ 2
  Real radius = 0.25;      ///< of the circle through the vertices [m], > 0
  Real height = 1;         ///< along the axis [m], > 0
  Real top_radius = 0;     ///< of the circle at the top [m], ≥ 0; 0: `radius`, else it is a blunt cone
  Caps caps = Caps::open;  ///< its ends, open or closed

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"segments", "", "vertices around the axis", Range{3}}, self.segments);
    field(OptionInfo{"rows", "", "vertices along the axis", Range{2}}, self.rows);
    field(OptionInfo{"radius", "m", "of the circle through the vertices", positive}, self.radius);
    field(OptionInfo{"height", "m", "along the axis", positive}, self.height);
    field(
        OptionInfo{"top_radius", "m", "at the top; 0: `radius`, else a blunt cone: a skirt, a lampshade", not_negative},
        self.top_radius);
    field(OptionInfo{"caps", "", "its ends: `open` or `closed`"}, self.caps);
  }
};

/// A cylinder, or a blunt cone, about the z axis from z = 0 up, normals outward. Vertex row·segments + a lies at angle
/// 2πa/segments; the lids are fans about two more vertices, the bottom's and the top's middle.
Mesh cylinder(const CylinderOptions& options);

struct CapsuleOptions {
  static constexpr std::string_view shape = "capsule";
  static constexpr std::string_view summary =
      "The hull of two balls, one about the origin, the other above it: a closed surface.";

  Index segments = 24;  ///< vertices around the axis, ≥ 3
  Real radius = 0.1;    ///< of the ball at the lower end [m], > 0
  Real height = 0.5;    ///< between the middles of both balls [m], > 0
  Real top_radius = 0;  ///< of the ball at the upper end [m], ≥ 0; 0: `radius`

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"segments", "", "vertices around the axis", Range{3}}, self.segments);
    field(OptionInfo{"radius", "m", "of the ball at the lower end", positive}, self.radius);
    field(OptionInfo{"height", "m", "between the middles of both balls", positive}, self.height);
    field(OptionInfo{"top_radius", "m", "of the ball at the upper end; 0: `radius`, else it tapers: a limb",
                     not_negative},
          self.top_radius);
  }
};

/// The hull of two balls, one about the origin, the other above it: a closed surface, normals outward. Rows of vertices
/// lie as far from each other as vertices within one, about. Vertex row·segments + a lies at angle 2πa/segments, rows
/// from below; behind them are the lowest and the highest point. One ball must not hold the other.
Mesh capsule(const CapsuleOptions& options);

}  // namespace pliant
