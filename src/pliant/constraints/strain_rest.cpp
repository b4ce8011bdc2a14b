#include "pliant/constraints/strain_rest.h"

namespace pliant {
namespace {

/// F = Ds Dm⁻¹ with Ds = (x₁ − x₀, ..., x_d − x₀): column a of F is Σⱼ Dm⁻¹(j, a) (xⱼ₊₁ − x₀).
template <int d>
RestElement<d + 1> element(const Eigen::Matrix<Real, d, d>& inverse, Real measure) {
  RestElement<d + 1> rest;
  rest.measure = measure;
  for (int a = 0; a < d; ++a) {
    Real sum = 0;
    for (int j = 0; j < d; ++j) {
      rest.reduction[static_cast<std::size_t>(a * (d + 1) + j + 1)] = inverse(j, a);
      sum += inverse(j, a);
    }
    rest.reduction[static_cast<std::size_t>(a * (d + 1))] = -sum;
  }
  return rest;
}

}  // namespace

RestElement<3> rest_triangle(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
  const Vec3 e1 = x1 - x0;
  const Vec3 e2 = x2 - x0;
  const Real length = e1.norm();
  const Real height = e1.cross(e2).norm() / length;
  Eigen::Matrix<Real, 2, 2> Dm;
  Dm << length, e1.dot(e2) / length, 0, height;
  return element<2>(Dm.inverse(), length * height / 2);
}

RestElement<4> rest_tetrahedron(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  Mat3 Dm;
  Dm << x1 - x0, x2 - x0, x3 - x0;
  return element<3>(Dm.inverse(), Dm.determinant() / 6);
}

}  // namespace pliant
