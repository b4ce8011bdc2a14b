#include "pliant/mesh/detail/lattice_filling.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/detail/winding_lines.h"

namespace pliant {
namespace {

/// Lines along a side of a cube, at first and at most, and in all at most.
constexpr Index first_fineness = 8;
constexpr Index last_fineness = 32;
constexpr Real most_lines = 4e6;
/// Share of the volume that lines may miss without finer ones, and at all.
constexpr Real good_error = 0.01;
constexpr Real largest_error = 0.2;
/// Places nearer than that to the plane between two tetrahedra lie in it [sides].
constexpr Real tie = 1e-9;

using Corners = std::array<Vec3, 4>;

/// Whether a triangle may meet a tetrahedron: false where a face of either has all of the other on its far side. All in
/// units of the side.
bool may_meet(const std::array<Vec3, 3>& triangle, const Corners& tetrahedron, Real slack) {
  const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
  Real least = std::numeric_limits<Real>::max(), most = std::numeric_limits<Real>::lowest();
  for (const Vec3& corner : tetrahedron) {
    const Real height = normal.dot(corner - triangle[0]);
    least = std::min(least, height);
    most = std::max(most, height);
  }
  if (least > slack || most < -slack) return false;
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 &a = tetrahedron[(i + 1) % 4], &b = tetrahedron[(i + 2) % 4], &c = tetrahedron[(i + 3) % 4];
    Vec3 outward = (b - a).cross(c - a).normalized();
    if (outward.dot(tetrahedron[i] - a) > 0) outward = -outward;
    const auto is_beyond = [&](const Vec3& p) { return outward.dot(p - a) > slack; };
    if (is_beyond(triangle[0]) && is_beyond(triangle[1]) && is_beyond(triangle[2])) return false;
  }
  return true;
}

/// Which tetrahedra the surface may meet, and which cubes have such a one.
struct CutCells {
  std::vector<char> tetrahedra;
  std::vector<char> cubes;

  CutCells(const LatticeGrid& grid, const Positions& x, std::span<const Triangle> triangles)
      : tetrahedra(static_cast<std::size_t>(grid.tetrahedron_count()), 0),
        cubes(static_cast<std::size_t>(grid.cube_count()), 0),
        grid_(grid) {
    const Index widest = *std::ranges::max_element(grid.counts());
    slack_ = 1e-6 + 1e-6 * widest;  // past what the lines are rounded by
    for (const Triangle& each : triangles) {
      mark({grid.inside(row(x, each[0])), grid.inside(row(x, each[1])), grid.inside(row(x, each[2]))});
    }
    for (std::size_t t = 0; t < tetrahedra.size(); ++t) {
      if (tetrahedra[t] == 0) continue;
      const auto corners = grid.oriented_corners(static_cast<std::int64_t>(t));  // both centers first
      cubes[static_cast<std::size_t>(corners[0])] = cubes[static_cast<std::size_t>(corners[1])] = 1;
    }
  }

 private:
  void mark(const std::array<Vec3, 3>& triangle) {
    const Vec3 reach = Vec3::Constant(slack_);
    const auto low = grid_.cube_at(triangle[0].cwiseMin(triangle[1]).cwiseMin(triangle[2]) - reach);
    const auto high = grid_.cube_at(triangle[0].cwiseMax(triangle[1]).cwiseMax(triangle[2]) + reach);
    const Vec3 normal = (triangle[1] - triangle[0]).cross(triangle[2] - triangle[0]).normalized();
    const Real reach_of_cube = normal.cwiseAbs().sum() + slack_;  // half a cube, and half of its neighbor
    for (Index k = low[2]; k <= high[2]; ++k) {
      for (Index j = low[1]; j <= high[1]; ++j) {
        for (Index i = low[0]; i <= high[0]; ++i) {
          if (std::abs(normal.dot(Vec3(i + 0.5, j + 0.5, k + 0.5) - triangle[0])) <= reach_of_cube) {
            mark_in({i, j, k}, triangle);
          }
        }
      }
    }
  }

  void mark_in(const std::array<Index, 3>& cube, const std::array<Vec3, 3>& triangle) {
    const Vec3 center(cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5);
    for (int number = 0; number < 24; ++number) {
      const LatticeGrid::Half half = LatticeGrid::half_of(number);
      const auto t = static_cast<std::size_t>(grid_.tetrahedron(cube, half));
      if (tetrahedra[t] == 0 && may_meet(triangle, corners(center, half), slack_)) tetrahedra[t] = 1;
    }
  }

