#include "pliant_io/mesh/detail/mesh_output.h"
#include "pliant_io/mesh/detail/vtu_output.h"
#include "pliant_io/mesh/vtk.h"

namespace pliant {

void write_vtu(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  check_positions(path, mesh, positions);
  VtuCells cells;
  cells.add(mesh, 0);
  std::vector<VtuArray> maps;
  for (const VertexMap& map : mesh.maps) maps.push_back(vtu_array(map.name, 1, std::span<const Real>(map.values)));
  const std::string element = cells.element();
  write_vtu_file(path, positions, {element, cells.count()}, maps);
}

}  // namespace pliant
