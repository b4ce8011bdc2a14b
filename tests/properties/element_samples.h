#pragma once
// The samples of triangles, tetrahedra and ties.
#include <Eigen/SVD>

#include "projection_samples.h"

namespace pliant_tests {

/// Matrices whose stretches lie between two limits; row a of z is column a of F.
template <int columns>
struct StretchSamples {
  using Transposed = Eigen::Matrix<Real, columns, 3, Eigen::RowMajor>;
  static Fields fields(Random& random) { return limits(random, columns == 3 ? 0.1 : 0); }
  static void turn(Fields&, const pliant::Mat3&) {}
  static Transposed member(Random& random, const Fields& f) {
    Eigen::Matrix<Real, columns, 1> sigma;
    for (Real& stretch : sigma) stretch = random.uniform(f[0], f[1]);
    const pliant::Mat3 V = random.rotation();
    Eigen::Matrix<Real, columns, columns> turned = V.topLeftCorner<columns, columns>();
    if constexpr (columns == 2) turned = Eigen::Rotation2D<Real>(random.uniform(0, 7)).toRotationMatrix();
    return turned * sigma.asDiagonal() * random.rotation().template leftCols<columns>().transpose();
  }
  static Real distance(const Fields& f, const Transposed& p) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd{Eigen::MatrixXd(p)};
    const Real below = f[0] - svd.singularValues().minCoeff();
    const Real above = svd.singularValues().maxCoeff() - f[1];
    if constexpr (columns == 3) {
      if (!(p.determinant() > 0)) return 1;
    }
    return std::max({below, above, Real(0)});
  }
};

template <>
struct Samples<pliant::TriangleStrainProjection> : StretchSamples<2> {};
template <>
struct Samples<pliant::TetrahedronStrainProjection> : StretchSamples<3> {};

/// Matrices whose area or volume lies between two limits; row a of z is column a of F.
template <int columns>
struct ProductSamples {
  using Transposed = Eigen::Matrix<Real, columns, 3, Eigen::RowMajor>;
  static Fields fields(Random& random) { return limits(random, columns == 3 ? 0.1 : 0); }
  static void turn(Fields&, const pliant::Mat3&) {}
  static Transposed member(Random& random, const Fields& f) {
    Eigen::Matrix<Real, columns, 1> sigma;
    sigma[0] = random.uniform(f[0], f[1]);
    for (int i = 1; i < columns; ++i) {
      sigma[i] = std::pow(10, random.uniform(-1, 1));
      sigma[0] /= sigma[i];
    }
    const pliant::Mat3 V = random.rotation();
    Eigen::Matrix<Real, columns, columns> turned = V.topLeftCorner<columns, columns>();
    if constexpr (columns == 2) turned = Eigen::Rotation2D<Real>(random.uniform(0, 7)).toRotationMatrix();
    return turned * sigma.asDiagonal() * random.rotation().template leftCols<columns>().transpose();
  }
  /// By how much the smallest stretch would have to change.
  static Real distance(const Fields& f, const Transposed& p) {
    const Eigen::JacobiSVD<Eigen::MatrixXd> svd{Eigen::MatrixXd(p)};
    const auto& sigma = svd.singularValues();
    Real smallest = sigma[columns - 1], others = sigma.head(columns - 1).prod();
    if constexpr (columns == 3) smallest = std::copysign(smallest, p.determinant());
    if (others == 0) return f[0] > 0 ? 1 : 0;
    return std::max({f[0] / others - smallest, smallest - f[1] / others, Real(0)});
  }
};

template <>
struct Samples<pliant::TriangleAreaProjection> : ProductSamples<2> {};
template <>
struct Samples<pliant::TetrahedronVolumeProjection> : ProductSamples<3> {};

/// What is no projection has neither set nor members.
template <>
struct Samples<pliant::TautFibrePotential> {
  static Fields fields(Random& random) {
    const Fields free = limits(random, 0);
    const Real rise = random.index(2) == 0 ? 1e-30 : random.uniform(0.01, 0.3);
    return {free[0], free[1], free[1] * random.uniform(1, 1.2), rise, random.uniform(0, 20)};
  }
};

template <class Law, int columns>
struct Samples<pliant::ElasticPotential<Law, columns>> {
  static Fields fields(Random& random) { return {random.uniform(0.05, 1.3), random.uniform(0, 1.1)}; }
};

template <>
struct Samples<pliant::AttachmentProjection> : ShellSamples {
  static Fields fields(Random& random) {
    const Real length = random.index(3) == 0 ? 0 : random.uniform(0.2, 2);
    return {length, length, length, 0, 0};
  }
  static Eigen::RowVector3d member(Random& random, const Fields& f) { return member_of(random, 0, f[0]); }
  static Real distance(const Fields& f, const Eigen::RowVector3d& p) { return distance_from(0, f[0], p); }
};

}  // namespace pliant_tests
