#include "integrators/oscillator.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "pliant_io/recorder/measurements.h"

namespace pliant_experiments {
namespace {

/// Of the amplitude: half the logarithm of the energy.
double logarithm_of_amplitude(pliant::Simulation& simulation) {
  return std::log(measure(simulation, {}).total) / 2;
}

}  // namespace

const std::vector<Method>& methods() {
  using pliant::Integrator;
  static const std::vector<Method> list = {{"implicit Euler", Integrator::implicit_euler, 1, 0},
                                           {"implicit Euler, 2 substeps", Integrator::implicit_euler, 2, 1},
                                           {"implicit Euler, 4 substeps", Integrator::implicit_euler, 4, 2},
                                           {"BDF2", Integrator::bdf2, 1, 3}};
  return list;
}

const std::vector<Method>& projected_methods() {
  using pliant::Integrator;
  static const std::vector<Method> list = {{"implicit Euler, energy projection", Integrator::implicit_euler, 1, 5, 1},
                                           {"BDF2, energy projection", Integrator::bdf2, 1, 6, 1}};
  return list;
}

pliant::Scene oscillator(const ExperimentContext& context, const Method& method, double time_step, double damping) {
  pliant::Scene scene = context.scene("integrators/oscillator");
  pliant::SolverSettings settings = scene.simulation.settings();
  settings.time_step = time_step;
  settings.integrator = method.integrator;
  settings.substeps = method.substeps;
  settings.damping = damping;
  settings.energy_projection = method.energy_projection;
  scene.simulation.set_settings(settings);
  return scene;
}

double extension(const pliant::Simulation& simulation) {
  return (simulation.state().positions.row(1) - simulation.state().positions.row(0)).norm() - 1;
}

double loss_a_period(const ExperimentContext& context, const Method& method, double h_omega) {
  pliant::Scene scene = oscillator(context, method, h_omega / oscillator_omega);
  const double steps_a_period = 2 * std::numbers::pi / h_omega;
  const auto period = static_cast<std::int64_t>(std::ceil(steps_a_period));
  context.step(scene, std::max<std::int64_t>(period, 5));  // the first step is one of implicit Euler in any method
  const double begin = logarithm_of_amplitude(scene.simulation);
  double last = begin;
  std::int64_t steps = 0;
  constexpr double enough = 10;  // e-folds, before rounding is all that is left
  while (steps < 10 * period && begin - last < enough) {
    context.step(scene);
    last = logarithm_of_amplitude(scene.simulation);
    ++steps;
  }
  return 1 - std::exp((last - begin) * steps_a_period / static_cast<double>(steps));
}

double error_of(const ExperimentContext& context, const Method& method, int steps) {
  pliant::Scene scene = oscillator(context, method, 1.0 / steps);
  double sum = 0;
  for (int i = 1; i <= 2 * steps; ++i) {
    context.step(scene);
    const double exact = oscillator_amplitude * std::cos(oscillator_omega * i / steps);
    sum += std::pow(extension(scene.simulation) - exact, 2);
  }
  return std::sqrt(sum / (2 * steps));
}

double largest_extension(const ExperimentContext& context, const Method& method, double h_omega) {
  pliant::Scene scene = oscillator(context, method, h_omega / oscillator_omega);
  double largest = 0;
  for (int i = 0; i < 2000; ++i) {
    context.step(scene);
    largest = std::max(largest, std::abs(extension(scene.simulation)));
  }
  return largest / oscillator_amplitude;
}

double decay_rate(const ExperimentContext& context, const Method& method, double time_step, double damping) {
  pliant::Scene scene = oscillator(context, method, time_step, damping);
  const auto a_second = static_cast<std::int64_t>(std::llround(1 / time_step));
  // Mean over a period: the energy of a discrete oscillation goes up and down with its phase.
  const auto mean_of_next_period = [&] {
    double sum = 0;
    for (std::int64_t i = 0; i < a_second; ++i) {
      context.step(scene);
      sum += logarithm_of_amplitude(scene.simulation);
    }
    return sum / static_cast<double>(a_second);
  };
  const double begin = mean_of_next_period();
  context.step(scene, 2 * a_second);
  return (begin - mean_of_next_period()) / 3;
}

}  // namespace pliant_experiments
