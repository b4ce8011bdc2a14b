#include <limits>

#include <doctest/doctest.h>

#include "viewer/rounding.h"

namespace test_rounding {

using pliant::Real;
using pliant::Vec3;
using namespace pliant_viewer;

TEST_CASE("a number to some digits is the double nearest to that decimal number") {
  CHECK(with_digits(0.12345678901234, 5) == 0.12346);
  CHECK(with_digits(1234567.8, 5) == 1234600);
  CHECK(with_digits(-9.99999e-7, 5) == -1e-6);
  CHECK(with_digits(0.3, 5) == 0.3);
  CHECK(with_digits(Real{0}, 5) == 0);
  const Real infinite = std::numeric_limits<Real>::infinity();
  CHECK(with_digits(infinite, 5) == infinite);
}

TEST_CASE("the numbers of a vector end at the same decimal place") {
  CHECK(with_digits(Vec3(1.23456789, -0.0000123, 0.1234567), 5) == Vec3(1.2346, 0, 0.1235));
  CHECK(with_digits(Vec3(12345.678, 0.9, -0.4), 5) == Vec3(12346, 1, 0));
  CHECK(with_digits(Vec3(0, 0, -9.81), 5) == Vec3(0, 0, -9.81));
  CHECK(with_digits(Vec3::Zero().eval(), 5) == Vec3::Zero());
  CHECK(with_digits(Vec3(0.12345678, 0, 0), 5)[0] == with_digits(0.12345678, 5));
}

TEST_CASE("a number of single precision has the digits of that") {
  CHECK(without_single_precision(static_cast<Real>(0.3F)) == 0.3);
  CHECK(without_single_precision(Real{0.5}) == 0.5);
  CHECK(without_single_precision(0.1234567890123) == 0.1234567890123);
  CHECK(without_single_precision(1e300) == 1e300);
  CHECK(without_single_precision(Vec3(static_cast<Real>(-1.1F), 2, 0)) == Vec3(-1.1, 2, 0));
}

}  // namespace test_rounding
