#pragma once
// The few types that every layer shares.
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include <Eigen/Geometry>

namespace pliant {

using Real = double;         ///< State and sums are double precision everywhere.
using Index = std::int32_t;  ///< Index of a vertex, an element or a constraint; -1 never occurs in valid data.

using Vec2 = Eigen::Matrix<Real, 2, 1>;
using Vec3 = Eigen::Matrix<Real, 3, 1>;
using Mat3 = Eigen::Matrix<Real, 3, 3>;

/// Positions [m], velocities [m/s] or forces [N] of m vertices: m × 3, one row a vertex (C order, as NumPy has it).
using Positions = Eigen::Matrix<Real, Eigen::Dynamic, 3, Eigen::RowMajor>;

using Edge = std::array<Index, 2>;
using Triangle = std::array<Index, 3>;
using Tetrahedron = std::array<Index, 4>;

/// An index as a place in a standard container.
constexpr std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// The number of entries of a container.
template <class List>
constexpr Index count_of(const List& list) {
  return static_cast<Index>(list.size());
}

/// Row i of an m × 3 array as a column vector.
inline Vec3 row(const Positions& x, Index i) {
  return x.row(i).transpose();
}

}  // namespace pliant
