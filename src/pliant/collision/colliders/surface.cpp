#include "pliant/collision/colliders/surface.h"

#include <cmath>
#include <map>
#include <numbers>

namespace pliant {
namespace {

constexpr int round_segments = 16;     // of a quarter of a circle
constexpr Real towards_middle = 1e-3;  // share of the way from a corner to the middle of its triangle

/// A direction in a plane, and the side of the box on which its point lies.
struct RoundStep {
  Real cosine, sine;
  Real side_of_cosine, side_of_sine;
};

/// So many quarters of a circle, one after the other: where they meet there are two steps of one direction.
std::vector<RoundStep> round_steps(int quarters, int segments) {
  static constexpr std::array<Real, 5> cosines = {1, 0, -1, 0, 1};  // where quarters begin, without rounding
  static constexpr std::array<Real, 5> sines = {0, 1, 0, -1, 0};
  std::vector<RoundStep> steps;
  for (int i = 0; i < quarters; ++i) {
    const Real side_of_cosine = i == 0 || i == 3 ? 1 : -1, side_of_sine = i < 2 ? 1 : -1;
    const auto begin = static_cast<std::size_t>(i);
    steps.push_back({cosines[begin], sines[begin], side_of_cosine, side_of_sine});
    for (int k = 1; k < segments; ++k) {
      const Real angle = std::numbers::pi / 2 * (i + static_cast<Real>(k) / segments);
      steps.push_back({std::cos(angle), std::sin(angle), side_of_cosine, side_of_sine});
    }
    steps.push_back({cosines[begin + 1], sines[begin + 1], side_of_cosine, side_of_sine});
  }
  return steps;
}

/// Collects triangles by the places of their corners: corners at one place are one vertex, and what has two of them
/// alike is left out.
class SurfaceBuilder {
 public:
  Index vertex(const Vec3& place) {
    const auto [found, is_new] = numbers_.try_emplace({place.x(), place.y(), place.z()}, count_of(places_));
    if (is_new) places_.push_back(place);
    return found->second;
  }
  void add(Index a, Index b, Index c) {
    if (a != b && b != c && c != a) mesh_.triangles.push_back({a, b, c});
  }
  Mesh finish() {
    mesh_.vertices.resize(static_cast<Eigen::Index>(places_.size()), 3);
    for (std::size_t i = 0; i < places_.size(); ++i) {
      mesh_.vertices.row(static_cast<Eigen::Index>(i)) = places_[i].transpose();
    }
    return std::move(mesh_);
  }

 private:
  std::map<std::array<Real, 3>, Index> numbers_;
  std::vector<Vec3> places_;
  Mesh mesh_;
};

}  // namespace

Mesh rounded_box(const Vec3& half_size, Real rounding) {
  const int segments = rounding > 0 ? round_segments : 1;
  const std::vector<RoundStep> columns = round_steps(4, segments);  // about z, from x on
  const std::vector<RoundStep> rows = round_steps(2, segments);     // from the top down
  SurfaceBuilder builder;
  std::vector<std::vector<Index>> grid;
  for (const RoundStep& row : rows) {
    std::vector<Index>& line = grid.emplace_back();
    for (const RoundStep& column : columns) {
      const Vec3 direction(row.sine * column.cosine, row.sine * column.sine, row.cosine);
      const Vec3 side(column.side_of_cosine, column.side_of_sine, row.side_of_cosine);
      line.push_back(builder.vertex(side.cwiseProduct(half_size) + rounding * direction));
    }
  }
  for (std::size_t c = 0; c < columns.size(); ++c) {
    const std::size_t next = (c + 1) % columns.size();
    for (std::size_t r = 0; r + 1 < rows.size(); ++r) {
      builder.add(grid[r][c], grid[r + 1][c], grid[r + 1][next]);
      builder.add(grid[r][c], grid[r + 1][next], grid[r][next]);
    }
    builder.add(grid.front()[0], grid.front()[c], grid.front()[next]);
    builder.add(grid.back()[0], grid.back()[next], grid.back()[c]);
  }
  return builder.finish();
}

Positions corner_normals(const ColliderShape& shape, const Mesh& surface) {
  Positions normals(static_cast<Eigen::Index>(3 * surface.triangles.size()), 3);
  Eigen::Index corner = 0;
  for (const Triangle& triangle : surface.triangles) {
    const Vec3 middle =
        (surface.vertices.row(triangle[0]) + surface.vertices.row(triangle[1]) + surface.vertices.row(triangle[2])) / 3;
    for (const Index vertex : triangle) {
      const Vec3 place = surface.vertices.row(vertex).transpose();
      normals.row(corner++) = shape.distance(place + towards_middle * (middle - place)).normal.transpose();
    }
  }
  return normals;
}

}  // namespace pliant
