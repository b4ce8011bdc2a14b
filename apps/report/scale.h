#pragma once
// From values to places along an axis.
#include "report/plot.h"
#include "report/ticks.h"

namespace pliant_report {

/// The smallest and the largest of some values; without any, min > max.
struct Extent {
  double min = 1;
  double max = -1;

  bool is_empty() const { return min > max; }
  void add(double value) {
    const bool is_first = is_empty();
    if (is_first || value < min) min = value;
    if (is_first || value > max) max = value;
  }
};

/// Which part of the number line an axis shows.
class Scale {
 public:
  /// The limits that the axis has; where it has none, or none that it can show, those of the values: with `margin`
  /// times their extent more on both sides, and never past a zero that is not among them. Far too narrow ranges are
  /// widened.
  Scale(const Axis& axis, const Extent& values, double margin);

  /// Whether an axis can show the value at all: it is finite, and positive where the axis is logarithmic.
  static bool can_show(const Axis& axis, double value);

  /// 0 at the axis's start, 1 at its end; of values far outside, some number of the right sign. NaN for values that
  /// cannot be shown.
  double fraction(double value) const;

  Ticks ticks(int max_count) const;
  double fraction(const Tick& tick) const { return fraction_of_coordinate(tick.at); }

 private:
  double fraction_of_coordinate(double coordinate) const;

  bool is_logarithmic_;
  double min_ = 0;  ///< values, or their decimal logarithms
  double max_ = 1;
};

}  // namespace pliant_report
