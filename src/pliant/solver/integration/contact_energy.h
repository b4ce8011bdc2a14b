#pragma once
// Contact gives no energy. With surfaces that touch, the energy of components that touch each other,
//
//     H = Σ T + V + C,      C: what contact may give back, its potential and what friction has stored
//
// ends a substep with no more than it began with and the forces have done meanwhile. That holds for the minimum of
// implicit Euler where the potentials are convex; iterations that have not converged, moves that were cut and contact
// that has become stiffer since may leave more. Velocities are then scaled so that it holds: first what vibrates, which
// leaves momentum and angular momentum of each component, then what the components do against each other, which leaves
// those of all of them where nothing holds them. Positions stay. What cannot be taken so is owed: it is taken off C,
// which is part of the state.
#include "pliant/solver/step_context.h"

namespace pliant {

class ContactEnergy {
 public:
  /// After the last local step of a substep, with velocities found. Scales them and writes C for the next substep.
  /// Returns what it has taken [J]. Leaves out components that touch nothing, and those that something drives: a pin or
  /// a collider that moves, or a force that acts through constraints, with all that touch them. Overwrites what the
  /// system found in the last local step.
  Real limit(const StepContext& context, WorkingState& work);

 private:
  void find_groups(const StepContext& context, const WorkingState& work);
  void mark_driven(const System& system, const WorkingState& work);
  void find_excess(const StepContext& context, const WorkingState& work);
  Real take(const StepContext& context, std::size_t group, WorkingState& work);
  void owe(Real energy);
  void write_energies(const System& system, WorkingState& work) const;

  std::vector<std::size_t> group_of_;  // of each component, the least of those that touch
  std::vector<char> touches_, is_driven_, is_held_;
  std::vector<Real> stored_, elastic_, elastic_before_;  // of each component [J]
  std::vector<Real> excess_, size_;                      // of each group, and of the energies that it is a difference of
  std::vector<Real> owed_;                               // of each component
  std::vector<std::size_t> members_;                     // of the group at hand
  std::vector<Index> vertices_;                          // of them
  Positions forces_;                                     // scratch
};

}  // namespace pliant
