#include "pliant/mesh/shapes/panel.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes/curve.h"
#include "pliant/mesh/shapes/limits.h"

namespace pliant {

namespace {

/// The line through the points: a smooth curve from each that is given twice in a row to the next such one.
std::vector<Vec3> side_line(const std::vector<Vec3>& points, std::string_view side) {
  std::vector<Vec3> line, piece{points[0]};
  const auto end_piece = [&] {
    if (piece.size() < 2) {
      fail_input(
          fmt::format("panel: {}: the point ({:.4g}, {:.4g}, {:.4g}) m is given twice where the side ends, or "
                      "three times; a point twice in a row is a corner between others",
                      side, piece[0][0], piece[0][1], piece[0][2]));
    }
    const std::vector<Vec3> curve = smooth_curve(piece, CurveEnds::open);
    line.insert(line.end(), curve.begin() + (line.empty() ? 0 : 1), curve.end());
  };
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i] != points[i - 1]) {
      piece.push_back(points[i]);
      continue;
    }
    end_piece();
    piece = {points[i]};
  }
  end_piece();
  return line;
}

/// So many points at equal distances along a line, its ends among them.
std::vector<Vec3> spread_along(const std::vector<Vec3>& line, Index count) {
  const std::vector<Real> lengths = lengths_along(line);
  std::vector<Vec3> result{line.front()};
  std::size_t piece = 1;
  for (Index i = 1; i + 1 < count; ++i) {
    const Real length = lengths.back() * i / (count - 1);
    while (piece + 1 < line.size() && lengths[piece] < length) ++piece;
    const Real share = (length - lengths[piece - 1]) / (lengths[piece] - lengths[piece - 1]);
    result.push_back(line[piece - 1] + std::min(share, Real{1}) * (line[piece] - line[piece - 1]));
  }
  result.push_back(line.back());
  return result;
}

const std::vector<Vec3>& ends_of(const Points& side, std::string_view name) {
  const std::vector<Vec3>& points = side.list();
  if (points.size() < 2) {
    fail_input(
        fmt::format("panel: {}: {} given; it needs two points or more, of which the first and the last are "
                    "corners of the panel",
                    name, points.size()));
  }
  return points;
}

std::vector<Vec3> between(const Vec3& below, const Points& side, const Vec3& above) {
  std::vector<Vec3> points{below};
  points.insert(points.end(), side.list().begin(), side.list().end());
  points.push_back(above);
  return points;
}

/// The four sides as points at equal distances, and the surface between them.
struct CoonsPatch {
  std::vector<Vec3> bottom, top, left, right;

  explicit CoonsPatch(const PanelOptions& options) {
    const std::vector<Vec3>& below = ends_of(options.bottom, "bottom");
    const std::vector<Vec3>& above = ends_of(options.top, "top");
    bottom = spread_along(side_line(below, "bottom"), options.columns);
    top = spread_along(side_line(above, "top"), options.columns);
    left = spread_along(side_line(between(below.front(), options.left, above.front()), "left"), options.rows);
    right = spread_along(side_line(between(below.back(), options.right, above.back()), "right"), options.rows);
  }

  Vec3 place(Index i, Index j) const {
    const auto column = static_cast<std::size_t>(i);
    const auto row = static_cast<std::size_t>(j);
    const Real u = static_cast<Real>(i) / static_cast<Real>(bottom.size() - 1);
    const Real v = static_cast<Real>(j) / static_cast<Real>(left.size() - 1);
    if (j == 0) return bottom[column];
    if (row + 1 == left.size()) return top[column];
    if (i == 0) return left[row];
    if (column + 1 == bottom.size()) return right[row];
    const Vec3 corners =
        (1 - v) * ((1 - u) * bottom.front() + u * bottom.back()) + v * ((1 - u) * top.front() + u * top.back());
    return (1 - v) * bottom[column] + v * top[column] + (1 - u) * left[row] + u * right[row] - corners;
  }
};

Vec3 area_vector(const Mesh& mesh, const Triangle& triangle) {
  const Vec3 origin = row(mesh.vertices, triangle[0]);
  return (row(mesh.vertices, triangle[1]) - origin).cross(row(mesh.vertices, triangle[2]) - origin) / 2;
}