  static Corners corners(const Vec3& center, const LatticeGrid::Half& half) {
    const int second = (half.axis + 1 + half.second) % 3, third = (half.axis + 2 - half.second) % 3;
    const Vec3 along = Vec3::Unit(half.axis) * (half.axis_up ? 1 : -1);
    const Vec3 edge = center + along / 2 + Vec3::Unit(second) * (half.second_up ? 0.5 : -0.5);
    return {center, center + along, edge + Vec3::Unit(third) / 2, edge - Vec3::Unit(third) / 2};
  }

  const LatticeGrid& grid_;
  Real slack_ = 0;
};

/// Walks along lines through all cubes.
class LineFilling {
 public:
  LineFilling(const LatticeGrid& grid, const CutCells& cut, Index fineness)
      : grid_(grid), cut_(cut), fineness_(fineness), step_(grid.side() / fineness) {
    made_.volumes.assign(static_cast<std::size_t>(grid.tetrahedron_count()), 0);
    made_.vertex_volumes.assign(static_cast<std::size_t>(grid.vertex_count()), 0);
    cut_volumes_.assign(made_.vertex_volumes.size(), 0);
  }

  void walk(const Positions& x, std::span<const Triangle> triangles) {
    const auto& counts = grid_.counts();
    const Vec3 origin = grid_.position(grid_.cube_count());
    const WindingLines lines(x, triangles, origin, step_, counts[1] * fineness_, counts[2] * fineness_);
    origin_x_ = origin[0];
    for (Index k = fineness_; k < (counts[2] - 1) * fineness_; ++k) {
      for (Index j = fineness_; j < (counts[1] - 1) * fineness_; ++j) walk_along(lines.at(j, k), j, k);
    }
  }

  /// Share of the volume that lines have missed, against what the surface says; 0 where parts overlap, of which that
  /// counts each.
  Real error(Real volume) const {
    if (overlaps_ || cut_sum_ == 0) return cut_sum_ == 0 ? 1 : 0;
    return (full_sum_ + cut_sum_ - volume) / volume;
  }

  LatticeFilling take(Real volume) {
    const Real factor = overlaps_ ? 1 : (volume - full_sum_) / cut_sum_;
    for (std::size_t t = 0; t < made_.volumes.size(); ++t) {
      if (cut_.tetrahedra[t] != 0) made_.volumes[t] *= factor;
    }
    for (std::size_t v = 0; v < cut_volumes_.size(); ++v) made_.vertex_volumes[v] += factor * cut_volumes_[v];
    made_.volume = full_sum_ + factor * cut_sum_;
    return std::move(made_);
  }

 private:
  /// The winding number at places that rise along x.
  struct Walker {
    std::span<const WindingCrossing> crossings;
    std::size_t next = 0;
    Index winding = 0;

    Index go_to(Real x) {
      while (next < crossings.size() && crossings[next].x <= x) winding += crossings[next++].change;
      return winding;
    }
  };

  void walk_along(std::span<const WindingCrossing> crossings, Index j, Index k) {
    if (crossings.empty()) return;
    Walker walker{crossings};
    const bool is_middle = j % fineness_ == fineness_ / 2 && k % fineness_ == fineness_ / 2;
    for (Index i = 1; i < grid_.counts()[0] - 1; ++i) {
      const std::array<Index, 3> cube = {i, j / fineness_, k / fineness_};
      if (cut_.cubes[static_cast<std::size_t>(grid_.cube(cube))] != 0) {
        walk_through(cube, walker, j, k);
      } else if (is_middle && walker.go_to(origin_x_ + (i + 0.5) * grid_.side()) > 0) {
        for (int half = 0; half < 24; ++half) fill(cube, LatticeGrid::half_of(half));
      }
    }
  }

