#include "crossing_texts.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "pliant/simulation/held.h"

namespace pliant_cli {
namespace {

using pliant::Crossing;
using pliant::Index;
using pliant::Triangle;

/// All surfaces of a simulation, one after another.
struct AllSurfaces {
  std::vector<CrossingBody> bodies;
  std::vector<Triangle> triangles;
  std::vector<pliant::Edge> edges;  ///< of ropes and the like, where surfaces touch
  std::vector<bool> is_held = {};   ///< of each body, as a whole
};

AllSurfaces surfaces_of(const pliant::Simulation& simulation) {
  AllSurfaces all;
  const std::vector<char> held = pliant::held_vertices(simulation);
  for (const pliant::Body& body : simulation.bodies()) {
    all.is_held.push_back(pliant::is_held(body, held));
    all.bodies.push_back({body.name, body.first_vertex, pliant::count_of(all.triangles), body.mesh.triangles.empty()});
    for (const auto& [a, b, c] : pliant::surface_triangles(body.mesh)) {
      all.triangles.push_back({a + body.first_vertex, b + body.first_vertex, c + body.first_vertex});
    }
    if (!simulation.contact().surfaces) continue;
    for (const auto& [a, b] : body.mesh.edges) all.edges.push_back({a + body.first_vertex, b + body.first_vertex});
  }
  return all;
}

/// The first crossing of a body with itself or of two bodies, and how many there are.
struct BodyCrossings {
  std::int64_t count = 0;
  Crossing first;
};

/// Whether surfaces touch, but not these two.
bool is_meant_to_cross(const pliant::Simulation& simulation, std::size_t a, std::size_t b) {
  if (!simulation.contact().surfaces) return false;
  const auto ignores = [&](std::size_t one, std::size_t other) {
    const std::vector<pliant::BodyId>& ignored = simulation.bodies()[one].contact.ignores;
    return std::ranges::find(ignored, pliant::BodyId{static_cast<Index>(other)}) != ignored.end();
  };
  return a == b ? !simulation.bodies()[a].contact.self : ignores(a, b) || ignores(b, a);
}

/// Whether the triangle at a crossing's edge has a number in its body.
bool has_triangle(const CrossingBody& body, const Crossing& crossing) {
  return !body.is_solid && crossing.edge_triangles[0] >= 0;
}

auto place_in_list(const Crossing& crossing) {
  return std::tuple(crossing.edge, crossing.triangle);
}

/// What is held as a whole meets nothing else that is.
std::string harm_text(const AllSurfaces& all, std::size_t a, std::size_t b) {
  if (!all.is_held[a] || !all.is_held[b]) return "";
  return a == b ? "; all of it is held, so that does no harm" : "; both are held, so that does no harm";
}

std::string warning_text(const AllSurfaces& all, std::size_t edge_body, std::size_t triangle_body,
                         const BodyCrossings& crossings) {
  const Crossing& first = crossings.first;
  const CrossingBody& edges = all.bodies[edge_body];
  const std::string end = fmt::format("at {}{}{}", place_text(first.point), more_text(crossings.count),
                                      harm_text(all, edge_body, triangle_body));
  if (edge_body == triangle_body) {
    return fmt::format("'{}' crosses itself: {}, {}", edges.name, both_sides_text(edges, first, all.triangles), end);
  }
  const CrossingBody& triangles = all.bodies[triangle_body];
  std::string one = fmt::format("{} of '{}'", edge_side_text(edges, first), edges.name);
  std::string other = fmt::format("{} of '{}'", triangle_side_text(triangles, first, all.triangles), triangles.name);
  if (edge_body > triangle_body) std::swap(one, other);
  return fmt::format("'{}' crosses '{}': {}, {}, {}", all.bodies[std::min(edge_body, triangle_body)].name,
                     all.bodies[std::max(edge_body, triangle_body)].name, one, other, end);
}

}  // namespace

std::string edge_side_text(const CrossingBody& body, const Crossing& crossing) {
  if (has_triangle(body, crossing)) {
    return fmt::format("triangle {}", crossing.edge_triangles[0] - body.first_triangle);
  }
  return fmt::format("edge {}-{}", crossing.edge[0] - body.first_vertex, crossing.edge[1] - body.first_vertex);
}

std::string triangle_side_text(const CrossingBody& body, const Crossing& crossing,
                               std::span<const Triangle> triangles) {
  if (!body.is_solid) return fmt::format("triangle {}", crossing.triangle - body.first_triangle);
  const auto& [a, b, c] = triangles[pliant::at(crossing.triangle)];
  return fmt::format("face {}-{}-{}", a - body.first_vertex, b - body.first_vertex, c - body.first_vertex);
}

std::string both_sides_text(const CrossingBody& body, const Crossing& crossing, std::span<const Triangle> triangles) {
  if (!has_triangle(body, crossing)) {
    return fmt::format("{} and {}", edge_side_text(body, crossing), triangle_side_text(body, crossing, triangles));
  }
  return fmt::format("triangles {} and {}", crossing.edge_triangles[0] - body.first_triangle,
                     crossing.triangle - body.first_triangle);
}

std::string place_text(const pliant::Vec3& point) {
  const pliant::Vec3 x = point.array() + 0.0;  // no −0
  return fmt::format("({:.4g}, {:.4g}, {:.4g}) m", x[0], x[1], x[2]);
}

std::string more_text(std::int64_t count) {
  return count > 1 ? fmt::format(" (and {} more)", count - 1) : std::string();
}

std::vector<std::string> crossing_warnings(const pliant::Simulation& simulation) {
  const AllSurfaces all = surfaces_of(simulation);
  const auto body_of = [&](Index vertex) {
    const auto next = std::ranges::upper_bound(all.bodies, vertex, {}, &CrossingBody::first_vertex);
    return static_cast<std::size_t>(next - all.bodies.begin()) - 1;
  };
  const auto bodies_of = [&](const Crossing& crossing) {
    return std::pair(body_of(crossing.edge[0]), body_of(all.triangles[pliant::at(crossing.triangle)][0]));
  };
  std::map<std::pair<std::size_t, std::size_t>, BodyCrossings> found;  // by the bodies, the lower first
  const pliant::Positions& positions = simulation.state().positions;
  const auto note = [&](const Crossing& crossing) {
    const std::pair<std::size_t, std::size_t> bodies = bodies_of(crossing);
    if (is_meant_to_cross(simulation, bodies.first, bodies.second)) return;
    BodyCrossings& entry = found[std::minmax(bodies.first, bodies.second)];
    if (entry.count++ == 0 || place_in_list(crossing) < place_in_list(entry.first)) entry.first = crossing;
  };
  const bool is_complete = may_be_surface(all.triangles.size(), simulation.state().vertex_count()) &&
                           pliant::visit_crossings({.positions = positions,
                                                    .triangles = all.triangles,
                                                    .edges = all.edges,
                                                    .most_effort = pliant::usual_crossing_effort(all.triangles.size())},
                                                   note);
  constexpr std::size_t shown = 5;
  std::vector<std::string> warnings;
  for (const auto& [key, crossings] : found) {
    if (warnings.size() == shown) {
      warnings.push_back(fmt::format("and {} more bodies or pairs of bodies that cross", found.size() - shown));
      break;
    }
    const auto [edge_body, triangle_body] = bodies_of(crossings.first);
    warnings.push_back(warning_text(all, edge_body, triangle_body, crossings));
  }
  if (!is_complete) warnings.push_back(fmt::format("crossings: {}", incomplete_search));
  return warnings;
}

}  // namespace pliant_cli
