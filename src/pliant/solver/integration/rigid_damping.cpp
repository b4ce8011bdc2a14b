#include "pliant/solver/integration/rigid_damping.h"

#include "pliant/solver/integration/rigid_motion.h"

namespace pliant {

void RigidDamping::set_components(Components components, std::vector<char> is_pinned) {
  components_ = std::move(components);
  is_pinned_ = std::move(is_pinned);
}

void RigidDamping::apply(const Positions& positions, std::span<const Real> masses, Real factor,
                         Positions& velocities) const {
  for (std::size_t i = 0; i < components_.count(); ++i)
    apply_to(components_.component(i), positions, masses, factor, velocities);
}

void RigidDamping::apply_to(std::span<const Index> component, const Positions& positions, std::span<const Real> masses,
                            Real factor, Positions& velocities) const {
  const RigidMotion motion = fit_rigid_motion(component, positions, masses, velocities);
  if (!motion.turning.allFinite()) return;
  for (const Index v : component) {
    if (is_pinned_[static_cast<std::size_t>(v)]) continue;
    const Vec3 rigid = motion.velocity_at(row(positions, v));
    velocities.row(v) = (rigid + factor * (row(velocities, v) - rigid)).transpose();
  }
}

}  // namespace pliant
