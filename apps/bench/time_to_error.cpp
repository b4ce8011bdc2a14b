#include "bench/time_to_error.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "bench/timing.h"
#include "bench/xpbd.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/core/stopwatch.h"

namespace pliant_bench {
namespace {

using namespace pliant;

constexpr double seconds_a_level = 2;
/// Of how far a step goes: where its prediction is nearer to its end, that is rounding.
constexpr double least_unit = 1e-9;

/// One step, taken as often as one likes.
class Step {
 public:
  Step(Simulation& simulation, SolverSettings settings)
      : simulation_(simulation), settings_(settings), start_(simulation.state()) {
    const auto half = converged(most_iterations / 2);
    reference_ = converged(most_iterations);
    unit_ = 1;
    const double unit = error_of(prediction());
    can_be_measured_ = unit > least_unit * error_of(start_.positions);
    if (!can_be_measured_) return;
    unit_ = unit;
    uncertainty_ = error_of(half);
    usual_error_ = error_after(Acceleration::lbfgs, usual_iterations);
    simulation.restore(start_);
  }
  /// Not where nothing but inertia and forces acts, so that the step ends at its prediction.
  bool can_be_measured() const { return can_be_measured_; }
  double uncertainty() const { return uncertainty_; }
  double usual_error() const { return usual_error_; }
  double error_of(const Positions& positions) const {
    double sum = 0, mass = 0;
    for (Index i = 0; i < start_.vertex_count(); ++i) {
      const Real m = start_.masses[static_cast<std::size_t>(i)];
      sum += m * (positions.row(i) - reference_.row(i)).squaredNorm();
      mass += m;
    }
    return std::sqrt(sum / mass) / unit_;
  }

  double error_after(Acceleration acceleration, Index iterations) {
    const auto key = std::pair(acceleration, iterations);
    if (const auto found = errors_.find(key); found != errors_.end()) return found->second;
    take(acceleration, iterations);
    return errors_[key] = error_of(simulation_.state().positions);
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
  /// q + h v + h² M⁻¹ f
  Positions prediction() const {
    const Real h = settings_.time_step;
    Positions forces = Positions::Zero(start_.vertex_count(), 3);
    for (const auto& [id, force] : simulation_.forces()) force->add_to(forces, start_.view(), h);
    const Eigen::Map<const Eigen::VectorXd> masses(start_.masses.data(), start_.vertex_count());
    return start_.positions + h * start_.velocities + h * h * (masses.cwiseInverse().asDiagonal() * forces);
  }

  Simulation& simulation_;
  const SolverSettings settings_;
  const State start_;
  Positions reference_;
  double unit_ = 1;  // [m]
  bool can_be_measured_ = false;
  double uncertainty_ = 0;
  double usual_error_ = 0;
  std::map<std::pair<Acceleration, Index>, double> errors_;
};

/// One way to take the step. Errors are asked for from the largest to the smallest, times afterwards.
class Method {
 public:
  virtual ~Method() = default;
  /// The fewest that are enough; nothing where even the most are not.
  virtual std::optional<Index> iterations_for(double error) = 0;
  virtual double seconds(Index iterations) = 0;
  /// The error with the most iterations, where these have been asked for.
  virtual std::optional<double> last_error() = 0;
};

class Projective final : public Method {
 public:
  Projective(Step& step, Acceleration acceleration) : step_(step), acceleration_(acceleration) {}
  /// To a sixteenth.
  std::optional<Index> iterations_for(double error) override {
    const auto is_enough = [&](Index iterations) { return step_.error_after(acceleration_, iterations) <= error; };
    Index enough = 1;
    while (!is_enough(enough)) {
      if (enough >= most_iterations) {
        last_error_ = step_.error_after(acceleration_, most_iterations);
        return std::nullopt;
      }
      enough = std::min(2 * enough, most_iterations);
    }
    Index too_few = enough / 2;
    while (enough - too_few > std::max<Index>(1, enough / 16)) {
      const Index middle = (enough + too_few) / 2;
      (is_enough(middle) ? enough : too_few) = middle;
    }
    return enough;
  }
  double seconds(Index iterations) override { return step_.seconds(acceleration_, iterations); }
  std::optional<double> last_error() override { return last_error_; }

