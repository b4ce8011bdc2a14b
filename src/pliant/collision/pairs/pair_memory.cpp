#include "pliant/collision/pairs/pair_memory.h"

namespace pliant {

std::array<Index, 2> vertices_of(const PairMemory& pair, const Surface& surface) {
  const auto one_of = [](const auto& features, Index number) {
    return number < count_of(features) ? features[at(number)][0] : -1;
  };
  const auto vertex = [&](Index number) {
    return number < count_of(surface.vertices) ? surface.vertices[at(number)] : -1;
  };
  const auto [first, second] = pair.features;
  return {pair.kind == PairKind::edge_edge ? one_of(surface.edges, first) : vertex(first),
          pair.kind == PairKind::vertex_triangle ? one_of(surface.triangles, second) : one_of(surface.edges, second)};
}

}  // namespace pliant
