#include "report/scale.h"

#include <algorithm>
#include <cfloat>
#include <cmath>
#include <limits>

namespace pliant_report {
namespace {

constexpr double largest_bound = DBL_MAX / 2;  ///< so that max − min is finite
constexpr double narrowest = 1e-290;           ///< so that steps between ticks are no denormal numbers
constexpr double finest = 1e-11;               ///< of the values: below it, rounding is what would be seen
constexpr double far_outside = 1e6;  ///< in lengths of the axis: more would make lines of nothing but rounding

bool can_show(bool is_logarithmic, double value) {
  return std::isfinite(value) && (!is_logarithmic || value >= DBL_MIN);
}

/// A range of linear coordinates that ticks can be found for.
Extent widened(Extent range) {
  range.min = std::clamp(range.min, -largest_bound, largest_bound);
  range.max = std::clamp(range.max, -largest_bound, largest_bound);
  const double size = std::max(std::abs(range.min), std::abs(range.max));
  if (range.max - range.min <= std::max(narrowest, finest * size)) {
    const double middle = range.min / 2 + range.max / 2;
    const double half = size > 0 ? std::max(narrowest, 0.05 * size) : 1.0;
    range.min = std::max(middle - half, -largest_bound);
    range.max = std::min(middle + half, largest_bound);
  }
  return range;
}

/// The same for decimal logarithms.
Extent widened_decades(Extent range) {
  constexpr double least = 1e-9;
  const bool is_extreme = range.min < -290 || range.max > 300;
  const double width = is_extreme ? 3 : 2 * std::log10(2.0);
  if (range.max - range.min < (is_extreme ? width : least)) {
    const double middle = range.min / 2 + range.max / 2;
    range.min = middle - width / 2;
    range.max = middle + width / 2;
  }
  return range;
}

Extent with_margin(const Extent& values, double margin, bool is_logarithmic) {
  const double room = std::min((values.max / 2 - values.min / 2) * margin * 2, largest_bound);
  Extent result{std::max(values.min - room, -largest_bound), std::min(values.max + room, largest_bound)};
  if (is_logarithmic) return result;
  if (values.min >= 0 && result.min < 0) result.min = 0;
  if (values.max <= 0 && result.max > 0) result.max = 0;
  return result;
}

}  // namespace

bool Scale::can_show(const Axis& axis, double value) {
  return pliant_report::can_show(axis.is_logarithmic, value);
}

Scale::Scale(const Axis& axis, const Extent& values, double margin) : is_logarithmic_(axis.is_logarithmic) {
  const auto coordinate = [this](double value) { return is_logarithmic_ ? std::log10(value) : value; };
  const bool has_min = axis.min && can_show(axis, *axis.min);
  const bool has_max = axis.max && can_show(axis, *axis.max);
  Extent range{is_logarithmic_ ? -1.0 : 0.0, 1.0};
  if (!values.is_empty()) {
    range = with_margin({coordinate(values.min), coordinate(values.max)}, margin, is_logarithmic_);
  }
  if (has_min) range.min = coordinate(*axis.min);
  if (has_max) range.max = coordinate(*axis.max);
  // A limit that leaves out all values shows an empty stretch beside it.
  if (range.min > range.max && has_min && has_max) std::swap(range.min, range.max);
  if (range.min > range.max) (has_min ? range.max : range.min) = has_min ? range.min : range.max;
  range = is_logarithmic_ ? widened_decades(range) : widened(range);
  min_ = range.min;
  max_ = range.max;
}

double Scale::fraction(double value) const {
  if (!pliant_report::can_show(is_logarithmic_, value)) return std::numeric_limits<double>::quiet_NaN();
  return fraction_of_coordinate(is_logarithmic_ ? std::log10(value) : value);
}

double Scale::fraction_of_coordinate(double coordinate) const {
  return std::clamp((coordinate - min_) / (max_ - min_), -far_outside, far_outside);
}

Ticks Scale::ticks(int max_count) const {
  return is_logarithmic_ ? logarithmic_ticks(min_, max_, max_count) : linear_ticks(min_, max_, max_count);
}

}  // namespace pliant_report
