#include "bench/baselines.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"
#include "pliant/solver/global/global_step.h"
#include "system/memory.h"

namespace pliant_bench {
namespace {

using namespace pliant;

/// Results may differ by rounding alone, and by what the contraction of single precision leaves of a solve.
constexpr double rounding = 1e-9;

/// In a row, so that a baseline too finds in the caches what it left there: as many as Pliant has iterations in a step,
/// but for systems that take long and leave the caches anyway.
Index runs_in_a_row(const Simulation& simulation) {
  constexpr Index large_system = 20'000;
  const Index iterations = simulation.settings().iterations;
  return simulation.state().vertex_count() > large_system ? std::min<Index>(2, iterations) : iterations;
}

/// The largest distance as a share of the largest extent.
double relative_difference(const Positions& x, const Positions& reference) {
  const double extent = (reference.colwise().maxCoeff() - reference.colwise().minCoeff()).maxCoeff();
  return (x - reference).cwiseAbs().maxCoeff() / extent;
}

/// Some forces, the same ones every time.
ThreeColumns right_hand_sides(Index rows) {
  ThreeColumns b(rows, 3);
  for (Index axis = 0; axis < 3; ++axis) {
    for (Index i = 0; i < rows; ++i) b(i, axis) = std::sin(0.1 * (axis + 1) * i) + 0.5;
  }
  return b;
}

class SolveBaseline final : public Baseline {
 public:
  SolveBaseline(std::unique_ptr<Solve> solve, Index rows, Index runs)
      : solve_(std::move(solve)), b_(right_hand_sides(rows)), runs_(runs) {}

  double seconds() override {
    const Stopwatch watch;
    for (Index run = 0; run < runs_; ++run) solve_->run(b_);
    return watch.seconds() / runs_;
  }
  Positions solution() { return Eigen::Map<const ThreeColumns>(solve_->run(b_), b_.rows(), 3); }

 private:
  std::unique_ptr<Solve> solve_;
  ThreeColumns b_;
  Index runs_;
};

class TextbookBaseline final : public Baseline {
 public:
  TextbookBaseline(const Simulation& simulation, GlobalForm form)
      : textbook_(simulation, form), runs_(runs_in_a_row(simulation)) {}

  double seconds() override {
    textbook_.begin_step();
    const Stopwatch watch;
    for (Index run = 0; run < runs_; ++run) textbook_.iterate();
    const double seconds = watch.seconds() / runs_;
    textbook_.end_step();
    return seconds;
  }
  Positions step(Index iterations) {
    textbook_.begin_step();
    for (Index i = 0; i < iterations; ++i) textbook_.iterate();
    textbook_.end_step();
    return textbook_.positions();
  }

 private:
  Textbook textbook_;
  Index runs_;
};

class BaselineMaker {
 public:
  explicit BaselineMaker(const Reference& reference) : reference_(reference) {}

  void add_solve(const std::string& name, std::unique_ptr<Solve> (*make)(const LowerMatrix&)) {
    const Index rows = reference_.matrix.size();
    const pliant_system::PeakMemory peak;
    const Stopwatch watch;
    std::unique_ptr<Solve> solve = make(reference_.matrix);
    const double set_up = watch.seconds();
    auto baseline = std::make_unique<SolveBaseline>(std::move(solve), rows, runs_in_a_row(reference_.simulation));
    baseline->result = {name, "solve", {}, 0, set_up, peak.bytes()};
    if (solution_.rows() == 0) solution_ = own_solution();
    baseline->result.difference = relative_difference(baseline->solution(), solution_);
    take(std::move(baseline));
  }

  void add_textbook(const std::string& name, GlobalForm form) {
    const pliant_system::PeakMemory peak;
    const Stopwatch watch;
    auto baseline = std::make_unique<TextbookBaseline>(reference_.simulation, form);
    baseline->result = {name, "iteration", {}, 0, watch.seconds(), peak.bytes()};
    const Positions end = baseline->step(reference_.simulation.settings().iterations);
    baseline->result.difference = relative_difference(end, reference_.after_step);
    take(std::move(baseline));
  }

  std::vector<std::unique_ptr<Baseline>> baselines;

 private:
  /// What Pliant's own factor gives.
  Positions own_solution() const {
    const SolverSettings& settings = reference_.simulation.settings();
    GlobalStep own;
    own.set_factorization(make_factorization(settings.backend, settings.ordering));
    own.analyze(reference_.matrix);
    ThreadPool one_thread(1);
    SetUpTimes times;
    const Components nothing_is_free;
    own.factorize(reference_.matrix, settings.precision, {}, nothing_is_free, one_thread, times);
    Positions b = right_hand_sides(reference_.matrix.size());
    Positions x = Positions::Zero(b.rows(), 3);
    own.solve(b, 1, x, one_thread);
    return x;
  }

  void take(std::unique_ptr<Baseline> baseline) {
    if (!(baseline->result.difference <= rounding + 10 * reference_.contraction)) {
      fail_input(
          fmt::format("the baseline {} gives another result than Pliant, by {:.1e} of its extent, so that times "
                      "cannot be compared; report this, or leave it out of --baselines",
                      baseline->result.name, baseline->result.difference));
    }
    baselines.push_back(std::move(baseline));
  }

  const Reference& reference_;
  Positions solution_;
};

}  // namespace

LowerMatrix system_matrix(const Simulation& simulation) {
  std::vector<const ConstraintGroup*> groups;
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) groups.push_back(batch.get());
  }
  const State& state = simulation.state();
  const std::vector<char> nothing_pinned(state.masses.size(), 0);
  SystemMatrix matrix;
  matrix.set_groups(state.vertex_count(), groups);
  matrix.assemble(state.masses, simulation.settings().time_step, groups, nothing_pinned);
  return matrix.matrix();
}

std::vector<std::unique_ptr<Baseline>> make_baselines(const BenchOptions& options, const Reference& reference) {
  BaselineMaker maker(reference);
  if (options.has(BaselineKind::eigen)) maker.add_solve("Eigen", eigen_solve);
  if (options.has(BaselineKind::cholmod)) {
    maker.add_solve("CHOLMOD simplicial",
                    [](const LowerMatrix& matrix) { return cholmod_solve(matrix, CholmodMode::simplicial); });
    maker.add_solve("CHOLMOD supernodal",
                    [](const LowerMatrix& matrix) { return cholmod_solve(matrix, CholmodMode::supernodal); });
  }
  if (options.has(BaselineKind::textbook)) maker.add_textbook("textbook", GlobalForm::by_coordinate);
  if (options.has(BaselineKind::thesis)) maker.add_textbook("thesis 3m x 3m", GlobalForm::all_coordinates);
  return std::move(maker.baselines);
}

}  // namespace pliant_bench
