#include "pliant/simulation/held.h"

#include <algorithm>

namespace pliant {

std::vector<char> held_vertices(const Simulation& simulation) {
  std::vector<char> held(simulation.state().masses.size(), 0);
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) {
      for (const Index vertex : batch->pinned_vertices()) held[at(vertex)] = 1;
    }
  }
  return held;
}

std::vector<Index> vertices_of_pins(const Group& group) {
  std::vector<Index> vertices;
  for (const auto& batch : group.set.batches) {
    for (const std::span<const Index> some : {batch->pinned_vertices(), batch->stencil()}) {
      vertices.insert(vertices.end(), some.begin(), some.end());
    }
  }
  return vertices;
}

bool is_held(const Body& body, const std::vector<char>& held) {
  const auto first = held.begin() + body.first_vertex;
  return std::all_of(first, first + body.mesh.vertex_count(), [](char each) { return each != 0; });
}

}  // namespace pliant
