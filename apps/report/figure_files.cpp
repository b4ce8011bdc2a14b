#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pliant_io/files/csv.h"
#include "report/html_parts.h"
#include "report/report.h"
#include "report/typeset.h"

namespace pliant_report {
namespace {

std::string csv_line(const std::vector<std::string>& fields) {
  std::string line;
  for (const std::string& field : fields) line += (line.empty() ? "" : ",") + pliant::csv_field(field);
  return line + '\n';
}

/// As short as it can be written without loss; nothing where there is no finite value.
std::string csv_number(const std::vector<double>& values, std::size_t i) {
  return i < values.size() && std::isfinite(values[i]) ? fmt::format("{}", values[i]) : std::string();
}

/// A row for each value of each series.
std::string csv_of(const Plot& plot) {
  const bool has_bands = std::ranges::any_of(plot.series, [](const Series& series) { return !series.low.empty(); });
  std::vector<std::string> head = {"series", plot.x.label, plot.y.label};
  if (has_bands) head.insert(head.end(), {"low", "high"});
  std::string csv = csv_line(head);
  for (const Series& series : plot.series) {
    for (std::size_t i = 0; i < std::min(series.x.size(), series.y.size()); ++i) {
      std::vector<std::string> row = {series.name, csv_number(series.x, i), csv_number(series.y, i)};
      if (has_bands) row.insert(row.end(), {csv_number(series.low, i), csv_number(series.high, i)});
      csv += csv_line(row);
    }
  }
  return csv;
}

/// Of one chapter, numbered as in the page.
class Files {
 public:
  explicit Files(std::string chapter) : chapter_(std::move(chapter)) {}
  std::vector<FigureFile> files{};

  void operator()(const Paragraph&) {}
  void operator()(const Plot& plot) {
    const std::string name = fmt::format("{}-{}", chapter_, ++figures_);
    files.push_back({name + ".svg", to_svg(with_powers(plot), true)});
    files.push_back({name + ".csv", csv_of(plot)});
  }
  void operator()(const Picture& picture) {
    files.push_back({fmt::format("{}-{}.png", chapter_, ++figures_), picture.png});
  }
  void operator()(const Table& table) {
    std::string csv = table.columns.empty() ? "" : csv_line(table.columns);
    for (const std::vector<std::string>& row : table.rows) csv += csv_line(row);
    files.push_back({fmt::format("{}-table-{}.csv", chapter_, ++tables_), std::move(csv)});
  }

 private:
  std::string chapter_;
  int figures_ = 0;
  int tables_ = 0;
};

}  // namespace

std::vector<FigureFile> figure_files(const Report& report) {
  const std::vector<std::string> names = anchors(report.chapters);
  std::vector<FigureFile> all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    Files files(names[i]);
    for (const Block& block : report.chapters[i].blocks) std::visit(files, block);
    std::ranges::move(files.files, std::back_inserter(all));
  }
  return all;
}

}  // namespace pliant_report
