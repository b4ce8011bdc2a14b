#include "wind/wind.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/forces/wind.h"
#include "support/claims.h"
#include "support/trace.h"

namespace pliant_experiments {
namespace {

using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Table;

constexpr std::array<double, 3> time_steps = {1.0 / 60, 1, 8};
constexpr std::array<const char*, 3> time_step_names = {"1/60 s", "1 s", "8 s"};
constexpr std::int64_t steps = 300;
/// W a / (k L) is the wind's force on a cell over that of an edge that is stretched by its own length: a and L are the
/// area and the edge of a cell.
constexpr double cell_area = 0.01;   // [m²]
constexpr double edge_length = 0.1;  // [m]
constexpr double stiffness = 5e4;    // [N/m]

double ratio(double wind) {
  return wind * cell_area / (stiffness * edge_length);
}

struct StrongWind {
  std::vector<double> stretch;               // largest, after each step
  std::optional<std::int64_t> refused_step;  // whose positions would not be finite
  double largest() const { return *std::max_element(stretch.begin(), stretch.end()); }
};

pliant::Scene scene_of(const ExperimentContext& context, double wind, double time_step, const char* area) {
  pliant::Scene scene = context.scene(
      "wind/curtain", {fmt::format("forces[gale].velocity=[0,{},{}]", wind, 0.3 * wind),
                       fmt::format("settings.time_step={}", time_step), fmt::format("forces[gale].area={}", area)});
  context.disturb(scene);
  return scene;
}

StrongWind blow(const ExperimentContext& context, pliant::Scene scene, std::int64_t count) {
  StrongWind gale{{1}, {}};
  for (std::int64_t i = 1; i <= count; ++i) {
    try {
      context.step(scene);
    } catch (const pliant::Error& error) {
      if (error.kind() != pliant::ErrorKind::diverged) throw;
      gale.refused_step = i;
      return gale;
    }
    gale.stretch.push_back(1 + largest_stretch(scene.simulation));
  }
  return gale;
}

/// How a rising wind comes.
struct Rise {
  const char* name;
  std::int64_t steps = 20;       // in which it grows by a hundredth
  pliant::Index iterations = 5;  // a step
};

constexpr std::array<Rise, 3> rises = {{{"rises by 1 % every 20 steps"},
                                        {.name = "rises by 1 % every 100 steps", .steps = 100},
                                        {.name = "rises by 1 % every 20 steps, 50 iterations", .iterations = 50}}};

/// The strongest of a rising wind that the curtain still stands [N/m²].
double limit_of_rise(const ExperimentContext& context, double time_step, const Rise& rise) {
  double wind = 1e5;
  pliant::Scene scene = scene_of(context, wind, time_step, "current");
  pliant::SolverSettings settings = scene.simulation.settings();
  settings.iterations = rise.iterations;
  scene.simulation.set_settings(settings);
  const pliant::ForceId gale = scene.simulation.find_force("gale").value();
  for (;; wind *= 1.01) {
    pliant::Wind options = *scene.simulation.options<pliant::Wind>(gale);
    options.velocity = {0, wind, 0.3 * wind};
    scene.simulation.replace(gale, options);
    try {
      context.step(scene, rise.steps);
    } catch (const pliant::Error& error) {
      if (error.kind() != pliant::ErrorKind::diverged) throw;
      return wind / 1.01;
    }
  }
}

/// The same for a wind that sets in at once and blows for 1000 steps, to two parts in a thousand [N/m²].
double limit_of_gust(const ExperimentContext& context, double time_step) {
  double holds = 1e5;
  double overflows = 1e6;
  while (overflows > 1.002 * holds) {
    const double wind = std::sqrt(holds * overflows);
    (blow(context, scene_of(context, wind, time_step, "current"), 1000).refused_step ? overflows : holds) = wind;
  }
  return holds;
}

Plot stretch_plot(const ExperimentContext& context, double limit) {
  Plot plot{.title = "Largest stretch of an edge",
            .caption =
                "Largest stretch in 300 steps over the wind, as W a/(k L), the wind's force on a cell over that of an "
                "edge stretched to its double. The printed force grows with the square of the stretch, that of the "
                "edges with the stretch: past the dashed line a wind that rises by 1 % every 20 "
                "steps of 1/60 s ends the curtain. Where only two "
                "curves are seen, those of 1 s and 8 s coincide.",
            .x = {.label = "wind W a/(k L)", .is_logarithmic = true},
            .y = {.label = "length / rest length"},
            .series = {},
            .guides = {{ratio(limit), "limit of a rising wind", true}}};
  for (std::size_t i = 0; i < time_steps.size(); ++i) {
    pliant_report::Series series{.name = fmt::format("h = {}", time_step_names[i]),
                                 .mark = pliant_report::Mark::line_and_points};
    for (const double wind : {1e3, 3e3, 1e4, 3e4, 1e5, 2e5, 3e5, 4e5}) {
      const StrongWind gale = blow(context, scene_of(context, wind, time_steps[i], "current"), steps);
      series.x.push_back(ratio(wind));
      series.y.push_back(gale.refused_step ? std::nan("") : gale.largest());
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

void compare_stretch(const ExperimentContext& context, Chapter& chapter) {
  const std::array<std::pair<double, std::array<double, 3>>, 2> known = {
      {{1e3, {1.34, 1.94, 1.98}}, {1e4, {2.28, 2.04, 2.05}}}};
  Comparison comparison(0.1);
  bool is_intact = true;
  double largest = 0;
  for (const auto& [wind, stretches] : known) {
    for (std::size_t i = 0; i < time_steps.size(); ++i) {
      context.say(fmt::format("W = {:.0e}, h = {}", wind, time_step_names[i]));
      const StrongWind gale = blow(context, scene_of(context, wind, time_steps[i], "current"), steps);
      is_intact = is_intact && !gale.refused_step;
      largest = std::max(largest, gale.largest());
      comparison.add(fmt::format("W = {:.0e} N/m², h = {}", wind, time_step_names[i]), gale.largest(), stretches[i]);
    }
  }
  chapter.claims.push_back(claim("Meshes stay intact under extreme wind and with large time steps", "thesis, Sec. 6.1",
                                 is_intact,
                                 fmt::format("W of 1e3 and 1e4 N/m², h of 1/60, 1 and 8 s, 300 steps: no edge is ever "
                                             "longer than {:.2f} times its rest length",
                                             largest)));
  chapter.claims.push_back(comparison.claim("The largest stretch is that of an independent solver, within 10 %"));
  chapter.blocks.emplace_back(comparison.table("Largest stretch of an edge in 300 steps."));
}

/// What a time step makes of winds that are too strong.
struct Limits {
  std::array<double, rises.size()> rise{};  // the strongest of rising winds that the curtain stands [N/m²]
  double gust = 0;                          // of one that sets in at once
  StrongWind overflow;                      // 1e6 N/m² on the current area
  StrongWind at_rest;                       // 1e6 N/m² on the area at rest
  StrongWind far_beyond;                    // 1e9 N/m² on the area at rest

  bool is_bounded() const { return !at_rest.refused_step && !far_beyond.refused_step; }
};

Limits find_limits(const ExperimentContext& context, std::size_t i) {
  context.say(fmt::format("limit at h = {}", time_step_names[i]));
  const double h = time_steps[i];
  Limits limits{.gust = limit_of_gust(context, h),
                .overflow = blow(context, scene_of(context, 1e6, h, "current"), steps),
                .at_rest = blow(context, scene_of(context, 1e6, h, "rest"), steps),
                .far_beyond = blow(context, scene_of(context, 1e9, h, "rest"), steps)};
  for (std::size_t k = 0; k < rises.size(); ++k) limits.rise[k] = limit_of_rise(context, h, rises[k]);
  return limits;
}

std::string step_text(const StrongWind& gale) {
  return gale.refused_step ? std::to_string(*gale.refused_step) : "none";
}

std::string stretch_text(const StrongWind& gale) {
  return gale.refused_step ? "refused" : fmt::format("{:.3g}", gale.largest());
}

void judge_limits(Chapter& chapter, const std::array<Limits, 3>& found) {
  chapter.claims.push_back(
      claim("The animation is unconditionally stable", "thesis, Sec. 6.1",
            std::ranges::none_of(found, [](const Limits& limits) { return limits.overflow.refused_step.has_value(); }),
            fmt::format("in the printed wind of 1e6 N/m² the positions overflow, and a step is refused with a message: "
                        "at h = 1/60, 1 and 8 s steps {}, {} and {}",
                        step_text(found[0].overflow), step_text(found[1].overflow), step_text(found[2].overflow))));
  std::vector<double> limits;
  for (const Limits& each : found) {
    limits.push_back(ratio(each.gust));
    for (const double rise : each.rise) limits.push_back(ratio(rise));
  }
  const auto [least, most] = std::ranges::minmax(limits);
  chapter.claims.push_back(reported(
      "Past some wind the printed force has no equilibrium; where, depends on how the wind comes", "",
      fmt::format("W a/(k L) of {:.2f} to {:.2f} in {} set-ups of this curtain (table below). The force grows with the "
                  "stretch squared, that of the edges with the stretch: past a limit overflow is the exact answer",
                  least, most, limits.size())));
  chapter.claims.push_back(claim(
      "Wind on the area at rest makes nothing overflow", "", std::ranges::all_of(found, &Limits::is_bounded),
      fmt::format("largest stretch in 300 steps of 8 s: {} times the rest length in 1e6 N/m², {} times in 1e9 N/m²",
                  stretch_text(found[2].at_rest), stretch_text(found[2].far_beyond))));
}

void measure_limits(const ExperimentContext& context, Chapter& chapter) {
  const std::array<Limits, 3> found = {find_limits(context, 0), find_limits(context, 1), find_limits(context, 2)};
  judge_limits(chapter, found);
  Table limits{"Limits of the wind as the thesis prints it, as W a/(k L), by how it comes and by the time step.",
               {"the wind"},
               {}};
  for (const char* name : time_step_names) limits.columns.push_back(fmt::format("h = {}", name));
  for (std::size_t k = 0; k < rises.size(); ++k) {
    limits.rows.push_back({rises[k].name});
    for (const Limits& each : found) limits.rows.back().push_back(fmt::format("{:.3f}", ratio(each.rise[k])));
  }
  limits.rows.push_back({"sets in at once, 1000 steps"});
  for (const Limits& each : found) limits.rows.back().push_back(fmt::format("{:.3f}", ratio(each.gust)));
  Table table{
      "At which step the printed wind of 1e6 N/m² is refused, and the largest stretch with the area at rest in place "
      "of "
      "the current one.",
      {"h", "W = 1e6: refused step", "at rest, W = 1e6", "at rest, W = 1e9"},
      {}};
  for (std::size_t i = 0; i < found.size(); ++i) {
    table.rows.push_back({time_step_names[i], step_text(found[i].overflow), stretch_text(found[i].at_rest),
                          stretch_text(found[i].far_beyond)});
  }
  chapter.blocks.emplace_back(stretch_plot(context, found[0].rise[0]));
  chapter.blocks.emplace_back(std::move(limits));
  chapter.blocks.emplace_back(std::move(table));
}

}  // namespace

Chapter run_wind(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question =
      "A curtain of 16 x 16 vertices of 1 kg (edges of 5e4 N/m, two corners held, 5 iterations) in the wind as the "
      "thesis prints it, F = A (n·d) n with d = (0, W, .3 W), in steps of 1/60, 1 and 8 s. How far do its edges "
      "stretch, and is there a limit?";
  compare_stretch(context, chapter);
  measure_limits(context, chapter);
  std::vector<pliant_render::Image> pictures;
  for (const double time_step : time_steps) {
    pliant::Scene scene = scene_of(context, 1e4, time_step, "current");
    context.step(scene, steps);
    pictures.push_back(context.picture(scene));
  }
  context.show(chapter, pictures, 3,
               "The curtain after 300 steps of 1/60 s, 1 s and 8 s in a wind of 1e4 N/m² (Fig. 6.1 of the thesis).");
  return chapter;
}

}  // namespace pliant_experiments
