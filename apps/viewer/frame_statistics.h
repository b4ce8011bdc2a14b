#pragma once
// How fast steps or frames follow each other, and what they cost.
#include <deque>

#include "pliant/solver/state.h"
#include "viewer/pacer.h"

namespace pliant_viewer {

/// Rates and mean times over the last second.
class FrameStatistics {
 public:
  struct Sample {
    Clock::time_point when;
    double simulated = 0;  ///< [s]
    double local = 0;      ///< [s]
    double global = 0;     ///< [s]
    double factor = 0;     ///< [s]
    double contact = 0;    ///< in those [s]
    double total = 0;      ///< [s]
  };
  void add(const Sample& sample);
  void clear() { samples_.clear(); }

  struct Means {
    double rate = 0;   ///< samples per second; 0 while there are fewer than two
    double speed = 0;  ///< simulated seconds per second
    double local = 0;  ///< mean of a sample [s], as the following
    double global = 0;
    double factor = 0;
    double contact = 0;
    double total = 0;
  };
  /// The means at a time; when the last sample is long ago, the rate drops accordingly.
  Means means(Clock::time_point now) const;

 private:
  std::deque<Sample> samples_;
};

}  // namespace pliant_viewer
