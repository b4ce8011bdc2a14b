#pragma once
// Position-based dynamics on the same springs: XPBD (Macklin et al. 2016), whose compliance 1/k is that of the springs,
// and the PBD that it came from (Müller et al. 2007), whose springs have a share that each iteration corrects.
//
// Both go through the springs one after the other, in the order of the model, and move the two ends of each at once
// (Gauss-Seidel). Nothing is factorized.
#include <optional>

#include "support/mass_spring.h"

namespace pliant_experiments {

struct XpbdOptions {
  int iterations = 10;  ///< of each substep
  int substeps = 1;     ///< equal parts of a step
  /// PBD: the share of a spring's excess length that each iteration takes away, in (0, 1]; none: XPBD.
  std::optional<double> pbd_share{};
};

class Xpbd {
 public:
  /// Takes over the state of a simulation, its forces as they are now, which stay, and its time step. Throws
  /// Error(input) as mass_spring() does, and on soft pins.
  Xpbd(const pliant::Simulation& simulation, const XpbdOptions& options);

  /// One time step.
  void step();

  const pliant::Positions& positions() const { return positions_; }    ///< m × 3 [m]
  const pliant::Positions& velocities() const { return velocities_; }  ///< m × 3 [m/s]
  /// Goes on from elsewhere; both are m × 3.
  void set_state(const pliant::Positions& positions, const pliant::Positions& velocities);

 private:
  void substep(double time_step);
  void correct(std::size_t i, double compliance_factor);

  MassSpring model_;
  XpbdOptions options_;
  double time_step_;
  std::vector<double> inverse_masses_;  // [1/kg], 0 for pinned vertices
  pliant::Positions accelerations_, positions_, velocities_, before_;
  std::vector<double> multipliers_;  // λ of each spring [N s²], since the start of the substep
};

}  // namespace pliant_experiments