 private:
  Step& step_;
  Acceleration acceleration_;
  std::optional<double> last_error_;
};

class Sweeping final : public Method {
 public:
  Sweeping(const Step& step, const Simulation& simulation, Multipliers multipliers)
      : step_(step), xpbd_(simulation, multipliers) {}
  std::optional<Index> iterations_for(double error) override {
    while (!(error_ <= error) && sweeps_ < most_iterations) {
      xpbd_.sweep();
      ++sweeps_;
      error_ = step_.error_of(xpbd_.positions());
    }
    return error_ <= error ? std::optional(sweeps_) : std::nullopt;
  }
  /// All sweeps take the same time, so of many some are timed.
  double seconds(Index iterations) override {
    constexpr Index most_timed = 200;
    const Index timed = std::min(iterations, most_timed);
    xpbd_.begin_step();
    const Stopwatch watch;
    for (Index i = 0; i < timed; ++i) xpbd_.sweep();
    return watch.seconds() * static_cast<double>(iterations) / static_cast<double>(timed);
  }
  std::optional<double> last_error() override {
    return sweeps_ == most_iterations ? std::optional(error_) : std::nullopt;
  }

 private:
  const Step& step_;
  Xpbd xpbd_;
  Index sweeps_ = 0;
  double error_ = 1;
};

struct NamedMethod {
  std::string name;
  std::unique_ptr<Method> method;
};

/// `simulation` at the beginning of the step.
std::vector<NamedMethod> methods_of(Step& step, const Simulation& simulation) {
  std::vector<NamedMethod> methods;
  methods.push_back({"plain", std::make_unique<Projective>(step, Acceleration::none)});
  methods.push_back({"lbfgs", std::make_unique<Projective>(step, Acceleration::lbfgs)});
  methods.push_back({"anderson", std::make_unique<Projective>(step, Acceleration::anderson)});
  methods.push_back({"chebyshev", std::make_unique<Projective>(step, Acceleration::chebyshev)});
  if (Xpbd::takes(simulation)) {
    methods.push_back({"xpbd", std::make_unique<Sweeping>(step, simulation, Multipliers::one)});
    methods.push_back({"xpbd rows", std::make_unique<Sweeping>(step, simulation, Multipliers::each_row)});
  }
  return methods;
}

}  // namespace

TimeToErrorResult measure_time_to_error(const StepCase& step_case, const BenchOptions& options) {
  Scene scene = begin_of(step_case, options.threads.front());
  SolverSettings settings = scene.simulation.settings();
  settings.backend = options.settings.backend;
  settings.ordering = options.settings.ordering;
  settings.precision = options.settings.precision;
  Step step(scene.simulation, settings);
  if (!step.can_be_measured()) {
    fail_input(
        fmt::format("--time-to-error: step {} of '{}' ends where forces and inertia alone lead, as in free fall; "
                    "give other --steps",
                    step_case.steps + 1, printable(step_case.name)));
  }
  TimeToErrorResult result{.name = step_case.name,
                           .description = step_case.description,
                           .vertices = scene.simulation.state().vertex_count(),
                           .uncertainty = step.uncertainty(),
                           .usual_error = step.usual_error(),
                           .methods = {}};
  std::vector<double> errors(error_levels.begin(), error_levels.end());
  errors.push_back(result.usual_error);
  std::ranges::sort(errors, std::greater());
  const std::vector<NamedMethod> methods = methods_of(step, scene.simulation);
  for (const NamedMethod& each : methods) {
    MethodResult method{each.name, {}, {}};
    for (const double error : errors) {
      const bool can_be_told = error > 2 * step.uncertainty();
      method.levels.push_back({error, can_be_told ? each.method->iterations_for(error) : std::nullopt, {}});
    }
    method.last_error = each.method->last_error();
    result.methods.push_back(std::move(method));
  }
  for (std::size_t level = 0; level < errors.size(); ++level) {
    std::vector<Samples> samples(methods.size());
    repeat(options.repeats, seconds_a_level, [&] {
      for (std::size_t i = 0; i < methods.size(); ++i) {
        const std::optional<Index> iterations = result.methods[i].levels[level].iterations;
        if (iterations) samples[i].add(methods[i].method->seconds(*iterations));
      }
    });
    for (std::size_t i = 0; i < methods.size(); ++i) result.methods[i].levels[level].seconds = samples[i].spread();
  }
  return result;
}

}  // namespace pliant_bench
