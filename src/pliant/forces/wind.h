#pragma once
// Wind on triangles, a third of each triangle's force to each of its vertices (thesis Sec. 5.3).
#include "pliant/forces/force_options.h"

namespace pliant {

enum class WindModel { relative, thesis };
constexpr std::array<std::string_view, 2> choice_names(WindModel) {
  return {"relative", "thesis"};
}

enum class WindArea { current, rest };
constexpr std::array<std::string_view, 2> choice_names(WindArea) {
  return {"current", "rest"};
}

struct Wind {
  static constexpr ForceInfo info{"wind", "c A (n·(u − v)) n", "thesis Sec. 5.3, with drag and units",
                                  ForceReach::bodies};

  /// u of the air [m/s], any finite vector; model `thesis`: the vector d of Eq. 5.4 [N/m²].
  Vec3 velocity{0, 5, 0};
  /// `relative`: against the moving body, F = c A (n·(u − v)) n; `thesis`: as printed, F = A (n·d) n, without drag.
  WindModel model = WindModel::relative;
  /// A of a triangle: as it is now, or at rest: then stretched cloth catches no more wind.
  WindArea area = WindArea::current;
  /// c of the relative wind [kg/(m² s)], ≥ 0; doubling it doubles the force.
  Real drag = 1;
  /// Share of the velocity by which gusts vary it, 0 to 1; 0: steady.
  Real gust_strength = 0;
  /// From gust to gust [s], > 0.
  Real gust_period = 2;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"velocity", "m/s", "of the air, u; model `thesis`: the vector d of Eq. 5.4 [N/m²]"},
          self.velocity);
    field(OptionInfo{"model", "",
                     "`relative`: F = c A (n·(u − v)) n; `thesis`: F = A (n·d) n, without drag, and past "
                     "a limit without equilibrium, since it grows with the square of the stretch"},
          self.model);
    field(OptionInfo{"area", "", "A of a triangle: `current`, or at `rest`: then stretched cloth catches no more wind"},
          self.area);
    field(OptionInfo{"drag", "kg/(m² s)", "c of the relative wind; doubling it doubles the force", Range{0, 1e9}},
          self.drag);
    field(OptionInfo{"gust_strength", "", "share of the velocity by which gusts vary it; 0: steady", Range{0, 1}},
          self.gust_strength);
    field(OptionInfo{"gust_period", "s", "from gust to gust", positive}, self.gust_period);
  }
};

/// On all triangles of the bodies. Throws Error(input) on options out of their range, and where there are no triangles.
std::unique_ptr<Force> build(const ForceScope& scope, const Wind& options);

}  // namespace pliant
