#include <string>

#include <fmt/format.h>

#include "pliant/mesh/geometry.h"
#include "pliant/mesh/io/detail/readers.h"

namespace pliant {

std::string add_tetrahedron(Mesh& mesh, Tetrahedron tetrahedron, std::int64_t first_number) {
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (tetrahedron[i] != tetrahedron[j]) continue;
      return fmt::format("a tetrahedron with point {} at two corners; remove it", tetrahedron[i] + first_number);
    }
  }
  const auto& [a, b, c, d] = tetrahedron;
  const Positions& x = mesh.vertices;
  if (tetrahedron_volume(row(x, a), row(x, b), row(x, c), row(x, d)) < 0) std::swap(tetrahedron[2], tetrahedron[3]);
  mesh.tetrahedra.push_back(tetrahedron);
  return {};
}

}  // namespace pliant
