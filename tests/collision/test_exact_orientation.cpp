#include <array>
#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "pliant/collision/exact_orientation.h"
#include "tests/core/random.h"

namespace test_exact_orientation {

using namespace pliant;
using namespace pliant_tests;

namespace {

using Points = std::array<Vec3, 4>;
__extension__ using Wide = __int128;

int sign_of(const Points& x) {
  return orientation(x[0], x[1], x[2], x[3]);
}

/// Of points whose coordinates are whole multiples of `unit`, up to 2^38: no product of three overflows.
int sign_in_integers(const Points& x, Real unit = 1) {
  std::array<std::array<Wide, 3>, 3> d;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      d[i][k] = static_cast<std::int64_t>(x[i + 1][axis] / unit) - static_cast<std::int64_t>(x[0][axis] / unit);
    }
  }
  const Wide determinant = d[0][0] * (d[1][1] * d[2][2] - d[1][2] * d[2][1]) +
                           d[0][1] * (d[1][2] * d[2][0] - d[1][0] * d[2][2]) +
                           d[0][2] * (d[1][0] * d[2][1] - d[1][1] * d[2][0]);
  return determinant > 0 ? 1 : determinant < 0 ? -1 : 0;
}

Points whole_points(Random& random, Index limit) {
  Points x;
  for (Vec3& point : x) {
    for (Real& coordinate : point) coordinate = random.index(2 * limit + 1) - limit;
  }
  return x;
}

/// Four points in one plane but for rounding: the last is a + s (b − a) + t (c − a), rounded, a few ulps moved.
Points nearly_flat_points(Random& random) {
  Points x = {random.vector(1), random.vector(1), random.vector(1), Vec3::Zero()};
  x[3] = x[0] + random.uniform(-1, 2) * (x[1] - x[0]) + random.uniform(-1, 2) * (x[2] - x[0]);
  for (Real& coordinate : x[3]) {
    const Real towards = random.index(2) == 0 ? -10 : 10;
    for (Index ulps = random.index(3); ulps > 0; --ulps) coordinate = std::nextafter(coordinate, towards);
  }
  return x;
}

/// Every sign that a permutation of the points must have.
void check_permutations(const Points& x) {
  const int sign = sign_of(x);
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) {
      Points swapped = x;
      std::swap(swapped[i], swapped[j]);
      CHECK(sign_of(swapped) == -sign);
    }
  }
  CHECK(sign_of({x[0], x[2], x[3], x[1]}) == sign);
  CHECK(sign_of({x[0], x[3], x[1], x[2]}) == sign);
  const auto turned = [](const Vec3& point) { return Vec3(point[1], point[2], point[0]); };
  CHECK(sign_of({turned(x[0]), turned(x[1]), turned(x[2]), turned(x[3])}) == sign);
  const auto mirrored = [](const Vec3& point) { return Vec3(point[0], -point[1], point[2]); };
  CHECK(sign_of({mirrored(x[0]), mirrored(x[1]), mirrored(x[2]), mirrored(x[3])}) == -sign);
}

}  // namespace

TEST_CASE("the sign of a tetrahedron is that of its volume, as in a mesh") {
  CHECK(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == 1);
  CHECK(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1}) == -1);
  CHECK(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {7, 5, 0}) == 0);
}

TEST_CASE("signs agree with whole numbers, of every size") {
  Random random(11);
  std::array<int, 3> found = {0, 0, 0};
  for (const Index limit : {1, 3, 100, 1 << 20}) {
    for (int i = 0; i < 20000; ++i) {
      const Points x = whole_points(random, limit);
      const int expected = sign_in_integers(x);
      REQUIRE(sign_of(x) == expected);
      ++found[static_cast<std::size_t>(expected + 1)];
    }
  }
  for (const int count : found) CHECK(count > 1000);
}

TEST_CASE("one step of a coordinate off a plane is seen") {
  // On the plane x + 2y + 3z = 6 · 2^20 with coordinates of 2^20 and a lattice of 2^-16: rounding of products is larger
  // than what decides.
  constexpr Real step = 0x1p-16;
  Random random(12);
  std::array<int, 3> found = {0, 0, 0};
  for (int i = 0; i < 20000; ++i) {
    Points x;
    for (Vec3& point : x) {
      point[1] = 0x1p20 + step * random.index(1 << 20);
      point[2] = 0x1p20 + step * random.index(1 << 20);
      point[0] = 6 * 0x1p20 - 2 * point[1] - 3 * point[2];
    }
    REQUIRE(sign_of(x) == 0);
    x[static_cast<std::size_t>(random.index(4))][random.index(3)] += (random.index(2) == 0 ? -1 : 1) * step;
    const int expected = sign_in_integers(x, step);
    REQUIRE(sign_of(x) == expected);
    ++found[static_cast<std::size_t>(expected + 1)];
  }
  CHECK(found[0] > 5000);
  CHECK(found[2] > 5000);
}

TEST_CASE("swapping two points turns the sign, in points that only rounding keeps from a plane too") {
  Random random(13);
  int flat = 0;
  for (int i = 0; i < 3000; ++i) {
    const Points x = nearly_flat_points(random);
    check_permutations(x);
    flat += sign_of(x) == 0 ? 1 : 0;
  }
  CHECK(flat < 3000 / 2);
  for (int i = 0; i < 3000; ++i) check_permutations(whole_points(random, 2));
}

TEST_CASE("coordinates of every magnitude") {
  Random random(14);
  for (const int exponent : {-1050, -900, -340, -300, 300, 340, 1000}) {
    CAPTURE(exponent);
    for (int i = 0; i < 300; ++i) {
      Points x = whole_points(random, 1000);
      const int expected = sign_in_integers(x);
      for (Vec3& point : x) {
        for (Real& coordinate : point) coordinate = std::ldexp(coordinate, exponent);
      }
      REQUIRE(sign_of(x) == expected);
    }
  }
  // Differences that overflow, and a spread of 2^300.
  CHECK(orientation({-1e308, 0, 0}, {1e308, 0, 0}, {0, 1e308, 0}, {0, 0, 1e308}) == 1);
  CHECK(orientation({1, 1, 1}, {2, 1, 1}, {1, 2, 1}, {1, 1 + 0x1p-52, 1 + 0x1p-52}) == 1);
  CHECK(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0x1p-300}) == 1);
  CHECK(orientation({1, 0, 0}, {0, 1, 0}, {-1, -1, 0}, {0, 0, -0x1p-299}) == -1);
}

TEST_CASE("of coordinates that are not finite there is no sign") {
  const Real infinity = std::numeric_limits<Real>::infinity();
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  for (const Real bad : {infinity, -infinity, nan}) {
    CHECK(orientation({bad, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}) == 0);
    CHECK(orientation({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, bad, 1}) == 0);
  }
}

}  // namespace test_exact_orientation
