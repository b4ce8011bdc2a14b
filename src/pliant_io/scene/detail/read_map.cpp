#include "pliant_io/scene/detail/read_map.h"

#include <algorithm>

#include "pliant_io/mesh/vertex_map.h"
#include "pliant_io/scene/detail/json_values.h"
#include "pliant_io/scene/detail/scene_files.h"

namespace pliant {
namespace {

std::vector<Real> named_map(const Node& node, const Mesh& mesh) {
  std::string name;
  read(node, name);
  const auto found = std::ranges::find(mesh.maps, name, &VertexMap::name);
  if (found != mesh.maps.end()) return found->values;
  if (mesh.maps.empty()) node.fail("the mesh has no maps; read one of a file, or take a mesh from PLY that has some");
  std::vector<std::string_view> names;
  for (const VertexMap& map : mesh.maps) names.push_back(map.name);
  node.fail(fmt::format("unknown map '{}'; {}", printable(name), suggestion_text(name, names)));
}

}  // namespace

std::vector<Real> read_map(const Node& node, const Mesh& mesh) {
  node.check_keys({"name", "file"});
  const std::string_view key = node.require_one_of({"name", "file"});
  const Node source = node.require(key);
  if (key == "name") return named_map(source, mesh);
  const NamedFile file = read_named_file(source);
  std::vector<Real> values = source.locate([&] { return parse_vertex_map(file.bytes, file.path.string()); });
  if (values.size() != static_cast<std::size_t>(mesh.vertex_count())) {
    source.fail(fmt::format("{}: {} numbers for {} vertices; give one for each vertex",
                            printable_place(file.path.string()), values.size(), mesh.vertex_count()));
  }
  return values;
}

std::vector<Real> read_mapped_values(const Node& node, const Mesh& mesh) {
  node.check_keys({"map", "from", "to"});
  std::vector<Real> values = read_map(node.require("map"), mesh);
  if (!node.has("from") && !node.has("to")) return values;
  Real from = 0;
  Real to = 0;
  read(node.require("from"), from);
  read(node.require("to"), to);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (!(values[i] >= 0 && values[i] <= 1)) {
      node.fail(
          fmt::format("the map has {} at vertex {}; between 'from' and 'to' it must go from 0 to 1", values[i], i));
    }
    values[i] = (1 - values[i]) * from + values[i] * to;  // exactly from at 0 and to at 1
  }
  return values;
}

void check_mapped_range(const Node& node, const std::vector<Real>& values, const OptionInfo& info) {
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (const auto error = range_error(info, values[i])) node.fail(fmt::format("at vertex {}: {}", i, *error));
  }
}

}  // namespace pliant
