#include "iterations/iterations.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "iterations/strip.h"

namespace pliant_experiments {
namespace {

using namespace pliant;
using namespace pliant_report;

constexpr double soft_stiffness = 50;    // [N/m]
constexpr double stiff_stiffness = 5e3;  // [N/m]
constexpr std::array<int, 9> iteration_counts = {1, 2, 5, 10, 20, 50, 100, 200, 500};
constexpr int strip_steps = 600;  // 10 s
constexpr int last_steps = 60;    // whose mean iteration_counts as rest
constexpr int fall_steps = 60;    // in which the way there is compared
constexpr double pbd_share = .5;
constexpr int few = 10;  // iterations, as they are usual

/// One method over all numbers of iterations, on one strip.
struct Method {
  std::string name;
  int color = 0;
  bool is_dashed = false;
  std::function<Mover(int iterations)> make{};
  std::vector<Fall> falls{};  ///< of each number of iterations

  double at_rest(std::size_t i) const { return falls[i].last_mean(last_steps); }
  const Fall& fall_of(int iterations) const {
    return falls[static_cast<std::size_t>(std::find(iteration_counts.begin(), iteration_counts.end(), iterations) -
                                          iteration_counts.begin())];
  }
};

/// Everything about the strip of one stiffness.
struct Strip {
  double stiffness = 0;
  double at_rest = 0;  ///< the exact stretch
  Fall exact{};        ///< the exact steps of implicit Euler
  std::vector<Method> methods{};

