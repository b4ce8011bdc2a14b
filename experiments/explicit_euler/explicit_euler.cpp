#include "explicit_euler/explicit_euler.h"

#include <cmath>

#include <fmt/format.h>

#include "support/claims.h"
#include "support/mass_spring.h"
#include "support/trace.h"

namespace pliant_experiments {
namespace {

using pliant::Positions;
using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Table;

/// A disturbance and how fast it grows.
struct Growth {
  double time_step = 0;       // [s]
  double rate = 0;            // of the speed, by e-folds [1/s]
  double seconds = 0;         // simulated
  double implicit_ratio = 0;  // largest speed of implicit Euler over the first
};

constexpr double disturbance = 1e-6;  // [m/s]
constexpr double most_growth = 1e6;   // of the speed; then it is known well enough

/// In the plane of the curtain, in which its equilibrium is a minimum; out of it springs that are pressed buckle.
Positions disturbed_velocities(pliant::Index count) {
  Positions v(count, 3);
  for (pliant::Index i = 0; i < count; ++i) {
    const double n = i + 1.0;
    v.row(i) << disturbance * std::sin(12.9 * n * n), 0, disturbance * std::sin(3.1 * n * n + 2);
  }
  return v;
}

/// q ← q + h v, v ← v + h a(q), both from what was before, from an equilibrium under `loads`. Fits the growth to the
/// later half of the run, in which the fastest vibration is all that is seen.
Growth explicit_growth(const MassSpring& model, const Positions& equilibrium, double h, double seconds) {
  EulerStep step{h, equilibrium};
  const Positions loads = gradient(model, step, equilibrium);  // what gravity takes up
  Positions q = equilibrium;
  Positions v = disturbed_velocities(model.vertex_count());
  const double first = v.norm();
  std::vector<double> logarithms;
  for (double t = 0; t < seconds && v.norm() < most_growth * first; t += h) {
    step.predicted = q;  // without inertia: only the springs
    Positions force = loads - gradient(model, step, q);
    for (pliant::Index i = 0; i < model.vertex_count(); ++i) force.row(i) /= model.masses[static_cast<std::size_t>(i)];
    q += h * v;
    v += h * force;
    logarithms.push_back(std::log(v.norm()));
  }
  const std::size_t half = logarithms.size() / 2;
  const double rate = (logarithms.back() - logarithms[half]) / (h * static_cast<double>(logarithms.size() - 1 - half));
  return {h, rate, h * static_cast<double>(logarithms.size())};
}

/// Largest speed over the first, in as many seconds or 1000 steps of implicit Euler.
double implicit_ratio(const ExperimentContext& context, const Positions& equilibrium, double h, double seconds) {
  pliant::Scene scene = context.scene("explicit_euler/curtain", {fmt::format("settings.time_step={}", h)});
  scene.simulation.set_state(equilibrium, disturbed_velocities(scene.simulation.state().vertex_count()));
  const double first = scene.simulation.state().velocities.norm();
  double largest = 0;
  const auto steps = static_cast<std::int64_t>(std::min(1000.0, std::ceil(seconds / h)));
  for (std::int64_t i = 0; i < std::max<std::int64_t>(steps, 10); ++i) {
    context.step(scene);
    largest = std::max(largest, scene.simulation.state().velocities.norm());
  }
  return largest / first;
}

Plot growth_plot(const std::vector<Growth>& growths, double frequency) {
  Plot plot{.title = "Growth of a disturbance in explicit Euler",
            .caption =
                "How fast the speed grows, by e-folds a second, over the time step; dashed: ln(1 + h²ω²)/(2h) of the "
                "fastest vibration. There is no time step at which it does not grow; implicit Euler stays below the "
                "disturbance at all of them.",
            .x = {.label = "h [s]", .is_logarithmic = true},
            .y = {.label = "growth rate [1/s]", .is_logarithmic = true},
            .series = {}};
  pliant_report::Series measured{.name = "explicit Euler, measured", .mark = pliant_report::Mark::line_and_points};
  pliant_report::Series theory{.name = "fastest vibration, ln(1 + h²ω²)/(2h)", .is_dashed = true};
  for (const Growth& growth : growths) {
    measured.x.push_back(growth.time_step);
    measured.y.push_back(growth.rate);
    theory.x.push_back(growth.time_step);
    theory.y.push_back(std::log1p(std::pow(growth.time_step * frequency, 2)) / (2 * growth.time_step));
  }
  plot.series = {std::move(measured), std::move(theory)};
  return plot;
}

}  // namespace

Chapter run_explicit_euler(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question =
      "The same springs in explicit Euler, undamped: a curtain of 16 x 16 vertices of 1 kg hangs in equilibrium and is "
      "disturbed in its plane by speeds of 1e-6 m/s. How fast does the disturbance grow, over the time step?";
  pliant::Scene scene = context.scene("explicit_euler/curtain");
  context.say("equilibrium");
  settle(context, scene, 1e-8);
  const Positions equilibrium = scene.simulation.state().positions;
  const double frequency = scene.simulation.system_info().fastest_frequency;
  const MassSpring model = mass_spring(scene.simulation);
  std::vector<Growth> growths;
  Table table{fmt::format("Growth over the time step. The fastest vibration has ω = {:.0f} rad/s.", frequency),
              {"h [s]", "hω", "growth rate [1/s]", "doubles every [s]", "implicit Euler: largest speed / first"},
              {}};
  bool grows = true;
  bool implicit_stays = true;
  for (const double h : {1.0 / 60, 1e-2, 1e-3, 1e-4, 3e-5, 1e-5}) {
    context.say(fmt::format("explicit Euler, h = {:.0e} s", h));
    Growth growth = explicit_growth(model, equilibrium, h, 2);
    growth.implicit_ratio = implicit_ratio(context, equilibrium, h, growth.seconds);
    grows = grows && growth.rate > 0;
    implicit_stays = implicit_stays && growth.implicit_ratio <= 1 + 1e-6;
    table.rows.push_back({fmt::format("{:.2g}", h), fmt::format("{:.3g}", h * frequency),
                          fmt::format("{:.3g}", growth.rate), fmt::format("{:.2g}", std::log(2.0) / growth.rate),
                          fmt::format("{:.2g}", growth.implicit_ratio)});
    growths.push_back(growth);
  }
  chapter.claims.push_back(claim("Explicit Euler grows at every time step", "", grows,
                                 fmt::format("by {:.3g} e-folds a second at h = 1/60 s, still by {:.2g} at 1e-5 s",
                                             growths.front().rate, growths.back().rate)));
  chapter.claims.push_back(
      claim("Implicit Euler does not, from the same disturbance", "thesis, Sec. 6.1", implicit_stays,
            fmt::format("its largest speed is {:.2g} of the first at h = 1/60 s", growths.front().implicit_ratio)));
  chapter.blocks.emplace_back(growth_plot(growths, frequency));
  chapter.blocks.emplace_back(std::move(table));
  return chapter;
}

}  // namespace pliant_experiments
