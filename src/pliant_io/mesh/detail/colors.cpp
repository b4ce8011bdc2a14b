#include "pliant_io/mesh/detail/colors.h"

#include <algorithm>
#include <cmath>

namespace pliant {

ColorMaps::ColorMaps(const Mesh& mesh) {
  for (const std::string_view name : color_names) {
    const auto map = std::ranges::find(mesh.maps, name, &VertexMap::name);
    if (map == mesh.maps.end() || map->values.size() != static_cast<std::size_t>(mesh.vertex_count())) break;
    channels[count++] = &*map;
  }
  if (count < 3) count = 0;
  Real largest = 0;
  bool are_whole = count > 0;
  for (std::size_t k = 0; k < count; ++k) {
    for (const Real value : channels[k]->values) {
      are_whole = are_whole && value >= 0 && value <= 255 && value == std::floor(value);
      largest = std::max(largest, value);
    }
  }
  are_bytes = are_whole && largest > 1;
}

}  // namespace pliant
