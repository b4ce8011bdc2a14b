#include "iterations/strip.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"
#include "support/statistics.h"

namespace pliant_experiments {
namespace {

using namespace pliant;

constexpr int newton_limit = 200;
constexpr double resting_move = 1e-11;  // [m], of every vertex
constexpr double long_step = 1;         // [s]
constexpr int most_long_steps = 1000;

}  // namespace

Scene strip(const ExperimentContext& context, double stiffness) {
  Scene scene =
      context.scene("iterations/strip", {fmt::format("bodies[strip].constraints[springs].stiffness={}", stiffness)});
  context.disturb(scene);
  // In its plane: springs make what they stretch narrower, which a sheet without bending yields to by waves.
  Positions positions = scene.simulation.state().positions;
  const Positions velocities = scene.simulation.state().velocities;
  positions.col(1) = scene.simulation.bodies().front().mesh.vertices.col(1);
  scene.simulation.set_state(positions, velocities);
  return scene;
}

double stretch(const Scene& rest, const Positions& positions) {
  const Positions& at_rest = rest.simulation.bodies().front().mesh.vertices;
  const double lowest = at_rest.col(2).minCoeff();
  double sum = 0;
  int count = 0;
  for (Index i = 0; i < at_rest.rows(); ++i) {
    if (at_rest(i, 2) > lowest) continue;
    sum += at_rest(i, 2) - positions(i, 2);
    ++count;
  }
  return sum / count / (at_rest.col(2).maxCoeff() - lowest);
}

Mover by_projective_dynamics(const ExperimentContext& context, double stiffness, int iterations, Start start) {
  const auto scene = std::make_shared<Scene>(strip(context, stiffness));
  SolverSettings settings = scene->simulation.settings();
  settings.iterations = iterations;
  settings.start = start;
  scene->simulation.set_settings(settings);
  return [scene, &context]() -> const Positions& {
    context.step(*scene);
    return scene->simulation.state().positions;
  };
}

Mover by_position_based_dynamics(const ExperimentContext& context, double stiffness, const XpbdOptions& options) {
  const auto xpbd = std::make_shared<Xpbd>(strip(context, stiffness).simulation, options);
  return [xpbd]() -> const Positions& {
    xpbd->step();
    return xpbd->positions();
  };
}

Mover by_newton(const ExperimentContext& context, double stiffness) {
  const auto scene = std::make_shared<Scene>(strip(context, stiffness));
  const auto newton = std::make_shared<Newton>(mass_spring(scene->simulation));
  const MassSpring model = mass_spring(scene->simulation);
  return [scene, newton, model]() -> const Positions& {
    Simulation& simulation = scene->simulation;
    const EulerStep step = next_step(simulation, model);
    const Positions before = simulation.state().positions;
    Positions q = step.predicted;
    newton->minimize(step, q, newton_limit);
    simulation.set_state(q, (q - before) / step.time_step);
    return simulation.state().positions;
  };
}

double stretch_at_rest(const ExperimentContext& context, double stiffness) {
  Scene scene = strip(context, stiffness);
  Simulation& simulation = scene.simulation;
  SolverSettings settings = simulation.settings();
  settings.time_step = long_step;
  simulation.set_settings(settings);
  const MassSpring model = mass_spring(simulation);
  Newton newton(model);
  const Positions still = Positions::Zero(simulation.state().positions.rows(), 3);
  for (int i = 0; i < most_long_steps; ++i) {
    const Positions before = simulation.state().positions;
    Positions q = before;
    newton.minimize(next_step(simulation, model), q, newton_limit);
    simulation.set_state(q, still);
    if ((q - before).cwiseAbs().maxCoeff() < resting_move) return stretch(scene, q);
  }
  throw Error(ErrorKind::diverged, fmt::format("{}: not at rest after {} steps", scene.place(), most_long_steps));
}

double Fall::last_mean(int count) const {
  return std::accumulate(stretch.end() - count, stretch.end(), 0.) / count;
}

Fall fall(const Scene& rest, const Mover& mover, int steps) {
  Fall result{{stretch(rest, rest.simulation.state().positions)}};
  std::vector<double> seconds;
  for (int i = 0; i < steps; ++i) {
    const Stopwatch watch;
    const Positions& positions = mover();
    seconds.push_back(watch.seconds());
    result.stretch.push_back(stretch(rest, positions));
    if (i + 1 == steps) result.last = positions;
  }
  result.seconds = median(std::move(seconds));
  return result;
}

}  // namespace pliant_experiments
