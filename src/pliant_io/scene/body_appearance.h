#pragma once
// What a body looks like: its two sides, and a pattern on them.
#include <optional>

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

struct BodyAppearance {
  std::optional<Color> front{};          ///< of the side that normals point from; none: that of bodies without any
  std::optional<Color> back{};           ///< of the other side; none: `front`
  Pattern pattern = Pattern::none;       ///< on both sides
  Color pattern_color{0.95, 0.94, 0.9};  ///< of every second field or stripe
  Real pattern_size = 0.1;               ///< of a field, or across a stripe, at rest [m], > 0

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
  }
};

}  // namespace pliant
