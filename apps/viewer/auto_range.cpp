#include "viewer/auto_range.h"

#include <algorithm>
#include <cmath>

namespace pliant_viewer {
namespace {

constexpr Seconds needed_for{2};
constexpr float smallest_range = 1e-6F;

/// The next of 1, 2, 5, 10, ... that is no smaller.
float round_up(float number) {
  const float power = std::pow(10.0F, std::floor(std::log10(number)));
  for (const float factor : {1.0F, 2.0F, 5.0F}) {
    if (factor * power >= number * 0.9999F) return factor * power;
  }
  return 10 * power;
}

}  // namespace

std::array<float, 2> AutoRange::update(pliant::ColorBy color, float largest, Clock::time_point now) {
  if (!std::isfinite(largest)) largest = smallest_range;
  const float wanted = round_up(std::max(largest, smallest_range));
  const bool is_another = color != color_;
  color_ = color;
  if (is_another || wanted >= bound_) last_needed_ = now;
  if (is_another || wanted > bound_ || now - last_needed_ > needed_for) {
    bound_ = wanted;
    last_needed_ = now;
  }
  return {color == pliant::ColorBy::stretch ? -bound_ : 0, bound_};
}

}  // namespace pliant_viewer
