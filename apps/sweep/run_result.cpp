#include "sweep/run_result.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/scene/scene.h"
#include "sweep/measurement_table.h"

namespace pliant_sweep {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::json;

/// Of the state, which the start has as well, or of a step.
enum class Of { state, step };

struct Quantity {
  std::string_view column;
  std::string_view label;
  std::string_view unit;
  Of of;
};

constexpr std::array quantities = {
    Quantity{"kinetic", "kinetic energy", " [J]", Of::state},
    Quantity{"elastic", "elastic energy", " [J]", Of::state},
    Quantity{"gravitational", "gravitational energy", " [J]", Of::state},
    Quantity{"other_potential", "potential energy of other forces", " [J]", Of::state},
    Quantity{"total", "total energy", " [J]", Of::state},
    Quantity{"speed_sum", "total speed", " [m/s]", Of::state},
    Quantity{"momentum", "momentum", " [N·s]", Of::state},
    Quantity{"past_limits", "stretch past its limits", "", Of::state},
    Quantity{"residual", "residual", " [N]", Of::step},
    Quantity{"objective", "objective", " [J]", Of::step},
    Quantity{"iterations", "iterations", "", Of::step},
    Quantity{"contacts", "contacts", "", Of::step},
    Quantity{"deepest", "depth within the distance of contact", " [m]", Of::step},
    Quantity{"backtracks", "backtracks", " [a step]", Of::step},
    Quantity{"refactorizations", "refactorizations with contact", " [a step]", Of::step},
    Quantity{"pairs", "pairs of surfaces that might meet", "", Of::step},
    Quantity{"active", "pairs of surfaces that push", "", Of::step},
    Quantity{"shortened", "moves cut by surfaces", " [a step]", Of::step},
    Quantity{"momentum_lost", "momentum that steps of contact lose", " [N·s]", Of::step},
    Quantity{"energy_taken", "energy that contact would have given", " [J]", Of::step},
    Quantity{"lag", "lag of pinned surfaces", " [m]", Of::step},
    Quantity{"let_go", "crossings and pinned vertices let go", "", Of::step},
};
constexpr std::array times = {
    Quantity{"ms_local", "local steps", " [ms a step]", Of::step},
    Quantity{"ms_global", "global steps", " [ms a step]", Of::step},
    Quantity{"ms_total", "time", " [ms a step]", Of::step},
};

std::vector<FigureInfo> make_figure_infos() {
  std::vector<FigureInfo> infos;
  for (const Quantity& each : quantities) {
    infos.push_back({fmt::format("{}_end", each.column), fmt::format("{} at the end{}", each.label, each.unit)});
    infos.push_back({fmt::format("{}_mean", each.column), fmt::format("mean {}{}", each.label, each.unit)});
    infos.push_back({fmt::format("{}_max", each.column), fmt::format("largest {}{}", each.label, each.unit)});
  }
  infos.push_back({"smallest_gap_min", "smallest gap between surfaces [m]"});
  infos.push_back({"speed_sum_late", "mean total speed in the last third [m/s]"});
  infos.push_back({"time_end", "simulated time at the end [s]"});
  for (const Quantity& each : times) {
    infos.push_back({std::string(each.column), fmt::format("{}{}", each.label, each.unit)});
  }
  infos.push_back({"wall_seconds", "duration of the run [s]"});
  return infos;
}

double mean(std::span<const double> values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The rows of a column that count for a quantity.
std::span<const double> rows_of(const MeasurementTable& table, const Quantity& quantity,
                                std::span<const double> column) {
  const std::vector<double>* steps = table.find("step");
  const bool has_start = steps != nullptr && !steps->empty() && steps->front() == 0;
  return quantity.of == Of::step && has_start ? column.subspan(1) : column;
}

std::optional<double> late_mean(const MeasurementTable& table, const std::vector<double>& values) {
  const std::vector<double>* time = table.find("time");
  if (time == nullptr || time->empty()) return std::nullopt;
  const double begin = time->back() - (time->back() - time->front()) / 3;
  const auto first = static_cast<std::size_t>(std::ranges::lower_bound(*time, begin) - time->begin());
  return mean(std::span(values).subspan(std::min(first, values.size() - 1)));
}

std::vector<std::optional<double>> figures_of(const MeasurementTable& table, std::optional<double> wall_seconds) {
  std::vector<std::optional<double>> figures(figure_infos().size());
  const std::vector<double> elastic = table.elastic();
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    const auto* column = quantities[i].column == "elastic" ? &elastic : table.find(quantities[i].column);
    if (column == nullptr) continue;
    const std::span<const double> rows = rows_of(table, quantities[i], *column);
    if (rows.empty()) continue;
    figures[3 * i] = rows.back();
    figures[3 * i + 1] = mean(rows);
    figures[3 * i + 2] = *std::ranges::max_element(rows);
  }
  if (const auto* gaps = table.find("smallest_gap"); gaps != nullptr && !gaps->empty()) {
    const double least = *std::ranges::min_element(*gaps);  // infinite where none is near
    if (std::isfinite(least)) figures[figure_index("smallest_gap_min")] = least;
  }
  if (const auto* speeds = table.find("speed_sum")) figures[figure_index("speed_sum_late")] = late_mean(table, *speeds);
  if (const auto* time = table.find("time"); time != nullptr && !time->empty()) {
    figures[figure_index("time_end")] = time->back();
  }
  for (const Quantity& each : times) {
    const auto* column = table.find(each.column);
    if (column == nullptr) continue;
    const std::span<const double> rows = rows_of(table, each, *column);
    if (!rows.empty()) figures[figure_index(each.column)] = mean(rows);
  }
  figures.back() = wall_seconds;
  return figures;
}

/// What counts of a run.json.
struct RunFile {
  RunOutcome outcome = RunOutcome::waiting;
  std::string error;
  std::int64_t steps = 0;
  std::int64_t every = 1;
  double wall_seconds = 0;
};

/// @throws nlohmann::json::exception, pliant::Error
std::int64_t read_count(const Json& json, std::int64_t least) {
  const std::int64_t count = json.is_number_integer() ? json.get<std::int64_t>() : -1;
  if (count < least || count > pliant::max_steps) pliant::fail_input("not a number of steps");
  return count;
}

/// @throws nlohmann::json::exception, pliant::Error
RunFile read_run_file(const fs::path& path) {
  const Json json = Json::parse(pliant::read_file(path));
  RunFile file;
  const auto outcome = json.at("outcome").get<std::string>();
  if (outcome == "ok") file.outcome = RunOutcome::ok;
  if (outcome == "diverged") file.outcome = RunOutcome::diverged;
  file.error = json.value("error", "");
  file.steps = read_count(json.at("totals").at("steps"), 0);
  file.every = read_count(json.at("output").at("every"), 1);
  file.wall_seconds = json.at("totals").at("wall_seconds").get<double>();
  return file;
}

/// A run that diverges may do so while its last step is measured: then that one has no row.
bool is_complete(const RunFile& file, const MeasurementTable& table) {
  const auto rows = static_cast<std::int64_t>(table.row_count());
  const std::int64_t wanted = file.steps / file.every + 1;
  return table.is_whole && rows > 0 && (rows == wanted || (file.outcome == RunOutcome::diverged && rows + 1 == wanted));
}

/// The last line of a text, without its end.
std::string_view last_line(std::string_view text) {
  while (text.ends_with('\n')) text.remove_suffix(1);
  const std::size_t end = text.rfind('\n');
  return end == text.npos ? text : text.substr(end + 1);
}

constexpr std::string_view note_head = "exit code ";
constexpr int signal_base = 128;  // of the exit codes by which a shell tells of signals

/// The exit code that a line notes; 0: it is no note.
int noted_code(std::string_view line) {
  int code = 0;
  if (!line.starts_with(note_head)) return 0;
  line.remove_prefix(note_head.size());
  const auto [end, error] = std::from_chars(line.data(), line.data() + line.size(), code);
  return error == std::errc() && end == line.data() + line.size() && code > 0 && code < 256 ? code : 0;
}

/// Empty where nothing can be read.
std::string read_text(const fs::path& file) {
  try {
    return pliant::read_file(file);
  } catch (const pliant::Error&) {
    return "";
  }
}

/// Discarded where there is none.
nlohmann::ordered_json read_run_json(const fs::path& folder) {
  return nlohmann::ordered_json::parse(read_text(folder / "run.json"), nullptr, false);
}

bool says_ended(const nlohmann::ordered_json& run) {
  return run.is_object() && run.contains("outcome") && (run["outcome"] == "ok" || run["outcome"] == "diverged");
}

/// The last line of what a run wrote, without the name of the program. Empty when it wrote nothing.
std::string last_message(const fs::path& output) {
  const std::string text = read_text(output);
  std::string_view line = last_line(text);
  if (noted_code(line) != 0) line = last_line(std::string_view(text).substr(0, text.rfind(note_head)));
  constexpr std::string_view head = "pliant: error: ";
  if (line.starts_with(head)) line.remove_prefix(head.size());
  return pliant::printable_place(line, 900);
}

}  // namespace

