#include "start/start.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "support/claims.h"
#include "support/trace.h"

namespace pliant_experiments {
namespace {

using pliant::Index;
using pliant::Start;
using pliant_report::Chapter;
using pliant_report::Plot;

constexpr Index converged = 3000;
constexpr int start_frames = 30;
constexpr std::array<Index, 8> start_counts = {1, 2, 3, 5, 10, 20, 50, 100};

/// Mean over the frames of the largest error of a vertex [m], by number of iterations.
using Errors = std::map<Index, double>;

class Steps {
 public:
  explicit Steps(pliant::Scene& scene) : scene_(scene) {}

  /// The state after one step from the given one.
  pliant::State from(const ExperimentContext& context, const pliant::State& state, Start start, Index iterations) {
    pliant::SolverSettings settings = scene_.simulation.settings();
    settings.start = start;
    settings.iterations = iterations;
    scene_.simulation.set_settings(settings);
    scene_.simulation.restore(state);
    context.step(scene_);
    return scene_.simulation.state();
  }

 private:
  pliant::Scene& scene_;
};

/// `residual` becomes the largest force [N] that any of the steps taken for exact leaves.
std::map<Start, Errors> measure(const ExperimentContext& context, pliant::Scene& scene, const pliant::State& begin,
                                double& residual) {
  std::map<Start, Errors> errors;
  Steps steps(scene);
  pliant::State state = begin;
  for (int frame = 0; frame < start_frames; ++frame) {
    context.say(fmt::format("frame {} of {}", frame + 1, start_frames));
    const pliant::State exact = steps.from(context, state, Start::prediction, converged);
    residual = std::max(residual, scene.simulation.evaluate().residual);
    for (const Start start : {Start::prediction, Start::positions}) {
      for (const Index count : start_counts) {
        const pliant::State found = steps.from(context, state, start, count);
        errors[start][count] += (found.positions - exact.positions).rowwise().norm().maxCoeff() / start_frames;
      }
    }
    state = exact;
  }
  return errors;
}

}  // namespace

Chapter run_start(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question =
      "A curtain of 16 x 16 vertices of 1 kg (edges of 5e4 N/m) is drawn from its equilibrium by 2000 N for 30 frames. "
      "From each of the frames one step is taken from the prediction s and one from the last positions qₙ, with 1 to "
      "100 iterations. How far are they from the converged step?";
  pliant::Scene resting = context.scene("start/curtain");
  resting.simulation.remove(resting.simulation.find_force("pull").value());
  context.say("equilibrium");
  settle(context, resting, 1e-8);
  pliant::Scene scene = context.scene("start/curtain");
  double residual = 0;
  context.disturb(resting);
  const std::map<Start, Errors> errors = measure(context, scene, resting.simulation.state(), residual);
  Plot plot{
      .title = "Error of a step by where its iterations begin",
      .caption = fmt::format("Distance of the vertex that is farthest from the converged step, mean of 30 frames. What "
                             "is taken for converged, after {} iterations, leaves forces of at most {:.1g} N.",
                             converged, residual),
      .x = {.label = "iterations", .is_logarithmic = true},
      .y = {.label = "largest error of a vertex [m]", .is_logarithmic = true},
      .series = {}};
  for (const Start start : {Start::prediction, Start::positions}) {
    pliant_report::Series series{
        .name = start == Start::prediction ? "from the prediction s" : "from the last positions qₙ",
        .mark = pliant_report::Mark::line_and_points};
    for (const auto& [count, error] : errors.at(start)) {
      series.x.push_back(count);
      series.y.push_back(error);
    }
    plot.series.push_back(std::move(series));
  }
  const Errors& from_s = errors.at(Start::prediction);
  const Errors& from_q = errors.at(Start::positions);
  chapter.claims.push_back(
      claim("With one iteration the start at s is worse, since the explicit step dominates over the constraints",
            "thesis, Sec. 6.4", from_s.at(1) > from_q.at(1),
            fmt::format("{:.3f} m from s, {:.3f} m from qₙ", from_s.at(1), from_q.at(1))));
  chapter.claims.push_back(
      claim("With more iterations the start at s is better", "thesis, Sec. 6.4",
            from_s.at(10) < from_q.at(10) && from_s.at(50) < from_q.at(50),
            fmt::format("10 iterations: {:.4f} m from s, {:.4f} m from qₙ; 50: {:.4f} and {:.4f} m", from_s.at(10),
                        from_q.at(10), from_s.at(50), from_q.at(50))));
  chapter.blocks.emplace_back(std::move(plot));
  return chapter;
}

}  // namespace pliant_experiments
