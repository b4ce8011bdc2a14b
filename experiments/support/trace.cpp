#include "support/trace.h"

#include <numeric>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/topology.h"

namespace pliant_experiments {

void Trace::add(const pliant::Measurements& row) {
  frames.push_back(static_cast<double>(frames.size()));
  time.push_back(row.time);
  speed_sum.push_back(row.speed_sum);
  momentum.push_back(row.momentum.norm());
  kinetic.push_back(row.kinetic);
  elastic.push_back(std::accumulate(row.elastic.begin(), row.elastic.end(), 0.0));
  gravitational.push_back(row.gravitational);
  total.push_back(row.total);
}

Trace record(const ExperimentContext& context, pliant::Scene& scene, std::int64_t steps) {
  Trace trace;
  trace.add(measure(scene.simulation, {}));
  for (std::int64_t i = 0; i < steps; ++i) {
    const pliant::StepReport report = context.step(scene);
    trace.add(measure(scene.simulation, report));
  }
  return trace;
}

double mean(const std::vector<double>& values, std::size_t begin, std::size_t end) {
  if (end > values.size() || begin >= end) return std::numeric_limits<double>::quiet_NaN();
  return std::accumulate(values.begin() + static_cast<std::ptrdiff_t>(begin),
                         values.begin() + static_cast<std::ptrdiff_t>(end), 0.0) /
         static_cast<double>(end - begin);
}

void settle(const ExperimentContext& context, pliant::Scene& scene, double tolerance) {
  pliant::Simulation& simulation = scene.simulation;
  const pliant::SolverSettings given = simulation.settings();
  pliant::State begin = simulation.state();
  pliant::SolverSettings settings = given;
  settings.time_step = 100;
  settings.iterations = 2000;
  settings.tolerance = tolerance / 2;
  settings.start = pliant::Start::positions;
  settings.precision = pliant::Precision::double_;
  simulation.set_settings(settings);
  constexpr int most_steps = 1000;
  bool is_at_rest = false;
  const auto fail_unless_at_rest = [&] {
    if (is_at_rest) return;
    throw pliant::Error(pliant::ErrorKind::diverged, fmt::format("{}: found no equilibrium", scene.name));
  };
  for (int i = 0; i < most_steps && !is_at_rest; ++i) {
    context.step(scene);
    is_at_rest = simulation.evaluate().residual <= tolerance;  // inertia has no part in it: m/h² is next to nothing
    simulation.set_state(simulation.state().positions, pliant::Positions::Zero(simulation.state().vertex_count(), 3));
  }
  fail_unless_at_rest();
  // Large steps leave what their rounding is, about 1e-16 of the largest position times the stiffness: small ones,
  // whose starts damp them strongly, take it away.
  constexpr int small_steps = 4000;
  settings.time_step = 1.0 / 60;
  settings.iterations = 5;
  settings.tolerance = 0;
  simulation.set_settings(settings);
  context.step(scene, small_steps);
  is_at_rest = simulation.evaluate().residual <= tolerance;
  fail_unless_at_rest();
  begin.positions = simulation.state().positions;
  begin.velocities.setZero();
  simulation.set_settings(given);
  simulation.restore(begin);
}

double largest_stretch(const pliant::Simulation& simulation) {
  double largest = 0;
  for (const pliant::Body& body : simulation.bodies()) {
    const pliant::Positions& rest = body.mesh.vertices;
    const auto place = [&](pliant::Index v) {
      return pliant::row(simulation.state().positions, body.first_vertex + v);
    };
    for (const pliant::Edge& edge : pliant::unique_edges(body.mesh)) {
      const double length = (place(edge[1]) - place(edge[0])).norm();
      largest = std::max(largest, length / (pliant::row(rest, edge[1]) - pliant::row(rest, edge[0])).norm() - 1);
    }
  }
  return largest;
}

}  // namespace pliant_experiments
