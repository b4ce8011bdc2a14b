#pragma once
// Damping that leaves flight and turning alone: of each connected component, what its velocities have besides those of
// the rigid motion nearest to them.
#include "pliant/core/thread_pool.h"
#include "pliant/solver/global/components.h"

namespace pliant {

/// v ← v_rigid + factor (v − v_rigid) in each component; pinned vertices keep their velocities. The rigid motion
/// v_rigid = c + ω × x, nearest to v in Σ m ‖·‖², has the component's momentum and angular momentum, so the damped
/// velocities of a component without pinned vertices have them too. A component on a line, or of one vertex, has no
/// turning about itself. Positions [m] and velocities [m/s] are m × 3, masses [kg]; all in one order of the vertices.
/// Never allocates.
void damp_vibrations(const Components& components, std::span<const char> is_pinned, const Positions& positions,
                     std::span<const Real> masses, Real factor, Positions& velocities, ThreadPool& threads);

}  // namespace pliant
