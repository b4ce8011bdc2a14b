#include "bench/textbook.h"

#include <Eigen/SVD>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"

namespace pliant_bench {
namespace {

using namespace pliant;
using Sparse = Eigen::SparseMatrix<double>;

class TextbookSpring final : public TextbookConstraint {
 public:
  TextbookSpring(std::span<const Index> stencil, Index row, double rest_length)
      : from_(stencil[0]), to_(stencil[1]), row_(row), rest_length_(rest_length) {}
  void project(const Columns& points, Columns& projections) const override {
    const Vec3 z = points.col(to_) - points.col(from_);
    projections.col(row_) = z * (rest_length_ / z.norm());
  }

 private:
  Index from_, to_, row_;
  double rest_length_;
};

class TextbookPin final : public TextbookConstraint {
 public:
  TextbookPin(Index row, const Vec3& target) : row_(row), target_(target) {}
  void project(const Columns&, Columns& projections) const override { projections.col(row_) = target_; }

 private:
  Index row_;
  Vec3 target_;
};

/// A curvature vector keeps its length.
class TextbookBending final : public TextbookConstraint {
 public:
  TextbookBending(std::span<const Index> stencil, std::span<const Real> reduction, Index row, double rest_length)
      : stencil_(stencil.begin(), stencil.end()),
        reduction_(reduction.begin(), reduction.end()),
        row_(row),
        rest_length_(rest_length) {}
  void project(const Columns& points, Columns& projections) const override {
    Vec3 z = Vec3::Zero();
    for (std::size_t j = 0; j < stencil_.size(); ++j) z += reduction_[j] * points.col(stencil_[j]);
    const double length = z.norm();
    projections.col(row_) = length > 1e-12 ? Vec3(z * (rest_length_ / length)) : Vec3(z);
  }

 private:
  std::vector<Index> stencil_;
  std::vector<double> reduction_;
  Index row_;
  double rest_length_;
};

/// As rigid as possible: the nearest rotation by a singular value decomposition.
class TextbookTetrahedron final : public TextbookConstraint {
 public:
  TextbookTetrahedron(std::span<const Index> stencil, std::span<const Real> reduction, Index row) : row_(row) {
    std::copy_n(stencil.begin(), 4, stencil_.begin());
    // Rows of the reduction are differences to the first vertex: columns of Dm⁻¹.
    for (Index r = 0; r < 3; ++r) {
      for (Index j = 0; j < 3; ++j) inverse_rest_(j, r) = reduction[static_cast<std::size_t>(4 * r + j + 1)];
    }
  }
  void project(const Columns& points, Columns& projections) const override {
    Mat3 edges;
    for (Index j = 0; j < 3; ++j) {
      edges.col(j) = points.col(stencil_[static_cast<std::size_t>(j) + 1]) - points.col(stencil_[0]);
    }
    const Mat3 F = edges * inverse_rest_;
    const Eigen::JacobiSVD<Mat3> svd(F, Eigen::ComputeFullU | Eigen::ComputeFullV);
    Mat3 U = svd.matrixU();
    if (U.determinant() * svd.matrixV().determinant() < 0) U.col(2) = -U.col(2);
    projections.middleCols<3>(row_) = U * svd.matrixV().transpose();
  }

 private:
  std::array<Index, 4> stencil_{};
  Mat3 inverse_rest_;
  Index row_;
};

Vec3 reduced(std::span<const Index> stencil, std::span<const Real> reduction, const Positions& x) {
  Vec3 z = Vec3::Zero();
  for (std::size_t j = 0; j < stencil.size(); ++j) z += reduction[j] * (row(x, stencil[j]) - row(x, stencil[0]));
  return z;
}

/// The Kronecker product with the 3 × 3 identity.
Sparse for_all_coordinates(const Sparse& matrix) {
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(3 * static_cast<std::size_t>(matrix.nonZeros()));
  for (Index column = 0; column < matrix.outerSize(); ++column) {
    for (Sparse::InnerIterator entry(matrix, column); entry; ++entry) {
      for (Index axis = 0; axis < 3; ++axis) {
        entries.emplace_back(3 * static_cast<Index>(entry.row()) + axis, 3 * column + axis, entry.value());
      }
    }
  }
  Sparse product(3 * matrix.rows(), 3 * matrix.cols());
  product.setFromTriplets(entries.begin(), entries.end());
  return product;
}

}  // namespace

Textbook::Textbook(const Simulation& simulation, GlobalForm form)
    : form_(form), time_step_(simulation.settings().time_step) {
  const Stopwatch watch;
  const State& state = simulation.state();
  points_ = state.positions.transpose();
  velocities_ = state.velocities.transpose();
  const Eigen::Map<const Eigen::VectorXd> masses(state.masses.data(), points_.cols());
  inertia_weights_ = masses / (time_step_ * time_step_);
  Positions force = Positions::Zero(points_.cols(), 3);
  for (const auto& [id, each] : simulation.forces()) each->add_to(force, state.view(), time_step_);
  force_ = force.transpose();
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) add_group(*batch, simulation.body(group.body).mesh.vertices);
  }
  assemble();
  set_up_seconds_ = watch.seconds();
}

