#include "pliant_io/recorder/measurements.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <string>

#include <fmt/format.h>

#include "pliant/constraints/fibre_strain.h"
#include "pliant/constraints/kernels/local_kernels.h"
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
    Column{"past_limits", [](const Measurements& row) { return row.past_limits; }},
    Column{"residual", [](const Measurements& row) { return row.residual; }},
    Column{"objective", [](const Measurements& row) { return row.objective; }},
    Column{"iterations", [](const Measurements& row) { return static_cast<Real>(row.report.iterations); }},
    Column{"ms_local", [](const Measurements& row) { return 1e3 * row.report.seconds_local; }},
    Column{"ms_global", [](const Measurements& row) { return 1e3 * row.report.seconds_global; }},
    Column{"ms_total", [](const Measurements& row) { return 1e3 * row.report.seconds_total; }},
};

/// Where there are colliders, or surfaces touch.
constexpr std::array of_contact = {
    Column{"contacts", [](const Measurements& row) { return static_cast<Real>(row.report.contact.contacts); }},
    Column{"deepest", [](const Measurements& row) { return row.report.contact.deepest; }},
    Column{"friction_power", [](const Measurements& row) { return row.report.contact.friction_power; }},
    Column{"held_back", [](const Measurements& row) { return static_cast<Real>(row.report.contact.held_back); }},
    Column{"backtracks", [](const Measurements& row) { return static_cast<Real>(row.report.backtracks); }},
    Column{"refactorizations",
           [](const Measurements& row) { return static_cast<Real>(row.report.contact.refactorizations); }},
    Column{"ms_contact", [](const Measurements& row) { return 1e3 * row.report.contact.seconds; }},
};

/// Where surfaces touch.
constexpr std::array of_surfaces = {
    Column{"pairs", [](const Measurements& row) { return static_cast<Real>(row.report.contact.pairs); }},
    Column{"active", [](const Measurements& row) { return static_cast<Real>(row.report.contact.active); }},
    Column{"smallest_gap", [](const Measurements& row) { return row.report.contact.smallest_gap; }},
    Column{"shortened", [](const Measurements& row) { return static_cast<Real>(row.report.contact.shortened); }},
    Column{"momentum_lost", [](const Measurements& row) { return row.report.contact.momentum_lost.norm(); }},
    Column{"energy_taken", [](const Measurements& row) { return row.report.contact.energy_taken; }},
    Column{"lag", [](const Measurements& row) { return row.report.contact.lag; }},
    Column{"let_go", [](const Measurements& row) { return static_cast<Real>(row.report.contact.let_go); }},
};

struct WrenchColumn {
  std::string_view name;
  Real (*value)(const Wrench&);
};

/// Of each collider.
constexpr std::array of_wrench = {
    WrenchColumn{"force_x", [](const Wrench& wrench) { return wrench.force.x(); }},
    WrenchColumn{"force_y", [](const Wrench& wrench) { return wrench.force.y(); }},
    WrenchColumn{"force_z", [](const Wrench& wrench) { return wrench.force.z(); }},
    WrenchColumn{"torque_x", [](const Wrench& wrench) { return wrench.torque.x(); }},
    WrenchColumn{"torque_y", [](const Wrench& wrench) { return wrench.torque.y(); }},
    WrenchColumn{"torque_z", [](const Wrench& wrench) { return wrench.torque.z(); }},
};

/// Positions may still be finite where their energies no longer are.
void check_finite(const Measurements& row) {
  const auto check_value = [&row](Real value, std::string_view name) {
    if (std::isfinite(value)) return;
    throw Error(ErrorKind::diverged,
                fmt::format("step {} (t = {} s): `{}` is not finite; reduce masses, stiffness or velocities, or give "
                            "a larger time step",
                            row.step, row.time, name));
  };
  const auto check = [&](const auto& columns) {
    for (const Column& column : columns) check_value(column.value(row), column.name);
  };
  check(before_elastic);
  check(after_elastic);
  check(of_contact);
  for (const Wrench& wrench : row.wrenches) {
    for (const WrenchColumn& column : of_wrench) check_value(column.value(wrench), column.name);
  }
}

}  // namespace

