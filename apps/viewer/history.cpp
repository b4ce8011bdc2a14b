#include "viewer/history.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"

namespace pliant_viewer {
namespace {

using Names = std::vector<std::string>;

/// Adds those of `present` that `names` has fewer of. `is_wanted` is asked for each by its place.
template <class IsWanted>
bool add_missing(Names& names, const Names& present, IsWanted&& is_wanted) {
  bool has_added = false;
  for (std::size_t i = 0; i < present.size(); ++i) {
    const auto end = present.begin() + static_cast<std::ptrdiff_t>(i) + 1;
    const auto wanted = std::count(present.begin(), end, present[i]);
    if (std::ranges::count(names, present[i]) >= wanted || !is_wanted(i)) continue;
    names.push_back(present[i]);
    has_added = true;
  }
  return has_added;
}

bool is_always_wanted(std::size_t) {
  return true;
}

}  // namespace

std::optional<MeasuredStep> StepMeasurer::measure_start(pliant::Scene& scene) {
  groups_ = scene.group_names;
  contact_ = {scene.collider_names, scene.has_surfaces};
  Names present;
  for (const auto& [id, group] : scene.simulation.groups()) present.push_back(group.name);
  add_missing(groups_, present, is_always_wanted);
  columns_.reset();
  known_groups_.clear();
  known_colliders_.clear();
  try {
    MeasuredStep start = row_of(scene, pliant::measure(scene.simulation, {}));
    start.begins = true;
    return start;
  } catch (const pliant::Error&) {  // what is wrong with a scene its steps tell
    return {};
  }
}

std::optional<MeasuredStep> StepMeasurer::measure_step(pliant::Scene& scene, const pliant::StepReport& report,
                                                       const Measuring& measuring) {
  for_energies_.earn(report.seconds_total);
  for_past_limits_.earn(report.seconds_total);
  try {
    return row_of(scene, measure(scene.simulation, report, measuring));
  } catch (const pliant::Error&) {
    return {};
  }
}

pliant::Measurements StepMeasurer::measure(pliant::Simulation& simulation, const pliant::StepReport& report,
                                           const Measuring& measuring) {
  const bool has_limits = measuring.past_limits || for_past_limits_.has_some();
  if (!has_limits && !measuring.energies && !for_energies_.has_some()) return measure_motion(simulation, report);
  pliant::Stopwatch watch;
  pliant::Measurements row = measure_energies(simulation, report);
  if (!measuring.energies) for_energies_.spend(watch.lap());
  if (!has_limits) return row;
  watch.lap();
  row.past_limits = stretch_past_limits(simulation);
  if (!measuring.past_limits) for_past_limits_.spend(watch.lap());
  return row;
}

MeasuredStep StepMeasurer::row_of(const pliant::Scene& scene, const pliant::Measurements& row) {
  add_columns(scene, row);
  return {names_, columns_->values(row)};
}

void StepMeasurer::add_columns(const pliant::Scene& scene, const pliant::Measurements& row) {
  const bool has_surfaces = contact_.surfaces || scene.simulation.contact().surfaces;
  bool has_changed = !columns_ || has_surfaces != contact_.surfaces;
  contact_.surfaces = has_surfaces;
  if (row.colliders != known_colliders_) {
    has_changed |= add_missing(contact_.colliders, row.colliders, is_always_wanted);
    known_colliders_ = row.colliders;
  }
  if (row.groups != known_groups_) {
    bool is_known = true;
    has_changed |= add_missing(groups_, row.groups, [&](std::size_t i) {
      is_known = is_known && row.elastic[i] > 0;
      return row.elastic[i] > 0;
    });
    if (is_known) known_groups_ = row.groups;
  }
  if (!has_changed) return;
  columns_.emplace(groups_, contact_);
  names_ = std::make_shared<const Names>(columns_->names());
}

History::History(std::string name, std::size_t capacity, std::size_t recent)
    : run_{std::move(name), {}}, capacity_(capacity), recent_(recent) {}

void History::add(const MeasuredStep& step) {
  if (step.begins) {
    run_.table = {};
    names_ = nullptr;
    stride_ = 1;
  }
  if (step.names != names_) arrange(*step.names);
  names_ = step.names;
  for (std::size_t i = 0; i < step.values.size(); ++i) run_.table.columns[i].push_back(step.values[i]);
  if (run_.table.row_count() >= capacity_) thin_out();
  ++version_;
}

/// Puts the columns in the order of `names`; of those that were not there before, the rows of before have 0, as in
/// measurements.csv.
void History::arrange(const Names& names) {
  const std::size_t count = run_.table.row_count();
  pliant_sweep::MeasurementTable next{names, std::vector<std::vector<double>>(names.size())};
  std::vector<bool> is_taken(run_.table.names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    next.columns[i].assign(count, 0);
    for (std::size_t old = 0; old < is_taken.size(); ++old) {
      if (is_taken[old] || run_.table.names[old] != names[i]) continue;
      is_taken[old] = true;
      next.columns[i] = std::move(run_.table.columns[old]);
      break;
    }
  }
  run_.table = std::move(next);
}

void History::thin_out() {
  const std::vector<double>& steps = run_.table.columns.front();
  const std::size_t older = steps.size() - std::min(recent_, steps.size() / 2);
  std::vector<std::size_t> kept;
  const auto find_kept = [&] {
    kept.clear();
    for (std::size_t i = 0; i < older; ++i) {
      if (std::llround(steps[i] - steps.front()) % stride_ == 0) kept.push_back(i);
    }
  };
  for (find_kept(); kept.size() > std::max<std::size_t>(older / 2, 1); find_kept()) stride_ *= 2;
  for (std::vector<double>& column : run_.table.columns) {
    std::size_t to = 0;
    for (const std::size_t from : kept) column[to++] = column[from];
    column.erase(column.begin() + static_cast<std::ptrdiff_t>(to), column.begin() + static_cast<std::ptrdiff_t>(older));
  }
}

void leave_out_every_second(std::vector<MeasuredStep>& steps) {
  std::size_t place = 0;
  std::erase_if(steps, [&](const MeasuredStep& step) { return ++place % 2 == 0 && !step.begins; });
}

}  // namespace pliant_viewer
