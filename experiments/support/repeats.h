#pragma once
// One figure of several runs that differ by disturbances too small to be seen: its median, and a band.
#include "report/plot.h"
#include "support/statistics.h"

namespace pliant_experiments {

constexpr unsigned repeats_of_bands = 5;

/// A line of medians with a band from the least to the largest, each point with the values of its repeats.
inline void add_point(pliant_report::Series& series, double x, const Spread& spread) {
  series.x.push_back(x);
  series.y.push_back(spread.middle);
  series.low.push_back(spread.least);
  series.high.push_back(spread.most);
}

}  // namespace pliant_experiments
