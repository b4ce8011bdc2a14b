#include "pliant/solver/integration/rigid_damping.h"

#include "pliant/solver/integration/rigid_motion.h"

namespace pliant {

void damp_vibrations(const Components& components, std::span<const char> is_pinned, const Positions& positions,
                     std::span<const Real> masses, Real factor, Positions& velocities) {
  for (std::size_t i = 0; i < components.count(); ++i) {
    const RigidMotion motion = fit_rigid_motion(components.component(i), positions, masses, velocities);
    if (!motion.turning.allFinite()) continue;
    for (const Index v : components.component(i)) {
      if (is_pinned[at(v)]) continue;
      const Vec3 rigid = motion.velocity_at(row(positions, v));
      velocities.row(v) = (rigid + factor * (row(velocities, v) - rigid)).transpose();
    }
  }
}

}  // namespace pliant