/// Throws where a triangle faces away from the panel as a whole, which is unit vector `normal`.
void check_folds(const Mesh& mesh, const Vec3& normal) {
  for (const Triangle& triangle : mesh.triangles) {
    if (area_vector(mesh, triangle).dot(normal) > 0) continue;
    const Vec3 middle =
        (row(mesh.vertices, triangle[0]) + row(mesh.vertices, triangle[1]) + row(mesh.vertices, triangle[2])) / 3;
    fail_input(
        fmt::format("panel: between its sides it folds over itself at ({:.4g}, {:.4g}, {:.4g}) m; bottom and "
                    "top go from left to right, left and right from below; curve the sides less, or make two "
                    "panels of it",
                    middle[0], middle[1], middle[2]));
  }
}

void set_texture_coordinates(Mesh& mesh, const Vec3& normal, const Vec3& upward) {
  const Vec3 v = (upward - upward.dot(normal) * normal).normalized();
  const Vec3 u = v.cross(normal);
  Eigen::Matrix<Real, Eigen::Dynamic, 2, Eigen::RowMajor> places(mesh.vertex_count(), 2);
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 x = row(mesh.vertices, i);
    places.row(i) << x.dot(u), x.dot(v);
  }
  const Eigen::Matrix<Real, 1, 2> least = places.colwise().minCoeff();
  places.rowwise() -= least;
  mesh.texture_coordinates = places / places.maxCoeff();
}

/// The vertices of each side, from left to right and from below.
std::vector<VertexGroup> sides_of(Index columns, Index rows) {
  std::vector<VertexGroup> sides{{"bottom", {}}, {"top", {}}, {"left", {}}, {"right", {}}};
  for (Index i = 0; i < columns; ++i) {
    sides[0].vertices.push_back(i);
    sides[1].vertices.push_back((rows - 1) * columns + i);
  }
  for (Index j = 0; j < rows; ++j) {
    sides[2].vertices.push_back(j * columns);
    sides[3].vertices.push_back(j * columns + columns - 1);
  }
  return sides;
}

/// Middles of crossed cells lie at the mean of the cell's corners.
void place_vertices(Mesh& mesh, const CoonsPatch& patch, const PanelOptions& options) {
  for (Index j = 0; j < options.rows; ++j) {
    for (Index i = 0; i < options.columns; ++i) {
      mesh.vertices.row(j * options.columns + i) = patch.place(i, j).transpose();
    }
  }
  if (options.diagonals != Diagonals::crossed) return;
  Index middle = options.columns * options.rows;
  for (Index j = 0; j + 1 < options.rows; ++j) {
    for (Index i = 0; i + 1 < options.columns; ++i) {
      const Index a = j * options.columns + i, c = a + options.columns;
      mesh.vertices.row(middle++) =
          (mesh.vertices.row(a) + mesh.vertices.row(a + 1) + mesh.vertices.row(c) + mesh.vertices.row(c + 1)) / 4;
    }
  }
}

}  // namespace

Mesh panel(const PanelOptions& options) {
  check_options(options.shape, options);
  ends_of(options.bottom, "bottom");
  ends_of(options.top, "top");
  const bool is_crossed = options.diagonals == Diagonals::crossed;
  require_vertex_count("panel: columns and rows", Real{1} * options.columns * options.rows * (is_crossed ? 2 : 1));
  Mesh mesh = grid({.columns = options.columns, .rows = options.rows, .diagonals = options.diagonals});
  place_vertices(mesh, CoonsPatch(options), options);
  Vec3 area = Vec3::Zero();
  for (const Triangle& triangle : mesh.triangles) area += area_vector(mesh, triangle);
  const Vec3 normal = area.normalized();
  check_folds(mesh, normal);
  const std::vector<Vec3>& below = options.bottom.list();
  const std::vector<Vec3>& above = options.top.list();
  set_texture_coordinates(mesh, normal, above.front() + above.back() - below.front() - below.back());
  mesh.vertex_groups = sides_of(options.columns, options.rows);
  return mesh;
}

}  // namespace pliant
