// What holds for every projection, written once over the list of them.
#include <doctest/doctest.h>

#include "element_samples.h"
#include "pliant/core/svd.h"

namespace test_projections {

using namespace pliant;
using namespace pliant_tests;

namespace {

template <class Type>
Rows<Type> projected(const Fields& fields, const Rows<Type>& z) {
  Rows<Type> p;
  Type::project(fields.data(), z.data(), p.data());
  return p;
}

template <class Type>
Rows<Type> random_rows(Random& random, Real size) {
  Rows<Type> z;
  for (int row = 0; row < Type::rows; ++row) z.row(row) = random.vector(size).transpose();
  return z;
}

/// Whether the nearest point of the set is unique near z, by a margin.
template <class Type>
bool is_regular(const Fields& fields, const Rows<Type>& z) {
  if constexpr (Type::rows == 3) {
    const SmallSvd<3> svd = signed_svd(Mat3(z.transpose()));
    return svd.sigma[1] + svd.sigma[2] > 0.1;
  } else if constexpr (Type::rows == 2) {
    return svd(ThreeRows<2>(z.transpose())).sigma[1] > 0.1;
  } else if constexpr (std::is_base_of_v<HalfSphereSamples, Samples<Type>>) {
    return z.cross(Eigen::RowVector3d(fields[5], fields[6], fields[7])).norm() > 0.1;
  } else {
    return z.norm() > 0.1;
  }
}

}  // namespace

TEST_CASE_TEMPLATE_DEFINE("a projection lies in the set, and projecting it again leaves it there", Type, in_the_set) {
  Random random;
  for (int i = 0; i < 300; ++i) {
    const Fields fields = Samples<Type>::fields(random);
    const Rows<Type> z = random_rows<Type>(random, 2);
    const Rows<Type> p = projected<Type>(fields, z);
    CHECK(Samples<Type>::distance(fields, p) < 1e-13);
    CHECK((projected<Type>(fields, p) - p).norm() < 1e-13);
  }
}
TEST_CASE_TEMPLATE_APPLY(in_the_set, BuiltinProjections);

TEST_CASE_TEMPLATE_DEFINE("the projection of a member is the member", Type, of_a_member) {
  Random random;
  for (int i = 0; i < 300; ++i) {
    const Fields fields = Samples<Type>::fields(random);
    const Rows<Type> member = Samples<Type>::member(random, fields);
    CHECK((projected<Type>(fields, member) - member).norm() < 1e-13);
  }
}
TEST_CASE_TEMPLATE_APPLY(of_a_member, BuiltinProjections);

TEST_CASE_TEMPLATE_DEFINE("a projection turns with space", Type, turns) {
  Random random;
  for (int i = 0; i < 300; ++i) {
    Fields fields = Samples<Type>::fields(random);
    const Rows<Type> z = random_rows<Type>(random, 2);
    const Mat3 R = random.rotation();
    const Rows<Type> expected = projected<Type>(fields, z) * R.transpose();
    if (!is_regular<Type>(fields, z)) continue;
    Samples<Type>::turn(fields, R);
    CHECK((projected<Type>(fields, z * R.transpose()) - expected).norm() < 1e-12);
  }
}
TEST_CASE_TEMPLATE_APPLY(turns, BuiltinProjections);

TEST_CASE_TEMPLATE_DEFINE("no sampled member of the set is nearer than the projection", Type, nearest) {
  Random random;
  for (int i = 0; i < 60; ++i) {
    const Fields fields = Samples<Type>::fields(random);
    const Rows<Type> z = random_rows<Type>(random, 2);
    const Rows<Type> p = projected<Type>(fields, z);
    const Real distance = (z - p).norm();
    Real nearest = std::numeric_limits<Real>::max();
    for (int sample = 0; sample < 300; ++sample) {
      nearest = std::min(nearest, (z - Samples<Type>::member(random, fields)).norm());
      // Members close to p are those that a slightly wrong projection would lose to.
      const Real reach = std::pow(10, random.uniform(-5, 0));
      const Rows<Type> member = projected<Type>(fields, p + random_rows<Type>(random, reach));
      nearest = std::min(nearest, (z - member).norm());
    }
    CHECK(distance <= nearest + 1e-13);
  }
}
TEST_CASE_TEMPLATE_APPLY(nearest, BuiltinProjections);

TEST_CASE_TEMPLATE_DEFINE("z - p is the gradient of half the squared distance", Type, gradient) {
  Random random;
  constexpr Real h = 1e-6;
  int regular = 0;
  for (int i = 0; i < 300; ++i) {
    const Fields fields = Samples<Type>::fields(random);
    const Rows<Type> z = random_rows<Type>(random, 2);
    if (!is_regular<Type>(fields, z)) continue;
    ++regular;
    const Rows<Type> exact = z - projected<Type>(fields, z);
    const auto energy = [&](const Rows<Type>& x) { return (x - projected<Type>(fields, x)).squaredNorm() / 2; };
    for (int a = 0; a < Type::rows * 3; ++a) {
      Rows<Type> ahead = z;
      Rows<Type> behind = z;
      ahead.data()[a] += h;
      behind.data()[a] -= h;
      CHECK(std::abs((energy(ahead) - energy(behind)) / (2 * h) - exact.data()[a]) < 1e-8 * (1 + exact.norm()));
    }
  }
  CHECK(regular > 100);
}
TEST_CASE_TEMPLATE_APPLY(gradient, BuiltinProjections);

TEST_CASE_TEMPLATE_DEFINE("a projection is in the set for zero, tiny and huge arguments", Type, extremes) {
  Random random;
  for (const Real size : {0.0, 1e-300, 1e-150, 1e-20, 1e20, 1e150}) {
    for (int i = 0; i < 50; ++i) {
      const Fields fields = Samples<Type>::fields(random);
      const Rows<Type> z = random_rows<Type>(random, size);
      const Rows<Type> p = projected<Type>(fields, z);
      CAPTURE(size);
      CAPTURE(z);
      REQUIRE(p.allFinite());
      CHECK(Samples<Type>::distance(fields, p) <= 1e-13 * (1 + p.norm()));
      CHECK(projected<Type>(fields, z) == p);
    }
  }
}
TEST_CASE_TEMPLATE_APPLY(extremes, BuiltinProjections);

TEST_CASE_TEMPLATE_DEFINE("a projection of what is not finite comes to an end", Type, not_finite) {
  Random random;
  const Fields fields = Samples<Type>::fields(random);
  for (const Real bad : {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity()}) {
    for (int a = 0; a < Type::rows * 3; ++a) {
      Rows<Type> z = random_rows<Type>(random, 1);
      z.data()[a] = bad;
      projected<Type>(fields, z);
    }
    projected<Type>(fields, Rows<Type>::Constant(bad));
  }
}
TEST_CASE_TEMPLATE_APPLY(not_finite, BuiltinProjections);

TEST_CASE("a tetrahedron is projected to a positive determinant, however it has been crushed") {
  Random random;
  const std::array<Vec3, 9> sigmas = {Vec3(1, 1, -1), Vec3(2, 1, -0.5), Vec3(1, 1, 0),
                                      Vec3(1, 0, 0),  Vec3(0, 0, 0),    Vec3(-1, -1, -1),
                                      Vec3(1, -1, 1), Vec3(3, 2, 1),    Vec3(1, 1e-16, -1e-16)};
  for (const auto& [min, max] : {std::pair(1.0, 1.0), std::pair(0.9, 1.1), std::pair(1e-3, 5.0)}) {
    const Fields limits = {min, max};
    for (const Vec3& sigma : sigmas) {
      for (int i = 0; i < 50; ++i) {
        const Mat3 F = random.rotation() * sigma.asDiagonal() * random.rotation();
        const Mat3 p = projected<TetrahedronStrainProjection>(limits, F.transpose());
        CHECK(p.determinant() >= min * min * min * (1 - 1e-12));
        CHECK((projected<TetrahedronStrainProjection>(limits, p) - p).norm() < 1e-13);
      }
    }
  }
}

}  // namespace test_projections
