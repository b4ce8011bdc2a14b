#pragma once
// The measurements.csv of a run, read again.
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace pliant_sweep {

/// Columns of numbers, all of the same length.
struct MeasurementTable {
  std::vector<std::string> names;
  std::vector<std::vector<double>> columns;  ///< by name, then by row
  bool is_whole = true;                      ///< nothing was left out behind the last row

  std::size_t row_count() const { return columns.empty() ? 0 : columns.front().size(); }
  /// Null when there is none of that name.
  const std::vector<double>* find(std::string_view name) const;
  /// The sums of the rows over the columns "elastic_*": of all groups.
  std::vector<double> elastic() const;
};

/// Reads as far as there are whole rows: a run that was killed may leave a part of one.
/// @throws pliant::Error (input) without the file
MeasurementTable read_measurements(const std::filesystem::path& file);

/// The same of a text.
MeasurementTable parse_measurements(std::string_view text);

/// The text of a table, as measurements.csv has it.
std::string to_csv(const MeasurementTable& table);

}  // namespace pliant_sweep
