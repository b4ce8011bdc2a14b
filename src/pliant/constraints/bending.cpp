#include "pliant/constraints/bending.h"

#include "pliant/constraints/build.h"
#include "pliant/constraints/curvature.h"
#include "pliant/core/error.h"
#include "pliant/mesh/topology.h"

namespace pliant {
namespace {

struct Fan {
  std::vector<Real> cotangents;  // cot α + cot β of each neighbor
  Real area = 0;                 // mixed Voronoi area
};

/// The part of the triangle (center, a, b) that belongs to its center (Meyer et al. 2003, Fig. 4).
Real mixed_area(const Vec3& a, const Vec3& b, Real cot_a, Real cot_b) {
  const Real area = a.cross(b).norm() / 2;
  if (a.dot(b) < 0) return area / 2;
  if (cot_a < 0 || cot_b < 0) return area / 4;
  return (cot_b * a.squaredNorm() + cot_a * b.squaredNorm()) / 8;
}

Fan fan_of(const Positions& x, Index center, std::span<const Index> ring) {
  Fan fan;
  fan.cotangents.assign(ring.size(), 0);
  const Vec3 origin = row(x, center);
  for (std::size_t j = 0; j < ring.size(); ++j) {
    const std::size_t next = (j + 1) % ring.size();
    const Vec3 a = row(x, ring[j]) - origin;
    const Vec3 b = row(x, ring[next]) - origin;
    const Real twice_area = a.cross(b).norm();
    const Real cot_a = a.dot(a - b) / twice_area;  // the angle at ring[j], opposite the edge to ring[next]
    const Real cot_b = b.dot(b - a) / twice_area;
    fan.cotangents[next] += cot_a;
    fan.cotangents[j] += cot_b;
    fan.area += mixed_area(a, b, cot_a, cot_b);
  }
  return fan;
}

/// Adds the stencil [center, neighbors...] with v = 1/(2a) Σ cⱼ (xⱼ − x₀).
void add_fan(CurvatureBatches<SignedFanCurvature>& batches, std::span<const Index> stencil,
             std::span<const Real> cotangents, Real area, Real stiffness) {
  std::vector<Real> coefficients(stencil.size());
  for (std::size_t j = 1; j < stencil.size(); ++j) {
    coefficients[j] = cotangents[j - 1] / (2 * area);
    coefficients[0] -= coefficients[j];
  }
  batches.add(stencil, coefficients, stiffness * area);
}

ConstraintSet from_arrays(const BodyView& body, const Bending& options) {
  constexpr std::string_view type = Bending::info.name;
  const Index count = options.stencils.size();
  choose_stencils(
      type, body, options.on, options.stencils, [] { return Stencils(); }, 0);
  if (options.cotangents.size() != count || options.areas.empty()) {
    fail_input("bending: stencils need one list of cotangents each and areas; give both, or leave out the stencils");
  }
  const Values areas = of_stencils(type, body, "areas", options.areas, options.stencils);
  const StiffnessSplit stiffness(type, body, options.stiffness, options.stencils);
  CurvatureBatches<SignedFanCurvature> batches(type, body, options.orientation, stiffness.common());
  for (Index i = 0; i < count; ++i) {
    const std::span<const Index> stencil = options.stencils[i];
    if (stencil.size() < 2 || options.cotangents[i].size() + 1 != stencil.size()) {
      fail_input("bending: stencil " + std::to_string(i) + " has " + std::to_string(stencil.size()) + " vertices and " +
                 std::to_string(options.cotangents[i].size()) +
                 " cotangents; give the center, its neighbors, and one cotangent for each neighbor");
    }
    add_fan(batches, stencil, options.cotangents[i], areas[i], stiffness.of(i));
  }
  return batches.take();
}

std::string reasons(const VertexRings& rings) {
  return std::to_string(rings.boundary_vertex_count) + " on the boundary, " +
         std::to_string(rings.nonmanifold_vertex_count) + " non-manifold, " +
         std::to_string(rings.isolated_vertex_count) + " without triangles";
}

}  // namespace

ConstraintSet build(const BodyView& body, const Bending& options) {
  if (!options.stencils.empty()) return from_arrays(body, options);
  if (!options.cotangents.empty() || !options.areas.empty()) {
    fail_input("bending: cotangents and areas are given without stencils; give those as well, or neither");
  }
  constexpr std::string_view type = Bending::info.name;
  const VertexRings rings = vertex_rings(body.rest);
  Stencils candidates;
  std::vector<Index> stencil;
  for (Index r = 0; r < rings.ring_count(); ++r) {
    stencil.assign(1, rings.centers[static_cast<std::size_t>(r)]);
    stencil.insert(stencil.end(), rings.ring(r).begin(), rings.ring(r).end());
    candidates.add(stencil);
  }
  const Stencils chosen = choose_stencils(
      type, body, options.on, {}, [&] { return candidates; }, 0);
  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  CurvatureBatches<SignedFanCurvature> batches(type, body, options.orientation, stiffness.common());
  for (Index i = 0; i < chosen.size(); ++i) {
    const Fan fan = fan_of(body.rest.vertices, chosen[i][0], chosen[i].subspan(1));
    add_fan(batches, chosen[i], fan.cotangents, fan.area, stiffness.of(i));
  }
  ConstraintSet set = batches.take();
  set.skipped = rings.boundary_vertex_count + rings.nonmanifold_vertex_count + rings.isolated_vertex_count;
  set.skipped_reason = "vertices of the mesh: " + reasons(rings);
  return set;
}

}  // namespace pliant
