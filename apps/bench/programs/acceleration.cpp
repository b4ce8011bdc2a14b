// How near a step comes to where it converges, over iterations and over time: plain and with each acceleration, from
// the same state, one thread. Errors are of the objective, as shares of what a step begins with, and of positions.
//
//     bench_acceleration [repeats [scene...]]
#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pliant/pliant.h"
#include "pliant_io/pliant_io.h"
#include "pliant_io/scene/builtin_scenes.h"

namespace {

using namespace pliant;

constexpr Index iterations_to_the_end = 3000;
constexpr std::array<Index, 8> iteration_counts = {1, 3, 5, 10, 20, 40, 80, 300};

/// A bump of 1 m/s across the sheet, half its side wide, at its middle.
void push_middle(Simulation& simulation) {
  const Positions& x = simulation.state().positions;
  const Vec3 center = x.colwise().mean().transpose();
  Positions velocities = Positions::Zero(x.rows(), 3);
  for (Index i = 0; i < static_cast<Index>(x.rows()); ++i) {
    const Real distance = (row(x, i) - center).norm() / 0.25;
    if (distance < 1) velocities(i, 1) = (1 - distance * distance) * (1 - distance * distance);
  }
  simulation.set_state(x, velocities);
}

/// Hangs until it is nearly at rest.
void settle(Simulation& simulation, int steps) {
  const SolverSettings settings = simulation.settings();
  SolverSettings settling = settings;
  settling.acceleration = Acceleration::lbfgs;
  settling.iterations = 30;
  settling.damping = 3;
  simulation.set_settings(settling);
  for (int i = 0; i < steps; ++i) simulation.step();
  simulation.set_settings(settings);
}

/// W5 of the standard workloads, W2 with springs in its place: hung by two corners, settled, pushed.
Simulation cloth(Index n, bool is_strain) {
  Simulation simulation({.threads = 1});
  const BodyId body = simulation.add_body(grid({.columns = n, .rows = n, .size = {1, 1}}),
                                          is_strain ? Mass::area_density(0.2) : Mass::per_vertex(1));
  simulation.add(Gravity{});
  if (is_strain) {
    simulation.add(body, TriangleStrain{.stiffness = 1e3});
    simulation.add(body, HingeBending{.stiffness = 1e-5});
  } else {
    simulation.add(body, EdgeSpring{.stiffness = 1e3});
  }
  simulation.add(body, Position{.on = {n * n - n, n * n - 1}});
  settle(simulation, 600);
  push_middle(simulation);
  return simulation;
}

/// From a level start, a third of a second into its swing.
Simulation swinging_chain() {
  Simulation simulation({.threads = 1});
  const BodyId body =
      simulation.add_body(chain({.links = 200, .length = 2, .direction = {1, 0, 0}}), Mass::per_vertex(0.01));
  simulation.add(Gravity{});
  simulation.add(body, EdgeSpring{.stiffness = 1e4});
  simulation.add(body, Position{.on = {0}});
  for (int i = 0; i < 20; ++i) simulation.step();
  return simulation;
}

Simulation falling_bar() {
  Simulation simulation({.threads = 1});
  const BodyId body = simulation.add_body(bar({.cells = {40, 10, 10}, .size = {4, 1, 1}, .cut = TetrahedronCut::five}),
                                          Mass::per_vertex(1));
  simulation.add(Gravity{});
  simulation.add(body, TetrahedronStrain{.stiffness = 1e5});
  std::vector<Index> end;
  const Positions& x = simulation.state().positions;
  for (Index i = 0; i < static_cast<Index>(x.rows()); ++i) {
    if (x(i, 0) == 0) end.push_back(i);
  }
  simulation.add(body, Position{.on = end});
  for (int i = 0; i < 20; ++i) simulation.step();
  return simulation;
}

Simulation builtin(std::string_view name, int steps) {
  for (const BuiltinScene& candidate : builtin_scenes()) {
    if (candidate.name != name) continue;
    Scene scene = parse_scene(candidate.text, ".", name);
    for (int i = 0; i < steps; ++i) scene.step();
    SolverSettings settings = scene.simulation.settings();
    settings.threads = 1;
    settings.energy_projection = 0;
    settings.substeps = 1;
    settings.tolerance = 0;
    scene.simulation.set_settings(settings);
    return std::move(scene.simulation);
  }
  fail_input("there is no scene " + std::string(name));
}

struct Ending {
  Real objective = 0;
  Positions positions;
  double seconds = 0;
};

Ending step_from(Simulation& simulation, const State& start, Acceleration acceleration, Index iterations) {
  SolverSettings settings = simulation.settings();
  settings.acceleration = acceleration;
  settings.iterations = iterations;
  simulation.set_settings(settings);
  simulation.restore(start);
  const StepReport report = simulation.step();
  return {simulation.evaluate().objective(), simulation.state().positions, report.seconds_total};
}

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

constexpr std::array<std::pair<const char*, Acceleration>, 4> methods = {{{"plain", Acceleration::none},
                                                                          {"lbfgs", Acceleration::lbfgs},
                                                                          {"anderson", Acceleration::anderson},
                                                                          {"chebyshev", Acceleration::chebyshev}}};

/// Methods take turns.
void compare(std::string_view name, Simulation& simulation, int repeats) {
  const State start = simulation.state();
  const Ending plain_end = step_from(simulation, start, Acceleration::none, iterations_to_the_end);
  const Ending end = step_from(simulation, start, Acceleration::lbfgs, iterations_to_the_end);
  const Real lowest = std::min(plain_end.objective, end.objective);
  const Real first = simulation.objective_history().front();
  const Real resolution = 1e-15 * lowest;
  fmt::print("\n{}: {} vertices; E from {:.6g} to {:.10g} J, plain {:.2g} of that above it after {} iterations\n", name,
             start.vertex_count(), first, lowest, (plain_end.objective - lowest) / (first - lowest),
             iterations_to_the_end);
  fmt::print("{:>10} {:>10} {:>10} {:>10} {:>10} {:>8}\n", "iterations", "", "E", "x", "ms", "ratio");
  for (const Index iterations : iteration_counts) {
    std::array<std::vector<double>, methods.size()> seconds;
    std::array<Ending, methods.size()> found;
    for (int i = 0; i < repeats; ++i) {
      for (std::size_t m = 0; m < methods.size(); ++m) {
        found[m] = step_from(simulation, start, methods[m].second, iterations);
        seconds[m].push_back(found[m].seconds);
      }
    }
    for (std::size_t m = 0; m < methods.size(); ++m) {
      const Real objective = std::max(found[m].objective - lowest, resolution) / (first - lowest);
      const Real distance = std::max(1e-15, (found[m].positions - end.positions).rowwise().norm().maxCoeff());
      fmt::print("{:>10} {:>10} {:10.2e} {:10.2e} {:10.3f} {:8.2f}\n", iterations, methods[m].first, objective,
                 distance, 1e3 * median(seconds[m]), median(seconds[m]) / median(seconds[0]));
    }
  }
}

}  // namespace

int main(int count, char** arguments) {
  const std::vector<std::string> words(arguments + 1, arguments + count);
  const int repeats = words.empty() ? 5 : std::stoi(words[0]);
  const std::vector<std::pair<std::string, Simulation (*)()>> scenarios = {
      {"W5", [] { return cloth(100, true); }},
      {"W2", [] { return cloth(100, false); }},
      {"curtain", [] { return builtin("curtain", 60); }},
      {"flag", [] { return builtin("flag", 120); }},
      {"pillow", [] { return builtin("pillow", 20); }},
      {"bar", falling_bar},
      {"chain", swinging_chain}};
  for (const auto& [name, make] : scenarios) {
    if (words.size() < 2 || std::find(words.begin() + 1, words.end(), name) != words.end()) {
      Simulation simulation = make();
      compare(name, simulation, repeats);
    }
  }
}
