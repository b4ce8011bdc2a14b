#include "pliant/constraints/triangle_bending.h"

#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include "pliant/constraints/build.h"
#include "pliant/constraints/curvature.h"
#include "pliant/constraints/edge_slope.h"
#include "pliant/constraints/strain_rest.h"

namespace pliant {
namespace {

/// The rows of a triangle: H_xx, √2 H_xy, H_yy as combinations of its corners and of at most nine vertices around.
struct HessianRows {
  static constexpr Index capacity = 12;
  static constexpr Real rounding = 1e-12;
  std::vector<Index> stencil;
  Eigen::Matrix<Real, 3, capacity> coefficients = Eigen::Matrix<Real, 3, capacity>::Zero();

  void add(Index vertex, const Vec3& column) {
    const auto place = std::find(stencil.begin(), stencil.end(), vertex) - stencil.begin();
    if (place == std::ssize(stencil)) stencil.push_back(vertex);
    coefficients.col(place) += column;
  }

  /// Leaves out vertices that count for nothing, but no corner.
  void tidy() {
    const Real largest = coefficients.cwiseAbs().maxCoeff();
    Index kept = 0;
    for (Index j = 0; j < count_of(stencil); ++j) {
      if (j >= 3 && coefficients.col(j).cwiseAbs().maxCoeff() <= rounding * largest) continue;
      stencil[at(kept)] = stencil[at(j)];
      coefficients.col(kept++) = coefficients.col(j);
    }
    stencil.resize(at(kept));
    coefficients.rightCols(capacity - kept).setZero();
  }

  /// Where the rest shape is curved, turns the rows so that the first holds most of its bend, the last least.
  void align(const Positions& rest) {
    Mat3 z = Mat3::Zero();
    Real magnitude = 0;
    for (Index j = 1; j < count_of(stencil); ++j) {
      const Vec3 e = row(rest, stencil[at(j)]) - row(rest, stencil[0]);
      z += coefficients.col(j) * e.transpose();
      magnitude += coefficients.col(j).norm() * e.norm();
    }
    if (z.norm() <= rounding * magnitude) return;
    const Eigen::SelfAdjointEigenSolver<Mat3> solver(z * z.transpose());
    coefficients = (solver.eigenvectors().rowwise().reverse().transpose() * coefficients).eval();
  }

