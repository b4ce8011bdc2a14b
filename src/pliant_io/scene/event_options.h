#pragma once
// The options of events in scene files; docs/scenes.md says what each event does.
#include <string>

#include "pliant/timeline/path.h"

namespace pliant {

/// When an event acts: one of the two.
struct EventTime {
  std::int64_t step = 0;  ///< n ≥ 0: acts before the step n → n + 1
  Real time = 0;          ///< t [s], ≥ 0: acts before the first step n with t ≤ tₙ + 1e-9 h

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"step", "", "n: acts before the step n → n + 1", not_negative}, self.step);
    field(OptionInfo{"time", "s", "t: acts before the first step n with t ≤ tₙ + 1e-9 h", not_negative}, self.time);
  }
};

/// Constraints of a group by number: one, several or (empty) all.
using ConstraintNumbers = std::vector<Index>;

/// Of `move`, which has one of target, offset, rotate and keyframes.
struct MoveOptions {
  ConstraintNumbers index{};  ///< of the group, from 0; empty: all
  Points target{};            ///< [m]: one for all, or one for each
  Points offset{};            ///< [m], from where the targets are as the move begins: one for all, or one for each
  std::optional<Rotation> rotate{};   ///< of all together about the center
  std::vector<Keyframe> keyframes{};  ///< of a rigid motion of all together, with times from the start of the move
  std::optional<Vec3> center{};       ///< of turns [m]; none: the mean of the targets as the move begins
  Real over = 0;                      ///< duration [s], ≥ 0; 0: a jump. Keyframes have their own
  Ease ease = Ease::linear;           ///< how the way is shared over the time

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"index", "", "constraints of the group: a number, or a list; default: all"}, self.index);
    field(OptionInfo{"target", "m", "where to: a point for all, or a list with one for each"}, self.target);
    field(OptionInfo{"offset", "m", "how far from where the targets are: for all, or one for each"}, self.offset);
    field(OptionInfo{"rotate", "", "a turn of all together about the center: `{\"axis\", \"degrees\"}`"}, self.rotate);
    field(OptionInfo{"keyframes", "", "a rigid motion of all together: a list of keys"}, self.keyframes);
    field(OptionInfo{"center", "m", "of turns; default: the mean of the targets as the move begins"}, self.center);
    field(OptionInfo{"over", "s", "duration of the move, which keyframes tell themselves; 0: a jump", not_negative},
          self.over);
    field(OptionInfo{"ease", "", "`linear`: at constant speed; `smooth`: from rest to rest"}, self.ease);
  }
};

/// Of `follow`, which has a body or a file besides.
struct FollowOptions {
  ConstraintNumbers index{};       ///< of the group, from 0; empty: all
  std::vector<Index> vertices{};   ///< followed ones, one for each constraint or one for all; empty: the nearest
  Attach attach = Attach::offset;  ///< offset: in the distance at the start; exact: where the vertex is

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"index", "", "constraints of the group: a number, or a list; default: all"}, self.index);
    field(OptionInfo{"vertices", "", "followed ones, one for each constraint or one for all; default: the nearest"},
          self.vertices);
    field(OptionInfo{"attach", "", "`offset`: in the distance in which it begins; `exact`: where the vertex is"},
          self.attach);
  }
};

/// What a file of frames adds to `follow`.
struct FileOptions {
  Real frames_per_second = 24;  ///< [1/s], > 0; of PC2 and NPY files, MDD has its own times

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"frames_per_second", "1/s", "of a PC2 or NPY file; an MDD file has its own times", positive},
          self.frames_per_second);
  }
};

/// What `change` of a group adds to the options of its type.
struct RampOptions {
  Real over = 0;             ///< [s], ≥ 0, in which the stiffness goes to its new value by equal ratios; 0: at once
  Ease ease = Ease::linear;  ///< how the way is shared over the time

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"over", "s", "in which the stiffness goes to its new value, by equal ratios in equal times",
                     not_negative},
          self.over);
    field(OptionInfo{"ease", "", "`linear`: at constant speed; `smooth`: from rest to rest"}, self.ease);
  }
};

}  // namespace pliant
