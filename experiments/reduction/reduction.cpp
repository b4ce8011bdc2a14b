#include "reduction/reduction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

#include "pliant/constraints/edge_spring.h"
#include "pliant/mesh/topology.h"
#include "support/claims.h"

namespace pliant_experiments {
namespace {

using pliant::choice_names, pliant::EdgeReduction;
using pliant::Index;
using pliant::Vec3;
using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Series;

constexpr std::array<EdgeReduction, 2> reductions = {EdgeReduction::difference, EdgeReduction::identity};
constexpr std::array<Index, 5> counts_of_spread = {1, 2, 3, 5, 8};
constexpr std::array<Index, 12> counts_of_error = {1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000};
constexpr Index until_the_limit = 10000;
constexpr double same_limit = 1e-9;  // [m]
constexpr double moved = 1e-13;      // [m]: far above rounding of positions of a meter
constexpr double bound = 0.1;        // of the way of the step
constexpr double slower = 5;

const char* name_of(EdgeReduction reduction) {
  return reduction == EdgeReduction::difference ? "A = S, the difference" : "A = I, the identity";
}

pliant::Scene sheet_of(const ExperimentContext& context, EdgeReduction reduction, Index iterations, const char* start) {
  return context.scene("reduction/curtain",
                       {fmt::format("bodies[sheet].constraints[threads].reduction={}",
                                    choice_names(reduction)[static_cast<std::size_t>(reduction)]),
                        fmt::format("settings.iterations={}", iterations), fmt::format("settings.start={}", start)});
}

/// Edges from the held corner to each vertex.
std::vector<Index> edges_from_corner(const pliant::Mesh& mesh) {
  const std::vector<pliant::Edge> edges = pliant::unique_edges(mesh);
  std::vector<Index> distance(static_cast<std::size_t>(mesh.vertex_count()), mesh.vertex_count());
  distance[0] = 0;
  for (bool changes = true; changes;) {
    changes = false;
    for (const pliant::Edge& edge : edges) {
      for (const auto& [from, to] : {std::pair{edge[0], edge[1]}, std::pair{edge[1], edge[0]}}) {
        Index& far = distance[static_cast<std::size_t>(to)];
        const Index by_edge = distance[static_cast<std::size_t>(from)] + 1;
        if (by_edge < far) {
          far = by_edge;
          changes = true;
        }
      }
    }
  }
  return distance;
}

/// By a centimeter, in the plane of the sheet and out of it.
void move_corner(pliant::Simulation& simulation) {
  const pliant::GroupId corner = simulation.find_group("corner").value();
  simulation.set_target(corner, 0, simulation.target(corner, 0) + Vec3(0.006, 0.008, 0));
}

/// The sheet at rest whose corner is moved: by how much each ring of vertices, as many edges from the corner, moves in
/// one step [m].
std::vector<double> rings_moved(const ExperimentContext& context, EdgeReduction reduction, Index iterations) {
  pliant::Scene scene = sheet_of(context, reduction, iterations, "positions");
  pliant::Simulation& simulation = scene.simulation;
  const pliant::Positions before = simulation.state().positions;
  move_corner(simulation);
  context.step(scene);
  const std::vector<Index> distances = edges_from_corner(simulation.bodies()[0].mesh);
  std::vector<double> rings(static_cast<std::size_t>(*std::ranges::max_element(distances)) + 1, 0);
  for (std::size_t i = 0; i < distances.size(); ++i) {
    double& ring = rings[static_cast<std::size_t>(distances[i])];
    const auto vertex = static_cast<Eigen::Index>(i);
    ring = std::max(ring, (simulation.state().positions.row(vertex) - before.row(vertex)).norm());
  }
  return rings;
}

Index rings_reached(const std::vector<double>& rings) {
  Index reached = 0;
  for (std::size_t i = 0; i < rings.size(); ++i) reached = rings[i] > moved ? static_cast<Index>(i) : reached;
  return reached;
}

/// The sheet without its pin, thrown at 1 m/s, and stirred by a tenth of that: its step begins at the last positions.
pliant::Scene thrown_sheet(const ExperimentContext& context, EdgeReduction reduction, Index iterations) {
  pliant::Scene scene = sheet_of(context, reduction, iterations, "positions");
  context.disturb(scene);
  scene.simulation.remove(scene.simulation.find_group("corner").value());
  const pliant::Positions x = scene.simulation.state().positions;
  pliant::Positions velocities(x.rows(), 3);
  for (Eigen::Index i = 0; i < x.rows(); ++i) {
    velocities.row(i) << 1 + 0.1 * std::sin(9 * x(i, 2)), 0.1 * std::cos(7 * x(i, 0)), 0.1 * std::sin(5 * x(i, 0) + 2);
  }
  scene.simulation.set_state(x, velocities);
  return scene;
}

pliant::Positions next_positions(const ExperimentContext& context, EdgeReduction reduction, Index iterations) {
  pliant::Scene scene = thrown_sheet(context, reduction, iterations);
  context.step(scene);
  return scene.simulation.state().positions;
}

double farthest(const pliant::Positions& a, const pliant::Positions& b) {
  return (a - b).rowwise().norm().maxCoeff();
}

void measure_spreading(const ExperimentContext& context, Chapter& chapter) {
  context.say("how far a change gets");
  Plot plot{.title = "How far a change gets in one step",
            .caption =
                "The corner of a sheet at rest is moved aside: by how much the vertices move in one step, over "
                "the number of edges between them and the corner. With A = I the system matrix is diagonal, and "
                "each iteration hands a change on by one edge.",
            .x = {.label = "edges from the corner"},
            .y = {.label = "way [m]", .is_logarithmic = true, .min = 1e-13},
            .series = {}};
  std::map<EdgeReduction, std::map<Index, Index>> reached;
  Index rings_of_sheet = 0;
  for (const EdgeReduction reduction : reductions) {
    for (const Index count : counts_of_spread) {
      const std::vector<double> rings = rings_moved(context, reduction, count);
      reached[reduction][count] = rings_reached(rings);
      rings_of_sheet = static_cast<Index>(rings.size()) - 1;
      if (count != 1 && count != 3 && count != 8) continue;
      Series series{.name = fmt::format("{}, iterations: {}", name_of(reduction), count),
                    .mark = pliant_report::Mark::line_and_points,
                    .is_dashed = reduction == EdgeReduction::identity};
      for (std::size_t i = 0; i < rings.size(); ++i) {
        series.x.push_back(static_cast<double>(i));
        series.y.push_back(rings[i] > moved ? rings[i] : std::nan(""));
      }
      plot.series.push_back(std::move(series));
    }
  }
  const auto& by_identity = reached.at(EdgeReduction::identity);
  const bool goes_by_edges =
      std::ranges::all_of(by_identity, [](const auto& each) { return each.second == each.first; });
  const Index at_once = reached.at(EdgeReduction::difference).at(1);
  chapter.claims.push_back(
      claim("With A = I changes spread only slowly: by one edge an iteration", "thesis, Sec. 4.4.3",
            goes_by_edges && at_once == rings_of_sheet,
            fmt::format("with A = I the change has come {}, {}, {}, {} and {} edges far after 1, 2, 3, 5 and 8 "
                        "iterations; with A = S {} after one, which is the whole sheet ({} edges)",
                        by_identity.at(1), by_identity.at(2), by_identity.at(3), by_identity.at(5), by_identity.at(8),
                        at_once, rings_of_sheet)));
  chapter.blocks.emplace_back(std::move(plot));
}

void measure_errors(const ExperimentContext& context, Chapter& chapter) {
  std::map<EdgeReduction, pliant::Positions> limits;
  for (const EdgeReduction reduction : reductions) {
    context.say(fmt::format("limit with {}", name_of(reduction)));
    limits[reduction] = next_positions(context, reduction, until_the_limit);
  }
  const double difference = farthest(limits.at(reductions[0]), limits.at(reductions[1]));
  Plot plot{.title = "Error of a step by its iterations",
            .caption = fmt::format("Distance of the vertex that is farthest from the converged step, of a free sheet "
                                   "that is thrown. Both come to the same step, within {:.1g} m after {} iterations.",
                                   difference, until_the_limit),
            .x = {.label = "iterations", .is_logarithmic = true},
            .y = {.label = "largest error of a vertex [m]", .is_logarithmic = true, .min = 1e-10},
            .series = {}};
  const pliant::Positions& limit = limits.at(EdgeReduction::difference);
  const double first =
      farthest(thrown_sheet(context, EdgeReduction::difference, 1).simulation.state().positions, limit);
  std::map<EdgeReduction, Index> needed;
  for (const EdgeReduction reduction : reductions) {
    Series series{.name = name_of(reduction), .mark = pliant_report::Mark::line_and_points};
    for (const Index count : counts_of_error) {
      const double error = farthest(next_positions(context, reduction, count), limit);
      series.x.push_back(count);
      series.y.push_back(error);
      if (error < bound * first && needed[reduction] == 0) needed[reduction] = count;
    }
    plot.series.push_back(std::move(series));
  }
  const Index with_difference = needed[EdgeReduction::difference];
  const Index with_identity = needed[EdgeReduction::identity];
  chapter.claims.push_back(claim("What they converge to is the same", "", difference < same_limit,
                                 fmt::format("after {} iterations of one step no vertex is farther than {:.1g} m from "
                                             "where it is with the other (asked for: {:.0e} m)",
                                             until_the_limit, difference, same_limit)));
  chapter.claims.push_back(
      claim("With A = S, which takes out translations, changes propagate much faster", "thesis, Sec. 4.4.3",
            with_difference > 0 && with_identity >= slower * with_difference,
            fmt::format("to {:.0f} % of the way of this step it takes {} iterations with A = S and {} with A = I, "
                        "of the numbers tried (asked for: {} times as many)",
                        100 * bound, with_difference, with_identity, slower)));
  chapter.blocks.emplace_back(std::move(plot));
}

}  // namespace

Chapter run_reduction(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question =
      "The matrices A = B of an edge may be the identity, so that both ends are projected by themselves, or take their "
      "difference, as those that the thesis prints (Eq. 4.3). Both have the same energy. How fast does a change spread "
      "through a sheet of 21 x 21 vertices of 10 g (edges of 1000 N/m, h = 1/60 s), and is what they converge to the "
      "same?";
  measure_spreading(context, chapter);
  measure_errors(context, chapter);
  return chapter;
}

}  // namespace pliant_experiments
