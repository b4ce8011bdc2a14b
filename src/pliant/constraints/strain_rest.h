#pragma once
// Rest data of triangles and tetrahedra: the reduction that takes vertices to the deformation gradient F = Ds Dm⁻¹.
#include "pliant/constraints/constraint_set.h"

namespace pliant {

/// One element at rest.
template <int vertices>
struct RestElement {
  std::array<Real, static_cast<std::size_t>((vertices - 1) * vertices)> reduction;  ///< row a: column a of F
  Real measure;                                                                     ///< area [m²] or volume [m³], > 0
};

/// F of a triangle is 3 × 2, in the frame (x along x₁ − x₀, y in the plane of the triangle).
RestElement<3> rest_triangle(const Vec3& x0, const Vec3& x1, const Vec3& x2);

RestElement<4> rest_tetrahedron(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3);

}  // namespace pliant
