#include "contact/contact_convergence.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "contact/sheet_on_plane.h"
#include "support/claims.h"

namespace pliant_experiments {
namespace {

using pliant::Acceleration;
using pliant::Index;
using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Table;

constexpr Index most_shown = 320;  // iterations
constexpr Index until_converged = 4000;
constexpr std::array<Index, 6> few = {5, 10, 20, 40, 80, 160};

/// Friction's load is refreshed within a step, which makes the objective another one; without friction it stays.
pliant::Scene cloth_at_sphere(Acceleration acceleration, Index iterations) {
  pliant::SolverSettings settings = contact_settings(contact_methods().front());
  settings.acceleration = acceleration;
  settings.iterations = iterations;
  pliant::Scene scene = sheet_scene(settings, {.side = 40, .center = {0.02, 0.01, 0.32}});
  scene.simulation.add(pliant::SphereCollider{.radius = 0.3, .friction = 0.0});
  return scene;
}

/// Objectives before each solve of a step from `begin`, and after the last one [J].
std::vector<double> descend(const ExperimentContext& context, const pliant::State& begin, Acceleration acceleration,
                            Index iterations) {
  pliant::Scene scene = cloth_at_sphere(acceleration, iterations);
  scene.simulation.restore(begin);
  context.step(scene);
  const std::span<const double> history = scene.simulation.objective_history();
  std::vector<double> energies(history.begin(), history.end());
  energies.push_back(scene.simulation.evaluate().objective());
  return energies;
}

}  // namespace

void measure_contact_convergence(const ExperimentContext& context, Chapter& chapter) {
  context.say("convergence of a step");
  pliant::Scene falling = cloth_at_sphere(Acceleration::lbfgs, 50);
  context.step(falling, 11);
  const pliant::State begin = falling.simulation.state();
  const Index contacts = context.step(falling).contact.contacts;
  const std::vector<double> converged = descend(context, begin, Acceleration::lbfgs, until_converged);
  const double best = *std::ranges::min_element(converged);
  const double first = converged.front();
  const auto share = [&](double energy) { return (energy - best) / (first - best); };
  Plot plot{
      .title = "Convergence of a step with contact",
      .caption = fmt::format("A cloth of 40 x 40 vertices hits a sphere, {} of them touch it: what is left of the "
                             "objective's way to its least value E*, by iterations of one step. E* is what "
                             "{} iterations of L-BFGS reach.",
                             contacts, until_converged),
      .x = {.label = "iterations"},
      .y = {.label = "(E − E*) / (E₀ − E*)", .is_logarithmic = true},
      .series = {}};
  Table table{"What is left of the objective's way after steps of so many iterations.",
              {"iterations", "none", "lbfgs", "ratio"},
              {}};
  std::map<Acceleration, std::map<Index, double>> left;
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::lbfgs}) {
    const std::vector<double> energies = descend(context, begin, acceleration, most_shown);
    pliant_report::Series series{.name = acceleration == Acceleration::none ? "none" : "lbfgs"};
    for (std::size_t i = 0; i < energies.size(); ++i) {
      series.x.push_back(static_cast<double>(i));
      series.y.push_back(share(energies[i]));
    }
    plot.series.push_back(std::move(series));
    for (const Index count : few)
      left[acceleration][count] = share(descend(context, begin, acceleration, count).back());
  }
  for (const Index count : few) {
    const double plain = left[Acceleration::none][count];
    const double quick = left[Acceleration::lbfgs][count];
    table.rows.push_back({std::to_string(count), fmt::format("{:.2e}", plain), fmt::format("{:.2e}", quick),
                          fmt::format("{:.1f}", plain / quick)});
  }
  const double plain = left[Acceleration::none][20];
  const double quick = left[Acceleration::lbfgs][20];
  chapter.claims.push_back(claim(
      "With contact 20 iterations of L-BFGS are at least 3 times nearer than 20 plain ones", "", plain >= 3 * quick,
      fmt::format("in objective {:.2e} against {:.2e} of the way left, {:.1f} times", quick, plain, plain / quick)));
  chapter.blocks.emplace_back(std::move(plot));
  chapter.blocks.emplace_back(std::move(table));
}

}  // namespace pliant_experiments
