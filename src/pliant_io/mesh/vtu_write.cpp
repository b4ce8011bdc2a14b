#include <set>
#include <string>
#include <vector>

#include "pliant_io/mesh/detail/mesh_output.h"
#include "pliant_io/mesh/detail/vtu_output.h"
#include "pliant_io/mesh/vtk.h"

namespace pliant {

void write_vtu(const std::filesystem::path& path, const Mesh& mesh, const Positions& positions) {
  check_positions(path, mesh, positions);
  VtuCells cells;
  cells.add(mesh, 0);
  std::vector<VtuArray> maps;
  std::set<std::string> names;  // XML cannot hold all characters, so that two may become one
  for (const VertexMap& map : mesh.maps) {
    if (!names.insert(xml_attribute_text(map.name)).second) continue;
    maps.push_back(vtu_array(map.name, 1, std::span<const Real>(map.values)));
  }
  const std::string element = cells.element();
  write_vtu_file(path, positions, {element, cells.count()}, maps);
}

}  // namespace pliant
