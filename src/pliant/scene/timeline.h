#pragma once
// Moves of pins and drags at given times.
#include <map>
#include <optional>
#include <utility>

#include "pliant/simulation/simulation.h"

namespace pliant {

/// What the points of a move mean: where to, or how far from where the target is when the move begins.
enum class MoveKind { target, offset };

/// One move of targets of a group of pins or drags.
struct Move {
  GroupId group{};
  std::optional<Index> index;  ///< of the constraint in its group; default: all of them
  std::int64_t step = 0;       ///< n ≥ 0: acts before the step n → n + 1
  MoveKind kind = MoveKind::target;
  Points to;          ///< one for all, or one for each constraint moved [m]
  Real duration = 0;  ///< of a straight motion at constant speed [s], ≥ 0; 0: a jump
};

/// The moves still to come and those under way.
class Timeline {
 public:
  /// Throws Error(input) on a group without targets, an index out of range, a negative step or duration, a wrong
  /// number of points, a point that is not finite.
  void add(Simulation& simulation, Move move);

  /// Sets the targets of the step that comes next; to be called before each step. A move of duration T that begins at
  /// tₙ has the target at the end of a step, t, on its way by the fraction (t − tₙ)/T. A later move of the same
  /// constraint takes over from where an earlier one has come; among those of one step the last one added counts.
  void apply(Simulation& simulation);

  /// Moves that are still to begin.
  std::size_t event_count() const { return pending_.size(); }

 private:
  struct Motion {
    Vec3 from;
    Vec3 to;
    Real begin;  // tₙ [s]
    Real duration;
  };
  void begin(Simulation& simulation, const Move& move);

  std::multimap<std::int64_t, Move> pending_;  // by step, those of one step in the order of their adding
  std::map<std::pair<GroupId, Index>, Motion> motions_;
};

}  // namespace pliant
