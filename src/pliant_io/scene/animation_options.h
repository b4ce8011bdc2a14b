#pragma once
// The options of a body's animation in scene files; docs/scenes/bodies.md says what they do.
#include <optional>

#include "pliant/core/options.h"

namespace pliant {

/// At constant velocities; without any, the body stays where it is.
struct SteadyAnimation {
  Vec3 velocity = Vec3::Zero();          ///< [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< [rad/s], axis times speed
  std::optional<Vec3> center{};          ///< of the turn [m]; none: the mean of the vertices as they begin

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"velocity", "m/s", "with which it moves on"}, self.velocity);
    field(OptionInfo{"angular_velocity", "rad/s", "with which it turns on: axis times speed"}, self.angular_velocity);
    field(OptionInfo{"center", "m", "about which it turns; default: the mean of its vertices"}, self.center);
  }
};

/// By frames, which the key `frames` names besides.
struct FrameAnimation {
  Real frames_per_second = 24;  ///< [1/s], > 0; an MDD file has its own times
  bool repeat = false;          ///< again and again, the last frame being the first one

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"frames_per_second", "1/s", "how fast they follow each other; an MDD file has its own times",
                     positive},
          self.frames_per_second);
    field(OptionInfo{"repeat", "", "whether they begin anew after the last one, which stands for the first one"},
          self.repeat);
  }
};

}  // namespace pliant
