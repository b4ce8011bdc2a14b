#pragma once
// The range of a color map while nobody knows what is still to come.
#include "pliant_io/scene/view_settings.h"
#include "viewer/pacer.h"

namespace pliant_viewer {

/// A round number that nothing has been beyond: grows at once, and shrinks after a while in which less would have done,
/// so that the colors of a quiet picture tell something too and the legend does not flicker.
class AutoRange {
 public:
  /// The ends of the map; `largest`: the largest magnitude now.
  std::array<float, 2> update(pliant::ColorBy color, float largest, Clock::time_point now);

 private:
  pliant::ColorBy color_ = pliant::ColorBy::none;
  float bound_ = 0;
  Clock::time_point last_needed_{};
};

}  // namespace pliant_viewer
