#pragma once
// What a scene that is simulated measures after its steps, for plots over time.
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pliant_io/recorder/measurements.h"
#include "pliant_io/scene/scene.h"
#include "plot/run_plots.h"

namespace pliant_viewer {

/// A row of measurements.csv; NaN where it was not measured.
struct MeasuredStep {
  std::shared_ptr<const std::vector<std::string>> names;  ///< the same pointer while the columns are the same
  std::vector<double> values;
  bool begins = false;  ///< the state at a start, behind which other curves begin
};

/// What is measured after every step, though it takes a local step or more. What is not asked for is measured as often
/// as it takes a small share of the time, and is NaN in between.
struct Measuring {
  bool energies = false;     ///< elastic energies, potentials, their total, the residual and the objective
  bool past_limits = false;  ///< how far stretches are past their limits; brings energies along

  bool operator==(const Measuring&) const = default;
};

/// How often something may be done that is to take no more than a share of the time of steps.
class TimeBudget {
 public:
  explicit TimeBudget(double share) : share_(share) {}
  void earn(double seconds) { credit_ = std::min(0.0, credit_ + share_ * seconds); }
  void spend(double seconds) { credit_ -= seconds; }
  bool has_some() const { return credit_ >= 0; }

 private:
  double share_;
  double credit_ = 0;  // at most 0 [s]
};

/// Measures a scene in the thread that simulates it.
class StepMeasurer {
 public:
  /// The state from which steps begin; columns are those of the scene and of what is in it.
  /// Nothing when it cannot be measured: a number is not finite.
  std::optional<MeasuredStep> measure_start(pliant::Scene& scene);
  /// After a step. A group, a collider or contact of surfaces that has come meanwhile has columns from then on; a group
  /// once it has energy.
  std::optional<MeasuredStep> measure_step(pliant::Scene& scene, const pliant::StepReport& report,
                                           const Measuring& measuring);

 private:
  pliant::Measurements measure(pliant::Simulation& simulation, const pliant::StepReport& report,
                               const Measuring& measuring);
  MeasuredStep row_of(const pliant::Scene& scene, const pliant::Measurements& row);
  void add_columns(const pliant::Scene& scene, const pliant::Measurements& row);

  std::vector<std::string> groups_;
  pliant::ContactColumns contact_;
  std::optional<pliant::MeasurementColumns> columns_;
  std::shared_ptr<const std::vector<std::string>> names_;
  std::vector<std::string> known_groups_, known_colliders_;  // that have columns, as they came last
  TimeBudget for_energies_{0.02}, for_past_limits_{0.01};
};

/// Rows of measurements.csv in the order of their steps, of a bounded number: when there are too many, those of the
/// last `recent` steps stay, and of the older ones every second, fourth and so on. The start stays, and any row is one
/// that was measured.
class History {
 public:
  explicit History(std::string name, std::size_t capacity = 12'288, std::size_t recent = 4096);

  void add(const MeasuredStep& step);
  const pliant_plot::MeasuredRun& run() const { return run_; }
  /// Changes with the rows.
  std::uint64_t version() const { return version_; }

 private:
  void arrange(const std::vector<std::string>& names);
  void thin_out();

  pliant_plot::MeasuredRun run_;
  std::size_t capacity_;
  std::size_t recent_;
  std::int64_t stride_ = 1;  // steps between older rows
  std::shared_ptr<const std::vector<std::string>> names_;
  std::uint64_t version_ = 0;
};

/// Leaves out every second row, but none that begins, of rows that nobody has taken.
void leave_out_every_second(std::vector<MeasuredStep>& steps);

}  // namespace pliant_viewer