namespace {

/// ‖z − p‖ of one constraint, where its energy says that it is at most `most`: fibres that get taut have more energy.
Real move_of(const ConstraintGroup& batch, const Positions& positions, Index i, Real most) {
  const auto* taut = dynamic_cast<const Batch<TautFibrePotential>*>(&batch);
  if (taut == nullptr) return most;
  constexpr std::size_t n = TautFibrePotential::vertices;
  const auto first = static_cast<std::size_t>(i);
  Vec3 z;
  sum_stencil<1, true>(positions.data(), batch.stencil().subspan(n * first, n), batch.reduction().data() + n * first,
                       z.data());
  const Real* limits = taut->fields().data() + TautFibrePotential::fields * first;
  return std::abs(z.norm() - std::clamp(z.norm(), limits[0], limits[1]));
}

/// The larger of `largest` and the largest ‖z − p‖ of these constraints. Energies of many together are found in lanes;
/// only where one of them alone could be past the largest so far are they taken apart.
Real largest_move(const ConstraintGroup& batch, const Positions& positions, Real largest) {
  const GroupShape shape = batch.shape();
  constexpr Index at_once = local_block, in_lanes = 8;
  std::vector<Real> scratch(
      static_cast<std::size_t>(3 * at_once * (takes_forces(batch) ? shape.vertices : shape.rows)));
  const auto look_at = [&](auto&& self, Index begin, Index end) -> void {
    const Real energy = project_to_slots(batch, positions, scratch, begin, end);
    const auto measures =
        batch.rest_measure().subspan(static_cast<std::size_t>(begin), static_cast<std::size_t>(end - begin));
    const Real most = std::sqrt(2 * energy / (batch.stiffness() * std::ranges::min(measures)));
    if (!(most > largest)) return;
    if (end - begin == 1) {
      largest = std::max(largest, move_of(batch, positions, begin, most));
      return;
    }
    const Index part = end - begin > in_lanes ? in_lanes : 1;
    for (Index i = begin; i < end; i += part) self(self, i, std::min(i + part, end));
  };
  for (Index i = 0; i < shape.count; i += at_once) look_at(look_at, i, std::min(i + at_once, shape.count));
  return largest;
}

}  // namespace

Real stretch_past_limits(const Simulation& simulation) {
  std::set<BodyId> with_fibres;
  const auto is_fibres = [](const ConstraintGroup& batch) { return batch.type() == FibreStrain::info.name; };
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) {
      if (is_fibres(*batch)) with_fibres.insert(group.body);
    }
  }
  Real largest = 0;
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) {
      if (!batch->limits_stretches() || (with_fibres.contains(group.body) && !is_fibres(*batch))) continue;
      largest = largest_move(*batch, simulation.state().positions, largest);
    }
  }
  return largest;
}

namespace {

Measurements motion_of(const Simulation& simulation, const StepReport& report) {
  const State& state = simulation.state();
  Measurements row;
  row.step = state.step;
  row.time = state.time;
  row.report = report;
  for (Index i = 0; i < state.vertex_count(); ++i) {
    const Real mass = state.masses[static_cast<std::size_t>(i)];
    const Vec3 v = pliant::row(state.velocities, i);
    row.kinetic += mass / 2 * v.squaredNorm();
    row.speed_sum += v.norm();
    row.momentum += mass * v;
    row.angular_momentum += mass * pliant::row(state.positions, i).cross(v);
  }
  for (const auto& [id, collider] : simulation.colliders()) {
    row.colliders.push_back(collider.name);
    row.wrenches.push_back(simulation.wrench(id));
  }
  return row;
}

}  // namespace

Measurements measure_motion(const Simulation& simulation, const StepReport& report) {
  constexpr Real unknown = std::numeric_limits<Real>::quiet_NaN();
  Measurements row = motion_of(simulation, report);
  for (const auto& [id, group] : simulation.groups()) {
    row.groups.push_back(group.name);
    row.elastic.push_back(unknown);
  }
  row.gravitational = row.other_potential = row.total = unknown;
  row.past_limits = row.residual = row.objective = unknown;
  return row;
}

