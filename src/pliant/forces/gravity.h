#pragma once
#include <memory>

#include "pliant/core/options.h"
#include "pliant/forces/force.h"

namespace pliant {

struct GravityOptions {
  Vec3 acceleration{0, 0, -9.81};

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"acceleration", "m/s²", "g"}, self.acceleration);
  }
};

/// f = m g on every vertex (thesis Eq. 5.2).
class Gravity final : public Force {
 public:
  /// acceleration [m/s²]. Throws Error(input) when it is not finite.
  explicit Gravity(const Vec3& acceleration = {0, 0, -9.81});

  std::string_view type() const override { return "gravity"; }
  void add_to(Positions& forces, const StateView& state, Real time_step) override;
  /// −Σ m g·x
  Real potential(const StateView& state) const override;
  bool is_conservative() const override { return true; }

  GravityOptions options() const { return {acceleration_}; }
  std::unique_ptr<Gravity> with(const GravityOptions& options) const {
    return std::make_unique<Gravity>(options.acceleration);
  }

 private:
  Vec3 acceleration_;
};

}  // namespace pliant
