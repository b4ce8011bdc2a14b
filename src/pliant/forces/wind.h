#pragma once
// Wind on triangles, a third of each triangle's force to each of its vertices (thesis Sec. 5.3).
#include <array>
#include <memory>

#include "pliant/core/options.h"
#include "pliant/forces/force.h"

namespace pliant {

enum class WindModel { relative, thesis };
constexpr std::array<std::string_view, 2> choice_names(WindModel) {
  return {"relative", "thesis"};
}

enum class WindArea { current, rest };
constexpr std::array<std::string_view, 2> choice_names(WindArea) {
  return {"current", "rest"};
}

struct WindOptions {
  Vec3 velocity{0, 5, 0};
  WindModel model = WindModel::relative;
  WindArea area = WindArea::current;
  Real drag = 1;
  Real gust_strength = 0;
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
    field(OptionInfo{"drag", "kg/(m² s)", "c of the relative wind; doubling it doubles the force", not_negative},
          self.drag);
    field(OptionInfo{"gust_strength", "", "share of the velocity by which gusts vary it; 0: steady", Range{0, 1}},
          self.gust_strength);
    field(OptionInfo{"gust_period", "s", "from gust to gust", positive}, self.gust_period);
  }
};

class Wind final : public Force {
 public:
  /// Triangles with the indices of the simulation, and the rest area of each [m²]. Throws Error(input) on options out
  /// of their range.
  Wind(std::vector<Triangle> triangles, std::vector<Real> rest_areas, const WindOptions& options);

  std::string_view type() const override { return "wind"; }
  std::string remedy() const override { return "reduce it, or give it `area` `rest` or the model `relative`"; }

  /// `relative` is evaluated at vₙ, which alone would overshoot once x = h c ΣA/(3m) passes 2; each vertex' share is
  /// therefore scaled by (1 − e⁻ˣ)/x: the exact decay of a vertex that only the wind acts on.
  void add_to(Positions& forces, const StateView& state, Real time_step) override;
  std::optional<Index> vertex_out_of_range(Index vertex_count) const override;

  const WindOptions& options() const { return options_; }
  /// The same triangles under another wind. Throws Error(input) on options out of their range.
  std::unique_ptr<Wind> with(const WindOptions& options) const {
    return std::make_unique<Wind>(triangles_, rest_areas_, options);
  }

 private:
  /// The air's velocity at a time: steady, times 1 + gust_strength (0.6 sin φ + 0.4 sin(1.618 φ + 1)), φ = 2π t/period.
  Vec3 velocity_at(Real time) const;

  /// Adds the force of triangle t to share_, and a third of its area to area_, at its vertices.
  void add_triangle(std::size_t t, const StateView& state, const Vec3& air);

  std::vector<Triangle> triangles_;
  std::vector<Real> rest_areas_;
  Positions share_;         // scratch: this wind's force on each vertex
  std::vector<Real> area_;  // scratch: a third of the area of the triangles at each vertex
  WindOptions options_;
};

}  // namespace pliant
