#include "pliant_io/recorder/measurements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/csv.h"

namespace pliant {
namespace {

struct Column {
  std::string_view name;
  Real (*value)(const Measurements&);
};

constexpr std::array before_elastic = {
    Column{"time", [](const Measurements& row) { return row.time; }},
    Column{"kinetic", [](const Measurements& row) { return row.kinetic; }},
};
constexpr std::array after_elastic = {
    Column{"gravitational", [](const Measurements& row) { return row.gravitational; }},
    Column{"other_potential", [](const Measurements& row) { return row.other_potential; }},
    Column{"total", [](const Measurements& row) { return row.total; }},
    Column{"speed_sum", [](const Measurements& row) { return row.speed_sum; }},
    Column{"momentum", [](const Measurements& row) { return row.momentum.norm(); }},
    Column{"angular_momentum_x", [](const Measurements& row) { return row.angular_momentum[0]; }},
    Column{"angular_momentum_y", [](const Measurements& row) { return row.angular_momentum[1]; }},
    Column{"angular_momentum_z", [](const Measurements& row) { return row.angular_momentum[2]; }},
    Column{"residual", [](const Measurements& row) { return row.residual; }},
    Column{"objective", [](const Measurements& row) { return row.objective; }},
    Column{"iterations", [](const Measurements& row) { return static_cast<Real>(row.report.iterations); }},
    Column{"ms_local", [](const Measurements& row) { return 1e3 * row.report.seconds_local; }},
    Column{"ms_global", [](const Measurements& row) { return 1e3 * row.report.seconds_global; }},
    Column{"ms_total", [](const Measurements& row) { return 1e3 * row.report.seconds_total; }},
};

/// Positions may still be finite where their energies no longer are.
void check_finite(const Measurements& row) {
  const auto check = [&row](const auto& columns) {
    for (const Column& column : columns) {
      if (std::isfinite(column.value(row))) continue;
      throw Error(ErrorKind::diverged,
                  fmt::format("step {} (t = {} s): `{}` is not finite; reduce masses, stiffness or velocities, or give "
                              "a larger time step",
                              row.step, row.time, column.name));
    }
  };
  check(before_elastic);
  check(after_elastic);
}

}  // namespace

Measurements measure(Simulation& simulation, const StepReport& report) {
  const Evaluation evaluation = simulation.evaluate();
  const State& state = simulation.state();
  Measurements row;
  row.step = state.step;
  row.time = state.time;
  row.report = report;
  row.residual = evaluation.residual;
  row.objective = evaluation.objective();
  for (Index i = 0; i < state.vertex_count(); ++i) {
    const Real mass = state.masses[static_cast<std::size_t>(i)];
    const Vec3 v = pliant::row(state.velocities, i);
    row.kinetic += mass / 2 * v.squaredNorm();
    row.speed_sum += v.norm();
    row.momentum += mass * v;
    row.angular_momentum += mass * pliant::row(state.positions, i).cross(v);
  }
  row.total = row.kinetic;
  for (const auto& [id, group] : simulation.groups()) {
    row.groups.push_back(group.name);
    row.elastic.push_back(simulation.elastic_energy(id));
    row.total += row.elastic.back();
  }
  for (const auto& [id, force] : simulation.forces()) {
    const Real potential = force->potential(state.view());
    const bool is_gravitational = force->potential_kind() == PotentialKind::gravitational;
    (is_gravitational ? row.gravitational : row.other_potential) += potential;
    row.total += potential;
  }
  check_finite(row);
  return row;
}

namespace {

std::string column_names(const std::vector<std::string>& groups) {
  std::string line = "step";
  for (const Column& column : before_elastic) line += fmt::format(",{}", column.name);
  for (const std::string& name : groups) line += ',' + csv_field("elastic_" + name);
  for (const Column& column : after_elastic) line += fmt::format(",{}", column.name);
  return line + '\n';
}

/// Where the rows end that stay. Names of groups may hold line ends, rows cannot.
std::uintmax_t kept_bytes(const std::filesystem::path& path, const std::string& names, std::int64_t kept_rows) {
  std::ifstream file(path, std::ios::binary);
  std::string begin(names.size(), '\0');
  file.read(begin.data(), static_cast<std::streamsize>(begin.size()));
  bool is_ours = file && begin == names;
  std::uintmax_t bytes = names.size();
  std::string row;
  for (std::int64_t i = 0; is_ours && i < kept_rows; ++i) {
    is_ours = std::getline(file, row) && !file.eof();
    bytes += row.size() + 1;
  }
  if (is_ours) return bytes;
  fail_input(
      fmt::format("{}: not {} rows of this run, after which it would go on; run the scene from its start, or put "
                  "that file back",
                  printable_place(path.string()), kept_rows));
}

OutputFile open(const std::filesystem::path& path, const std::string& names, std::int64_t kept_rows) {
  if (kept_rows > 0) return OutputFile(path, kept_bytes(path, names, kept_rows));
  OutputFile file(path);
  file.write(names);
  file.flush();
  return file;
}

}  // namespace

MeasurementsWriter::MeasurementsWriter(const std::filesystem::path& path, std::vector<std::string> groups,
                                       std::int64_t kept_rows)
    : file_(open(path, column_names(groups), kept_rows)), elastic_count_(groups.size()) {
  for (std::size_t column = 0; column < groups.size(); ++column) elastic_of_[groups[column]].push_back(column);
}

/// The energies of the groups that have columns. Of several groups with one name, each takes the next such column.
std::vector<Real> MeasurementsWriter::elastic_columns(const Measurements& row) const {
  std::vector<Real> columns(elastic_count_, 0);
  std::map<std::string_view, std::size_t> taken;
  for (std::size_t i = 0; i < row.groups.size(); ++i) {
    const auto found = elastic_of_.find(row.groups[i]);
    if (found == elastic_of_.end()) continue;
    const std::size_t place = taken[found->first]++;
    if (place < found->second.size()) columns[found->second[place]] = row.elastic[i];
  }
  return columns;
}

void MeasurementsWriter::add(const Measurements& row) {
  std::string line = std::to_string(row.step);
  for (const Column& column : before_elastic) line += fmt::format(",{}", column.value(row));
  for (const Real energy : elastic_columns(row)) line += fmt::format(",{}", energy);
  for (const Column& column : after_elastic) line += fmt::format(",{}", column.value(row));
  file_.write(line + '\n');
  file_.flush();
}

}  // namespace pliant
