#pragma once
// The range of a color map while the values of later frames are still unknown.
#include "pliant_io/scene/view_settings.h"
#include "viewer/pacer.h"

namespace pliant_viewer {

/// A round upper bound of the values. It grows at once, and shrinks only after a smaller one has sufficed for a while,
/// so that colors stay meaningful in a quiet picture and the legend does not flicker.
class AutoRange {
 public:
  /// Returns both ends of the map; `largest` is the largest magnitude of the current frame.
  std::array<float, 2> update(pliant::ColorBy color, float largest, Clock::time_point now);

 private:
  pliant::ColorBy color_ = pliant::ColorBy::none;
  float bound_ = 0;
  Clock::time_point last_needed_{};
};

}  // namespace pliant_viewer
