#include "pliant/simulation/divergence_message.h"

#include <algorithm>
#include <tuple>

#include <fmt/format.h>

#include "pliant/simulation/simulation.h"
#include "pliant/solver/constraint_rows.h"

namespace pliant {
namespace {

/// That a vertex of the simulation belongs to.
const Body& body_of(const Simulation& simulation, Index vertex) {
  const auto after = std::ranges::upper_bound(simulation.bodies(), vertex, {}, &Body::first_vertex);
  return *std::prev(after);
}

std::string vertex_words(const Simulation& simulation, Index vertex) {
  const Body& body = body_of(simulation, vertex);
  return fmt::format("vertex {} of '{}'", vertex - body.first_vertex, body.name);
}

/// The index of the element that has these vertices, in ascending order, or -1.
template <class Element>
Index find_element(const std::vector<Element>& elements, const std::vector<Index>& vertices) {
  if (std::tuple_size_v<Element> != vertices.size()) return -1;
  const auto found = std::ranges::find_if(elements, [&](Element element) {
    std::ranges::sort(element);
    return std::ranges::equal(element, vertices);
  });
  return found == elements.end() ? -1 : static_cast<Index>(found - elements.begin());
}

/// What a constraint is on: an element of the mesh by its number, else its vertices. They may be of other bodies.
std::string element_words(const Body& body, std::span<const Index> stencil) {
  std::vector<Index> vertices(stencil.begin(), stencil.end());
  for (Index& vertex : vertices) vertex -= body.first_vertex;
  std::vector<Index> sorted = vertices;
  std::ranges::sort(sorted);
  if (const Index i = find_element(body.mesh.tetrahedra, sorted); i >= 0) return fmt::format("tetrahedron {}", i);
  if (const Index i = find_element(body.mesh.triangles, sorted); i >= 0) return fmt::format("triangle {}", i);
  if (const Index i = find_element(body.mesh.edges, sorted); i >= 0) return fmt::format("edge {}", i);
  if (vertices.size() == 1) return fmt::format("vertex {}", vertices[0]);
  if (vertices.size() == 2) return fmt::format("the edge from vertex {} to vertex {}", vertices[0], vertices[1]);
  constexpr std::size_t most_shown = 4;
  const bool is_long = vertices.size() > most_shown;
  if (is_long) vertices.resize(most_shown);
  return fmt::format("vertices {}{}", fmt::join(vertices, ", "), is_long ? " and others" : "");
}

std::string constraint_words(const Simulation& simulation, const DivergenceCause& cause) {
  const std::span<const Index> stencil = stencil_of(*cause.group, at(cause.constraint));
  for (const auto& [id, group] : simulation.groups()) {
    const auto is_it = [&](const auto& batch) { return batch.get() == cause.group; };
    if (std::ranges::none_of(group.set.batches, is_it)) continue;
    const Body& body = body_of(simulation, stencil.front());
    return fmt::format("the {} constraint of '{}' on {} of '{}'", group.type, group.name, element_words(body, stencil),
                       body.name);
  }
  return fmt::format("constraint {} of type {}", cause.constraint, cause.group->type());
}

std::string force_words(const Simulation& simulation, const Force* searched) {
  for (const auto& [id, force] : simulation.forces()) {
    if (force.get() == searched) return fmt::format("the force '{}'", simulation.name(id));
  }
  return fmt::format("the force '{}'", searched->type());
}

}  // namespace

std::string message_of(const DivergenceCause& cause, const Simulation& simulation) {
  return message_of(cause, vertex_words(simulation, cause.vertex),
                    cause.force == nullptr ? "" : force_words(simulation, cause.force),
                    cause.group == nullptr ? "" : constraint_words(simulation, cause));
}

}  // namespace pliant
