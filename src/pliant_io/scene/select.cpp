#include "pliant_io/scene/select.h"

#include "pliant_io/scene/detail/selection.h"

namespace pliant {

Selection select(std::string_view json, const Mesh& mesh, std::string_view name) {
  const Origin origin{.name = std::string(name)};
  const Document document(parse_json(json, name), {.origin = &origin});
  std::optional<NearestVertex> index;
  return read_selection(Node(document), {mesh, mesh.vertices, index});
}

}  // namespace pliant
