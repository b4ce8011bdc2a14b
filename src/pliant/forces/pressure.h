#pragma once
// Pressure inside a closed surface, a third of each triangle's force to each of its vertices.
//
//     F = p A n         p: inside less outside [Pa];  n: unit normal, outward
//
//     constant          p
//     gas               p = (p₀ + p_a) V₀/V − p_a: an ideal gas at one temperature (Boyle's law, P V = P₀ V₀), p₀ over
//                       the ambient p_a at the volume V₀ at rest; it stiffens when squeezed
//
// Both are conservative: the potential is −∫ p dV from V₀, and since the surface is closed the forces sum to zero.
// A volume under a hundredth of V₀ counts as that hundredth, so that a surface pressed flat or turned inside out meets
// a large pressure and not an infinite one.
#include "pliant/forces/force_options.h"

namespace pliant {

enum class PressureModel { constant, gas };
constexpr std::array<std::string_view, 2> choice_names(PressureModel) {
  return {"constant", "gas"};
}

struct Pressure {
  static constexpr ForceInfo info{"pressure", "p A n", "Boyle's law, of a gas"};

  /// Vertices whose triangles hold the pressure; they must form a closed surface. Default: all.
  Selection on{};
  /// `constant`: p stays; `gas`: it follows the volume.
  PressureModel model = PressureModel::constant;
  /// p inside less outside [Pa], any finite number; of a gas at the rest volume. Negative: it draws in.
  Real pressure = 100;
  /// p_a outside [Pa], ≥ 0, of a gas alone; the air's 101325 asks for very small time steps.
  Real ambient = 0;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"on", "", "vertices whose triangles hold the pressure; they must close"}, self.on);
    field(OptionInfo{"model", "", "`constant`, or `gas`: p = (pressure + ambient) V₀/V − ambient, V₀ the rest volume"},
          self.model);
    field(OptionInfo{"pressure", "Pa", "p inside less outside, of a gas at the rest volume; negative: it draws in"},
          self.pressure);
    field(OptionInfo{"ambient", "Pa", "outside, of a gas; the air has 101325, which asks for very small time steps",
                     not_negative},
          self.ambient);
  }
};

class PressureForce final : public Force {
 public:
  /// The selected triangles of a body, the surface of its tetrahedra if it has none; vertex 0 of the mesh is
  /// `first_vertex` of the simulation. The side with the positive volume is the inside, whichever way the triangles
  /// run. Throws Error(input): options out of their range; no triangles; a surface with a border (with the number of
  /// its edges) or triangles that disagree on their outside; no volume at rest; a gas without any pressure.
  PressureForce(const Mesh& mesh, Index first_vertex, const Pressure& options);

  std::string_view type() const override { return Pressure::info.name; }
  void add_to(Positions& forces, const StateView& state, Real time_step) override;
  std::optional<Index> vertex_out_of_range(Index vertex_count) const override;
  Real potential(const StateView& state) const override;
  bool is_conservative() const override { return true; }
  std::unique_ptr<Force> copy() const override { return std::make_unique<PressureForce>(*this); }

  /// Explicit, at qₙ: stable for itself while h² ω² < 4, with the bound ω² = −dp/dV Σ ‖aᵢ‖²/mᵢ + |p| maxᵢ Σⱼ ‖Hᵢⱼ‖/mᵢ,
  /// a = ∂V/∂x and Hᵢⱼ = ∂²V/∂xᵢ∂xⱼ: the gas as a spring of the one vector a, and the turning of the normals, which
  /// crumples light, finely meshed cloth. A skin that holds the surface allows more.
  std::optional<std::string> warning(const StateView& state, Real time_step) const override;

  /// The enclosed volume [m³], > 0 at rest.
  Real volume(const Positions& positions) const;
  Real rest_volume() const { return rest_volume_; }
  /// Inside less outside at a volume [Pa].
  Real pressure_at(Real volume) const;

 private:
  /// ω² of `warning` [1/s²].
  Real squared_frequency(const StateView& state) const;

  std::vector<Triangle> triangles_;  // outward, indices of the simulation
  Pressure options_;
  Real rest_volume_ = 0;
};

/// Throws Error(input) as the constructor of PressureForce does.
std::unique_ptr<Force> build(const ForceScope& scope, const Pressure& options);

}  // namespace pliant
