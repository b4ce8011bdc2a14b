#include "bench/time_to_error.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "bench/timing.h"
#include "pliant/core/error.h"

namespace pliant_bench {
namespace {

using namespace pliant;

constexpr Index most_iterations = 20'000;
constexpr double seconds_a_level = 2;

/// One step, taken as often as one likes.
class Step {
 public:
  Step(Simulation& simulation, SolverSettings settings)
      : simulation_(simulation), settings_(settings), start_(simulation.state()) {
    const auto half = converged(most_iterations / 2);
    reference_ = converged(most_iterations);
    unit_ = 1;
    unit_ = distance(prediction());
    uncertainty_ = distance(half);
  }
  double uncertainty() const { return uncertainty_; }

  double error_after(Acceleration acceleration, Index iterations) {
    const auto key = std::pair(acceleration, iterations);
    if (const auto found = errors_.find(key); found != errors_.end()) return found->second;
    take(acceleration, iterations);
    return errors_[key] = distance(simulation_.state().positions);
  }
  /// Of a step with so many, without what is done once.
  double seconds(Acceleration acceleration, Index iterations) {
    take(acceleration, iterations);
    const StepReport report = take(acceleration, iterations);  // the factor is there now
    return report.seconds_total;
  }

 private:
  StepReport take(Acceleration acceleration, Index iterations) {
    SolverSettings settings = settings_;
    settings.acceleration = acceleration;
    settings.iterations = iterations;
    settings.tolerance = 0;
    simulation_.set_settings(settings);
    simulation_.restore(start_);
    return simulation_.step();
  }
  Positions converged(Index iterations) {
    take(Acceleration::lbfgs, iterations);
    return simulation_.state().positions;
  }
  Positions prediction() const {
    const Real h = settings_.time_step;
    Positions q = start_.positions + h * start_.velocities;
    q.col(2).array() -= 9.81 * h * h;
    return q;
  }
  double distance(const Positions& positions) const {
    double sum = 0, mass = 0;
    for (Index i = 0; i < start_.vertex_count(); ++i) {
      const Real m = start_.masses[static_cast<std::size_t>(i)];
      sum += m * (positions.row(i) - reference_.row(i)).squaredNorm();
      mass += m;
    }
    return std::sqrt(sum / mass) / unit_;
  }

  Simulation& simulation_;
  const SolverSettings settings_;
  const State start_;
  Positions reference_;
  double unit_ = 1;  // [m]
  double uncertainty_ = 0;
  std::map<std::pair<Acceleration, Index>, double> errors_;
};

/// The fewest that are enough, to a sixteenth; nothing where even the most are not.
std::optional<Index> iterations_for(Step& step, Acceleration acceleration, double error) {
  const auto is_enough = [&](Index iterations) { return step.error_after(acceleration, iterations) <= error; };
  Index enough = 1;
  while (!is_enough(enough)) {
    if (enough >= most_iterations) return std::nullopt;
    enough = std::min(2 * enough, most_iterations);
  }
  Index too_few = enough / 2;
  while (enough - too_few > std::max<Index>(1, enough / 16)) {
    const Index middle = (enough + too_few) / 2;
    (is_enough(middle) ? enough : too_few) = middle;
  }
  return enough;
}

}  // namespace

TimeToErrorResult measure_time_to_error(const StepCase& step_case, const BenchOptions& options) {
  Scene scene = begin_of(step_case, options.threads.front());
  SolverSettings settings = scene.simulation.settings();
  settings.backend = options.settings.backend;
  settings.ordering = options.settings.ordering;
  settings.precision = options.settings.precision;
  Step step(scene.simulation, settings);
  TimeToErrorResult result{
      step_case.name, step_case.description, scene.simulation.state().vertex_count(), step.uncertainty(), {}};
  constexpr std::array<std::pair<const char*, Acceleration>, 4> methods = {{{"plain", Acceleration::none},
                                                                            {"lbfgs", Acceleration::lbfgs},
                                                                            {"anderson", Acceleration::anderson},
                                                                            {"chebyshev", Acceleration::chebyshev}}};
  for (const auto& [name, acceleration] : methods) {
    MethodResult method{name, {}};
    for (const double error : error_levels) {
      const bool can_be_told = error > 2 * step.uncertainty();
      method.levels.push_back({error, can_be_told ? iterations_for(step, acceleration, error) : std::nullopt, {}});
    }
    result.methods.push_back(std::move(method));
  }
  for (std::size_t level = 0; level < error_levels.size(); ++level) {
    std::array<Samples, methods.size()> samples;
    repeat(options.repeats, seconds_a_level, [&] {
      for (std::size_t i = 0; i < methods.size(); ++i) {
        const std::optional<Index> iterations = result.methods[i].levels[level].iterations;
        if (iterations) samples[i].add(step.seconds(methods[i].second, *iterations));
      }
    });
    for (std::size_t i = 0; i < methods.size(); ++i) result.methods[i].levels[level].seconds = samples[i].spread();
  }
  return result;
}

}  // namespace pliant_bench
