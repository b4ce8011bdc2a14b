#pragma once
// Singular value decompositions of 3 × 2 and 3 × 3 matrices by one-sided Jacobi rotations (Hestenes 1958): the columns
// of F are turned against each other until they are orthogonal; their lengths are then the singular values. Unlike the
// eigenvalues of FᵀF it keeps small singular values to full relative accuracy. The number of sweeps is fixed, so a NaN
// cannot make it spin, and every matrix costs the same. Scratch-free and without allocation.
#include <algorithm>
#include <cmath>
#include <limits>

#include "pliant/core/types.h"

namespace pliant {

template <int columns>
using ThreeRows = Eigen::Matrix<Real, 3, columns>;

/// F = U diag(sigma) Vᵀ.
template <int columns>
struct SmallSvd {
  ThreeRows<columns> U;                     ///< orthonormal columns
  Eigen::Matrix<Real, columns, 1> sigma;    ///< sorted by descending magnitude
  Eigen::Matrix<Real, columns, columns> V;  ///< a rotation: det V = +1
};

namespace detail {

/// A unit vector orthogonal to the unit vector u; always the same one for the same u.
inline Vec3 any_orthogonal(const Vec3& u) {
  int axis = 0;
  if (std::abs(u[1]) < std::abs(u[axis])) axis = 1;
  if (std::abs(u[2]) < std::abs(u[axis])) axis = 2;
  return u.cross(Vec3::Unit(axis)).normalized();
}

/// Turns columns i and j of B = F V (and V with them) until they are orthogonal.
template <int columns>
void jacobi_rotation(ThreeRows<columns>& B, Eigen::Matrix<Real, columns, columns>& V, int i, int j) {
  const Real alpha = B.col(i).squaredNorm();
  const Real beta = B.col(j).squaredNorm();
  const Real gamma = B.col(i).dot(B.col(j));
  if (!(std::abs(gamma) > std::numeric_limits<Real>::epsilon() / 4 * std::sqrt(alpha) * std::sqrt(beta))) return;
  const Real zeta = (beta - alpha) / (2 * gamma);
  const Real t = std::copysign(1 / (std::abs(zeta) + std::sqrt(1 + zeta * zeta)), zeta);
  const Real c = 1 / std::sqrt(1 + t * t);
  const Real s = c * t;
  const auto turn = [c, s, i, j](auto& matrix) {
    const auto old = matrix.col(i).eval();
    matrix.col(i) = c * old - s * matrix.col(j);
    matrix.col(j) = s * old + c * matrix.col(j);
  };
  turn(B);
  turn(V);
}

/// Puts the longer of two columns first. One is negated, so that V stays a rotation.
template <int columns>
void sort_columns(ThreeRows<columns>& B, Eigen::Matrix<Real, columns, columns>& V, int i, int j) {
  if (!(B.col(i).squaredNorm() < B.col(j).squaredNorm())) return;
  B.col(i).swap(B.col(j));
  V.col(i).swap(V.col(j));
  B.col(j) = -B.col(j);
  V.col(j) = -V.col(j);
}

/// The second left vector: column 1 of B made a unit vector orthogonal to u, whatever its length.
inline Vec3 second_left_vector(const Vec3& u, const Vec3& column) {
  const Vec3 rest = column - column.dot(u) * u;
  const Real length = rest.norm();
  return length > 0 ? Vec3(rest / length) : any_orthogonal(u);
}

inline Vec3 first_left_vector(const Vec3& column) {
  const Real length = column.norm();
  return length > 0 ? Vec3(column / length) : Vec3::UnitX();
}

}  // namespace detail

/// Singular values ≥ 0.
inline SmallSvd<2> svd(const ThreeRows<2>& F) {
  ThreeRows<2> B = F;
  SmallSvd<2> result;
  result.V.setIdentity();
  for (int sweep = 0; sweep < 3; ++sweep) detail::jacobi_rotation(B, result.V, 0, 1);
  detail::sort_columns(B, result.V, 0, 1);
  result.U.col(0) = detail::first_left_vector(B.col(0));
  result.U.col(1) = detail::second_left_vector(result.U.col(0), B.col(1));
  result.sigma = {B.col(0).norm(), B.col(1).norm()};
  return result;
}

/// U and V are rotations; sigma[2] has the sign of det F and the smallest magnitude.
inline SmallSvd<3> signed_svd(const Mat3& F) {
  Mat3 B = F;
  SmallSvd<3> result;
  result.V.setIdentity();
  for (int sweep = 0; sweep < 8; ++sweep) {
    detail::jacobi_rotation(B, result.V, 0, 1);
    detail::jacobi_rotation(B, result.V, 0, 2);
    detail::jacobi_rotation(B, result.V, 1, 2);
  }
  detail::sort_columns(B, result.V, 0, 1);
  detail::sort_columns(B, result.V, 0, 2);
  detail::sort_columns(B, result.V, 1, 2);
  result.U.col(0) = detail::first_left_vector(B.col(0));
  result.U.col(1) = detail::second_left_vector(result.U.col(0), B.col(1));
  result.U.col(2) = result.U.col(0).cross(result.U.col(1));
  result.sigma = {B.col(0).norm(), B.col(1).norm(), result.U.col(2).dot(B.col(2))};
  return result;
}

}  // namespace pliant
