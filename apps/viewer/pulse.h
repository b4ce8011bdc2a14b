#pragma once
// How fast something goes on: steps, frames.
#include <deque>

#include "pliant/solver/state.h"
#include "viewer/pacer.h"

namespace pliant_viewer {

/// Of the last second: how often something happened, and how long what took on average.
class Pulse {
 public:
  struct Beat {
    Clock::time_point when;
    double simulated = 0;  ///< [s]
    double local = 0;      ///< [s]
    double global = 0;     ///< [s]
    double factor = 0;     ///< [s]
    double total = 0;      ///< [s]
  };
  void add(const Beat& beat);
  void clear() { beats_.clear(); }

  struct Means {
    double rate = 0;   ///< of beats [1/s]; 0 while too few are known
    double speed = 0;  ///< simulated seconds in a second
    double local = 0;  ///< of a beat [s], as the others
    double global = 0;
    double factor = 0;
    double total = 0;
  };
  /// As seen at a time: when nothing has happened for long, the rate is no more than that tells.
  Means means(Clock::time_point now) const;

 private:
  std::deque<Beat> beats_;
};

}  // namespace pliant_viewer