void Textbook::add_group(const ConstraintGroup& group, const Positions& rest) {
  const GroupShape shape = group.shape();
  const auto n = static_cast<std::size_t>(shape.vertices);
  const auto k = static_cast<std::size_t>(shape.rows);
  // targets() is not const, since points may be moved through it; here they are only read.
  const std::span<const Real> targets = const_cast<ConstraintGroup&>(group).targets();
  for (std::size_t i = 0; i < static_cast<std::size_t>(shape.count); ++i) {
    const auto first_row = static_cast<Index>(weights_.size());
    const std::span<const Index> stencil = group.stencil().subspan(i * n, n);
    const std::span<const Real> reduction = group.reduction().subspan(i * n * k, n * k);
    for (std::size_t place = 0; place < n * k; ++place) {
      reduction_.emplace_back(first_row + static_cast<Index>(place / n), stencil[place % n], reduction[place]);
    }
    weights_.insert(weights_.end(), k, group.stiffness() * group.rest_measure()[i]);
    if (group.type() == "position") {
      constraints_.push_back(std::make_unique<TextbookPin>(first_row, Vec3(targets.data() + 3 * i)));
    } else if (group.type() == "tetrahedron_strain") {
      constraints_.push_back(std::make_unique<TextbookTetrahedron>(stencil, reduction, first_row));
    } else if (group.type() == "edge_spring") {
      const double length = reduced(stencil, reduction, rest).norm();
      constraints_.push_back(std::make_unique<TextbookSpring>(stencil, first_row, length));
    } else if (group.type() == "bending" || group.type() == "hinge") {
      const double length = reduced(stencil, reduction, rest).norm();
      constraints_.push_back(std::make_unique<TextbookBending>(stencil, reduction, first_row, length));
    } else {
      fail_input("the textbook has no constraint '" + std::string(group.type()) + "'; leave it out");
    }
  }
}

void Textbook::assemble() {
  const auto rows = static_cast<Index>(weights_.size());
  Sparse A(rows, points_.cols());
  A.setFromTriplets(reduction_.begin(), reduction_.end());
  reduction_ = {};
  const Eigen::Map<const Eigen::VectorXd> weights(weights_.data(), rows);
  weighted_transpose_ = Sparse(A.transpose()) * weights.asDiagonal();
  Sparse Y = weighted_transpose_ * A;
  for (Index i = 0; i < static_cast<Index>(points_.cols()); ++i) Y.coeffRef(i, i) += inertia_weights_[i];
  if (form_ == GlobalForm::all_coordinates) {
    Y = for_all_coordinates(Y);
    weighted_transpose_ = for_all_coordinates(weighted_transpose_);
  }
  llt_.compute(Y);
  if (llt_.info() != Eigen::Success) fail_input("the textbook's matrix is not positive definite; reduce the stiffness");
  projections_.resize(3, rows);
}

void Textbook::begin_step() {
  start_ = points_;
  const Eigen::RowVectorXd inverse = inertia_weights_.cwiseInverse().transpose();
  predicted_ = points_ + time_step_ * velocities_ + force_ * inverse.asDiagonal();
  momentum_ = predicted_ * inertia_weights_.asDiagonal();
  points_ = predicted_;
}

void Textbook::iterate() {
  for (const auto& constraint : constraints_) constraint->project(points_, projections_);
  if (form_ == GlobalForm::by_coordinate) {
    solve_by_coordinate();
  } else {
    solve_all_coordinates();
  }
}

void Textbook::solve_by_coordinate() {
  for (Index axis = 0; axis < 3; ++axis) {
    const Eigen::VectorXd b =
        weighted_transpose_ * projections_.row(axis).transpose() + momentum_.row(axis).transpose();
    points_.row(axis) = llt_.solve(b).transpose();
  }
}

void Textbook::solve_all_coordinates() {
  const Eigen::VectorXd b = weighted_transpose_ * projections_.reshaped() + momentum_.reshaped();
  points_.reshaped() = llt_.solve(b);
}

void Textbook::end_step() {
  velocities_ = (points_ - start_) / time_step_;
}

}  // namespace pliant_bench
