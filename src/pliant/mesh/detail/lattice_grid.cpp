#include "pliant/mesh/detail/lattice_grid.h"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

constexpr std::size_t axis_of(int axis) {
  return static_cast<std::size_t>(axis % 3);
}

}  // namespace

Vec3 LatticeGrid::position(std::int64_t vertex) const {
  const bool is_center = vertex < cube_count();
  const std::int64_t number = is_center ? vertex : vertex - cube_count();
  const std::int64_t rows = counts_[0] + (is_center ? 0 : 1), layers = counts_[1] + (is_center ? 0 : 1);
  const Real shift = is_center ? 0.5 : 0;
  return origin_ + side_ * Vec3(static_cast<Real>(number % rows) + shift,
                                static_cast<Real>(number / rows % layers) + shift,
                                static_cast<Real>(number / rows / layers) + shift);
}

std::array<Index, 3> LatticeGrid::cube_at(const Vec3& in_sides) const {
  std::array<Index, 3> found{};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto place = static_cast<Index>(std::floor(in_sides[static_cast<Eigen::Index>(axis)]));
    found[axis] = std::clamp(place, Index{1}, counts_[axis] - 2);
  }
  return found;
}

LatticeGrid::Half LatticeGrid::half_of(int number) {
  return {number / 8, number / 4 % 2, number / 2 % 2 == 1, number % 2 == 1};
}

std::int64_t LatticeGrid::tetrahedron(const std::array<Index, 3>& of, const Half& half) const {
  std::array<Index, 3> lower = of;
  if (!half.axis_up) --lower[axis_of(half.axis)];
  return tetrahedra_of_cube * cube(lower) + 4 * half.axis + 2 * half.second + (half.second_up ? 1 : 0);
}

std::array<std::int64_t, 4> LatticeGrid::corners(std::array<Index, 3> of, const Half& half) const {
  const std::size_t first = axis_of(half.axis), second = axis_of(half.axis + 1 + half.second),
                    third = axis_of(half.axis + 2 - half.second);
  const std::int64_t own = cube(of);
  std::array<Index, 3> low = of;
  if (half.axis_up) ++low[first];
  if (half.second_up) ++low[second];
  std::array<Index, 3> high = low;
  ++high[third];
  of[first] += half.axis_up ? 1 : -1;
  return {own, cube(of), corner(high), corner(low)};
}

LatticeGrid::Point LatticeGrid::locate(const std::array<Index, 3>& of, const Vec3& from_center) const {
  const Vec3 size = from_center.cwiseAbs();
  Half half;
  for (int axis = 1; axis < 3; ++axis) {
    if (size[axis] > size[half.axis]) half.axis = axis;
  }
  const auto next = [&](int further) { return static_cast<Eigen::Index>(axis_of(half.axis + further)); };
  half.second = size[next(2)] > size[next(1)] ? 1 : 0;
  const Eigen::Index second = next(1 + half.second), third = next(2 - half.second);
  half.axis_up = from_center[half.axis] > 0;
  half.second_up = from_center[second] > 0;
  Point point{tetrahedron(of, half), corners(of, half), {}};
  const Real x1 = size[half.axis], x2 = size[second], x3 = from_center[third];
  point.weights = {1 - x1 - x2, x1 - x2, x2 + x3, x2 - x3};
  Real sum = 0;
  for (Real& weight : point.weights) sum += weight = std::clamp<Real>(weight, 0, 1);
  for (Real& weight : point.weights) weight /= sum;
  return point;
}

std::array<std::int64_t, 4> LatticeGrid::oriented_corners(std::int64_t number) const {
  const auto kind = static_cast<int>(number % tetrahedra_of_cube);
  const std::int64_t own = number / tetrahedra_of_cube;
  const std::array<Index, 3> of = {static_cast<Index>(own % counts_[0]),
                                   static_cast<Index>(own / counts_[0] % counts_[1]),
                                   static_cast<Index>(own / counts_[0] / counts_[1])};
  const Half half{kind / 4, kind / 2 % 2, true, kind % 2 == 1};
  std::array<std::int64_t, 4> found = corners(of, half);
  // d, the edge's side and p+ make a left-handed frame unless one of the other two is turned.
  const bool is_right_handed = (half.second == 0) == half.second_up;
  if (is_right_handed) std::swap(found[2], found[3]);
  return found;
}

}  // namespace pliant
