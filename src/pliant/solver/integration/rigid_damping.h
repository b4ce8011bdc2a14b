#pragma once
// Damping that leaves flight and turning alone: of each connected component, what its velocities have besides those of
// the rigid motion nearest to them.
#include "pliant/solver/global/components.h"
#include "pliant/solver/state.h"

namespace pliant {

class RigidDamping {
 public:
  /// Connected components, and which vertices are pinned: their velocities are not changed. All with the indices
  /// of the simulation.
  void set_components(Components components, std::vector<char> is_pinned);

  /// v ← v_rigid + factor (v − v_rigid). The rigid motion v_rigid = c + ω × x, nearest to v in Σ m ‖·‖², has the
  /// component's momentum and angular momentum, so the damped velocities of a component without pinned vertices have
  /// them too. A component on a line, or of one vertex, has no turning about itself. Never allocates.
  void apply(const Positions& positions, std::span<const Real> masses, Real factor, Positions& velocities) const;

 private:
  void apply_to(std::span<const Index> component, const Positions& positions, std::span<const Real> masses, Real factor,
                Positions& velocities) const;

  Components components_;
  std::vector<char> is_pinned_;
};

}  // namespace pliant
