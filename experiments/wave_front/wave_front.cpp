#include "wave_front/wave_front.h"

#include <algorithm>
#include <array>
#include <map>

#include <fmt/format.h>

#include "support/claims.h"
#include "support/repeats.h"

namespace pliant_experiments {
namespace {

using pliant::Index;
using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Table;

constexpr Index vertices_a_side = 31;
constexpr Index rings_to_border = 15;  // from the middle, a ring an edge
constexpr std::int64_t steps_to_release = 330;
constexpr int frames_watched = 8;
constexpr int early_frames = 3;
constexpr std::array<Index, 7> counts_of_wave = {1, 2, 5, 10, 20, 50, 500};
constexpr std::array<double, 2> stiffnesses = {1e4, 1e6};  // [N/m]
constexpr double soft = stiffnesses[0];
constexpr double stiff = stiffnesses[1];
constexpr double front = 1e-3;     // [m]: what has moved further has been reached
constexpr double unreached = .01;  // of the way of the vertex that was pulled
constexpr double faster = 1.3;

pliant::Scene curtain_of_wave(const ExperimentContext& context, double stiffness, Index iterations) {
  return context.scene("wave_front/curtain",
                       {fmt::format("bodies[curtain].constraints[threads].stiffness={}", stiffness),
                        fmt::format("forces[pull].force=[0,{},0]", stiffness == soft ? 2e3 : 2e4),
                        fmt::format("settings.iterations={}", iterations)});
}

/// By how much the release has moved each ring about the middle, after each frame [m]: against the same curtain that is
/// drawn on.
using Rings = std::vector<std::array<double, rings_to_border + 1>>;

Rings disturbance(const ExperimentContext& context, const pliant::State& begin, double stiffness, Index iterations,
                  unsigned repeat) {
  pliant::Scene drawn = curtain_of_wave(context, stiffness, iterations);
  pliant::Scene released = curtain_of_wave(context, stiffness, iterations);
  for (pliant::Scene* scene : {&drawn, &released}) {
    scene->simulation.restore(begin);
    context.disturb(*scene, repeat);
  }
  released.simulation.remove(released.simulation.find_force("pull").value());
  Rings rings(frames_watched);
  for (auto& ring : rings) {
    context.step(drawn);
    context.step(released);
    const Eigen::VectorXd ways =
        (drawn.simulation.state().positions - released.simulation.state().positions).rowwise().norm();
    ring.fill(0);
    for (Index i = 0; i < vertices_a_side * vertices_a_side; ++i) {
      const Index column = std::abs(i % vertices_a_side - rings_to_border);
      const Index row = std::abs(i / vertices_a_side - rings_to_border);
      double& most = ring[static_cast<std::size_t>(std::max(column, row))];
      most = std::max(most, ways[i]);
    }
  }
  return rings;
}

/// The ring farthest from the middle that has moved.
double ring_reached(const std::array<double, rings_to_border + 1>& ring) {
  double reached = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) reached = ring[i] > front ? static_cast<double>(i) : reached;
  return reached;
}

/// What was found at one stiffness, by iterations.
struct Waves {
  std::map<Index, std::vector<Rings>> repeats;

