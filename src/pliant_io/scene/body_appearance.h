#pragma once
// What a body looks like: its two sides, a pattern or a texture on them, and what its surface is like. And what a
// collider does.
#include <optional>
#include <string>

#include "pliant/core/options.h"

namespace pliant {

/// Shares of red, green and blue, each from 0 to 1 (sRGB).
struct Color {
  Real red = 0;    ///< 0 to 1
  Real green = 0;  ///< 0 to 1
  Real blue = 0;   ///< 0 to 1

  bool operator==(const Color&) const = default;
};

/// Fields or stripes of two colors in turn.
enum class Pattern { none, checker, stripes };
constexpr std::array<std::string_view, 3> choice_names(Pattern) {
  return {"none", "checker", "stripes"};
}

/// How patterns and textures lie on a body: by its places at rest, or by the texture coordinates of its mesh.
/// `automatic`: textures by texture coordinates where the mesh has them, all else by places at rest.
enum class Mapping { automatic, rest, uv };
constexpr std::array<std::string_view, 3> choice_names(Mapping) {
  return {"automatic", "rest", "uv"};
}

/// How a surface throws light back. `automatic`: what the body's material is like; without one that is known, cloth for
/// sheets and matte for solids.
enum class Finish { automatic, cloth, matte, glossy, metal };
constexpr std::array<std::string_view, 5> choice_names(Finish) {
  return {"automatic", "cloth", "matte", "glossy", "metal"};
}

struct BodyAppearance {
  std::optional<Color> front{};          ///< of the side that normals point from; none: that of bodies without any
  std::optional<Color> back{};           ///< of the other side; none: `front`
  Pattern pattern = Pattern::none;       ///< on both sides
  Color pattern_color{0.95, 0.94, 0.9};  ///< of every second field or stripe
  Real pattern_size = 0.1;  ///< of a field, or across a stripe, at rest [m], or by texture coordinates; > 0
  std::string texture{};    ///< path of a PNG or JPEG file; empty: none. In place of `front` and the pattern
  Real texture_size = 1;    ///< how wide it is laid at rest [m], or by texture coordinates; > 0
  Mapping mapping = Mapping::automatic;  ///< of pattern and texture
  Finish finish = Finish::automatic;     ///< how the surface throws light back
  std::optional<Real> weave{};  ///< from thread to thread at rest [m], ≥ 0, 0: none; none: that of the material

  bool operator==(const BodyAppearance&) const = default;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"front", "", "color of the side that normals point from; default: one of seven, in turn"},
          self.front);
    field(OptionInfo{"back", "", "color of the other side; default: `front`"}, self.back);
    field(OptionInfo{"pattern", "", "on both sides: `none`, `checker` or `stripes`"}, self.pattern);
    field(OptionInfo{"pattern_color", "", "of every second field or stripe"}, self.pattern_color);
    field(OptionInfo{"pattern_size", "m", "of a field, or across a stripe, on the body at rest", Range{1e-6, 1e6}},
          self.pattern_size);
    field(OptionInfo{"texture", "", "a PNG or JPEG file, from the folder of the scene; default: none"}, self.texture);
    field(
        OptionInfo{"texture_size", "m", "width that the texture is repeated at on the body at rest", Range{1e-6, 1e6}},
        self.texture_size);
    field(OptionInfo{"mapping", "",
                     "how pattern and texture lie: by places at `rest`, or by `uv`, in which sizes are shares of the "
                     "unit square; `automatic`: the texture by uv where the mesh has them"},
          self.mapping);
    field(OptionInfo{"finish", "",
                     "`cloth`, `matte`, `glossy` or `metal`; `automatic`: as its material, or cloth for sheets and "
                     "matte for solids"},
          self.finish);
    field(OptionInfo{"weave", "m", "from thread to thread, which close-ups show; 0: none; default: of the material",
                     Range{0, 1}},
          self.weave);
  }
};

/// Of a collider, with those keys of a body's that a shape without a rest state has.
struct ColliderAppearance {
  std::optional<Color> front{};       ///< none: the neutral gray blue of colliders, of a plane that of the ground
  Finish finish = Finish::automatic;  ///< how the surface throws light back; automatic: matte. None of a plane's

  bool operator==(const ColliderAppearance&) const = default;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"front", "", "its color; default: a neutral gray blue, and of a plane that of the ground"},
          self.front);
    field(OptionInfo{"finish", "", "`cloth`, `matte`, `glossy` or `metal`; `automatic`: matte. Planes are always dull"},
          self.finish);
  }
};

}  // namespace pliant