  /// Row r; nothing where borders have left nothing of it.
  std::vector<Real> row_of(Index r) const {
    std::vector<Real> numbers;
    if (coefficients.row(r).cwiseAbs().maxCoeff() <= 1e-9 * coefficients.cwiseAbs().maxCoeff()) return numbers;
    Real sum = 0;
    for (Index j = 1; j < count_of(stencil); ++j) sum += coefficients(r, j);
    numbers.push_back(-sum);
    for (Index j = 1; j < count_of(stencil); ++j) numbers.push_back(coefficients(r, j));
    return numbers;
  }
};

/// The three numbers of the symmetric part of a ⊗ b.
Vec3 symmetric(const Vec2& a, const Vec2& b) {
  return {a[0] * b[0], (a[0] * b[1] + a[1] * b[0]) / std::sqrt(Real(2)), a[1] * b[1]};
}

/// Takes out of the rows what free borders do not resist: the span of n ⊗ n of each.
void release_borders(HessianRows& rows, const std::vector<Vec3>& free) {
  Eigen::Matrix<Real, 3, Eigen::Dynamic> span(3, count_of(free));
  for (Index i = 0; i < count_of(free); ++i) span.col(i) = free[at(i)];
  const Eigen::Matrix<Real, 3, Eigen::Dynamic> basis =
      span.householderQr().householderQ() * Eigen::Matrix<Real, 3, Eigen::Dynamic>::Identity(3, span.cols());
  rows.coefficients -= (basis * (basis.transpose() * rows.coefficients)).eval();
}

HessianRows rows_of(const Sheet& sheet, const std::vector<EdgeSlope>& slopes, Index triangle, Real area) {
  const Triangle& corners = sheet.triangles[at(triangle)];
  const Vec3 origin = row(sheet.vertices, corners[0]);
  const Vec3 x = row(sheet.vertices, corners[1]) - origin;
  const Vec3 y = row(sheet.vertices, corners[2]) - origin;
  const std::array<Vec2, 3> flat = {Vec2(0, 0), Vec2(x.norm(), 0), Vec2(x.dot(y) / x.norm(), 2 * area / x.norm())};
  HessianRows rows;
  for (const Index corner : corners) rows.add(corner, Vec3::Zero());
  std::vector<Vec3> free;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 edge = flat[(k + 1) % 3] - flat[k];
    const Vec2 normal = Vec2(edge[1], -edge[0]).normalized();
    const Vec3 along = symmetric(edge.normalized(), normal) / area;
    rows.add(corners[k], -along);
    rows.add(corners[(k + 1) % 3], along);
    const Vec3 across = symmetric(normal, normal);
    const EdgeSlope& slope = slopes[at(sheet.edges_of[at(triangle)][k])];
    if (slope.is_free()) free.push_back(across);
    const Real outward = (slope.toward == triangle ? -1 : 1) * edge.norm() / area;
    for (std::size_t j = 0; j < slope.size; ++j) {
      rows.add(slope.vertices[j], outward * slope.coefficients[j] * across);
    }
  }
  if (!free.empty()) release_borders(rows, free);
  rows.tidy();
  return rows;
}

std::vector<Triangle> to_triangles(const Stencils& stencils) {
  std::vector<Triangle> triangles;
  triangles.reserve(static_cast<std::size_t>(stencils.size()));
  for (Index i = 0; i < stencils.size(); ++i) triangles.push_back({stencils[i][0], stencils[i][1], stencils[i][2]});
  return triangles;
}

}  // namespace

ConstraintSet build(const BodyView& body, const TriangleBending& options) {
  constexpr std::string_view type = TriangleBending::info.name;
  const Stencils chosen = choose_stencils(
      type, body, options.on, options.stencils, [&] { return to_stencils(body.rest.triangles); }, 3);
  const StiffnessSplit stiffness(type, body, options.stiffness, chosen);
  std::vector<Real> areas;
  for (Index i = 0; i < chosen.size(); ++i) {
    const auto corner = [&](std::size_t j) { return row(body.rest.vertices, chosen[i][j]); };
    areas.push_back(rest_triangle(corner(0), corner(1), corner(2)).measure);
    check_rest_measure(type, body, i, areas.back(), "area; leave it out, or fix its vertices");
  }
  const Sheet sheet(body.rest.vertices, to_triangles(chosen));
  const std::vector<EdgeSlope> slopes = edge_slopes(sheet);
  CurvatureBatches<SignedTriangleCurvature> batches(type, body, options.orientation, stiffness.common());
  Index bent = 0;
  for (Index i = 0; i < chosen.size(); ++i) {
    const auto is_free = [&](Index edge) { return slopes[at(edge)].is_free(); };
    if (std::ranges::all_of(sheet.edges_of[at(i)], is_free)) continue;
    HessianRows rows = rows_of(sheet, slopes, i, areas[at(i)]);
    const Real measure = stiffness.of(i) * areas[at(i)];
    ++bent;
    rows.align(body.rest.vertices);
    for (Index r = 0; r < 3; ++r) {
      const std::vector<Real> coefficients = rows.row_of(r);
      if (coefficients.empty()) continue;
      batches.add(rows.stencil, coefficients, measure, r == 0 ? options.orientation : Orientation::absolute);
    }
  }
  ConstraintSet set = batches.take();
  set.count = bent;
  set.skipped = sheet.skipped_nonmanifold + sheet.skipped_degenerate;
  set.skipped_reason = "edges of the mesh: " + std::to_string(sheet.skipped_nonmanifold) + " non-manifold, " +
                       std::to_string(sheet.skipped_degenerate) + " between triangles of the same vertices";
  return set;
}

}  // namespace pliant
