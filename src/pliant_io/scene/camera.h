#pragma once
// From where a scene is shown, and how that changes over time.
#include <optional>
#include <vector>

#include "pliant/core/options.h"
#include "pliant/core/types.h"

namespace pliant {

/// Where the camera is at a time; between two such it goes smoothly from one to the other.
struct CameraKeyframe {
  Real time = 0;                        ///< simulated [s]
  Vec3 position{0, 0, 0};               ///< [m]
  std::optional<Vec3> target{};         ///< [m]; none: that of the camera
  std::optional<Real> field_of_view{};  ///< [degrees], 1 to 170; none: that of the camera

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"time", "s", "simulated; each later than the one before"}, self.time);
    field(OptionInfo{"position", "m", "where the camera stands then; must be given"}, self.position);
    field(OptionInfo{"target", "m", "what it looks at then; default: the camera's `target`"}, self.target);
    field(OptionInfo{"field_of_view", "degrees", "then; default: the camera's", Range{1, 170}}, self.field_of_view);
  }
};

struct Camera {
  std::optional<Vec3> position{};   ///< [m]; none: where all that moves is in the picture
  std::optional<Vec3> target{};     ///< [m]; none: the middle of the bodies
  Vec3 up{0, 0, 1};                 ///< direction that is up in the picture, of any length but zero
  Real field_of_view = 40;          ///< [degrees], from the lower edge of the picture to the upper, 1 to 170
  std::optional<Real> azimuth{};    ///< [degrees], see visit; neither of the two: as most of the bodies is seen
  std::optional<Real> elevation{};  ///< [degrees], -89 to 89
  Real turn_rate = 0;               ///< about `up` [degrees/s], counterclockwise seen from above
  std::vector<CameraKeyframe> keyframes = {};  ///< by time, ascending, in place of the position

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"position", "m", "where it stands; default: where all that moves is in the picture"},
          self.position);
    field(OptionInfo{"target", "m", "what it looks at; default: the middle of the bodies"}, self.target);
    field(OptionInfo{"up", "", "direction that is up in the picture, of any length but zero"}, self.up);
    field(OptionInfo{"field_of_view", "degrees", "from the lower edge of the picture to the upper", Range{1, 170}},
          self.field_of_view);
    field(
        OptionInfo{"azimuth", "degrees",
                   "in place of a position: the side that it looks from, 0 the front (−y), 90 the right (+x), 180 the "
                   "back; default: the side from which most of the bodies is seen"},
        self.azimuth);
    field(OptionInfo{"elevation", "degrees", "likewise: how far from above it looks; 0 level", Range{-89, 89}},
          self.elevation);
    field(OptionInfo{"turn_rate", "degrees/s",
                     "it goes around its target, counterclockwise seen from above; negative: clockwise",
                     Range{-36000, 36000}},
          self.turn_rate);
    field(OptionInfo{"keyframes", "", "in place of a position: where it is at which time, see below"}, self.keyframes);
  }
};

}  // namespace pliant
