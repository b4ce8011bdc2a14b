#include "pliant/solver/integration/rigid_damping.h"

#include "pliant/solver/component_loops.h"
#include "pliant/solver/integration/rigid_motion.h"

namespace pliant {

void damp_vibrations(const Components& components, std::span<const char> is_pinned, const Positions& positions,
                     std::span<const Real> masses, Real factor, Positions& velocities, ThreadPool& threads) {
  for_each_component(components, threads, [&](std::size_t i, ThreadPool* inside) {
    const std::span<const Index> component = components.component(i);
    const RigidMotion motion = fit_rigid_motion(component, positions, masses, velocities, inside);
    if (!motion.turning.allFinite()) return;
    for_each_vertex(component, inside, [&](Index v) {
      if (is_pinned[at(v)]) return;
      const Vec3 rigid = motion.velocity_at(row(positions, v));
      velocities.row(v) = (rigid + factor * (row(velocities, v) - rigid)).transpose();
    });
  });
}

}  // namespace pliant
