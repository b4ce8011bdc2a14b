#pragma once
// External forces: evaluated at (qₙ, vₙ), before the prediction of a step (thesis Sec. 3.1 and Chapter 5); where energy
// is kept, conservative ones also at its end, for their work.
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant/core/state_view.h"

namespace pliant {

class ConstraintGroup;

/// Which energy the potential of a force is: measurements have one column for each.
enum class PotentialKind { gravitational, other };

/// A user's own force derives from this class. Indices are those of the simulation.
class Force {
 public:
  virtual ~Force() = default;

  virtual std::string_view type() const = 0;

  /// Adds this force [N] on every vertex to `forces` (m × 3).
  virtual void add_to(Positions& forces, const StateView& state, Real time_step) = 0;

  /// A vertex it acts on that is none of `vertex_count`, if there is one: such a force is refused.
  virtual std::optional<Index> vertex_out_of_range(Index vertex_count) const;

  /// Potential energy [J] of a conservative force; 0 for every other.
  virtual Real potential(const StateView& state) const;
  virtual PotentialKind potential_kind() const { return PotentialKind::other; }

  /// Whether it is conservative. Energy projection takes the work of any force along the way that vertices go in a
  /// step: with the mean of both ends where it is conservative, so that the sum of all energies is kept, else with the
  /// force at the beginning.
  virtual bool is_conservative() const { return false; }

  /// Whether it draws back like a spring that is evaluated at qₙ: such a force makes every step of BDF2 gain energy,
  /// however small, so the two are refused together.
  virtual bool is_explicit_spring() const { return false; }

  /// What helps where it has grown without bound: the end of the message of a step that diverges.
  virtual std::string remedy() const { return "reduce it"; }

  /// A warning when this force may be unstable with this time step, with the limit in it.
  virtual std::optional<std::string> warning(const StateView& state, Real time_step) const;

  /// What it does inside the minimization of a step, beside what add_to() adds: groups that last as long as the force,
  /// count as outside work (ConstraintGroup::is_external) and hold nothing.
  virtual std::vector<ConstraintGroup*> groups() const { return {}; }
  /// Exchanges the numbers that both were made of with another force of the same type on the same places, so that the
  /// groups of both stay; false, with nothing changed, where that cannot be.
  virtual bool exchange(Force&) { return false; }

  /// For a copy of the simulation, with groups of its own. Null from a force that cannot.
  virtual std::unique_ptr<Force> copy() const { return nullptr; }
};

}  // namespace pliant
