#include "pliant/constraints/curvature.h"

#include "pliant/constraints/build.h"
#include "pliant/core/svd.h"

namespace pliant {
namespace {

Real length(const Real* z) {
  return std::sqrt(z[0] * z[0] + z[1] * z[1] + z[2] * z[2]);
}

/// Below this share of the rest length a direction is not told apart from rounding.
constexpr Real no_direction = 1e-12;

Vec3 unit_or_zero(const Vec3& n) {
  const Real norm = n.stableNorm();
  return norm > 0 ? Vec3(n / norm) : Vec3::Zero();
}

}  // namespace

void AbsoluteCurvature::project(const Real* field, const Real* z, Real* p) {
  const Real now = length(z);
  const Real rest = field[0];
  const bool defined = now >= no_direction * rest;
  const Real scale = rest / now;
  for (int axis = 0; axis < 3; ++axis) p[axis] = defined ? scale * z[axis] : field[1 + axis];
}

template <Vec3 (*normal)(const Positions&, std::span<const Index>)>
void SignedCurvature<normal>::project(const Real* field, const Real* z, Real* p) {
  const Real rest = field[0];
  const Real sign = field[4];
  const Eigen::Map<const Vec3> n(field + 5);
  const Eigen::Map<const Vec3> v(z);
  const Real height = v.dot(n);
  if (length(z) < no_direction * rest && n.squaredNorm() > 0) {
    for (int axis = 0; axis < 3; ++axis) p[axis] = rest * sign * n[axis];
    return;
  }
  if (sign * height >= 0) return AbsoluteCurvature::project(field, z, p);
  // On the wrong side: the nearest point of the half-sphere lies on its rim.
  const Vec3 t = v - height * n;
  const Real width = t.norm();
  const Vec3 rim = width >= no_direction * rest ? Vec3(t / width) : detail::any_orthogonal(n);
  for (int axis = 0; axis < 3; ++axis) p[axis] = rest * rim[axis];
}

Vec3 fan_normal(const Positions& positions, std::span<const Index> stencil) {
  const Vec3 center = row(positions, stencil[0]);
  Vec3 sum = Vec3::Zero();
  Vec3 previous = row(positions, stencil.back()) - center;
  for (const Index neighbor : stencil.subspan(1)) {
    const Vec3 next = row(positions, neighbor) - center;
    sum += previous.cross(next);
    previous = next;
  }
  return unit_or_zero(sum);
}

Vec3 hinge_normal(const Positions& positions, std::span<const Index> stencil) {
  const Vec3 x0 = row(positions, stencil[0]);
  const Vec3 edge = row(positions, stencil[1]) - x0;
  const Vec3 first = row(positions, stencil[2]) - x0;
  const Vec3 second = row(positions, stencil[3]) - x0;
  return unit_or_zero(edge.cross(first) + second.cross(edge));
}

Vec3 corner_normal(const Positions& positions, std::span<const Index> stencil) {
  const Vec3 x0 = row(positions, stencil[0]);
  return unit_or_zero((row(positions, stencil[1]) - x0).cross(row(positions, stencil[2]) - x0));
}

template <class Signed>
void CurvatureBatches<Signed>::add(std::span<const Index> stencil, std::span<const Real> coefficients, Real measure,
                                   Orientation orientation) {
  const Positions& x = body_.rest.vertices;
  // Summed as the local step sums it, so that a curved body at rest has a force of exactly zero.
  std::array<Real, 3> z = {0, 0, 0};
  Real magnitude = 0;
  for (std::size_t j = 1; j < stencil.size(); ++j) {
    const Vec3 e = row(x, stencil[j]) - row(x, stencil[0]);
    for (std::size_t axis = 0; axis < 3; ++axis) z[axis] += coefficients[j] * e[static_cast<Index>(axis)];
    magnitude += std::abs(coefficients[j]) * e.norm();
  }
  const Real rest = length(z.data());
  const std::vector<Index> global = global_stencil(body_, stencil);
  BatchesOfSize& same_size = batches_[stencil.size()];
  if (rest <= no_direction * magnitude) {
    batch(same_size.flat, stencil.size()).add(global, coefficients, measure, {});
    return;
  }
  if (orientation == Orientation::absolute) {
    const std::array<Real, 4> field = {rest, z[0], z[1], z[2]};
    batch(same_size.absolute, stencil.size()).add(global, coefficients, measure, field);
    return;
  }
  std::array<Real, 8> field = {rest, z[0], z[1], z[2], 1, 0, 0, 0};
  Signed::begin_step(x, stencil, field.data());
  const Real height = z[0] * field[5] + z[1] * field[6] + z[2] * field[7];
  field[4] = std::copysign(Real(1), height);
  batch(same_size.with_sign, stencil.size()).add(global, coefficients, measure, field);
}

template <class Signed>
ConstraintSet CurvatureBatches<Signed>::take() {
  ConstraintSet set;
  const auto take_batch = [&set](auto& batch) {
    if (!batch) return;
    set.count += batch->shape().count;
    set.batches.push_back(std::move(batch));
  };
  for (auto& [size, same_size] : batches_) {
    take_batch(same_size.flat);
    take_batch(same_size.absolute);
    take_batch(same_size.with_sign);
  }
  return set;
}

template struct SignedCurvature<fan_normal>;
template struct SignedCurvature<hinge_normal>;
template struct SignedCurvature<corner_normal>;
template class CurvatureBatches<SignedFanCurvature>;
template class CurvatureBatches<SignedHingeCurvature>;
template class CurvatureBatches<SignedTriangleCurvature>;

}  // namespace pliant
