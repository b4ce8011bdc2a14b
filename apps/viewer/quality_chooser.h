#pragma once
// How much light a window follows where its scene leaves that open: all of it, unless pictures then take too long.
#include "pliant_io/scene/view_settings.h"

namespace pliant_viewer {

class QualityChooser {
 public:
  pliant::Quality choose(pliant::Quality asked) const {
    if (asked != pliant::Quality::automatic) return asked;
    return is_slow_ ? pliant::Quality::low : pliant::Quality::high;
  }
  /// One picture at high quality has taken this long [s]. Eight of them decide, the first of all left out, in which
  /// drivers still compile.
  void add(double seconds) {
    if (is_slow_ || ++count_ == 1) return;
    sum_ += seconds;
    if (count_ <= decided_after) return;
    is_slow_ = sum_ > decided_after * longest;
    count_ = 1;
    sum_ = 0;
  }
  /// Of another scene or size nothing is known.
  void forget() { *this = {}; }

 private:
  static constexpr int decided_after = 8;
  static constexpr double longest = 1.0 / 24;  // of a picture, in the mean [s]

  int count_ = 0;
  double sum_ = 0;  // [s]
  bool is_slow_ = false;
};

}  // namespace pliant_viewer
