// What elastic materials with energies of their own cost beside projections: iterations and time until a step is near
// its end, from the same moment of a bar that is clamped at one end and falls, one thread.
//
//     bench_elastic [repeats [cells across]]
#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "pliant/pliant.h"

namespace {

using namespace pliant;

constexpr Index iterations_to_the_end = 5000;
constexpr std::array<Real, 3> errors = {1e-2, 1e-4, 1e-6};
constexpr Real youngs_modulus = 1e5;

struct Material {
  std::string name;
  Real poisson_ratio;
  void (*add)(Simulation& simulation, BodyId body, Real poisson_ratio);
};

/// Young's modulus and Poisson's ratio of small strains as two projections.
void add_projections(Simulation& simulation, BodyId body, Real nu) {
  const Real strain = youngs_modulus / (1 + nu);
  simulation.add(body, TetrahedronStrain{.stiffness = strain});
  if (nu > 0) simulation.add(body, TetrahedronVolume{.stiffness = 3 * strain * nu / (1 - 2 * nu)});
}
template <class Type>
void add_elastic(Simulation& simulation, BodyId body, Real nu) {
  simulation.add(body, Type{.stiffness = youngs_modulus, .poisson_ratio = nu});
}

Simulation falling_bar(const Material& material, Index cells) {
  Simulation simulation({.iterations = 100, .acceleration = Acceleration::lbfgs, .threads = 1});
  const BodyId body =
      simulation.add_body(bar({.cells = {4 * cells, cells, cells}, .size = {0.8, 0.2, 0.2}}), Mass::density(1000));
  simulation.add(Gravity{});
  material.add(simulation, body, material.poisson_ratio);
  std::vector<Index> end;
  const Positions& x = simulation.state().positions;
  for (Index i = 0; i < static_cast<Index>(x.rows()); ++i) {
    if (x(i, 0) == 0) end.push_back(i);
  }
  simulation.add(body, Position{.on = end});
  for (int i = 0; i < 12; ++i) simulation.step();
  return simulation;
}

struct Ending {
  Positions positions;
  double seconds = 0;
};

Ending step_from(Simulation& simulation, const State& start, Index iterations) {
  SolverSettings settings = simulation.settings();
  settings.iterations = iterations;
  simulation.set_settings(settings);
  simulation.restore(start);
  const StepReport report = simulation.step();
  return {simulation.state().positions, report.seconds_local + report.seconds_global};
}

double median_seconds(Simulation& simulation, const State& start, Index iterations, int repeats) {
  std::vector<double> seconds;
  for (int i = 0; i < repeats; ++i) seconds.push_back(step_from(simulation, start, iterations).seconds);
  std::ranges::sort(seconds);
  return seconds[seconds.size() / 2];
}

void measure(const Material& material, Index cells, int repeats) {
  Simulation simulation = falling_bar(material, cells);
  const State start = simulation.state();
  const Positions end = step_from(simulation, start, iterations_to_the_end).positions;
  const Real way = (start.positions - end).norm();
  fmt::print("{:<22} {:>5}", material.name, material.poisson_ratio);
  Index iterations = 1;
  for (const Real error : errors) {
    while ((step_from(simulation, start, iterations).positions - end).norm() > error * way) ++iterations;
    fmt::print(" {:>8} {:>8.2f}", iterations, 1e3 * median_seconds(simulation, start, iterations, repeats));
  }
  fmt::print("\n");
}

}  // namespace

int main(int count, char** arguments) {
  const int repeats = count > 1 ? std::stoi(arguments[1]) : 9;
  const Index cells = count > 2 ? std::stoi(arguments[2]) : 4;
  fmt::print("{:<22} {:>5} {:>17} {:>17} {:>17}\n", "iterations and ms to", "ν", "1e-2", "1e-4", "1e-6");
  measure({"projections", 0, add_projections}, cells, repeats);
  for (const Real nu : {0.0, 0.3, 0.45, 0.49}) {
    if (nu > 0) measure({"projections", nu, add_projections}, cells, repeats);
    measure({"Neo-Hookean", nu, add_elastic<TetrahedronNeoHookean>}, cells, repeats);
    measure({"St. Venant-Kirchhoff", nu, add_elastic<TetrahedronStvk>}, cells, repeats);
  }
}