std::span<const FigureInfo> figure_infos() {
  static const std::vector<FigureInfo> infos = make_figure_infos();
  return infos;
}

std::size_t figure_index(std::string_view name) {
  const auto infos = figure_infos();
  const auto found = std::ranges::find(infos, name, &FigureInfo::name);
  if (found == infos.end()) throw std::logic_error(fmt::format("there is no figure '{}'", name));
  return static_cast<std::size_t>(found - infos.begin());
}

RunResult read_run_result(const fs::path& folder) {
  try {
    const RunFile file = read_run_file(folder / "run.json");
    if (file.outcome == RunOutcome::waiting) return {};
    const MeasurementTable table = read_measurements(folder / "measurements.csv");
    if (!is_complete(file, table)) return {};
    RunResult result{file.outcome, file.steps, file.error};
    result.exit_code = file.outcome == RunOutcome::diverged ? static_cast<int>(pliant::ErrorKind::diverged) : 0;
    result.figures = figures_of(table, file.wall_seconds);
    return result;
  } catch (const pliant::Error&) {  // no run was here, or what is here is none that has ended
  } catch (const Json::exception&) {
  }
  return {};
}

void forget_run_result(const fs::path& folder) {
  auto json = read_run_json(folder);
  if (!says_ended(json)) return;
  json["outcome"] = "interrupted";
  pliant::write_file_atomically(folder / "run.json", json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n');
}

// In this order: a run that says so has written all before.
void forget_cut_result(const fs::path& folder) {
  if (says_ended(read_run_json(folder)) && !read_run_result(folder).has_ended_by_itself()) forget_run_result(folder);
}

RunResult result_of_ended_run(const fs::path& folder, const pliant_system::ProcessEnd& end, const fs::path& output) {
  RunResult result = read_run_result(folder);
  if (end.signal == 0 && result.has_ended_by_itself() && end.exit_code == result.exit_code) return result;
  result = {RunOutcome::failed};
  result.exit_code = end.signal != 0 ? static_cast<int>(pliant::ErrorKind::input) : end.exit_code;
  const std::string line = last_message(output);
  const std::string how = end_text(end);
  if (end.signal != 0) {
    result.message = line.empty() ? how : fmt::format("{}: {}", how, line);
  } else if (end.exit_code == 0) {
    result.message = fmt::format("its files are not whole; remove {} and sweep again", folder.string());
    result.exit_code = static_cast<int>(pliant::ErrorKind::output);
  } else {
    const bool is_full = end.exit_code == static_cast<int>(pliant::ErrorKind::output);
    result.message = !line.empty() ? line : is_full ? "its files could not be written; make room" : how;
  }
  return result;
}

void note_end(const fs::path& output, const pliant_system::ProcessEnd& end) {
  const int code = end.signal != 0 ? signal_base + end.signal : end.exit_code;
  if (code != 0) std::ofstream(output, std::ios::app) << note_head << code << '\n';
}

int noted_exit_code(const fs::path& output) {
  return noted_code(last_line(read_text(output)));
}

RunResult result_of_noted_end(const fs::path& folder, const fs::path& output) {
  const int code = noted_exit_code(output);
  if (code == 0) return {};
  pliant_system::ProcessEnd end{code, 0};
  if (code > signal_base) end = {0, code - signal_base};
  return ended_by_interrupt(end) ? RunResult{} : result_of_ended_run(folder, end, output);
}

}  // namespace pliant_sweep