bool takes_local_step(std::string_view column) {
  constexpr std::array<std::string_view, 6> others = {"gravitational", "other_potential", "total",
                                                      "past_limits",   "residual",        "objective"};
  return column == "elastic" || column.starts_with("elastic_") || std::ranges::find(others, column) != others.end();
}

Measurements measure_energies(Simulation& simulation, const StepReport& report) {
  const Evaluation evaluation = simulation.evaluate();
  const State& state = simulation.state();
  Measurements row = motion_of(simulation, report);
  row.residual = evaluation.residual;
  row.objective = evaluation.objective();
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
  row.past_limits = std::numeric_limits<Real>::quiet_NaN();
  return row;
}

Measurements measure(Simulation& simulation, const StepReport& report) {
  Measurements row = measure_energies(simulation, report);
  row.past_limits = stretch_past_limits(simulation);
  check_finite(row);
  return row;
}

namespace {

bool has_contact(const ContactColumns& contact) {
  return contact.surfaces || !contact.colliders.empty();
}

std::vector<std::string> column_names(const std::vector<std::string>& groups, const ContactColumns& contact) {
  std::vector<std::string> names = {"step"};
  const auto add = [&names](const auto& columns) {
    for (const Column& column : columns) names.emplace_back(column.name);
  };
  add(before_elastic);
  for (const std::string& name : groups) names.push_back("elastic_" + name);
  add(after_elastic);
  if (!has_contact(contact)) return names;
  add(of_contact);
  if (contact.surfaces) add(of_surfaces);
  for (const std::string& name : contact.colliders) {
    for (const WrenchColumn& column : of_wrench) names.push_back(fmt::format("{}_{}", column.name, name));
  }
  return names;
}

std::string line_of(const std::vector<std::string>& names) {
  std::string line;
  for (const std::string& name : names) line += (line.empty() ? "" : ",") + csv_field(name);
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

NamedColumns::NamedColumns(const std::vector<std::string>& names) : count_(names.size()) {
  for (std::size_t column = 0; column < names.size(); ++column) columns_[names[column]].push_back(column);
}

std::vector<std::optional<std::size_t>> NamedColumns::places_of(const std::vector<std::string>& names) const {
  std::vector<std::optional<std::size_t>> places(names.size());
  std::map<std::string_view, std::size_t> taken;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto found = columns_.find(names[i]);
    if (found == columns_.end()) continue;
    const std::size_t place = taken[found->first]++;
    if (place < found->second.size()) places[i] = found->second[place];
  }
  return places;
}

MeasurementColumns::MeasurementColumns(const std::vector<std::string>& groups, const ContactColumns& contact)
    : names_(column_names(groups, contact)),
      elastic_(groups),
      wrenches_(contact.colliders),
      has_contact_(has_contact(contact)),
      has_surfaces_(contact.surfaces) {}

std::vector<Real> MeasurementColumns::values(const Measurements& row) const {
  std::vector<Real> values = {static_cast<Real>(row.step)};
  values.reserve(names_.size());
  const auto add = [&values](const auto& columns, const auto& of) {
    for (const auto& column : columns) values.push_back(column.value(of));
  };
  add(before_elastic, row);
  for (const Real energy : elastic_.values(row.groups, row.elastic)) values.push_back(energy);
  add(after_elastic, row);
  if (has_contact_) add(of_contact, row);
  if (has_surfaces_) add(of_surfaces, row);
  for (const Wrench& wrench : wrenches_.values(row.colliders, row.wrenches)) add(of_wrench, wrench);
  return values;
}

MeasurementsWriter::MeasurementsWriter(const std::filesystem::path& path, const std::vector<std::string>& groups,
                                       std::int64_t kept_rows, const ContactColumns& contact)
    : columns_(groups, contact), file_(open(path, line_of(columns_.names()), kept_rows)) {}

void MeasurementsWriter::add(const Measurements& row) {
  file_.write(fmt::format("{}\n", fmt::join(columns_.values(row), ",")));
  file_.flush();
}

}  // namespace pliant
