#include "contact/crossing_counts.h"

#include <algorithm>
#include <ctime>
#include <limits>

#include <fmt/format.h>

#include "pliant/collision/crossings.h"
#include "pliant/simulation/held.h"
#include "support/claims.h"
#include "support/statistics.h"

namespace pliant_experiments {
namespace {

using pliant::Index;
using pliant_report::Chapter;
using pliant_report::Table;

struct Played {
  std::string_view scene;
  Index frames;  // at 60 a second
};

/// Ropes cross no triangle that they do not have.
constexpr std::array<Played, 5> played = {
    {{"layers", 240}, {"twist", 300}, {"fold", 300}, {"pile", 300}, {"dress", 150}}};

/// What a run has come to.
struct Crossed {
  Index vertices = 0;
  Index frames = 0;       // in which something crosses
  std::int64_t most = 0;  // in a frame
  Index shortened = 0;    // moves
  double smallest_gap = std::numeric_limits<double>::infinity();
  double milliseconds = 0;  // of a step, of the processor, median
};

/// Of all bodies, one after another.
struct Features {
  std::vector<pliant::Triangle> triangles;
  std::vector<pliant::Edge> edges;

  explicit Features(const pliant::Simulation& simulation) {
    for (const pliant::Body& body : simulation.bodies()) {
      for (pliant::Triangle each : pliant::surface_triangles(body.mesh)) {
        for (Index& vertex : each) vertex += body.first_vertex;
        triangles.push_back(each);
      }
      for (pliant::Edge each : body.mesh.edges) {
        for (Index& vertex : each) vertex += body.first_vertex;
        edges.push_back(each);
      }
    }
  }
};

/// Edges that pass through a triangle. What is held may pass through itself: the limbs of a figure do.
std::int64_t count_crossings(const pliant::Simulation& simulation, const Features& features) {
  const std::vector<char> held = pliant::held_vertices(simulation);
  const auto is_held = [&](Index vertex) { return held[static_cast<std::size_t>(vertex)] != 0; };
  std::int64_t count = 0;
  pliant::visit_crossings(
      {simulation.state().positions, features.triangles, features.edges}, [&](const pliant::Crossing& crossing) {
        const pliant::Triangle& triangle = features.triangles[static_cast<std::size_t>(crossing.triangle)];
        if (!std::ranges::all_of(crossing.edge, is_held) || !std::ranges::all_of(triangle, is_held)) ++count;
      });
  return count;
}

Crossed play(const ExperimentContext& context, const Played& each, bool touches) {
  pliant::Scene scene = context.builtin_scene(
      each.scene, {"settings.threads=1", touches ? "contact.surfaces=true" : "contact.surfaces=false"});
  context.disturb(scene);
  const Features features(scene.simulation);
  Crossed result{.vertices = scene.simulation.state().vertex_count()};
  std::vector<double> milliseconds;
  for (Index i = 0; i < each.frames; ++i) {
    const std::clock_t begin = std::clock();
    const pliant::ContactReport contact = context.step(scene).contact;
    milliseconds.push_back(1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    const std::int64_t count = count_crossings(scene.simulation, features);
    result.frames += count > 0 ? 1 : 0;
    result.most = std::max(result.most, count);
    result.shortened += contact.shortened;
    result.smallest_gap = std::min(result.smallest_gap, contact.smallest_gap);
  }
  result.milliseconds = median(milliseconds);
  return result;
}

}  // namespace

void measure_crossings(const ExperimentContext& context, Chapter& chapter) {
  Table table{
      "Built-in scenes as they are, in which surfaces touch, and the same without: frames in which an edge passes "
      "through a triangle, by exact arithmetic, unless pins hold both, and the most such pairs of a frame; the "
      "smallest gap; moves that were "
      "shortened; milliseconds of the processor a step, median, on one thread.",
      {"scene", "vertices", "frames", "crossed", "most", "smallest gap [mm]", "shortened", "ms", "without: crossed",
       "most", "ms"},
      {}};
  Index crossed = 0, frames = 0, crossed_without = 0;
  for (const Played& each : played) {
    context.say(fmt::format("crossings, {}", each.scene));
    const Crossed with = play(context, each, true);
    const Crossed without = play(context, each, false);
    table.rows.push_back({std::string(each.scene), std::to_string(with.vertices), std::to_string(each.frames),
                          std::to_string(with.frames), std::to_string(with.most),
                          fmt::format("{:.2g}", 1e3 * with.smallest_gap), std::to_string(with.shortened),
                          fmt::format("{:.2f}", with.milliseconds), std::to_string(without.frames),
                          std::to_string(without.most), fmt::format("{:.2f}", without.milliseconds)});
    frames += each.frames;
    crossed += with.frames;
    crossed_without += without.frames > 0 ? 1 : 0;
  }
  chapter.claims.push_back(
      claim("Surfaces that touch never pass through each other or themselves, in any frame", "", crossed == 0,
            fmt::format("{} of {} frames of {} scenes have a crossing", crossed, frames, played.size())));
  chapter.claims.push_back(
      claim("Without contact between surfaces the same scenes do cross, so the count is no blind one", "",
            crossed_without == std::ssize(played), fmt::format("{} of {} scenes", crossed_without, played.size())));
  chapter.blocks.emplace_back(std::move(table));
}

}  // namespace pliant_experiments
