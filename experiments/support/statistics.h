#pragma once
#include <algorithm>
#include <vector>

namespace pliant_experiments {

/// The middle one, or the mean of the two in the middle; 0 of none.
inline double median(std::vector<double> values) {
  if (values.empty()) return 0;
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : (values[middle - 1] + values[middle]) / 2;
}

/// What repeats of one measurement are like.
struct Spread {
  double least = 0, low = 0, middle = 0, high = 0, most = 0;  ///< quartiles
};

/// All 0 of none.
inline Spread spread(std::vector<double> values) {
  if (values.empty()) return {};
  std::sort(values.begin(), values.end());
  const std::size_t last = values.size() - 1;
  return {values.front(), values[last / 4], median(values), values[last - last / 4], values.back()};
}

}  // namespace pliant_experiments