  template <class Get>
  Spread spread_of(Index iterations, Get&& get) const {
    std::vector<double> values;
    for (const Rings& rings : repeats.at(iterations)) values.push_back(get(rings));
    return spread(std::move(values));
  }
  Spread border(Index iterations, int frames) const {
    return spread_of(iterations,
                     [&](const Rings& rings) { return rings[static_cast<std::size_t>(frames) - 1].back(); });
  }
  Spread middle(Index iterations, int frames) const {
    return spread_of(iterations,
                     [&](const Rings& rings) { return rings[static_cast<std::size_t>(frames) - 1].front(); });
  }
  /// Frames after which the border is reached; one more than were watched: not in these.
  double arrival(Index iterations) const {
    for (int frame = 1; frame <= frames_watched; ++frame) {
      if (border(iterations, frame).middle > front) return frame;
    }
    return frames_watched + 1;
  }
};

Plot front_plot(const Waves& waves) {
  Plot plot{.title = fmt::format("The wave after a release, k = {:.0e} N/m", soft),
            .caption =
                fmt::format("The ring of vertices about the middle, an edge apart each, that has been moved by "
                            "more than {:.0f} mm, over the frames since the release; the border is ring {}. "
                            "Medians of {} runs whose starts differ by a millionth of a meter, bands from the "
                            "least to the largest; curves that are not seen lie under the one that is. After the right "
                            "half of Fig. 6.7 of the thesis.",
                            1e3 * front, rings_to_border, repeats_of_bands),
            .x = {.label = "frames since the release"},
            .y = {.label = "ring reached", .min = 0, .max = rings_to_border + 1.0},
            .series = {},
            .guides = {{rings_to_border, "border", false}}};
  for (const Index iterations : {1, 5, 20, 500}) {
    pliant_report::Series series{.name = fmt::format("{} iteration{}", iterations, iterations == 1 ? "" : "s"),
                                 .mark = pliant_report::Mark::line_and_points};
    for (std::size_t frame = 0; frame < frames_watched; ++frame) {
      add_point(series, static_cast<double>(frame + 1),
                waves.spread_of(iterations, [&](const Rings& rings) { return ring_reached(rings[frame]); }));
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Plot border_plot(const std::map<double, Waves>& all) {
  Plot plot{.title = "How far the border has been moved",
            .caption = fmt::format("The vertex of the border that the release has moved farthest, {} frames after it, "
                                   "over the iterations a step. Bands from the least to the largest of {} runs.",
                                   early_frames, repeats_of_bands),
            .x = {.label = "iterations", .is_logarithmic = true},
            .y = {.label = "way of the border [m]", .is_logarithmic = true},
            .series = {}};
  for (const auto& [stiffness, waves] : all) {
    pliant_report::Series series{.name = fmt::format("k = {:.0e} N/m", stiffness),
                                 .mark = pliant_report::Mark::line_and_points};
    for (const Index iterations : counts_of_wave) add_point(series, iterations, waves.border(iterations, early_frames));
    plot.series.push_back(std::move(series));
  }
  return plot;
}

Table arrivals(const std::map<double, Waves>& all) {
  Table table{
      fmt::format("Way of the border [mm] after so many frames, and the frame in which it has been moved by more "
                  "than {:.0f} mm.",
                  1e3 * front),
      {"k [N/m]", "iterations", "1", "2", "3", "5", "8", "reached in frame"},
      {}};
  for (const auto& [stiffness, waves] : all) {
    for (const Index iterations : counts_of_wave) {
      std::vector<std::string> row = {fmt::format("{:.0e}", stiffness), std::to_string(iterations)};
      for (const int frame : {1, 2, 3, 5, 8}) {
        row.push_back(fmt::format("{:.3g}", 1e3 * waves.border(iterations, frame).middle));
      }
      row.push_back(fmt::format("{:.0f}", waves.arrival(iterations)));
      table.rows.push_back(std::move(row));
    }
  }
  return table;
}

void judge_waves(Chapter& chapter, const Waves& softer, const Waves& stiffer) {
  const auto way = [&](const Waves& waves, Index iterations) { return waves.border(iterations, early_frames).middle; };
  const double share = softer.border(20, 1).most / softer.middle(20, 1).least;
  chapter.claims.push_back(claim(
      "Very shortly after the force has ended the disturbance has not yet spread to the edges",
      "thesis, Sec. 6.3, Fig. 6.7", share < unreached && softer.arrival(20) <= frames_watched,
      fmt::format("at {:.0e} N/m and 20 iterations the border has moved by {:.2g} % of the way of the vertex that "
                  "was pulled after one frame (asked for: less than {:.0f} %), and by more than {:.0f} mm in "
                  "frame {:.0f}; in eight frames it is reached in every run",
                  soft, 100 * share, 100 * unreached, 1e3 * front, softer.arrival(20))));
  const double gain = way(stiffer, 20) / way(stiffer, 1);
  const bool rises =
      way(stiffer, 1) < way(stiffer, 2) && way(stiffer, 2) < way(stiffer, 5) && way(stiffer, 5) < way(stiffer, 20);
  chapter.claims.push_back(claim(
      "With more iterations changes run faster through a stiff cloth", "thesis, Sec. 6.2", rises && gain > faster,
      fmt::format("at {:.0e} N/m the border has moved by {:.3g}, {:.3g}, {:.3g} and {:.3g} mm {} frames after the "
                  "release with 1, 2, 5 and 20 iterations, {:.2f} times as far with 20 as with 1 (asked for: "
                  "each further than the one before, and {} times)",
                  stiff, 1e3 * way(stiffer, 1), 1e3 * way(stiffer, 2), 1e3 * way(stiffer, 5), 1e3 * way(stiffer, 20),
                  early_frames, gain, faster)));
  const double difference = softer.arrival(1) - softer.arrival(500);
  chapter.claims.push_back(claim(
      "Through a soft one they run as fast with one iteration as with 500", "", std::abs(difference) <= 1,
      fmt::format("at {:.0e} N/m, k h²/m = {:.1f}, the border is reached in frame {:.0f} with 1, {:.0f} with 20 and "
                  "{:.0f} with 500 iterations (asked for: within one frame). A global solve is one of the whole "
                  "cloth; only what it takes for the directions of the edges is late",
                  soft, soft / 3600, softer.arrival(1), softer.arrival(20), softer.arrival(500))));
}

}  // namespace

Chapter run_wave_front(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question =
      "A curtain of 31 x 31 vertices of 1 kg hangs by two corners and is drawn at its middle for 30 frames of 1/60 s, "
      "by "
      "2000 N with edges of 1e4 N/m and by 20,000 N with 1e6 N/m, all with 50 iterations a step. Then the force ends, "
      "and "
      "1 to 500 iterations a step are taken. How fast does the change run to the border? It is measured against the "
      "same "
      "curtain that is drawn on, so that what moves anyway does not count.";
  std::map<double, Waves> all;
  std::vector<pliant_render::Image> pictures;
  for (const double stiffness : stiffnesses) {
    context.say(fmt::format("k = {:.0e} N/m, before the release", stiffness));
    pliant::Scene scene = curtain_of_wave(context, stiffness, 50);
    context.step(scene, steps_to_release);
    const pliant::State begin = scene.simulation.state();
    for (const Index iterations : counts_of_wave) {
      context.say(fmt::format("k = {:.0e} N/m, {} iterations", stiffness, iterations));
      for (unsigned repeat = 0; repeat < repeats_of_bands; ++repeat) {
        all[stiffness].repeats[iterations].push_back(disturbance(context, begin, stiffness, iterations, repeat));
      }
    }
    if (stiffness != soft) continue;
    pictures.push_back(context.picture(scene));
    scene.simulation.remove(scene.simulation.find_force("pull").value());
    context.step(scene, early_frames);
    pictures.push_back(context.picture(scene));
  }
  judge_waves(chapter, all.at(soft), all.at(stiff));
  context.show(
      chapter, pictures, 2,
      fmt::format("The curtain of 1e4 N/m at the release and {} frames later, after Fig. 6.7, right: the middle "
                  "goes back, and the border has been moved by {:.1f} mm.",
                  early_frames, 1e3 * all.at(soft).border(50, early_frames).middle));
  chapter.blocks.emplace_back(front_plot(all.at(soft)));
  chapter.blocks.emplace_back(border_plot(all));
  chapter.blocks.emplace_back(arrivals(all));
  return chapter;
}

}  // namespace pliant_experiments
