#include "pliant/forces/gravity.h"

#include <algorithm>
#include <limits>

#include "pliant/core/error.h"

namespace pliant {
namespace {

class GravityForce final : public Force {
 public:
  /// On the vertices [first, end) that there are.
  GravityForce(const Vec3& acceleration, Index first, Index end)
      : acceleration_(acceleration), first_(first), end_(end) {}

  std::string_view type() const override { return Gravity::info.name; }

  void add_to(Positions& forces, const StateView& state, Real) override {
    const Index end = std::min(end_, static_cast<Index>(forces.rows()));
    for (Index i = first_; i < end; ++i) {
      forces.row(i) += state.masses[static_cast<std::size_t>(i)] * acceleration_.transpose();
    }
  }

  PotentialKind potential_kind() const override { return PotentialKind::gravitational; }

  Real potential(const StateView& state) const override {
    Real energy = 0;
    const Index end = std::min(end_, static_cast<Index>(state.positions.rows()));
    for (Index i = first_; i < end; ++i) {
      energy -= state.masses[static_cast<std::size_t>(i)] * state.positions.row(i).dot(acceleration_.transpose());
    }
    return energy;
  }
  bool is_conservative() const override { return true; }
  std::unique_ptr<Force> copy() const override { return std::make_unique<GravityForce>(*this); }

 private:
  Vec3 acceleration_;
  Index first_;
  Index end_;
};

}  // namespace

std::unique_ptr<Force> build(const ForceScope& scope, const Gravity& options) {
  if (!options.acceleration.allFinite()) {
    fail_input("gravity: the acceleration is not finite; give three finite numbers");
  }
  if (scope.is_whole) {
    return std::make_unique<GravityForce>(options.acceleration, 0, std::numeric_limits<Index>::max());
  }
  const ForceBody& body = only_body(Gravity::info.name, scope);
  return std::make_unique<GravityForce>(options.acceleration, body.first_vertex,
                                        body.first_vertex + body.rest.vertex_count());
}

}  // namespace pliant
