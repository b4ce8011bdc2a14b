#include "pliant/constraints/hinge.h"

#include "pliant/constraints/build.h"
#include "pliant/constraints/curvature.h"
#include "pliant/mesh/topology.h"

namespace pliant {
namespace {

struct RestHinge {
  std::array<Real, 4> coefficients;
  std::array<Real, 2> areas;  // of the two triangles
};

RestHinge rest_hinge(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  const Vec3 edge = x1 - x0;
  const auto cotangents = [&](const Vec3& opposite) {
    const Vec3 from0 = opposite - x0;
    const Vec3 from1 = opposite - x1;
    const Real twice_area = edge.cross(from0).norm();
    return std::array<Real, 3>{edge.dot(from0) / twice_area, -edge.dot(from1) / twice_area, twice_area / 2};
  };
  const auto [c02, c12, area0] = cotangents(x2);
  const auto [c03, c13, area1] = cotangents(x3);
  return {{c12 + c13, c02 + c03, -(c02 + c12), -(c03 + c13)}, {area0, area1}};
}

}  // namespace

ConstraintSet build(const BodyView& body, const HingeBending& options) {
  constexpr std::string_view type = HingeBending::info.name;
  const Hinges all = hinges(body.rest);
  const Stencils chosen = choose_stencils(
      type, body, options.on, options.stencils, [&] { return to_stencils(all.stencils); }, 4);
  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  CurvatureBatches<SignedHingeCurvature> batches(type, body, options.orientation, stiffness.common());
  for (Index i = 0; i < chosen.size(); ++i) {
    const auto corner = [&](std::size_t j) { return row(body.rest.vertices, chosen[i][j]); };
    const RestHinge rest = rest_hinge(corner(0), corner(1), corner(2), corner(3));
    for (const Real area : rest.areas) {
      check_rest_measure(type, body, i, area, "area in one of its triangles; leave it out, or fix its vertices");
    }
    batches.add(chosen[i], rest.coefficients, stiffness.of(i) / (rest.areas[0] + rest.areas[1]));
  }
  ConstraintSet set = batches.take();
  if (options.stencils.empty()) {
    set.skipped = all.nonmanifold_edge_count + all.degenerate_edge_count;
    set.skipped_reason = "edges of the mesh: " + std::to_string(all.nonmanifold_edge_count) + " non-manifold, " +
                         std::to_string(all.degenerate_edge_count) + " between triangles of the same vertices";
  }
  return set;
}

}  // namespace pliant
