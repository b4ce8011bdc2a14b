#include "sheet_metal/sheet_metal.h"

#include <fmt/format.h>

#include "pliant/forces/test_force.h"
#include "pliant/mesh/topology.h"
#include "support/claims.h"
#include "support/curvature.h"
#include "support/trace.h"

namespace pliant_experiments {
namespace {

using pliant_report::Chapter;
using pliant_report::Plot;

constexpr std::array<double, 4> bendings = {0, 1, 10, 100};  // [N m]
constexpr std::int64_t release = 120;
constexpr std::int64_t shortly_after = 8;  // frames
constexpr pliant::Index pulled_vertex = 120;

pliant::Scene scene_of(const ExperimentContext& context, double bending) {
  pliant::Scene scene = context.scene("sheet_metal/curtain");
  if (bending > 0) scene.simulation.add(pliant::BodyId{0}, pliant::Bending{.stiffness = bending});
  context.disturb(scene);
  return scene;
}

pliant::TestForce endless_pull(const pliant::Simulation& simulation) {
  pliant::TestForce pull = *simulation.options<pliant::TestForce>(simulation.find_force("pull").value());
  pull.frames = {0, 100000};
  return pull;
}

/// How far the end of the force has moved the sheet [m]: against the same one that is drawn on.
struct Ways {
  double pulled = 0;  // of the vertex that was pulled
  double border = 0;  // of the vertex of the border that went farthest, pins apart
};

Ways ways_between(const pliant::Mesh& mesh, const pliant::Positions& drawn, const pliant::Positions& released) {
  const Eigen::VectorXd ways = (released - drawn).rowwise().norm();
  Ways result{.pulled = ways[pulled_vertex]};
  for (const pliant::Edge& edge : pliant::boundary_edges(mesh)) {
    for (const pliant::Index vertex : edge) result.border = std::max(result.border, ways[vertex]);
  }
  return result;
}

Plot wrinkle_plot() {
  return {.title = "Wrinkles",
          .caption = "∫‖Δq‖² while the force draws and after it; the stiffer the sheet in bending, the fewer wrinkles.",
          .x = {.label = "frame"},
          .y = {.label = "∫‖Δq‖² dA", .is_logarithmic = true},
          .series = {},
          .guides = {{release, "force ends", true}}};
}

auto border_claim(const std::array<Ways, bendings.size()>& ways) {
  return claim(
      fmt::format("{} frames after the force has ended, as in the pictures here, the border has moved, by more than a "
                  "tenth of the way of the vertex that was pulled",
                  shortly_after),
      "", ways[0].border > 0.1 * ways[0].pulled,
      fmt::format("without bending that vertex is {:.1f} cm from where the force would have it, and the border up to "
                  "{:.1f} cm, with 100 N m {:.1f} and {:.1f} cm. That a disturbance has not yet come to the edges, as "
                  "Fig. 6.7 has it at the right, is "
                  "tried in “The wave after a release”",
                  100 * ways[0].pulled, 100 * ways[0].border, 100 * ways[3].pulled, 100 * ways[3].border));
}

}  // namespace

Chapter run_sheet_metal(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question =
      "The middle of a sheet of 16 x 16 vertices that hangs by two corners is drawn by 4000 N for 120 frames, with a "
      "bending of 0, 1, 10 and 100 N m (edges of 5e4 N/m, 20 iterations). How much does it wrinkle? Measured is the "
      "square of its mean curvature vector over its area, ∫‖Δq‖².";
  const std::array<double, 4> known = {142, 79, 22, 5.3};
  CurvatureMeter meter(context, "sheet_metal/curtain");
  Comparison comparison(0.1);
  Plot plot = wrinkle_plot();
  std::vector<double> at_release;
  std::vector<pliant_render::Image> pictures;
  std::array<Ways, bendings.size()> ways;
  for (std::size_t i = 0; i < bendings.size(); ++i) {
    context.say(fmt::format("bending of {} N m", bendings[i]));
    pliant::Scene scene = scene_of(context, bendings[i]);
    pliant::Scene drawn_on = scene_of(context, bendings[i]);
    drawn_on.simulation.replace(drawn_on.simulation.find_force("pull").value(), endless_pull(drawn_on.simulation));
    pliant_report::Series series{.name = fmt::format("{} N m", bendings[i])};
    for (std::int64_t frame = 1; frame <= 240; ++frame) {
      context.step(scene);
      series.x.push_back(static_cast<double>(frame));
      series.y.push_back(meter.measure(scene.simulation));
      if (frame == release) at_release.push_back(series.y.back());
      if (frame <= release + shortly_after) context.step(drawn_on);
      if (frame == release + shortly_after) {
        ways[i] = ways_between(scene.simulation.bodies()[0].mesh, drawn_on.simulation.state().positions,
                               scene.simulation.state().positions);
      }
      const bool is_end = bendings[i] == 0 || bendings[i] == 100;
      if (is_end && (frame == release || frame == release + shortly_after)) pictures.push_back(context.picture(scene));
    }
    comparison.add(fmt::format("bending of {} N m, frame 120", bendings[i]), at_release.back(), known[i]);
    plot.series.push_back(std::move(series));
  }
  const bool falls = std::ranges::is_sorted(at_release, std::greater<>());
  chapter.claims.push_back(
      claim("With bending constraints the sheet does not wrinkle and resembles sheet metal", "thesis, Sec. 6.3",
            falls && at_release.front() > 10 * at_release.back(),
            fmt::format("∫‖Δq‖² at the end of the force falls as {:.3g}, {:.3g}, {:.3g}, {:.3g} with 0, 1, 10, 100 N m",
                        at_release[0], at_release[1], at_release[2], at_release[3])));
  chapter.claims.push_back(border_claim(ways));
  chapter.claims.push_back(comparison.claim("The figures are those of an independent solver, within 10 %"));
  context.show(
      chapter, pictures, 2,
      fmt::format("Left at the end of the force, right {} frames later; after Fig. 6.7 of the thesis. Above without "
                  "bending: folds run from the middle to the corners, and the border is up to {:.1f} cm from where "
                  "the force would have it; below with 100 N m.",
                  shortly_after, 100 * ways[0].border));
  chapter.blocks.emplace_back(std::move(plot));
  chapter.blocks.emplace_back(comparison.table("∫‖Δq‖² at the end of the force, frame 120."));
  return chapter;
}

}  // namespace pliant_experiments
