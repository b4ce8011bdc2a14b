#include "pliant/constraints/edge_rest.h"

#include <cmath>

#include "pliant/constraints/build.h"
#include "pliant/core/error.h"
#include "pliant/mesh/topology.h"

namespace pliant {

Stencils mesh_edges(const BodyView& body) {
  return to_stencils(unique_edges(body.rest));
}

std::vector<Real> rest_lengths(std::string_view type, const BodyView& body, const Stencils& edges,
                               const Values& option) {
  const Values given = of_stencils(type, body, "rest_length", option, edges);
  std::vector<Real> lengths;
  lengths.reserve(static_cast<std::size_t>(edges.size()));
  for (Index i = 0; i < edges.size(); ++i) {
    // The same sums as in the projection, so that an edge at rest has a force of exactly zero.
    const Vec3 e = row(body.rest.vertices, edges[i][1]) - row(body.rest.vertices, edges[i][0]);
    const Real length = given.empty() ? std::sqrt(e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) : given[i];
    if (!(length > 0) || !std::isfinite(length)) {
      fail_input(std::string(type) + " on body '" + std::string(body.name) + "': edge " + std::to_string(i) + " (" +
                 std::to_string(edges[i][0]) + ", " + std::to_string(edges[i][1]) +
                 ") has no positive rest length; give it one, or leave it out");
    }
    lengths.push_back(length);
  }
  return lengths;
}

}  // namespace pliant
