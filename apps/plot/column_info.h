#pragma once
// What the columns of measurements.csv mean, for axes and legends.
#include <string>
#include <string_view>

namespace pliant_plot {

struct ColumnInfo {
  std::string label;            ///< "kinetic energy"
  std::string unit{};           ///< "J"; empty: a number without one
  bool is_of_step = false;      ///< the first row, the start, has none
  bool is_logarithmic = false;  ///< over several powers of ten, as residuals
};

/// Of a column of the file, or "elastic", the sum of all groups'; those of groups and colliders have these in their
/// names. One that is not known is its own label.
ColumnInfo column_info(std::string_view column);

/// "residual [N]"; without a unit the text alone.
std::string with_unit(const std::string& text, const std::string& unit);

}  // namespace pliant_plot
