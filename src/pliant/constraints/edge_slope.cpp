#include "pliant/constraints/edge_slope.h"

#include <algorithm>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>

namespace pliant {
namespace {

/// Where the third corner of a triangle stands, seen from one of its edges.
struct Apex {
  Index vertex;
  Real along;   // 0 at the first end of the edge, 1 at the second
  Real height;  // [m]
};

/// A vertex in the plane into which the triangles are unfolded.
struct Unfolded {
  Index vertex;
  Vec2 at;
};

/// A combination of four vertices, and what it makes of a quadratic surface: the coefficients of H_xx, √2 H_xy, H_yy.
struct Fold {
  std::array<Unfolded, 4> points;
  std::array<Real, 4> coefficients;

  Vec3 of_quadratics(const Eigen::LLT<Eigen::Matrix<Real, 2, 2>>& scale) const {
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < 4; ++i) {
      const Vec2 y = scale.matrixL().solve(points[i].at);
      sum += coefficients[i] * Vec3(y[0] * y[0] / 2, y[0] * y[1] / std::sqrt(Real(2)), y[1] * y[1] / 2);
    }
    return sum;
  }
};

Apex apex_of(const Sheet& sheet, Index triangle, const Edge& edge) {
  Index vertex = -1;
  for (const Index corner : sheet.triangles[at(triangle)]) {
    if (corner != edge[0] && corner != edge[1]) vertex = corner;
  }
  const Vec3 from = row(sheet.vertices, edge[0]);
  const Vec3 e = row(sheet.vertices, edge[1]) - from;
  const Vec3 o = row(sheet.vertices, vertex) - from;
  return {vertex, e.dot(o) / e.squaredNorm(), e.cross(o).norm() / e.norm()};
}

/// `first` times the slope toward one apex plus `second` times that toward the other.
std::array<Real, 4> slopes(const Apex& one, const Apex& other, Real first, Real second) {
  const Real a = first / one.height;
  const Real b = second / other.height;
  return {-a * (1 - one.along) - b * (1 - other.along), -a * one.along - b * other.along, a, b};
}

bool folds(const Sheet& sheet, Index edge) {
  const std::span<const Index> triangles = sheet.edges.triangles_of(edge);
  if (triangles.size() != 2) return false;
  const Edge& ends = sheet.edges.edges[at(edge)];
  return apex_of(sheet, triangles[0], ends).vertex != apex_of(sheet, triangles[1], ends).vertex;
}

/// The folds at the two other edges of a triangle, which is unfolded already: corners[2] is its apex.
void add_outer_folds(const Sheet& sheet, Index triangle, Index edge, const std::array<Unfolded, 3>& corners,
                     std::vector<Fold>& found) {
  const auto corner = [&](Index vertex) {
    return *std::find_if(corners.begin(), corners.end(), [&](const Unfolded& c) { return c.vertex == vertex; });
  };
  for (const Index outer : sheet.edges_of[at(triangle)]) {
    if (outer == edge || !folds(sheet, outer)) continue;
    const Edge& ends = sheet.edges.edges[at(outer)];
    const std::span<const Index> both = sheet.edges.triangles_of(outer);
    const Apex inner = apex_of(sheet, triangle, ends);
    const Apex apex = apex_of(sheet, both[0] == triangle ? both[1] : both[0], ends);
    const Unfolded from = corner(ends[0]);
    const Unfolded to = corner(ends[1]);
    const Unfolded third = corner(inner.vertex);
    const Vec2 e = to.at - from.at;
    Vec2 normal = Vec2(-e[1], e[0]).normalized();
    if (normal.dot(third.at - from.at) > 0) normal = -normal;
    const Unfolded beyond{apex.vertex, from.at + apex.along * e + apex.height * normal};
    found.push_back({{from, to, third, beyond}, slopes(inner, apex, 1, 1)});
  }
}

/// How much of each fold makes up for `error`: the least of all choices that come nearest to it.
Eigen::VectorXd least_combination(const Eigen::Matrix<Real, 3, Eigen::Dynamic>& folds_of_quadratics,
                                  const Vec3& error) {
  constexpr Real singular = 1e-4;
  const Eigen::SelfAdjointEigenSolver<Mat3> solver(folds_of_quadratics * folds_of_quadratics.transpose());
  const Vec3 values = solver.eigenvalues();
  Vec3 part = solver.eigenvectors().transpose() * error;
  for (Index i = 0; i < 3; ++i) part[i] = values[i] > singular * values[2] ? part[i] / values[i] : 0;
  return folds_of_quadratics.transpose() * (solver.eigenvectors() * part);
}

/// Leaves the fold at the edge itself and the two others that need the smallest shares, and returns these.
Eigen::VectorXd choose(std::vector<Fold>& all, const Eigen::Matrix<Real, 3, Eigen::Dynamic>& of_quadratics,
                       const Vec3& error) {
  constexpr Real clearly_smaller = 1 - 1e-6;  // so that rounding does not choose
  Real smallest = 1;
  Vec3 chosen = Vec3::Zero();
  std::array<std::size_t, 2> pair{};
  for (std::size_t i = 1; i < all.size(); ++i) {
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      Mat3 three;
      three << of_quadratics.col(0), of_quadratics.col(static_cast<Index>(i)), of_quadratics.col(static_cast<Index>(j));
      const Vec3 share = three.inverse() * error;
      if (!(share.cwiseAbs().maxCoeff() < clearly_smaller * smallest)) continue;
      smallest = share.cwiseAbs().maxCoeff();
      chosen = share;
      pair = {i, j};
    }
  }
  if (pair[0] == 0) return least_combination(of_quadratics, error);
  all = {all[0], all[pair[0]], all[pair[1]]};
  return chosen;
}

