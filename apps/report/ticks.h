#pragma once
// Round numbers along an axis.
#include <string>
#include <string_view>
#include <vector>

namespace pliant_report {

struct Tick {
  double at = 0;        ///< the value; on a logarithmic axis, its decimal logarithm
  std::string label{};  ///< empty: a short mark without a number
};

struct Ticks {
  std::vector<Tick> ticks{};
  int power = 0;  ///< labels are in units of 10^power
};

/// The multiples of 1, 2 or 5 times a power of ten between min and max, as many as stay below `max_count` + 1, which is
/// to be at least 3. Of numbers too long to read, a power of ten, a multiple of 3, is taken out of all of them.
/// `min` < `max`, both within ±DBL_MAX/2, and further apart than 1e-12 of them and than 1e-291.
Ticks linear_ticks(double min, double max, int max_count);

/// Powers of ten between the decimal logarithms `min` and `max`, with 2 and 5 between them where few decades are to be
/// seen, and linear_ticks() where not even those would be three. At most `max_count` >= 3 of them have labels.
/// `min` < `max`; less than three decades are expected to lie between 1e-290 and 1e300.
Ticks logarithmic_ticks(double min, double max, int max_count);

/// "10⁻³"
std::string power_of_ten(int power);

/// An axis's label with the power of ten in its unit: "length [m]" becomes "length [10³ m]".
std::string with_power(std::string_view label, int power);

}  // namespace pliant_report
