#include "sweep/measurement_table.h"

#include <algorithm>
#include <charconv>

#include <fmt/format.h>

#include "pliant_io/files/csv.h"
#include "pliant_io/files/read_file.h"

namespace pliant_sweep {
namespace {

/// Takes a field off the front of `text`, and the comma or the line's end behind it (RFC 4180, Sec. 2). False when the
/// text ends before.
bool take_field(std::string_view& text, std::string& field, bool& is_last) {
  field.clear();
  bool is_quoted = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (is_quoted) {
      if (c != '"') {
        field += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        field += text[++i];
      } else {
        is_quoted = false;
      }
    } else if (c == '"' && field.empty()) {
      is_quoted = true;
    } else if (c == ',' || c == '\n') {
      is_last = c == '\n';
      text.remove_prefix(i + 1);
      return true;
    } else {
      field += c;
    }
  }
  return false;
}

bool take_names(std::string_view& text, std::vector<std::string>& names) {
  std::string name;
  for (bool is_last = false; !is_last;) {
    if (!take_field(text, name, is_last)) return false;
    names.push_back(name);
  }
  return true;
}

/// Takes a row of numbers off the front of `text`; false when there is no whole one.
bool take_row(std::string_view& text, std::vector<double>& row) {
  const std::size_t end = text.find('\n');
  if (end == text.npos) return false;
  const char* at = text.data();
  for (double& number : row) {
    const auto [stop, error] = std::from_chars(at, text.data() + end, number);
    const bool is_last = &number == &row.back();
    if (error != std::errc{} || *stop != (is_last ? '\n' : ',')) return false;
    at = stop + 1;
  }
  text.remove_prefix(end + 1);
  return true;
}

}  // namespace

const std::vector<double>* MeasurementTable::find(std::string_view name) const {
  const auto found = std::ranges::find(names, name);
  return found == names.end() ? nullptr : &columns[static_cast<std::size_t>(found - names.begin())];
}

std::vector<double> MeasurementTable::elastic() const {
  std::vector<double> sums(row_count(), 0);
  for (std::size_t column = 0; column < names.size(); ++column) {
    if (!names[column].starts_with("elastic_")) continue;
    for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += columns[column][i];
  }
  return sums;
}

MeasurementTable parse_measurements(std::string_view text) {
  MeasurementTable table;
  if (!take_names(text, table.names)) return {{}, {}, false};
  table.columns.resize(table.names.size());
  std::vector<double> row(table.names.size());
  while (!text.empty() && take_row(text, row)) {
    for (std::size_t i = 0; i < row.size(); ++i) table.columns[i].push_back(row[i]);
  }
  table.is_whole = text.empty();
  return table;
}

MeasurementTable read_measurements(const std::filesystem::path& file) {
  return parse_measurements(pliant::read_file(file));
}

std::string to_csv(const MeasurementTable& table) {
  fmt::memory_buffer text;
  const auto out = std::back_inserter(text);
  for (std::size_t i = 0; i < table.names.size(); ++i) {
    fmt::format_to(out, "{}{}", i == 0 ? "" : ",", pliant::csv_field(table.names[i]));
  }
  text.push_back('\n');
  for (std::size_t row = 0; row < table.row_count(); ++row) {
    for (std::size_t i = 0; i < table.columns.size(); ++i) {
      fmt::format_to(out, "{}{}", i == 0 ? "" : ",", table.columns[i][row]);
    }
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

}  // namespace pliant_sweep
