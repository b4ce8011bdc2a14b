#pragma once
#include "pliant/core/options.h"
#include "pliant/forces/force.h"

namespace pliant {

struct MouseSpringOptions {
  Vec3 anchor = Vec3::Zero();
  Real stiffness = 100;
  Real rest_length = 0;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"anchor", "m", "where the mouse is"}, self.anchor);
    field(
        OptionInfo{"stiffness", "N/m", "k, explicit: stable only while h² k/m < 4; a drag has no such limit", positive},
        self.stiffness);
    field(OptionInfo{"rest_length", "m", "L", not_negative}, self.rest_length);
  }
};

/// The mouse spring as the thesis prints it (Sec. 5.2, Eq. 5.3): F = k (‖d‖ − L) d/‖d‖ with d = anchor − xᵢ, evaluated
/// at qₙ. Explicit, hence unstable once h² k/m ≥ 4; the constraint Drag is the implicit spring without that limit.
class MouseSpring final : public Force {
 public:
  /// Throws Error(input) on options out of their range.
  MouseSpring(Index vertex, const MouseSpringOptions& options);

  std::string_view type() const override { return "mouse_spring"; }
  void add_to(Positions& forces, const StateView& state, Real time_step) override;
  std::optional<Index> vertex_out_of_range(Index vertex_count) const override;
  /// k/2 (‖d‖ − L)²
  Real potential(const StateView& state) const override;
  bool is_conservative() const override { return true; }
  bool is_explicit_spring() const override { return true; }
  std::optional<std::string> warning(const StateView& state, Real time_step) const override;

  /// Throws Error(input) when it is not finite.
  void set_anchor(const Vec3& anchor);

 private:
  Index vertex_;
  MouseSpringOptions options_;
};

}  // namespace pliant
