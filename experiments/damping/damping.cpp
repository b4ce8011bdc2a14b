#include "damping/damping.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "support/claims.h"
#include "support/trace.h"

namespace pliant_experiments {
namespace {

using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Series;
using pliant_report::Table;

constexpr std::string_view thesis = "thesis, Sec. 6.2";
constexpr std::int64_t frames = 900;
constexpr std::size_t release = 30;
constexpr int from_positions = -1;  // in place of a number of iterations: one, from the last positions

/// A run, and what its late frames are in runs that begin a little elsewhere.
struct Swing {
  Trace trace;
  std::vector<double> late_of_others{};
  double at_release() const { return trace.speed_sum[release]; }
  double early() const { return mean(trace.speed_sum, 30, 330); }
  double late() const { return mean(trace.speed_sum, 600, 900); }
  /// From the release on, until the last one above a tenth of Σ‖v‖ at release.
  std::size_t frames_to_a_tenth() const {
    std::size_t last = release;
    for (std::size_t i = release; i < trace.size(); ++i) last = trace.speed_sum[i] > at_release() / 10 ? i : last;
    return last - release;
  }
  /// Root mean square of what three neighboring frames have besides a straight line, over the mean.
  double irregularity() const {
    double sum = 0;
    std::size_t count = 0;
    for (std::size_t i = release + 1; i + 1 < trace.size(); ++i, ++count) {
      const double bend = trace.speed_sum[i - 1] - 2 * trace.speed_sum[i] + trace.speed_sum[i + 1];
      sum += bend * bend;
    }
    return std::sqrt(sum / static_cast<double>(count)) / mean(trace.speed_sum, release, trace.size());
  }
};

using Swings = std::map<int, Swing>;  // by iterations

Sets sets_of(double stiffness, int iterations) {
  Sets sets = {fmt::format("bodies[curtain].constraints[threads].stiffness={}", stiffness),
               fmt::format("settings.iterations={}", std::abs(iterations))};
  if (iterations == from_positions) sets.emplace_back("settings.start=positions");
  return sets;
}

pliant::Scene without_pull(const ExperimentContext& context, double stiffness, int iterations) {
  pliant::Scene scene = context.scene("damping/curtain", sets_of(stiffness, iterations));
  scene.simulation.remove(scene.simulation.find_force("pull").value());
  return scene;
}

pliant::State equilibrium(const ExperimentContext& context, double stiffness) {
  pliant::Scene scene = without_pull(context, stiffness, 1);
  settle(context, scene, 1e-8);
  return scene.simulation.state();
}

/// Largest way of a vertex from the equilibrium in 60 frames without the pull [m].
double drift(const ExperimentContext& context, const pliant::State& begin, double stiffness, int iterations) {
  pliant::Scene scene = without_pull(context, stiffness, iterations);
  scene.simulation.restore(begin);
  context.step(scene, 60);
  return (scene.simulation.state().positions - begin.positions).rowwise().norm().maxCoeff();
}

std::string label(int iterations) {
  if (iterations == from_positions) return "1 iteration, start at the positions";
  return iterations == 1 ? "1 iteration" : fmt::format("{} iterations", iterations);
}

/// Mean Σ‖v‖ of the late frames with one iteration, in runs whose start is moved by a thousand millionth of a meter.
std::vector<double> late_of_others(const ExperimentContext& context, const pliant::State& begin, double stiffness) {
  std::vector<double> values;
  for (int run = 1; run <= 8; ++run) {
    pliant::Scene scene = context.scene("damping/curtain", sets_of(stiffness, 1));
    pliant::State moved = begin;
    for (pliant::Index i = 0; i < moved.vertex_count(); ++i) moved.positions(i, 1) += 1e-9 * std::sin(run * (i + 1.0));
    scene.simulation.restore(moved);
    values.push_back(mean(record(context, scene, frames).speed_sum, 600, 900));
  }
  return values;
}

Swings swings_at(const ExperimentContext& context, const pliant::State& begin, double stiffness,
                 const std::vector<int>& iterations) {
  Swings swings;
  for (const int count : iterations) {
    context.say(fmt::format("k = {:.0e} N/m, {}", stiffness, label(count)));
    pliant::Scene scene = context.scene("damping/curtain", sets_of(stiffness, count));
    scene.simulation.restore(begin);
    context.disturb(scene);
    swings[count].trace = record(context, scene, frames);
    if (count == 1) swings[count].late_of_others = late_of_others(context, begin, stiffness);
  }
  return swings;
}

Plot speed_plot(const Swings& swings, double stiffness) {
  Plot plot{.title = fmt::format("Total speed, k = {:.0e} N/m", stiffness),
            .caption =
                "The sum of the speeds of all vertices from the moment at which the force sets in (Fig. 6.4 to 6.6 of "
                "the thesis); the force ends at frame 30.",
            .x = {.label = "frame"},
            .y = {.label = "Σ‖v‖ [m/s]", .min = 0},
            .series = {},
            .guides = {{release, "force ends", true}}};
  int color = 0;
  for (const int iterations : {1, 5, 20}) {
    const Trace& trace = swings.at(iterations).trace;
    plot.series.push_back({.name = label(iterations), .x = trace.frames, .y = trace.speed_sum, .color = color++});
  }
  return plot;
}

Plot energy_plot(const Trace& trace) {
  Plot plot{.title = "Energies, k = 1e4 N/m, 20 iterations",
            .caption =
                "Kinetic, elastic and gravitational energy, the latter two against the equilibrium, and their sum: "
                "what the sum loses behind the release is the integrator's damping.",
            .x = {.label = "frame"},
            .y = {.label = "energy [J]"},
            .series = {}};
  const auto above_start = [](std::vector<double> values) {
    const double start = values.front();
    for (double& value : values) value -= start;
    return values;
  };
  plot.series = {{.name = "kinetic", .x = trace.frames, .y = trace.kinetic},
                 {.name = "elastic", .x = trace.frames, .y = above_start(trace.elastic)},
                 {.name = "gravitational", .x = trace.frames, .y = above_start(trace.gravitational)},
                 {.name = "total", .x = trace.frames, .y = above_start(trace.total), .is_dashed = true}};
  return plot;
}

Table figures(const std::map<double, Swings>& all) {
  Table table{
      "Σ‖v‖ [m/s], the momentum ‖Σmv‖ at release, and the energy above that of the equilibrium; below it where the "
      "curtain has come to rest in folds. Irregularity: root mean square of the second differences of Σ‖v‖ over its "
      "mean.",
      {"k [N/m]", "iterations", "at release", "frames 30 to 330", "frames 600 to 900", "‖Σmv‖ [N s]",
       "energy at release [J]", "at the end [J]", "irregularity"},
      {}};
  for (const auto& [stiffness, swings] : all) {
    for (const auto& entry : swings) {
      const int iterations = entry.first;
      const Swing& swing = entry.second;
      const auto above = [&](std::size_t i) { return swing.trace.total[i] - swing.trace.total[0]; };
      table.rows.push_back({fmt::format("{:.0e}", stiffness),
                            iterations == from_positions ? "1 (from positions)" : std::to_string(iterations),
                            fmt::format("{:.0f}", swing.at_release()), fmt::format("{:.0f}", swing.early()),
                            fmt::format("{:.1f}", swing.late()), fmt::format("{:.0f}", swing.trace.momentum[release]),
                            fmt::format("{:.0f}", above(release)), fmt::format("{:.0f}", above(frames)),
                            fmt::format("{:.3f}", swing.irregularity())});
    }
  }
  return table;
}

/// What an independent program gave for the same set-up.
void add_known(Comparison& comparison, double stiffness, const Swings& swings) {
  struct Known {
    double stiffness;
    int iterations;
    double at_release, early, late;
  };
  constexpr double none = 0;
  for (const Known& known : {Known{1e4, 1, 457, 222, 55},
                             {1e4, 5, 492, 283, 95},
                             {1e4, 20, 496, 284, 102},
                             {5e4, 1, 376, 158, 15.7},
                             {5e4, 5, 391, 235, 72.8},
                             {5e4, 20, 410, 256, 93.4},
                             {5e4, 100, 399, 257, none}}) {
    if (known.stiffness != stiffness) continue;
    const Swing& swing = swings.at(known.iterations);
    const std::string what = fmt::format("k = {:.0e} N/m, {}", stiffness, label(known.iterations));
    comparison.add(what + ", at release", swing.at_release(), known.at_release);
    comparison.add(what + ", frames 30 to 330", swing.early(), known.early);
    if (known.late == none) continue;
    const bool has_others = !swing.late_of_others.empty();
    comparison.add(what + (has_others ? ", frames 600 to 900, mean of 8 runs" : ", frames 600 to 900"),
                   has_others ? mean(swing.late_of_others, 0, swing.late_of_others.size()) : swing.late(), known.late);
  }
}

void judge(Chapter& chapter, const Swings& soft, const Swings& stiff) {
  const auto three = [](const auto& get, const Swings& swings) {
    return fmt::format("{:.3g}, {:.3g}, {:.3g}", get(swings.at(1)), get(swings.at(5)), get(swings.at(20)));
  };
  const auto both = [&](const auto& get) {
    return fmt::format("1, 5, 20 iterations: {} at 1e4 N/m; {} at 5e4 N/m", three(get, soft), three(get, stiff));
  };
  const auto in_both = [&](const auto& holds) { return holds(soft) && holds(stiff); };
  const auto late_share = [](const Swing& s) { return s.late() / s.at_release(); };
  chapter.claims.push_back(claim("The swinging is damped, although no force damps it", std::string(thesis),
                                 in_both([&](const Swings& s) { return late_share(s.at(1)) < 0.5; }),
                                 "Σ‖v‖ of frames 600 to 900 over that at release, " + both(late_share)));
  const auto early = [](const Swing& s) { return s.early(); };
  chapter.claims.push_back(claim("More iterations damp less: 5 less than 1", std::string(thesis),
                                 in_both([&](const Swings& s) { return s.at(5).early() > 1.1 * s.at(1).early(); }),
                                 "mean Σ‖v‖ of frames 30 to 330 [m/s], " + both(early)));
  const auto at_release = [](const Swing& s) { return s.at_release(); };
  chapter.claims.push_back(claim("After the force the speed is higher with 5 iterations than with 1",
                                 std::string(thesis),
                                 in_both([](const Swings& s) { return s.at(5).at_release() > s.at(1).at_release(); }),
                                 "Σ‖v‖ at release [m/s], " + both(at_release)));
  const auto late = [](const Swing& s) { return s.late(); };
  chapter.claims.push_back(
      claim("20 iterations differ little from 5", std::string(thesis),
            in_both([](const Swings& s) { return std::abs(s.at(20).early() / s.at(5).early() - 1) < 0.1; }),
            fmt::format("mean Σ‖v‖ of frames 30 to 330 differs by less than 10 %; {}. Of frames 600 to 900: {}",
                        both(early), both(late))));
  chapter.claims.push_back(
      claim("The damping of implicit Euler remains, however many iterations", std::string(thesis),
            late_share(stiff.at(100)) < 0.5,
            fmt::format("100 iterations at 5e4 N/m: {:.0f} m/s at release, {:.0f} m/s in frames 600 to 900",
                        stiff.at(100).at_release(), stiff.at(100).late())));
  const auto irregularity = [](const Swing& s) { return s.irregularity(); };
  chapter.claims.push_back(reported("The irregularities grow with the iterations", std::string(thesis),
                                    "root mean square of second differences over the mean, " + both(irregularity)));
  const auto tenth = [](const Swing& s) { return s.frames_to_a_tenth(); };
  chapter.claims.push_back(
      claim("One iteration from the last positions, in place of the prediction, damps almost at once", "",
            in_both([&](const Swings& s) { return 3 * tenth(s.at(from_positions)) < tenth(s.at(1)); }),
            fmt::format("frames from the release until Σ‖v‖ stays below a tenth: {} in place of {} at 1e4 N/m, {} in "
                        "place of {} at 5e4 N/m",
                        tenth(soft.at(from_positions)), tenth(soft.at(1)), tenth(stiff.at(from_positions)),
                        tenth(stiff.at(1)))));
  const auto range = std::ranges::minmax(stiff.at(1).late_of_others);
  chapter.claims.push_back(reported(
      "How the curtain swings late depends on the last digits of its start", "",
      fmt::format(
          "5e4 N/m, 1 iteration: {:.3g} to {:.3g} m/s in frames 600 to 900 of 8 runs whose starts differ by 1e-9 m",
          range.min, range.max)));
}

void draw(const ExperimentContext& context, Chapter& chapter, const pliant::State& begin) {
  pliant::Scene scene = context.scene("damping/curtain", sets_of(1e4, 20));
  scene.simulation.restore(begin);
  std::vector<pliant_render::Image> pictures = {context.picture(scene)};
  for (const std::int64_t more : {30, 40}) {
    context.step(scene, more);
    pictures.push_back(context.picture(scene));
  }
  context.show(chapter, pictures, 3,
               "The curtain in equilibrium, at the end of the force, and 40 frames later; 1e4 N/m, 20 iterations.");
}

}  // namespace

Chapter run_damping(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question =
      "A curtain of 16 x 16 vertices of 1 kg, 1.5 m wide, hangs by two corners in equilibrium. A force of 2000 N draws "
      "at a vertex in its middle for 30 frames of 1/60 s; then it is left alone. Without any damping the total speed "
      "would go up and down with a constant amplitude.";
  std::map<double, Swings> all;
  Comparison comparison(0.1);
  double most_drift = 0;
  for (const double stiffness : {1e4, 5e4}) {
    context.say(fmt::format("equilibrium at k = {:.0e} N/m", stiffness));
    const pliant::State begin = equilibrium(context, stiffness);
    std::vector<int> iterations = {from_positions, 1, 5, 20};
    if (stiffness == 5e4) iterations.push_back(100);
    all[stiffness] = swings_at(context, begin, stiffness, iterations);
    for (const int count : {1, 5, 20}) most_drift = std::max(most_drift, drift(context, begin, stiffness, count));
    if (stiffness == 1e4) draw(context, chapter, begin);
    add_known(comparison, stiffness, all[stiffness]);
  }
  judge(chapter, all[1e4], all[5e4]);
  chapter.claims.push_back(claim("The equilibrium does not drift, whatever the number of iterations", "",
                                 most_drift < 1e-9,
                                 fmt::format("{:.1e} m at most in 60 frames with 1, 5 and 20 iterations, from an "
                                             "equilibrium with forces of at most 1e-8 N",
                                             most_drift)));
  chapter.claims.push_back(comparison.claim("The figures are those of an independent solver, within 10 %"));
  for (const double stiffness : {1e4, 5e4}) chapter.blocks.emplace_back(speed_plot(all[stiffness], stiffness));
  chapter.blocks.emplace_back(energy_plot(all[1e4].at(20).trace));
  chapter.blocks.emplace_back(figures(all));
  chapter.blocks.emplace_back(comparison.table("Σ‖v‖ [m/s] against an independent program, same set-up."));
  return chapter;
}

}  // namespace pliant_experiments