  std::string name() const { return fmt::format("k = {:g} N/m", stiffness); }
  const Method& projective() const { return methods[0]; }
  const Method& projective_from_positions() const { return methods[1]; }
  const Method& xpbd() const { return methods[2]; }
  const Method& xpbd_in_substeps() const { return methods[3]; }
  const Method& pbd() const { return methods[4]; }
  double error(const Method& method, std::size_t i) const { return std::abs(method.at_rest(i) / at_rest - 1); }
  /// The largest distance from the exact stretch on the way, of the largest exact one.
  double way_error(const Fall& fall) const {
    double most = 0;
    for (std::size_t i = 0; i <= fall_steps; ++i) most = std::max(most, std::abs(fall.stretch[i] - exact.stretch[i]));
    return most / *std::max_element(exact.stretch.begin(), exact.stretch.end());
  }
};

std::vector<Method> methods(const ExperimentContext& context, double stiffness) {
  const auto projective = [&context, stiffness](Start start) {
    return [&context, stiffness, start](int n) { return by_projective_dynamics(context, stiffness, n, start); };
  };
  const auto xpbd = [&context, stiffness](const XpbdOptions& options) {
    return by_position_based_dynamics(context, stiffness, options);
  };
  return {
      {"Projective Dynamics", 0, false, projective(Start::prediction)},
      {"Projective Dynamics from the last positions", 0, true, projective(Start::positions)},
      {"XPBD", 2, false, [xpbd](int n) { return xpbd({.iterations = n}); }},
      {"XPBD, substeps of one iteration", 4, true, [xpbd](int n) { return xpbd({.iterations = 1, .substeps = n}); }},
      {fmt::format("PBD, share {}", pbd_share), 3, false,
       [xpbd](int n) { return xpbd({.iterations = n, .pbd_share = pbd_share}); }}};
}

Strip measure(const ExperimentContext& context, double stiffness) {
  const Scene rest = strip(context, stiffness);
  Strip result{stiffness, stretch_at_rest(context, stiffness), fall(rest, by_newton(context, stiffness), fall_steps),
               methods(context, stiffness)};
  for (Method& method : result.methods) {
    for (const int iterations : iteration_counts) {
      context.say(fmt::format("{}, {}, {} iterations", result.name(), method.name, iterations));
      method.falls.push_back(fall(rest, method.make(iterations), strip_steps));
    }
  }
  return result;
}

// ---- plots and tables

Plot rest_plot(const Strip& of) {
  Plot plot{.title = fmt::format("Stretch at rest over the number of iterations, {}", of.name()),
            .caption = fmt::format("Mean of the last second of {} s. The line across is the equilibrium, {:.4g} %.",
                                   strip_steps / 60, 100 * of.at_rest),
            .x = {.label = "iterations, or substeps", .is_logarithmic = true},
            .y = {.label = "stretch of the strip [%]", .is_logarithmic = true},
            .series = {},
            .guides = {{100 * of.at_rest, "equilibrium"}}};
  for (const Method& method : of.methods) {
    Series series{
        .name = method.name, .mark = Mark::line_and_points, .is_dashed = method.is_dashed, .color = method.color};
    for (std::size_t i = 0; i < iteration_counts.size(); ++i) {
      series.x.push_back(iteration_counts[i]);
      series.y.push_back(100 * method.at_rest(i));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Plot cost_plot(const Strip& of) {
  Plot plot{.title = fmt::format("Error at rest over the time of a step, {}", of.name()),
            .caption =
                "The distance of the stretch at rest from that of the equilibrium, on one thread, with 1 to 500 "
                "iterations or substeps; below the plot it is rounding. From the last positions Projective Dynamics is "
                "there throughout. Where XPBD levels off, it has come to the end of what it converges to: its "
                "multipliers add up along directions that turn meanwhile, so that is near the minimum, not at it.",
            .x = {.label = "time of a step [ms]", .is_logarithmic = true},
            .y = {.label = "error of the stretch, of the exact one", .is_logarithmic = true, .min = 1e-8},
            .series = {}};
  for (const Method& method : of.methods) {
    Series series{
        .name = method.name, .mark = Mark::line_and_points, .is_dashed = method.is_dashed, .color = method.color};
    for (std::size_t i = 0; i < iteration_counts.size(); ++i) {
      series.x.push_back(1e3 * method.falls[i].seconds);
      series.y.push_back(of.error(method, i));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Plot way_plot(const Strip& of) {
  Plot plot{.title = fmt::format("The fall and the first bounces, {}", of.name()),
            .caption =
                "The stretch of the strip in the first second. Projective Dynamics is on the exact steps of implicit "
                "Euler from few iterations on; XPBD with 20 bounces as a softer strip does.",
            .x = {.label = "time [s]"},
            .y = {.label = "stretch of the strip [%]", .min = 0.},
            .series = {}};
  const auto add = [&plot](std::string name, const Fall& fall, int color, bool is_dashed) {
    Series series{.name = std::move(name), .is_dashed = is_dashed, .color = color};
    for (std::size_t i = 0; i <= fall_steps; ++i) {
      series.x.push_back(static_cast<double>(i) / 60);
      series.y.push_back(100 * fall.stretch[i]);
    }
    plot.series.push_back(std::move(series));
  };
  add("Newton: exact steps", of.exact, 1, false);
  add("Projective Dynamics, 2 iterations", of.projective().fall_of(2), 0, true);
  add("Projective Dynamics, 10 iterations", of.projective().fall_of(10), 0, false);
  add("XPBD, 20 iterations", of.xpbd().fall_of(20), 2, true);
  add("XPBD, 100 iterations", of.xpbd().fall_of(100), 2, false);
  return plot;
}

Table rest_table(const Strip& of) {
  Table table{fmt::format("Stretch at rest [%], {}; the equilibrium is at {:.5f} %", of.name(), 100 * of.at_rest),
              {"method"}};
  for (const int count : iteration_counts) table.columns.push_back(fmt::format("{}", count));
  table.columns.emplace_back("ms an iteration");
  for (const Method& method : of.methods) {
    std::vector<std::string> row = {method.name};
    for (std::size_t i = 0; i < iteration_counts.size(); ++i)
      row.push_back(fmt::format("{:.5f}", 100 * method.at_rest(i)));
    row.push_back(fmt::format("{:.4f}", 1e3 * method.falls.back().seconds / iteration_counts.back()));
    table.rows.push_back(std::move(row));
  }
  return table;
}

/// Strips at rest side by side, from their last positions.
void add_pictures(const ExperimentContext& context, Chapter& chapter, const Strip& of) {
  std::vector<pliant_render::Image> pictures;
  for (const Fall* each : {&of.projective().fall_of(1), &of.projective().fall_of(few), &of.xpbd().fall_of(1),
                           &of.xpbd().fall_of(few), &of.pbd().fall_of(few)}) {
    Scene scene = strip(context, of.stiffness);
    scene.simulation.set_state(each->last, Positions::Zero(each->last.rows(), 3));
    pictures.push_back(context.picture(scene));
  }
  context.show(
      chapter, pictures, static_cast<int>(pictures.size()),
      fmt::format("After {0} s, {1}, from the left: Projective Dynamics with 1 and {2} iterations, XPBD with 1 "
                  "and {2}, PBD with {2}.",
                  strip_steps / 60, of.name(), few));
}

// ---- claims

using Strips = std::vector<const Strip*>;

std::string stretches(const Strip& of, const Method& method, std::initializer_list<int> iterations) {
  std::vector<std::string> parts;
  for (const int count : iterations) {
    parts.push_back(fmt::format("{:.4f} % with {}", 100 * method.fall_of(count).last_mean(last_steps), count));
  }
  return fmt::format("{}: {:.4f} % in the equilibrium; {} iterations. ", of.name(), 100 * of.at_rest,
                     fmt::join(parts, ", "));
}

/// Whether the stretch at rest is within that share of the exact one for all numbers of iterations from `least` on.
bool is_within(const Strip& of, const Method& method, int least, double share) {
  for (std::size_t i = 0; i < iteration_counts.size(); ++i) {
    if (iteration_counts[i] >= least && !(of.error(method, i) <= share)) return false;
  }
  return true;
}

Claim projective_keeps_stiffness(const Strips& strips) {
  constexpr double share = .05;
  Claim claim{
      fmt::format("The stiffness of Projective Dynamics does not depend on the number of iterations, from {} on", few),
      "Bouaziz et al. 2014", Verdict::holds};
  for (const Strip* of : strips) {
    if (!is_within(*of, of->projective(), few, share)) claim.verdict = Verdict::fails;
    claim.evidence += stretches(*of, of->projective(), {1, 2, 5, 10, 20, 500});
  }
  claim.evidence += fmt::format("Asked for: within {:.0f} %.", 100 * share);
  return claim;
}

Claim start_matters(const Strips& strips) {
  constexpr double share = 1e-6;
  Claim claim{"From the last positions, any number of iterations, even one, rests in the equilibrium", "",
              Verdict::holds};
  for (const Strip* of : strips) {
    if (!is_within(*of, of->projective_from_positions(), 1, share)) claim.verdict = Verdict::fails;
    claim.evidence += fmt::format(
        "{}: with one iteration off by {:.1e} of the stretch, and from the prediction, which has let the strip fall "
        "away from its rail, by {:.2g}. ",
        of->name(), of->error(of->projective_from_positions(), 0), of->error(of->projective(), 0));
  }
  return claim;
}

Claim projective_is_implicit_euler(const Strips& strips) {
  constexpr double share = 1e-3;
  Claim claim{"Projective Dynamics converges to the exact step of implicit Euler, on the way too",
              "Bouaziz et al. 2014", Verdict::holds};
  for (const Strip* of : strips) {
    if (of->way_error(of->projective().falls.back()) > share) claim.verdict = Verdict::fails;
    std::vector<std::string> parts;
    for (const int count : {1, 10, 100, 500}) {
      parts.push_back(fmt::format("{:.1e} with {}", of->way_error(of->projective().fall_of(count)), count));
    }
    claim.evidence +=
        fmt::format("{}: off by at most {} iterations, of the largest stretch. ", of->name(), fmt::join(parts, ", "));
  }
  return claim;
}

Claim xpbd_is_soft(const Strips& strips) {
  Claim claim{fmt::format("XPBD is softer than asked for with {} iterations", few), "Bouaziz et al. 2014, of PBD",
              Verdict::holds};
  for (const Strip* of : strips) {
    if (of->xpbd().fall_of(few).last_mean(last_steps) < 2 * of->at_rest) claim.verdict = Verdict::fails;
    claim.evidence += stretches(*of, of->xpbd(), {few, 100, 500});
  }
  return claim;
}

Claim xpbd_converges(const Strips& strips) {
  constexpr double share = .05;
  Claim claim{fmt::format("XPBD comes to the same stiffness within {} iterations", iteration_counts.back()),
              "Macklin et al. 2016", Verdict::holds};
  for (const Strip* of : strips) {
    const double error = of->error(of->xpbd(), iteration_counts.size() - 1);
    if (error > share) claim.verdict = Verdict::fails;
    claim.evidence +=
        fmt::format("{}: off by {:.2g} % of the exact stretch, in substeps of one iteration by {:.2g} %. ", of->name(),
                    100 * error, 100 * of->error(of->xpbd_in_substeps(), iteration_counts.size() - 1));
  }
  claim.evidence += fmt::format("Asked for: {:.0f} %.", 100 * share);
  return claim;
}

Claim pbd_has_no_stiffness(const Strips& strips) {
  Claim claim{"PBD gets the stiffer the more iterations it takes, and knows of no stiffness", "Bouaziz et al. 2014",
              Verdict::holds};
  const Method& first = strips.front()->pbd();
  for (std::size_t i = 0; i < iteration_counts.size(); ++i) {
    claim.evidence += fmt::format("{:.3g} % with {}, ", 100 * first.at_rest(i), iteration_counts[i]);
    if (i > 0 && iteration_counts[i] > few && first.at_rest(i) > .75 * first.at_rest(i - 1))
      claim.verdict = Verdict::fails;
  }
  claim.evidence += "whatever k is.";
  return claim;
}

}  // namespace

Chapter run_iterations(const ExperimentContext& context) {
  const Strip softer = measure(context, soft_stiffness);
  const Strip stiffer = measure(context, stiff_stiffness);
  const Strips strips = {&softer, &stiffer};

  Chapter chapter;
  chapter.question = fmt::format(
      "Is the material as stiff as it was asked to be, whatever the number of iterations? A strip of springs is let "
      "go, falls {} s under its weight and comes to rest. Its stretch is compared with that of the equilibrium, and on "
      "the way with the exact steps of implicit Euler, both by Newton's method. XPBD goes through the same springs "
      "with the compliance 1/k, one after the other; PBD takes {:.0f} % of each spring's excess length away in each "
      "iteration.",
      strip_steps / 60, 100 * pbd_share);
  chapter.claims = {projective_keeps_stiffness(strips),
                    start_matters(strips),
                    projective_is_implicit_euler(strips),
                    xpbd_is_soft(strips),
                    xpbd_converges(strips),
                    pbd_has_no_stiffness(strips)};
  add_pictures(context, chapter, softer);
  for (const Strip* of : strips) chapter.blocks.emplace_back(rest_plot(*of));
  for (const Strip* of : strips) chapter.blocks.emplace_back(rest_table(*of));
  for (const Strip* of : strips) chapter.blocks.emplace_back(cost_plot(*of));
  chapter.blocks.emplace_back(way_plot(softer));
  return chapter;
}

}  // namespace pliant_experiments
