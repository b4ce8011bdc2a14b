#include "pliant_io/mesh/detail/tetrahedra.h"

#include <string>

#include <fmt/format.h>

#include "pliant/mesh/geometry.h"

namespace pliant {

std::string add_tetrahedron(Mesh& mesh, Tetrahedron tetrahedron, std::int64_t first_number) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (tetrahedron[i] != tetrahedron[j]) continue;
      return fmt::format("a tetrahedron with point {} at two corners; remove it", tetrahedron[i] + first_number);
    }
  }
  const auto volume = [&x = mesh.vertices](const Tetrahedron& t) {
    return tetrahedron_volume(row(x, t[0]), row(x, t[1]), row(x, t[2]), row(x, t[3]));
  };
  const Tetrahedron swapped = {tetrahedron[0], tetrahedron[1], tetrahedron[3], tetrahedron[2]};
  // Rounding makes both negative where there is hardly a volume: then the order stays, however often it is read.
  const bool is_inverted = volume(tetrahedron) < 0 && volume(swapped) > 0;
  mesh.tetrahedra.push_back(is_inverted ? swapped : tetrahedron);
  return {};
}

void keep_highest_dimension(Mesh& mesh) {
  if (!mesh.tetrahedra.empty()) {
    mesh.triangles = {};
    mesh.faces = {};
  }
  if (!mesh.tetrahedra.empty() || !mesh.triangles.empty()) mesh.edges = {};
}

}  // namespace pliant
