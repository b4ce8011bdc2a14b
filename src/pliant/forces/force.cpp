#include "pliant/forces/force.h"

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/forces/force_options.h"

namespace pliant {

std::optional<Index> Force::vertex_out_of_range(Index) const {
  return std::nullopt;
}

Real Force::potential(const StateView&) const {
  return 0;
}

std::optional<std::string> Force::warning(const StateView&, Real) const {
  return std::nullopt;
}

const ForceBody& only_body(std::string_view type, const ForceScope& scope) {
  if (scope.bodies.size() != 1) {
    fail_input(fmt::format("{}: it acts on one body and there are {}; name the body", type, scope.bodies.size()));
  }
  return scope.bodies.front();
}

std::vector<Index> selected_vertices(std::string_view type, const ForceScope& scope, const Selection& on) {
  const ForceBody& body = only_body(type, scope);
  const Index count = body.rest.vertex_count();
  std::vector<Index> vertices = on.vertices;
  for (Index i = 0; on.everything && i < count; ++i) vertices.push_back(i);
  for (Index& vertex : vertices) {
    if (vertex < 0 || vertex >= count) {
      fail_input(fmt::format("{}: vertex {} is out of range; body '{}' has vertices 0 to {}", type, vertex, body.name,
                             count - 1));
    }
    vertex += body.first_vertex;
  }
  return vertices;
}

}  // namespace pliant
