#include "pliant/constraints/edge_strain.h"

#include "pliant/constraints/build.h"
#include "pliant/constraints/edge_rest.h"
#include "pliant/core/error.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/topology.h"

namespace pliant {
namespace {

/// A third of the area of the triangles at each stencil [m²]; zero where it is no edge of a triangle.
std::vector<Real> adjacent_areas(const BodyView& body, const Stencils& edges) {
  const EdgeTriangles adjacency = edge_triangles(body.rest);
  const std::vector<Real> areas = triangle_areas(body.rest.vertices, body.rest.triangles);
  std::vector<Real> result;
  result.reserve(static_cast<std::size_t>(edges.size()));
  for (Index i = 0; i < edges.size(); ++i) {
    const Edge edge = {std::min(edges[i][0], edges[i][1]), std::max(edges[i][0], edges[i][1])};
    const auto found = std::lower_bound(adjacency.edges.begin(), adjacency.edges.end(), edge);
    Real area = 0;
    if (found != adjacency.edges.end() && *found == edge) {
      for (const Index t : adjacency.triangles_of(static_cast<Index>(found - adjacency.edges.begin()))) {
        area += areas[static_cast<std::size_t>(t)] / 3;
      }
    }
    result.push_back(area);
  }
  return result;
}

}  // namespace

ConstraintSet build(const BodyView& body, const EdgeStrain& options) {
  constexpr std::string_view type = EdgeStrain::info.name;
  const Stencils chosen = choose_stencils(
      type, body, options.on, options.stencils, [&] { return mesh_edges(body); }, 2);
  const Limits limits(type, body, "stretch", options.min_stretch, options.max_stretch, chosen);
  const std::vector<Real> rest_length = rest_lengths(type, body, chosen, options.rest_length);
  const std::vector<Real> measure = options.measure == FibreMeasure::rope ? rest_length : adjacent_areas(body, chosen);

  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  auto batch = std::make_unique<Batch<EdgeStrainProjection>>(stiffness.common());
  for (Index i = 0; i < chosen.size(); ++i) {
    const auto c = static_cast<std::size_t>(i);
    if (!(measure[c] > 0)) {
      fail_input("edge_strain on body '" + std::string(body.name) + "': edge " + std::to_string(i) +
                 " belongs to no triangle, so it has no area; use measure `rope` for it");
    }
    const Real inverse = 1 / rest_length[c];
    const std::array<Real, 2> difference = {-inverse, inverse};
    batch->add(global_stencil(body, chosen[i]), difference, stiffness.of(i) * measure[c], limits[i]);
  }
  return one_batch(std::move(batch));
}

}  // namespace pliant
