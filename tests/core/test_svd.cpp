#include <doctest/doctest.h>

#include "pliant/core/svd.h"
#include "random.h"

namespace test_svd {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real accuracy = 1e-13;

template <class Matrix>
Real distance_from_orthonormal(const Matrix& columns) {
  const auto gram = (columns.transpose() * columns).eval();
  return (gram - decltype(gram)::Identity(gram.rows(), gram.cols())).cwiseAbs().maxCoeff();
}

SmallSvd<2> decompose(const ThreeRows<2>& F) {
  return svd(F);
}
SmallSvd<3> decompose(const Mat3& F) {
  return signed_svd(F);
}

template <int columns>
void check_svd(const ThreeRows<columns>& F) {
  CAPTURE(F);
  const SmallSvd<columns> result = decompose(F);
  CHECK(distance_from_orthonormal(result.U) < accuracy);
  CHECK(distance_from_orthonormal(result.V) < accuracy);
  CHECK(result.V.determinant() == doctest::Approx(1).epsilon(accuracy));
  for (int i = 1; i < columns; ++i) CHECK(std::abs(result.sigma[i]) <= std::abs(result.sigma[i - 1]) * (1 + accuracy));
  for (int i = 0; i < 2; ++i) CHECK(result.sigma[i] >= 0);
  const ThreeRows<columns> again = result.U * result.sigma.asDiagonal() * result.V.transpose();
  CHECK((again - F).cwiseAbs().maxCoeff() <= accuracy * F.cwiseAbs().maxCoeff());
}

void check_signed_svd(const Mat3& F) {
  check_svd<3>(F);
  CHECK(signed_svd(F).U.determinant() == doctest::Approx(1).epsilon(accuracy));
}

Mat3 random_matrix(Random& random) {
  Mat3 F;
  F << random.vector(1), random.vector(1), random.vector(1);
  return F;
}

}  // namespace

TEST_CASE("SVD of random matrices at scales from 1e-150 to 1e150") {
  Random random;
  for (const Real scale : {1.0, 1e-3, 1e6, 1e-150, 1e150}) {
    for (int i = 0; i < 500; ++i) {
      const Mat3 F = scale * random_matrix(random);
      check_signed_svd(F);
      check_svd<2>(F.leftCols<2>());
      CHECK(std::signbit(signed_svd(F).sigma[2]) == std::signbit((F / scale).determinant()));
    }
  }
}

TEST_CASE("SVD of matrices of rank 2, 1 and 0") {
  Random random;
  for (int i = 0; i < 500; ++i) {
    const Vec3 a = random.vector(1);
    const Vec3 b = random.vector(1);
    const Mat3 rank_one = a * b.transpose();
    const Mat3 rank_two = rank_one + random.vector(1) * random.vector(1).transpose();
    for (const Mat3& F : {rank_one, rank_two}) {
      check_signed_svd(F);
      check_svd<2>(F.leftCols<2>());
    }
    CHECK(signed_svd(rank_one).sigma[0] == doctest::Approx(a.norm() * b.norm()).epsilon(accuracy));
    CHECK(std::abs(signed_svd(rank_one).sigma[1]) < accuracy);
    CHECK(std::abs(signed_svd(rank_two).sigma[2]) < accuracy);
  }
  check_signed_svd(Mat3::Zero());
  check_svd<2>(ThreeRows<2>::Zero());
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) check_signed_svd(Vec3::Unit(i) * Vec3::Unit(j).transpose());
  }
}

TEST_CASE("SVD with singular values that repeat, nearly repeat, or differ by 12 orders") {
  Random random;
  const std::array<Vec3, 7> sigmas = {Vec3(1, 1, 1),         Vec3(1, 1, -1),       Vec3(2, 1, 1), Vec3(2, 2, 1),
                                      Vec3(1, 1, -1 + 1e-9), Vec3(1, 1e-6, 1e-12), Vec3(1, 1, 0)};
  for (const Vec3& sigma : sigmas) {
    for (int i = 0; i < 200; ++i) {
      const Mat3 F = random.rotation() * sigma.asDiagonal() * random.rotation().transpose();
      check_signed_svd(F);
      check_svd<2>(F.leftCols<2>());
      CHECK((signed_svd(F).sigma - sigma).cwiseAbs().maxCoeff() < accuracy);
    }
  }
}

TEST_CASE("SVD keeps the small singular value of orthogonal columns to its own accuracy") {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const Mat3 F = random.rotation() * Vec3(1e8, 1, 1e-8).asDiagonal();
    CHECK(signed_svd(F).sigma[2] == doctest::Approx(1e-8).epsilon(1e-6));
  }
}

TEST_CASE("SVD of what is not a number comes to an end") {
  const Real nan = std::numeric_limits<Real>::quiet_NaN();
  signed_svd(Mat3::Constant(nan));
  Mat3 F = Mat3::Identity();
  F(1, 2) = std::numeric_limits<Real>::infinity();
  signed_svd(F);
  svd(F.leftCols<2>());
}

TEST_CASE("any_orthogonal is a unit vector at a right angle, and always the same one") {
  Random random;
  for (int i = 0; i < 200; ++i) {
    const Vec3 u = i < 3 ? Vec3(Vec3::Unit(i)) : random.unit_vector();
    const Vec3 t = detail::any_orthogonal(u);
    CHECK(std::abs(t.dot(u)) < 1e-15);
    CHECK(t.norm() == doctest::Approx(1).epsilon(1e-15));
    CHECK(t == detail::any_orthogonal(u));
  }
}

}  // namespace test_svd
