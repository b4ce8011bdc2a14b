#include "pliant/mesh/shapes/tube.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes/curve.h"
#include "pliant/mesh/shapes/limits.h"

namespace pliant {

namespace {

/// A row's middle, and the axes of its circle: along × across points on along the curve.
struct TubeRow {
  Vec3 middle, forward, along, across;
};

/// Middles and directions of rows at equal distances along the curve.
std::vector<TubeRow> place_rows(const std::vector<Vec3>& curve, Index rows, bool is_joined) {
  const std::vector<Real> lengths = lengths_along(curve);
  std::vector<TubeRow> result(static_cast<std::size_t>(rows));
  std::size_t piece = 1;
  for (Index i = 0; i < rows; ++i) {
    const Real length = lengths.back() * i / (is_joined ? rows : rows - 1);
    while (piece + 1 < curve.size() && lengths[piece] < length) ++piece;
    const Real share = (length - lengths[piece - 1]) / (lengths[piece] - lengths[piece - 1]);
    TubeRow& row = result[static_cast<std::size_t>(i)];
    row.middle = curve[piece - 1] + std::min(share, Real{1}) * (curve[piece] - curve[piece - 1]);
    // Across one piece of the curve before and one behind, round the corner between both.
    const std::size_t last = curve.size() - 1;
    const Vec3& from = piece >= 2 ? curve[piece - 2] : is_joined ? curve[last - 1] : curve[0];
    const Vec3& to = piece < last ? curve[piece + 1] : is_joined ? curve[1] : curve[last];
    row.forward = (to - from).normalized();
  }
  return result;
}

Vec3 any_normal(const Vec3& direction) {
  Eigen::Index least = 0;
  direction.cwiseAbs().minCoeff(&least);
  return Vec3::Unit(least).cross(direction).normalized();
}

/// `along`, turned as little as takes `from` to `to`, which are unit vectors.
Vec3 carried(const Vec3& along, const Vec3& from, const Vec3& to) {
  const Vec3 turned = Eigen::Quaternion<Real>::FromTwoVectors(from, to) * along;
  return (turned - to.dot(turned) * to).normalized();
}

/// Axes that turn about the curve as little as can be.
void place_axes(std::vector<TubeRow>& rows, bool is_joined) {
  rows[0].along = any_normal(rows[0].forward);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    rows[i].along = carried(rows[i - 1].along, rows[i - 1].forward, rows[i].forward);
  }
  Real left = 0;  // of a turn, once around
  if (is_joined) {
    const Vec3 back = carried(rows.back().along, rows.back().forward, rows[0].forward);
    left = std::atan2(back.cross(rows[0].along).dot(rows[0].forward), back.dot(rows[0].along));
  }
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Real angle = left * static_cast<Real>(i) / static_cast<Real>(rows.size());
    const Vec3 across = rows[i].forward.cross(rows[i].along);
    rows[i].along = std::cos(angle) * rows[i].along + std::sin(angle) * across;
    rows[i].across = rows[i].forward.cross(rows[i].along);
  }
}

void check_points(const TubeOptions& options) {
  const bool is_joined = options.ends == TubeEnds::joined;
  const std::vector<Vec3>& points = options.points.list();
  const std::size_t least = is_joined ? 3 : 2;
  if (points.size() < least) {
    fail_input(fmt::format("tube: points: {} given; a curve{} needs {} or more", points.size(),
                           is_joined ? " whose ends are joined" : "", least));
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::size_t next = (i + 1) % points.size();
    if ((next > 0 || is_joined) && points[i] == points[next]) {
      fail_input(fmt::format("tube: points[{}] and points[{}] are the same; leave one out", i, next));
    }
  }
  if (is_joined && options.rows < 3) fail_input("tube: rows: a tube whose ends are joined needs 3 or more");
}

