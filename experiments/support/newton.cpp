#include "support/newton.h"

#include <algorithm>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"

namespace pliant_experiments {
namespace {

using namespace pliant;

constexpr double least_step = 1e-10;       // of the full one
constexpr double sufficient_share = 1e-4;  // of the decrease that the slope promises (Armijo)
constexpr double rounding_share = 1e-13;   // of the objective: smaller differences are mostly rounding

/// Every entry that any Hessian of the model has, lower triangle.
Eigen::SparseMatrix<double> pattern(const MassSpring& model) {
  std::vector<Eigen::Triplet<double>> entries;
  const auto add_block = [&](Index row, Index column) {
    for (Index r = 0; r < 3; ++r) {
      for (Index c = 0; c < 3; ++c) {
        if (3 * row + r >= 3 * column + c) entries.emplace_back(3 * row + r, 3 * column + c, 0.);
      }
    }
  };
  for (Index i = 0; i < model.vertex_count(); ++i) add_block(i, i);
  for (const Spring& spring : model.springs)
    add_block(std::max(spring.from, spring.to), std::min(spring.from, spring.to));
  Eigen::SparseMatrix<double> matrix(3 * model.vertex_count(), 3 * model.vertex_count());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

Mat3 spring_block(const Spring& spring, const Positions& q, Curvature curvature) {
  const Vec3 edge = row(q, spring.to) - row(q, spring.from);
  const double length = edge.norm();
  const Vec3 n = edge / length;
  double across = 1 - spring.rest_length / length;
  if (curvature == Curvature::positive) across = std::max(0., across);
  return spring.stiffness * ((1 - across) * n * n.transpose() + across * Mat3::Identity());
}

}  // namespace

Newton::Newton(MassSpring model) : model_(std::move(model)) {
  const Stopwatch watch;
  hessian_ = pattern(model_);
  for (Index i = 0; i < model_.vertex_count(); ++i) diagonal_.push_back(block(i, i));
  for (const Spring& spring : model_.springs) {
    off_diagonal_.push_back(block(std::max(spring.from, spring.to), std::min(spring.from, spring.to)));
  }
  llt_.analyzePattern(hessian_);
  times_.analysis = watch.seconds();
}

Newton::Block Newton::block(Index row, Index column) const {
  Block found;
  for (Index c = 0; c < 3; ++c) {
    const auto* const begin = hessian_.innerIndexPtr() + hessian_.outerIndexPtr()[3 * column + c];
    const auto* const end = hessian_.innerIndexPtr() + hessian_.outerIndexPtr()[3 * column + c + 1];
    const Index first = row == column ? 3 * row + c : 3 * row;
    found.columns[static_cast<std::size_t>(c)] = std::lower_bound(begin, end, first) - hessian_.innerIndexPtr();
  }
  return found;
}

void Newton::add(const Block& block, const Mat3& values, bool is_diagonal) {
  for (Index c = 0; c < 3; ++c) {
    double* value = hessian_.valuePtr() + block.columns[static_cast<std::size_t>(c)];
    for (Index r = is_diagonal ? c : 0; r < 3; ++r) *value++ += values(r, c);
  }
}

const Eigen::SparseMatrix<double>& Newton::assemble(const EulerStep& step, const Positions& q, Curvature curvature) {
  std::fill_n(hessian_.valuePtr(), hessian_.nonZeros(), 0.);
  const auto is_pinned = [&](Index i) { return model_.is_pinned[static_cast<std::size_t>(i)] != 0; };
  for (Index i = 0; i < model_.vertex_count(); ++i) {
    const double inertia = model_.masses[static_cast<std::size_t>(i)] / (step.time_step * step.time_step);
    add(diagonal_[static_cast<std::size_t>(i)], (is_pinned(i) ? 1 : inertia) * Mat3::Identity(), true);
  }
  for (std::size_t i = 0; i < model_.springs.size(); ++i) {
    const Spring& spring = model_.springs[i];
    const Mat3 values = spring_block(spring, q, curvature);
    for (const Index end : {spring.from, spring.to}) {
      if (!is_pinned(end)) add(diagonal_[static_cast<std::size_t>(end)], values, true);
    }
    if (!is_pinned(spring.from) && !is_pinned(spring.to)) add(off_diagonal_[i], -values, false);
  }
  for (const SoftPin& pin : model_.soft_pins) {
    add(diagonal_[static_cast<std::size_t>(pin.vertex)], pin.stiffness * Mat3::Identity(), true);
  }
  return hessian_;
}

bool Newton::factorize(const EulerStep& step, const Positions& q) {
  Stopwatch watch;
  assemble(step, q, curvature_);
  times_.assembly += watch.lap();
  llt_.factorize(hessian_);
  times_.factorization += watch.lap();
  return llt_.info() == Eigen::Success;
}

bool Newton::iterate(const EulerStep& step, Positions& q) {
  Stopwatch watch;
  const Positions g = gradient(model_, step, q);
  times_.assembly += watch.lap();
  if (!factorize(step, q)) {
    curvature_ = Curvature::positive;
    if (!factorize(step, q)) {
      throw Error(ErrorKind::diverged, "Newton's matrix is not positive definite; take a smaller time step");
    }
  }
  factor_entries_ = llt_.matrixL().nestedExpression().nonZeros();
  watch.lap();
  const Eigen::Map<const Eigen::VectorXd> slopes(g.data(), g.size());
  const Eigen::VectorXd direction = -llt_.solve(slopes);
  times_.solution += watch.lap();
  const bool moved = search(step, direction, g, q);
  times_.line_search += watch.lap();
  return moved;
}

bool Newton::search(const EulerStep& step, const Eigen::VectorXd& direction, const Positions& g, Positions& q) {
  const double before = objective(model_, step, q);
  const Eigen::Map<const Positions> move(direction.data(), q.rows(), 3);
  const double slope = g.cwiseProduct(move).sum();
  if (-slope < rounding_share * before) {  // the gradient tells more digits of the minimum than the objective
    const Positions trial = q + move;
    if (gradient(model_, step, trial).norm() >= g.norm()) return false;
    q = trial;
    return true;
  }
  for (double share = 1; share >= least_step; share /= 2) {
    const Positions trial = q + share * move;
    const double after = objective(model_, step, trial);
    if (after < before && after <= before + sufficient_share * share * slope) {
      q = trial;
      curvature_ = share == 1 ? Curvature::exact : Curvature::positive;
      return true;
    }
  }
  return false;
}

int Newton::minimize(const EulerStep& step, Positions& q, int most) {
  int done = 0;
  while (done < most && iterate(step, q)) ++done;
  return done;
}

}  // namespace pliant_experiments
