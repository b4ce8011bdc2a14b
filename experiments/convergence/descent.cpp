#include "convergence/descent.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/stopwatch.h"

namespace pliant_experiments {
namespace {

using namespace pliant;

constexpr int most_newton_iterations = 200;
constexpr double most_repeat_seconds = 0.5;  // of one number of iterations: long steps are taken once
constexpr double rounding = 1e-18;           // errors may come out as zero or less, which has no logarithm

double distance(const MassSpring& model, const Positions& a, const Positions& b) {
  double sum = 0;
  for (Index i = 0; i < model.vertex_count(); ++i) {
    sum += model.masses[static_cast<std::size_t>(i)] * (a.row(i) - b.row(i)).squaredNorm();
  }
  return std::sqrt(sum);
}

void take(Simulation& simulation, const State& start, int iterations) {
  simulation.restore(start);
  SolverSettings settings = simulation.settings();
  settings.iterations = iterations;
  simulation.set_settings(settings);
}

}  // namespace

double Problem::objective_error(const Positions& q) const {
  return (objective(model, step, q) - least_objective) / (first_objective - least_objective);
}

double Problem::position_error(const Positions& q) const {
  return distance(model, q, minimum) / first_distance;
}

Problem problem_after(const ExperimentContext& context, Scene scene, int steps) {
  for (int i = 0; i < steps; ++i) context.step(scene);
  State start = scene.simulation.state();
  MassSpring model = mass_spring(scene.simulation);
  EulerStep step = next_step(scene.simulation, model);
  Problem problem{std::move(scene), std::move(start), std::move(model), std::move(step)};
  problem.minimum = problem.step.predicted;
  problem.first_objective = objective(problem.model, problem.step, problem.step.predicted);
  problem.newton_iterations = Newton(problem.model).minimize(problem.step, problem.minimum, most_newton_iterations);
  problem.least_objective = objective(problem.model, problem.step, problem.minimum);
  problem.first_distance = distance(problem.model, problem.step.predicted, problem.minimum);
  problem.largest_gradient = gradient(problem.model, problem.step, problem.minimum).rowwise().norm().maxCoeff();
  return problem;
}

std::optional<std::size_t> Descent::first_under(double error) const {
  for (std::size_t i = 0; i < objective_errors.size(); ++i) {
    if (objective_errors[i] < error) return i;
  }
  return std::nullopt;
}

double Descent::objective_error_at(double time, const std::vector<double>& times) const {
  // The last entry that has come to its end by then; the machine may have been busy in an earlier one.
  std::size_t next = times.size();
  while (next > 0 && times[next - 1] > time) --next;
  if (next == 0) return 1;
  if (next == times.size()) return objective_errors.back();
  const double share = std::log(time / times[next - 1]) / std::log(times[next] / times[next - 1]);
  const double before = std::max(objective_errors[next - 1], rounding);
  return before * std::pow(std::max(objective_errors[next], rounding) / before, share);
}

Descent descend(const ExperimentContext& context, Problem& problem, const std::vector<int>& iterations, int repeats) {
  Simulation& simulation = problem.scene.simulation;
  Descent descent;
  for (const int count : iterations) {
    std::vector<double> seconds;
    const Stopwatch watch;
    for (int i = 0; i < repeats && (i == 0 || watch.seconds() < most_repeat_seconds); ++i) {
      take(simulation, problem.start, count);
      const StepReport report = context.step(problem.scene);
      seconds.push_back(report.seconds_local + report.seconds_global);
    }
    descent.iterations.push_back(count);
    const auto [least, most] = std::ranges::minmax(seconds);
    descent.seconds.push_back(least);
    descent.most_seconds.push_back(most);
    descent.objective_errors.push_back(problem.objective_error(simulation.state().positions));
    descent.position_errors.push_back(problem.position_error(simulation.state().positions));
  }
  return descent;
}

Descent descend_by_newton(const Problem& problem, int repeats) {
  std::vector<std::vector<double>> seconds;  // of each iteration, in each repeat
  Descent descent;
  for (int repeat = 0; repeat < repeats; ++repeat) {
    Newton newton(problem.model);
    Positions q = problem.step.predicted;
    for (std::size_t i = 0; i < static_cast<std::size_t>(most_newton_iterations) && newton.iterate(problem.step, q);
         ++i) {
      if (repeat == 0) {
        descent.iterations.push_back(static_cast<int>(i) + 1);
        descent.objective_errors.push_back(problem.objective_error(q));
        descent.position_errors.push_back(problem.position_error(q));
        seconds.emplace_back();
      }
      seconds[i].push_back(newton.times().iterations());
    }
  }
  for (const std::vector<double>& each : seconds) {
    const auto [least, most] = std::ranges::minmax(each);
    descent.seconds.push_back(least);
    descent.most_seconds.push_back(most);
  }
  return descent;
}

}  // namespace pliant_experiments