/// Wherever the curve bends more than a circle of the tube's radius does, rows pass through each other.
void check_bends(const Mesh& mesh, const std::vector<TubeRow>& rows, const TubeOptions& options) {
  const Index n = options.segments;
  const auto count = static_cast<Index>(rows.size());
  for (Index i = 0; i < (options.ends == TubeEnds::joined ? count : count - 1); ++i) {
    const Index next = (i + 1) % count;
    const Vec3& middle = rows[static_cast<std::size_t>(i)].middle;
    const Vec3 step = rows[static_cast<std::size_t>(next)].middle - middle;
    for (Index a = 0; a < n; ++a) {
      if (step.dot(row(mesh.vertices, next * n + a) - row(mesh.vertices, i * n + a)) > 0) continue;
      fail_input(
          fmt::format("tube: its curve bends too sharply for a radius of {} m at ({:.4g}, {:.4g}, {:.4g}) m, row {}; "
                      "give a smaller "
                      "radius, or points farther apart",
                      options.radius, middle[0], middle[1], middle[2], i));
    }
  }
}

/// Three tetrahedra for each wedge between two rows.
void fill_tube(Mesh& mesh, Index n, Index rows, bool is_joined) {
  for (Index i = 0; i < (is_joined ? rows : rows - 1); ++i) {
    const Index next = (i + 1) % rows;
    const Index middle = n * rows + i, next_middle = n * rows + next;
    for (Index k = 0; k < n; ++k) {
      const Index a = i * n + k, b = i * n + (k + 1) % n;
      const Index next_a = next * n + k, next_b = next * n + (k + 1) % n;
      mesh.tetrahedra.insert(
          mesh.tetrahedra.end(),
          {{middle, a, b, next_b}, {middle, a, next_b, next_a}, {middle, next_a, next_b, next_middle}});
    }
  }
}

void cover_tube(Mesh& mesh, Index n, Index rows, TubeEnds ends) {
  for (Index i = 0; i < (ends == TubeEnds::joined ? rows : rows - 1); ++i) {
    const Index next = (i + 1) % rows;
    for (Index k = 0; k < n; ++k) {
      const Index a = i * n + k, b = i * n + (k + 1) % n;
      const Index next_a = next * n + k, next_b = next * n + (k + 1) % n;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, next_b}, {a, next_b, next_a}});
    }
  }
  if (ends != TubeEnds::closed) return;
  const Index first_middle = n * rows, last_row = n * (rows - 1);
  for (Index k = 0; k < n; ++k) {
    const Index next = (k + 1) % n;
    mesh.triangles.insert(mesh.triangles.end(),
                          {{first_middle, next, k}, {first_middle + 1, last_row + k, last_row + next}});
  }
}

}  // namespace

Mesh tube(const TubeOptions& options) {
  check_options(options.shape, options);
  check_points(options);
  const bool is_joined = options.ends == TubeEnds::joined;
  const bool is_solid = options.inside == TubeInside::solid;
  const Index n = options.segments;
  require_vertex_count("tube: segments and rows", (Real{1} * n + 1) * options.rows);

  std::vector<TubeRow> rows = place_rows(
      smooth_curve(options.points.list(), is_joined ? CurveEnds::joined : CurveEnds::open), options.rows, is_joined);
  place_axes(rows, is_joined);
  Mesh mesh;
  const Index ring_vertices = n * options.rows;
  const Index middles = is_solid ? options.rows : options.ends == TubeEnds::closed ? 2 : 0;
  mesh.vertices.resize(ring_vertices + middles, 3);
  for (Index v = 0; v < ring_vertices; ++v) {
    const TubeRow& row = rows[static_cast<std::size_t>(v / n)];
    const Real angle = 2 * std::numbers::pi * (v % n) / n;
    const Vec3 outward = std::cos(angle) * row.along + std::sin(angle) * row.across;
    mesh.vertices.row(v) = (row.middle + options.radius * outward).transpose();
  }
  for (Index i = 0; i < middles; ++i) {
    const TubeRow& row = is_solid || i == 0 ? rows[static_cast<std::size_t>(i)] : rows.back();
    mesh.vertices.row(ring_vertices + i) = row.middle.transpose();
  }
  check_bends(mesh, rows, options);
  if (is_solid) {
    fill_tube(mesh, n, options.rows, is_joined);
  } else {
    cover_tube(mesh, n, options.rows, options.ends);
  }
  return mesh;
}

}  // namespace pliant
