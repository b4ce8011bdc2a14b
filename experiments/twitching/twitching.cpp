#include "twitching/twitching.h"

#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "pliant/mesh/topology.h"
#include "support/claims.h"
#include "support/repeats.h"

namespace pliant_experiments {
namespace {

using pliant::Index;
using pliant::Start;
using pliant_report::Chapter;
using pliant_report::Plot;

constexpr std::array<Index, 6> counts_of_twitches = {1, 2, 5, 10, 20, 50};
constexpr std::array<double, 2> threads = {5e4, 1e6};  // [N/m]
constexpr std::int64_t settling_frames = 32;           // while the force draws, and until three frames without it
constexpr std::int64_t twitching_frames = 300;
constexpr double steadier_start = 5;
constexpr double steadier_of_speed = 1.5;
constexpr double steadier_iterations = 2;

pliant::Scene curtain_of_twitches(const ExperimentContext& context, double stiffness, Start start, Index iterations) {
  return context.scene("twitching/curtain",
                       {fmt::format("bodies[curtain].constraints[threads].stiffness={}", stiffness),
                        fmt::format("settings.iterations={}", iterations),
                        fmt::format("settings.start={}", choice_names(start)[static_cast<std::size_t>(start)])});
}

/// Lengths of all edges over those at rest.
Eigen::VectorXd stretches_of(const pliant::Simulation& simulation, const std::vector<pliant::Edge>& edges) {
  const pliant::Positions& rest = simulation.bodies()[0].mesh.vertices;
  const pliant::Positions& q = simulation.state().positions;
  Eigen::VectorXd result(static_cast<Eigen::Index>(edges.size()));
  for (std::size_t i = 0; i < edges.size(); ++i) {
    const auto [from, to] = edges[i];
    result[static_cast<Eigen::Index>(i)] = (q.row(to) - q.row(from)).norm() / (rest.row(to) - rest.row(from)).norm();
  }
  return result;
}

/// Root mean square, over edges and frames, of what three frames of an edge's stretch have besides a straight line, and
/// the mean speed of a vertex [m/s].
struct Twitch {
  double stretch = 0;
  double speed = 0;
};

/// `first_edge` is given the stretch of one edge in each frame.
Twitch twitch(const ExperimentContext& context, pliant::Scene& scene, std::vector<double>* first_edge) {
  const std::vector<pliant::Edge> edges = pliant::unique_edges(scene.simulation.bodies()[0].mesh);
  context.step(scene, settling_frames - 1);
  Eigen::VectorXd before = stretches_of(scene.simulation, edges);
  context.step(scene);
  Eigen::VectorXd now = stretches_of(scene.simulation, edges);
  double sum = 0;
  double speed = 0;
  for (std::int64_t i = 0; i < twitching_frames; ++i) {
    context.step(scene);
    speed += scene.simulation.state().velocities.rowwise().norm().mean() / static_cast<double>(twitching_frames);
    const Eigen::VectorXd next = stretches_of(scene.simulation, edges);
    sum += (next - 2 * now + before).squaredNorm();
    before = std::exchange(now, next);
    if (first_edge != nullptr) first_edge->push_back(next[next.size() / 2]);
  }
  return {std::sqrt(sum / static_cast<double>(twitching_frames) / static_cast<double>(edges.size())), speed};
}

using Twitches = std::map<Start, std::map<Index, Spread>>;  // by iterations
using Speeds = std::map<std::pair<double, Start>, double>;  // with one iteration, by stiffness [m/s]

Plot twitch_plot(const std::map<double, Twitches>& all) {
  Plot plot{
      .title = "Twitching by the iterations",
      .caption = fmt::format("Root mean square of the second differences of the edges' stretch from frame to frame. "
                             "Medians of {} runs whose starts differ by a millionth of a meter, bands from the "
                             "least to the largest.",
                             repeats_of_bands),
      .x = {.label = "iterations", .is_logarithmic = true},
      .y = {.label = "change of stretch from frame to frame", .is_logarithmic = true},
      .series = {}};
  for (const auto& [stiffness, twitches] : all) {
    for (const auto& [start, by_count] : twitches) {
      pliant_report::Series series{
          .name = fmt::format("k = {:.0e} N/m, {}", stiffness, start == Start::prediction ? "from s" : "from qₙ"),
          .mark = pliant_report::Mark::line_and_points,
          .is_dashed = start == Start::positions};
      for (const auto& [count, spread] : by_count) add_point(series, count, spread);
      plot.series.push_back(std::move(series));
    }
  }
  return plot;
}

/// One edge in 60 frames, from both starts.
Plot edge_plot(const std::map<Start, std::vector<double>>& stretches) {
  Plot plot{.title = "An edge of the curtain with one iteration a step, k = 1e6 N/m",
            .caption =
                "Its length over that at rest, in the second after the force has ended. From the last positions the "
                "curtain hardly moves.",
            .x = {.label = "frame"},
            .y = {.label = "length / rest length"},
            .series = {}};
  for (const auto& [start, values] : stretches) {
    pliant_report::Series series{.name = start == Start::prediction ? "from the prediction s"
                                                                    : "from the last positions qₙ"};
    for (std::size_t i = 0; i < 60; ++i) {
      series.x.push_back(static_cast<double>(settling_frames) + static_cast<double>(i) + 1);
      series.y.push_back(values[i]);
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

void judge_twitches(Chapter& chapter, const std::map<double, Twitches>& all, const Speeds& speeds) {
  bool is_steadier = true;
  std::string evidence;
  for (const auto& [stiffness, twitches] : all) {
    const Spread& from_s = twitches.at(Start::prediction).at(1);
    const Spread& from_q = twitches.at(Start::positions).at(1);
    const double speed_s = speeds.at({stiffness, Start::prediction});
    const double speed_q = speeds.at({stiffness, Start::positions});
    const double of_speed = from_s.middle / speed_s / (from_q.middle / speed_q);
    is_steadier = is_steadier && from_s.least > steadier_start * from_q.most && of_speed > steadier_of_speed;
    evidence += fmt::format(
        "at {:.0e} N/m {:.2g} from s and {:.2g} from qₙ, where the curtain hardly moves, at {:.2g} in place of {:.2g} "
        "m/s "
        "in the mean: {:.2g} times as much of the speed; ",
        stiffness, from_s.middle, from_q.middle, speed_q, speed_s, of_speed);
  }
  chapter.claims.push_back(claim(
      "With one iteration the start at s leads to twitching, the start at the last positions does not",
      "thesis, Sec. 6.4", is_steadier,
      fmt::format(
          "second differences of the edges' stretch, {}asked for: {} times as large from s, and {} times of the speed",
          evidence, steadier_start, steadier_of_speed)));
  const std::map<Index, Spread>& stiff = all.at(threads[1]).at(Start::prediction);
  chapter.claims.push_back(claim(
      "With more iterations, from s, a stiff curtain twitches less", "thesis, Sec. 6.4",
      stiff.at(1).least > steadier_iterations * stiff.at(5).most,
      fmt::format("at {:.0e} N/m {:.2g}, {:.2g}, {:.2g} and {:.2g} with 1, 2, 5 and 20 iterations (asked for: with "
                  "1 more than {} times as much as with 5). At {:.0e} N/m it is {:.2g} with 1 and {:.2g} with 20: "
                  "what is left there is the motion of the curtain itself",
                  threads[1], stiff.at(1).middle, stiff.at(2).middle, stiff.at(5).middle, stiff.at(20).middle,
                  steadier_iterations, threads[0], all.at(threads[0]).at(Start::prediction).at(1).middle,
                  all.at(threads[0]).at(Start::prediction).at(20).middle)));
}

}  // namespace

Chapter run_twitching(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question =
      "A curtain of 16 x 16 vertices of 1 kg hangs by two corners and is drawn at its middle by 2000 N for 30 frames. "
      "In the 300 frames after, do its edges change their lengths smoothly or by jerks, with 1 to 50 iterations that "
      "begin at the prediction s or at the last positions qₙ?";
  std::map<double, Twitches> all;
  std::map<Start, std::vector<double>> an_edge;
  Speeds speeds;
  for (const double stiffness : threads) {
    for (const Start start : {Start::prediction, Start::positions}) {
      for (const Index count : counts_of_twitches) {
        context.say(fmt::format("k = {:.0e} N/m, {} iterations", stiffness, count));
        std::vector<double> values;
        for (unsigned repeat = 0; repeat < repeats_of_bands; ++repeat) {
          pliant::Scene scene = curtain_of_twitches(context, stiffness, start, count);
          context.disturb(scene, repeat);
          const bool is_shown = stiffness == threads[1] && count == 1 && repeat == 0;
          const Twitch found = twitch(context, scene, is_shown ? &an_edge[start] : nullptr);
          values.push_back(found.stretch);
          if (count == 1) speeds[{stiffness, start}] = found.speed;
        }
        all[stiffness][start][count] = spread(std::move(values));
      }
    }
  }
  judge_twitches(chapter, all, speeds);
  chapter.blocks.emplace_back(twitch_plot(all));
  chapter.blocks.emplace_back(edge_plot(an_edge));
  return chapter;
}

}  // namespace pliant_experiments
