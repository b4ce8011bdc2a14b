#pragma once
// Damping that leaves flight and turning alone: of each connected part, what its velocities have besides those of the
// rigid motion nearest to them.
#include "pliant/solver/global/connected_parts.h"
#include "pliant/solver/state.h"

namespace pliant {

class RigidDamping {
 public:
  /// Parts of connected vertices, and which vertices are held: their velocities are not changed. All with the indices
  /// of the simulation.
  void set_parts(ConnectedParts parts, std::vector<char> is_pinned);

  /// v ← v_rigid + factor (v − v_rigid). The rigid motion v_rigid = c + ω × x, nearest to v in Σ m ‖·‖², has the part's
  /// momentum and angular momentum, so the damped velocities of a part without held vertices have them too. A part on a
  /// line, or of one vertex, has no turning about itself. Never allocates.
  void apply(const Positions& positions, std::span<const Real> masses, Real factor, Positions& velocities) const;

 private:
  void apply_to(std::span<const Index> part, const Positions& positions, std::span<const Real> masses, Real factor,
                Positions& velocities) const;

  ConnectedParts parts_;
  std::vector<char> is_pinned_;
};

}  // namespace pliant
