#include "pliant/collision/exact_orientation.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace pliant {

namespace {

/// A number as the exact sum of at most `capacity` doubles: none is zero, each is larger than the sum of all before it.
template <std::size_t capacity>
struct Expansion {
  std::array<Real, capacity> terms;
  std::size_t count = 0;

  void push(Real term) {
    if (term != 0) terms[count++] = term;
  }
  int sign() const {
    if (count == 0) return 0;
    return terms[count - 1] > 0 ? 1 : -1;
  }
};

/// a + b = sum + error, exactly (Shewchuk's theorem 7, by Knuth).
struct RoundedSum {
  Real sum;
  Real error;

  RoundedSum(Real a, Real b) : sum(a + b), error(0) {
    const Real b_virtual = sum - a;
    const Real a_virtual = sum - b_virtual;
    error = (a - a_virtual) + (b - b_virtual);
  }
};

/// a = high + low, exactly, of at most 26 bits each (Shewchuk's theorem 17, by Dekker), for |a| up to 2^970.
struct Halves {
  Real high;
  Real low;

  explicit Halves(Real a) : high(0), low(0) {
    constexpr Real factor = 134217729;  // 2^27 + 1
    const Real shifted = factor * a;
    high = shifted - (shifted - a);
    low = a - high;
  }
};

/// a · b = product + error, exactly (theorem 18, by Veltkamp). Not by std::fma, which rounds twice in mingw.
struct RoundedProduct {
  Real product;
  Real error;

  RoundedProduct(Real a, Real b) : product(a * b), error(0) {
    const Halves x(a);
    const Halves y(b);
    error = x.low * y.low - (((product - x.high * y.high) - x.low * y.high) - x.high * y.low);
  }
};

/// Adds one double to an expansion (theorem 10, GROW-EXPANSION, without zeros).
template <std::size_t capacity>
void grow(Expansion<capacity>& e, Real term) {
  const std::size_t count = e.count;
  e.count = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const RoundedSum rounded(term, e.terms[i]);
    term = rounded.sum;
    e.push(rounded.error);
  }
  e.push(term);
}

/// Theorem 12, EXPANSION-SUM.
template <std::size_t n, std::size_t m>
Expansion<n + m> operator+(const Expansion<n>& a, const Expansion<m>& b) {
  Expansion<n + m> result;
  for (std::size_t i = 0; i < a.count; ++i) result.push(a.terms[i]);
  for (std::size_t j = 0; j < b.count; ++j) grow(result, b.terms[j]);
  return result;
}

template <std::size_t n>
Expansion<n> operator-(Expansion<n> a) {
  for (std::size_t i = 0; i < a.count; ++i) a.terms[i] = -a.terms[i];
  return a;
}

/// All products of two terms, each exact as its rounded value and the rest.
template <std::size_t n, std::size_t m>
Expansion<2 * n * m> operator*(const Expansion<n>& a, const Expansion<m>& b) {
  Expansion<2 * n * m> result;
  for (std::size_t i = 0; i < a.count; ++i) {
    for (std::size_t j = 0; j < b.count; ++j) {
      const RoundedProduct rounded(a.terms[i], b.terms[j]);
      grow(result, rounded.error);
      grow(result, rounded.product);
    }
  }
  return result;
}

Expansion<2> exact_difference(Real a, Real b) {
  const RoundedSum rounded(a, -b);
  Expansion<2> result;
  result.push(rounded.error);
  result.push(rounded.sum);
  return result;
}

Real largest_coordinate(const Vec3& x) {
  return x.cwiseAbs().maxCoeff();
}

/// What is common in meshes, and plain to see: all points on one plane across an axis, or two of them in one place.
bool is_plainly_flat(const std::array<Vec3, 4>& x) {
  for (Eigen::Index k = 0; k < 3; ++k) {
    if (x[1][k] == x[0][k] && x[2][k] == x[0][k] && x[3][k] == x[0][k]) return true;
  }
  return x[0] == x[1] || x[0] == x[2] || x[0] == x[3] || x[1] == x[2] || x[1] == x[3] || x[2] == x[3];
}

int exact_sign(std::array<Vec3, 4> x) {
  const Real largest = std::max(
      {largest_coordinate(x[0]), largest_coordinate(x[1]), largest_coordinate(x[2]), largest_coordinate(x[3])});
  if (largest == 0) return 0;
  const int exponent = std::ilogb(largest);
  for (Vec3& point : x) {
    for (Real& coordinate : point) coordinate = std::ldexp(coordinate, -exponent);
  }
  const auto difference = [&](std::size_t i, Eigen::Index k) { return exact_difference(x[i][k], x[0][k]); };
  const auto minor = [&](Eigen::Index k, Eigen::Index l) {
    return difference(1, k) * difference(2, l) + -(difference(1, l) * difference(2, k));
  };
  return (minor(0, 1) * difference(3, 2) + minor(1, 2) * difference(3, 0) + minor(2, 0) * difference(3, 1)).sign();
}

}  // namespace

int orientation(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  const Vec3 u = x1 - x0;
  const Vec3 v = x2 - x0;
  const Vec3 w = x3 - x0;
  const Real xy = u[0] * v[1];
  const Real yx = u[1] * v[0];
  const Real yz = u[1] * v[2];
  const Real zy = u[2] * v[1];
  const Real zx = u[2] * v[0];
  const Real xz = u[0] * v[2];
  const Real determinant = (xy - yx) * w[2] + (yz - zy) * w[0] + (zx - xz) * w[1];
  const Real permanent = (std::abs(xy) + std::abs(yx)) * std::abs(w[2]) +
                         (std::abs(yz) + std::abs(zy)) * std::abs(w[0]) +
                         (std::abs(zx) + std::abs(xz)) * std::abs(w[1]);
  constexpr Real epsilon = 0x1p-53;
  constexpr Real relative_error = (7 + 56 * epsilon) * epsilon;  // section 4.4, bound A
  // What underflows is under 2^-1070 times the largest factor, which is lost in the bound of a determinant above
  // 2^-600.
  const bool is_in_range = permanent < 0x1p1000 && std::abs(determinant) > 0x1p-600;
  const bool has_no_large_factor =
      largest_coordinate(u) < 0x1p300 && largest_coordinate(v) < 0x1p300 && largest_coordinate(w) < 0x1p300;
  if (is_in_range && has_no_large_factor && std::abs(determinant) > relative_error * permanent) {
    return determinant > 0 ? 1 : -1;
  }
  if (!(x0.allFinite() && x1.allFinite() && x2.allFinite() && x3.allFinite())) return 0;
  const std::array<Vec3, 4> x = {x0, x1, x2, x3};
  return is_plainly_flat(x) ? 0 : exact_sign(x);
}

}  // namespace pliant
