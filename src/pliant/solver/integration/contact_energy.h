#pragma once
// Contact gives no energy. Where surfaces touch, the energy of components that touch each other,
//
//     H = Σ T + V + C        C: what contact may give back, its potential and what friction has stored,
//
// ends a substep with no more than it began with and what forces have done meanwhile, F·Δq. Of the minimum of implicit
// Euler that is true, with F the forces at the end, as far as potentials are convex:
//
//     ΔH ≤ −h Σ r·v − ½ Σ m |Δv|²        with the residual r that iterations have left
//
// So energy comes from iterations that have not converged and moves that were cut, and besides from a potential of
// contact that is another one than that of the substep before: stiffer, or of other pairs. Velocities are scaled by
// what there is too much: first what vibrates, which leaves momentum and angular momentum of each component, then what
// the components do against each other, which leaves those of all together where nothing holds them. Positions stay.
// What cannot be taken so is elastic energy; it is owed: nine tenths of it are taken off C, which belongs to the state.
//
// T + V of BDF2 goes up and down by itself. There no more is taken than −h Σ r·v, what the residual has put in.
#include "pliant/solver/step_context.h"

namespace pliant {

class ContactEnergy {
 public:
  /// After the last local step of a substep, with velocities found. Scales them, and writes C for the next substep.
  /// Returns what it has taken [J]. Leaves alone where no pairs touch and nothing is owed, and what something drives,
  /// with all that touches it: a pin or a collider that moves, soft pins, drags and forces that act through
  /// constraints.
  Real limit(const StepContext& context, WorkingState& work);

 private:
  void find_groups(const StepContext& context, const WorkingState& work);
  void mark_driven(const System& system, const WorkingState& work);
  void find_excess(const StepContext& context, const WorkingState& work);
  Real excess_of_component(std::size_t component, const System& system, const WorkingState& work, Real& size) const;
  void allow_by_residual(const StepContext& context, const WorkingState& work);
  Real take(const StepContext& context, std::size_t group, WorkingState& work);
  void owe(Real energy);
  void write_energies(const System& system, WorkingState& work) const;

  std::vector<std::size_t> group_of_;  // of each component, the least of those that touch each other
  std::vector<char> touches_;          // of each component, then of each group: whether it is looked at
  std::vector<char> is_driven_, is_held_;
  std::vector<Real> stored_, elastic_, elastic_before_, owed_;  // of each component [J]
  std::vector<Real> excess_, sizes_, allowed_;                  // of each group; sizes of what that is a difference of
  std::vector<std::size_t> members_;                            // of the group at hand
  std::vector<Index> vertices_;                                 // of these
  Positions forces_;                                            // scratch
};

}  // namespace pliant