EdgeSlope slope_of(const Sheet& sheet, Index edge, std::vector<Fold>& all) {
  /// Below this share a correction would lengthen the stencil and not be noticed: meshes are written to few digits.
  constexpr Real negligible = 1e-4;
  const Edge& ends = sheet.edges.edges[at(edge)];
  const std::span<const Index> both = sheet.edges.triangles_of(edge);
  const Apex one = apex_of(sheet, both[0], ends);
  const Apex other = apex_of(sheet, both[1], ends);
  const Real length = (row(sheet.vertices, ends[1]) - row(sheet.vertices, ends[0])).norm();
  const Unfolded a{ends[0], {-length / 2, 0}};
  const Unfolded b{ends[1], {length / 2, 0}};
  const Unfolded above{one.vertex, {(one.along - Real(0.5)) * length, one.height}};
  const Unfolded below{other.vertex, {(other.along - Real(0.5)) * length, -other.height}};
  const Fold mean{{a, b, above, below}, slopes(one, other, 0.5, -0.5)};

  EdgeSlope slope;
  slope.toward = both[0];
  for (std::size_t i = 0; i < 4; ++i) slope.add(mean.points[i].vertex, mean.coefficients[i]);
  Eigen::Matrix<Real, 2, 2> spread = Eigen::Matrix<Real, 2, 2>::Zero();
  for (const Unfolded& point : mean.points) spread += point.at * point.at.transpose();
  const Eigen::LLT<Eigen::Matrix<Real, 2, 2>> scale(spread);
  const Vec3 error = mean.of_quadratics(scale);
  all.assign(1, Fold{mean.points, slopes(one, other, 1, 1)});
  if (error.norm() <= negligible * all[0].of_quadratics(scale).norm()) return slope;
  add_outer_folds(sheet, both[0], edge, {a, b, above}, all);
  add_outer_folds(sheet, both[1], edge, {a, b, below}, all);
  Eigen::Matrix<Real, 3, Eigen::Dynamic> of_quadratics(3, count_of(all));
  for (Index k = 0; k < count_of(all); ++k) of_quadratics.col(k) = all[at(k)].of_quadratics(scale);
  const Eigen::VectorXd share = choose(all, of_quadratics, error);
  for (Index k = 0; k < count_of(all); ++k) {
    if (std::abs(share[k]) <= negligible) continue;
    const Fold& fold = all[at(k)];
    for (std::size_t i = 0; i < 4; ++i) slope.add(fold.points[i].vertex, -share[k] * fold.coefficients[i]);
  }
  return slope;
}

}  // namespace

void EdgeSlope::add(Index vertex, Real coefficient) {
  const auto end = vertices.begin() + static_cast<std::ptrdiff_t>(size);
  const auto place = static_cast<std::size_t>(std::find(vertices.begin(), end, vertex) - vertices.begin());
  if (place == size) ++size;
  vertices[place] = vertex;
  coefficients[place] += coefficient;
}

Sheet::Sheet(const Positions& positions, std::vector<Triangle> triangles_of_sheet)
    : vertices(positions), triangles(std::move(triangles_of_sheet)) {
  Mesh mesh;
  mesh.vertices = positions;
  mesh.triangles = triangles;
  edges = edge_triangles(mesh);
  edges_of.resize(triangles.size());
  for (Index e = 0; e < edges.edge_count(); ++e) {
    const Edge& ends = edges.edges[at(e)];
    const std::span<const Index> around = edges.triangles_of(e);
    for (const Index t : around) {
      const Triangle& corners = triangles[at(t)];
      for (std::size_t k = 0; k < 3; ++k) {
        if (std::minmax(corners[k], corners[(k + 1) % 3]) == std::minmax(ends[0], ends[1])) edges_of[at(t)][k] = e;
      }
    }
    if (around.size() > 2) ++skipped_nonmanifold;
    if (around.size() == 2 && !folds(*this, e)) ++skipped_degenerate;
  }
}

std::vector<EdgeSlope> edge_slopes(const Sheet& sheet) {
  std::vector<EdgeSlope> found(static_cast<std::size_t>(sheet.edges.edge_count()));
  std::vector<Fold> scratch;
  for (Index e = 0; e < sheet.edges.edge_count(); ++e) {
    if (folds(sheet, e)) found[at(e)] = slope_of(sheet, e, scratch);
  }
  return found;
}

}  // namespace pliant
