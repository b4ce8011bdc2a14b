#pragma once
// What a property test needs to know of a projection: random rest data, how that turns with space, random members of
// the set, and how far a point is from it. One specialization for each type of BuiltinProjections.
#include <algorithm>

#include "../core/random.h"
#include "pliant/constraints/builtin.h"

namespace pliant_tests {

using pliant::Real;
using pliant::Vec3;

/// z or p of one constraint: k × 3.
template <class Type>
using Rows = Eigen::Matrix<Real, Type::rows, 3, Eigen::RowMajor>;

/// Rest data of one constraint.
using Fields = std::vector<Real>;

template <class Type>
struct Samples;

inline void rotate(Fields& fields, std::size_t first, const pliant::Mat3& R) {
  Eigen::Map<Vec3> v(fields.data() + first);
  v = (R * v).eval();
}

template <>
struct Samples<pliant::PositionProjection> {
  static Fields fields(Random& random) {
    const Vec3 t = random.vector(2);
    return {t[0], t[1], t[2]};
  }
  static void turn(Fields& fields, const pliant::Mat3& R) { rotate(fields, 0, R); }
  static Eigen::RowVector3d member(Random&, const Fields& f) { return {f[0], f[1], f[2]}; }
  static Real distance(const Fields& f, const Eigen::RowVector3d& p) {
    return (p - Eigen::RowVector3d(f[0], f[1], f[2])).norm();
  }
};

template <>
struct Samples<pliant::DragProjection> : Samples<pliant::PositionProjection> {};

template <>
struct Samples<pliant::LineProjection> {
  static Fields fields(Random& random) {
    const Vec3 o = random.vector(2);
    const Vec3 d = random.unit_vector();
    return {o[0], o[1], o[2], d[0], d[1], d[2]};
  }
  static void turn(Fields& fields, const pliant::Mat3& R) {
    rotate(fields, 0, R);
    rotate(fields, 3, R);
  }
  static Eigen::RowVector3d member(Random& random, const Fields& f) {
    const Real along = random.uniform(-4, 4);
    return {f[0] + along * f[3], f[1] + along * f[4], f[2] + along * f[5]};
  }
  static Real distance(const Fields& f, const Eigen::RowVector3d& p) {
    const Vec3 d(f[3], f[4], f[5]);
    return (p.transpose() - Vec3(f[0], f[1], f[2])).cross(d).norm();
  }
};

struct PlaneSamples {
  static Fields fields(Random& random) { return Samples<pliant::LineProjection>::fields(random); }
  static void turn(Fields& fields, const pliant::Mat3& R) { Samples<pliant::LineProjection>::turn(fields, R); }
  static Real height(const Fields& f, const Eigen::RowVector3d& p) {
    return (p - Eigen::RowVector3d(f[0], f[1], f[2])).dot(Eigen::RowVector3d(f[3], f[4], f[5]));
  }
  static Eigen::RowVector3d at_height(Random& random, const Fields& f, Real height_of_member) {
    const Eigen::RowVector3d p = random.vector(4).transpose();
    return p + (height_of_member - height(f, p)) * Eigen::RowVector3d(f[3], f[4], f[5]);
  }
};

template <>
struct Samples<pliant::PlaneProjection> : PlaneSamples {
  static Eigen::RowVector3d member(Random& random, const Fields& f) { return at_height(random, f, 0); }
  static Real distance(const Fields& f, const Eigen::RowVector3d& p) { return std::abs(height(f, p)); }
};

template <>
struct Samples<pliant::HalfSpaceProjection> : PlaneSamples {
  static Eigen::RowVector3d member(Random& random, const Fields& f) {
    return at_height(random, f, random.index(2) == 0 ? 0 : random.uniform(0, 3));
  }
  static Real distance(const Fields& f, const Eigen::RowVector3d& p) { return std::max(Real(0), -height(f, p)); }
};

/// Vectors of a length between two limits.
struct ShellSamples {
  static void turn(Fields&, const pliant::Mat3&) {}
  static Eigen::RowVector3d member_of(Random& random, Real min, Real max) {
    return random.uniform(min, max) * random.unit_vector().transpose();
  }
  static Real distance_from(Real min, Real max, const Eigen::RowVector3d& p) {
    return std::max({min - p.norm(), p.norm() - max, Real(0)});
  }
};

template <>
struct Samples<pliant::EdgeSpringProjection> : ShellSamples {
  static Fields fields(Random& random) { return {random.uniform(0.2, 2)}; }
  static Eigen::RowVector3d member(Random& random, const Fields& f) { return member_of(random, f[0], f[0]); }
  static Real distance(const Fields& f, const Eigen::RowVector3d& p) { return distance_from(f[0], f[0], p); }
};

/// Both ends of an edge of given length.
template <>
struct Samples<pliant::EdgeEndsProjection> {
  using Ends = Rows<pliant::EdgeEndsProjection>;
  static void turn(Fields&, const pliant::Mat3&) {}
  static Fields fields(Random& random) { return {random.uniform(0.2, 2)}; }
  static Ends member(Random& random, const Fields& f) {
    Ends ends;
    ends.row(0) = random.vector(2).transpose();
    ends.row(1) = ends.row(0) + f[0] * random.unit_vector().transpose();
    return ends;
  }
  static Real distance(const Fields& f, const Ends& p) { return std::abs((p.row(1) - p.row(0)).norm() - f[0]); }
};

/// Limits of the stretch: equal, apart, and (for types that allow it) from zero up.
inline Fields limits(Random& random, Real smallest) {
  switch (random.index(3)) {
    case 0:
      return {1, 1};
    case 1:
      return {random.uniform(0.5, 1), random.uniform(1, 1.5)};
    default:
      return {smallest, random.uniform(0.5, 1.5)};
  }
}

template <>
struct Samples<pliant::EdgeStrainProjection> : ShellSamples {
  static Fields fields(Random& random) { return limits(random, 0); }
  static Eigen::RowVector3d member(Random& random, const Fields& f) { return member_of(random, f[0], f[1]); }
  static Real distance(const Fields& f, const Eigen::RowVector3d& p) { return distance_from(f[0], f[1], p); }
};

template <>
struct Samples<pliant::FibreStrainProjection> : Samples<pliant::EdgeStrainProjection> {};

template <>
struct Samples<pliant::FlatCurvature> : ShellSamples {
  static Fields fields(Random&) { return {}; }
  static Eigen::RowVector3d member(Random&, const Fields&) { return Eigen::RowVector3d::Zero(); }
  static Real distance(const Fields&, const Eigen::RowVector3d& p) { return p.norm(); }
};

template <>
struct Samples<pliant::AbsoluteCurvature> : ShellSamples {
  static Fields fields(Random& random) {
    const Real rest = random.uniform(0.2, 5);
    const Vec3 v = rest * random.unit_vector();
    return {rest, v[0], v[1], v[2]};
  }
  static void turn(Fields& fields, const pliant::Mat3& R) { rotate(fields, 1, R); }
  static Eigen::RowVector3d member(Random& random, const Fields& f) { return member_of(random, f[0], f[0]); }
  static Real distance(const Fields& f, const Eigen::RowVector3d& p) { return distance_from(f[0], f[0], p); }
};

struct HalfSphereSamples : ShellSamples {
  static Fields fields(Random& random) {
    const Real rest = random.uniform(0.2, 5);
    const Vec3 v = rest * random.unit_vector();
    const Vec3 n = random.unit_vector();
    return {rest, v[0], v[1], v[2], std::copysign(Real(1), v.dot(n)), n[0], n[1], n[2]};
  }
  static void turn(Fields& fields, const pliant::Mat3& R) {
    rotate(fields, 1, R);
    rotate(fields, 5, R);
  }
  static Real height(const Fields& f, const Eigen::RowVector3d& p) {
    return f[4] * p.dot(Eigen::RowVector3d(f[5], f[6], f[7]));
  }
  static Eigen::RowVector3d member(Random& random, const Fields& f) {
    const Eigen::RowVector3d p = member_of(random, f[0], f[0]);
    return height(f, p) >= 0 ? p : Eigen::RowVector3d(-p);
  }
  static Real distance(const Fields& f, const Eigen::RowVector3d& p) {
    return std::max(distance_from(f[0], f[0], p), -height(f, p));
  }
};

template <>
struct Samples<pliant::SignedFanCurvature> : HalfSphereSamples {};
template <>
struct Samples<pliant::SignedHingeCurvature> : HalfSphereSamples {};

}  // namespace pliant_tests