  /// Through a cube that has tetrahedra which are cut.
  void walk_through(const std::array<Index, 3>& cube, Walker& walker, Index j, Index k) {
    const Vec3 center(cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5);
    Vec3 place(0, (j + 0.5) / fineness_, (k + 0.5) / fineness_);
    for (Index i = 0; i < fineness_; ++i) {
      const Real begin = cube[0] + static_cast<Real>(i) / fineness_, end = cube[0] + (i + 1.0) / fineness_;
      // What is inside between the two, and its middle.
      Real length = 0, moment = 0, from = begin;
      Index winding = walker.go_to(origin_x_ + begin * grid_.side());
      while (true) {
        const bool is_last =
            walker.next == walker.crossings.size() || walker.crossings[walker.next].x > origin_x_ + end * grid_.side();
        const Real to =
            is_last ? end : std::clamp((walker.crossings[walker.next].x - origin_x_) / grid_.side(), from, end);
        if (winding > 0) length += to - from, moment += (to - from) * (to + from) / 2;
        overlaps_ = overlaps_ || winding > 1;
        if (is_last) break;
        from = to;
        winding = walker.winding += walker.crossings[walker.next++].change;
      }
      place[0] = length > 0 ? moment / length : (begin + end) / 2;
      add(cube, place - center, length * fineness_);
    }
  }

  /// A piece along a line, of which that share is inside. One that lies in the plane between tetrahedra is theirs in
  /// equal parts.
  void add(const std::array<Index, 3>& cube, const Vec3& from_center, Real share) {
    const Vec3 size = from_center.cwiseAbs();
    const bool is_between =
        std::abs(size[0] - size[1]) < tie || std::abs(size[1] - size[2]) < tie || std::abs(size[2] - size[0]) < tie;
    if (!is_between) return add(grid_.locate(cube, from_center), share, 1);
    std::array<Eigen::Index, 3> order = {0, 1, 2};
    do {
      Vec3 moved = from_center;
      for (std::size_t i = 0; i < 3; ++i) {
        const Real further = 4 * tie * static_cast<Real>(i);
        moved[order[i]] += moved[order[i]] < 0 ? -further : further;
      }
      add(grid_.locate(cube, moved), share, Real{1} / 6);
    } while (std::next_permutation(order.begin(), order.end()));
  }

  void add(const LatticeGrid::Point& point, Real share, Real part) {
    const auto t = static_cast<std::size_t>(point.tetrahedron);
    if (cut_.tetrahedra[t] == 0) {
      if (share > 0.5 && made_.volumes[t] == 0) fill_tetrahedron(point.tetrahedron);
      return;
    }
    const Real volume = part * share * step_ * step_ * step_;
    made_.volumes[t] += volume;
    cut_sum_ += volume;
    for (std::size_t i = 0; i < 4; ++i) {
      cut_volumes_[static_cast<std::size_t>(point.corners[i])] += volume * point.weights[i];
    }
  }

  void fill(const std::array<Index, 3>& cube, const LatticeGrid::Half& half) {
    const std::int64_t t = grid_.tetrahedron(cube, half);
    if (made_.volumes[static_cast<std::size_t>(t)] == 0) fill_tetrahedron(t);
  }

  void fill_tetrahedron(std::int64_t t) {
    made_.volumes[static_cast<std::size_t>(t)] = grid_.tetrahedron_volume();
    full_sum_ += grid_.tetrahedron_volume();
    for (const std::int64_t v : grid_.oriented_corners(t)) {
      made_.vertex_volumes[static_cast<std::size_t>(v)] += grid_.tetrahedron_volume() / 4;
    }
  }

  const LatticeGrid& grid_;
  const CutCells& cut_;
  Index fineness_;
  Real step_;
  Real origin_x_ = 0;
  Real full_sum_ = 0;
  Real cut_sum_ = 0;
  bool overlaps_ = false;
  LatticeFilling made_;
  std::vector<Real> cut_volumes_;
};

}  // namespace

LatticeFilling fill_lattice(const LatticeGrid& grid, const Positions& x, const ClosedSurface& surface,
                            std::string_view name) {
  const CutCells cut(grid, x, surface.triangles);
  const Real lines_of_one = Real{1} * grid.counts()[1] * grid.counts()[2];
  for (Index fineness = first_fineness;; fineness *= 2) {
    LineFilling filling(grid, cut, fineness);
    filling.walk(x, surface.triangles);
    const Real error = std::abs(filling.error(surface.volume));
    const bool is_last = 2 * fineness > last_fineness || lines_of_one * (4 * fineness * fineness) > most_lines;
    if (error <= good_error || (is_last && error <= largest_error)) return filling.take(surface.volume);
    if (!is_last) continue;
    fail_input(
        fmt::format("{}: walls of the surface are too thin for a spacing of {:.4g} m: their volume of {:.3g} m³ "
                    "is measured wrong by {:.0f} %; give a smaller spacing",
                    name, grid.side(), surface.volume, 100 * error));
  }
}

}  // namespace pliant
