#pragma once
// Groups that come and go while a simulation runs, as drags and some pins do: they are no part of the layout of the
// local step nor of the factor, so that they cost neither.
#include <optional>

#include "pliant/solver/global/factor_correction.h"
#include "pliant/solver/local/local_step.h"
#include "pliant/solver/local/locality.h"

namespace pliant {

/// How many rows may stand beside the factor: those of drags and the like, and those of pins that come late. Drags have
/// room of their own, since each is held for a while alone.
inline constexpr std::int64_t most_rows_of_drags = 8;
inline constexpr std::int64_t most_rows_of_pins = 32;
static_assert(most_rows_of_drags + most_rows_of_pins == FactorCorrection::most_rows);

/// Of a group that stands beside the factor: of its forces, and one for each vertex that it pins.
std::int64_t rows_beside_factor(const ConstraintGroup& group);

class PassingGroups {
 public:
  /// Takes those that come and go out of `groups`, as long as they have few rows in all.
  static std::vector<ConstraintGroup*> take_out_of(std::vector<ConstraintGroup*>& groups, Index vertex_count);

  /// Groups of the simulation, which must outlive their use here.
  void set(std::vector<ConstraintGroup*> groups, const LocalGroups& order);
  void clear() { set({}, {}); }
  /// As LocalGroups has it.
  void sync_parameters();

  bool is_empty() const { return groups_.empty(); }
  /// Whether any has a force; hard pins have none.
  bool has_forces() const;
  std::span<ConstraintGroup* const> of_simulation() const { return groups_; }
  /// The same on vertices in the order of the solver.
  std::span<ConstraintGroup* const> in_use() const { return in_use_; }

  /// Adds forces −∇V [N] at q to those of vertices that are not pinned; returns V [J].
  Real add_forces(const Positions& q, std::span<const char> is_pinned, Positions& forces);
  struct Place {
    std::size_t group;
    Index constraint;
  };
  /// The first constraint whose force at finite q is not finite.
  std::optional<Place> first_not_finite(const Positions& q) const;
  /// Energy of a group of the simulation when its forces were added last [J]; 0 for one that is not here.
  Real elastic_energy(const ConstraintGroup& group) const;
  /// What they add to the system matrix, and which vertices they hold; until the next call.
  const FactorRows& rows(std::span<const char> is_pinned);

 private:
  std::vector<ConstraintGroup*> groups_;
  std::vector<std::unique_ptr<ConstraintGroup>> copies_;
  std::vector<ConstraintGroup*> in_use_;
  std::vector<std::vector<Index>> same_order_;  // of the constraints of each group
  std::vector<Real> energies_;                  // of the groups
  FactorRows rows_;
  std::vector<Real> slots_;  // scratch: w (p − z) of a constraint
  std::vector<Index> vertices_;
  std::vector<Real> coefficients_;
};

}  // namespace pliant
