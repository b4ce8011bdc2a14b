#include "pliant/solver/global/factor_correction.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pliant/core/error.h"

namespace pliant {
namespace {

/// Of the trace.
constexpr Real smallest_shift = 1e-15;

}  // namespace

void FactorRows::clear() {
  starts.assign(1, 0);
  vertices.clear();
  coefficients.clear();
  weights.clear();
}

void FactorRows::add(std::span<const Index> of_vertices, std::span<const Real> of_coefficients, Real weight) {
  if (of_vertices.empty()) return;
  for (std::size_t i = 0; i < count(); ++i) {
    const std::size_t size = starts[i + 1] - starts[i];
    if (std::ranges::equal(of_vertices, std::span(vertices).subspan(starts[i], size)) &&
        std::ranges::equal(of_coefficients, std::span(coefficients).subspan(starts[i], size))) {
      weights[i] += weight;
      return;
    }
  }
  vertices.insert(vertices.end(), of_vertices.begin(), of_vertices.end());
  coefficients.insert(coefficients.end(), of_coefficients.begin(), of_coefficients.end());
  starts.push_back(vertices.size());
  weights.push_back(weight);
}

void FactorRows::add_to_diagonal(std::span<Real> diagonal) const {
  for (std::size_t i = 0; i < count(); ++i) {
    for (std::size_t e = starts[i]; e < starts[i + 1]; ++e) {
      diagonal[at(vertices[e])] += weights[i] * coefficients[e] * coefficients[e];
    }
  }
}

void FactorCorrection::set(FactorRows rows, Positions& r, Positions& x, const std::function<void()>& solve) {
  rows_ = std::move(rows);
  const std::size_t count = rows_.count();
  const auto vertex_count = static_cast<std::size_t>(r.rows());
  before_.resize(rows_.vertices.size());
  columns_.resize(count * vertex_count);
  meeting_.resize(static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(count));
  for (std::size_t first = 0; first < count; first += 3) {
    const std::size_t together = std::min<std::size_t>(3, count - first);
    r.setZero();
    for (std::size_t j = 0; j < together; ++j) {
      for (std::size_t e = rows_.starts[first + j]; e < rows_.starts[first + j + 1]; ++e) {
        r(rows_.vertices[e], static_cast<Eigen::Index>(j)) += rows_.coefficients[e];
      }
    }
    solve();
    for (std::size_t i = 0; i < count; ++i) {
      const Vec3 products = times(i, x);
      for (std::size_t j = 0; j < together; ++j) {
        meeting_(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(first + j)) =
            products[static_cast<Eigen::Index>(j)];
      }
    }
    for (std::size_t v = 0; v < vertex_count; ++v) {
      for (std::size_t j = 0; j < together; ++j) {
        columns_[v * count + first + j] = x(static_cast<Eigen::Index>(v), static_cast<Eigen::Index>(j));
      }
    }
  }
  meeting_ = (meeting_ + meeting_.transpose()).eval() / 2;
  set_weights(std::vector<Real>(rows_.weights));
}

void FactorCorrection::set_weights(std::span<const Real> weights) {
  rows_.weights.assign(weights.begin(), weights.end());
  Matrix sum = meeting_;
  for (Eigen::Index i = 0; i < sum.rows(); ++i) {
    for (Eigen::Index j = 0; j < sum.cols(); ++j) {
      sum(i, j) *= std::sqrt(weights[static_cast<std::size_t>(i)]) * std::sqrt(weights[static_cast<std::size_t>(j)]);
    }
    sum(i, i) += 1;
  }
  if (!std::isfinite(sum.trace()) || !sum.allFinite()) {
    fail_input("a drag is too stiff, or what it pulls at too soft, for numbers of 64 bits; reduce its stiffness");
  }
  // Of rows that are nearly the same, as of four drags on one triangle, A W may have lost the difference to rounding.
  // What is added there takes a share of forces that move next to nothing.
  solver_.compute(sum);
  for (Real added = smallest_shift; solver_.info() != Eigen::Success; added *= 10) {
    Matrix more = sum;
    more.diagonal().array() += added * sum.trace();
    solver_.compute(more);
  }
}

Vec3 FactorCorrection::times(std::size_t row, const Positions& x) const {
  Vec3 sum = Vec3::Zero();
  for (std::size_t e = rows_.starts[row]; e < rows_.starts[row + 1]; ++e) {
    sum += rows_.coefficients[e] * x.row(rows_.vertices[e]).transpose();
  }
  return sum;
}

/// Row after row: any f will do.
Real FactorCorrection::take_out(Positions& r) {
  Real largest = 0;
  for (std::size_t e = 0; e < rows_.vertices.size(); ++e) {
    before_[e] = r.row(rows_.vertices[e]).transpose();
    largest = std::max(largest, before_[e].cwiseAbs().maxCoeff());
  }
  taken_.resize(static_cast<Eigen::Index>(rows_.count()), 3);
  for (std::size_t i = 0; i < rows_.count(); ++i) {
    Real square = 0;
    for (std::size_t e = rows_.starts[i]; e < rows_.starts[i + 1]; ++e)
      square += rows_.coefficients[e] * rows_.coefficients[e];
    const Vec3 force = square > 0 ? Vec3(times(i, r) / square) : Vec3(Vec3::Zero());
    taken_.row(static_cast<Eigen::Index>(i)) = force.transpose();
    for (std::size_t e = rows_.starts[i]; e < rows_.starts[i + 1]; ++e) {
      r.row(rows_.vertices[e]) -= rows_.coefficients[e] * force.transpose();
    }
  }
  return largest;
}

void FactorCorrection::put_back(Positions& r) const {
  for (std::size_t e = 0; e < rows_.vertices.size(); ++e) r.row(rows_.vertices[e]) = before_[e].transpose();
}

void FactorCorrection::finish(Positions& x) const {
  const std::size_t count = rows_.count();
  OfRows forces = taken_;  // K^½ of the right-hand side, then μ
  for (std::size_t i = 0; i < count; ++i) {
    const Real root = std::sqrt(rows_.weights[i]);
    const auto line = static_cast<Eigen::Index>(i);
    forces.row(line) = forces.row(line) / root - root * times(i, x).transpose();
  }
  solver_.solveInPlace(forces);
  std::array<Real, 3 * most_rows> factors{};
  for (std::size_t i = 0; i < count; ++i) {
    const Real root = std::sqrt(rows_.weights[i]);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      factors[3 * i + axis] = root * forces(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(axis));
    }
  }
  Real* to = x.data();
  const Real* column = columns_.data();
  for (Eigen::Index v = 0; v < x.rows(); ++v, to += 3, column += count) {
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t axis = 0; axis < 3; ++axis) to[axis] += column[i] * factors[3 * i + axis];
    }
  }
}

}  // namespace pliant
