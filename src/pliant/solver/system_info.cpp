#include "pliant/solver/system_info.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>

#include "pliant/solver/system.h"

namespace pliant {
namespace {

using Vector = Eigen::VectorX<Real>;

/// What resists a displacement: a matrix, and rows a with k beside it.
struct Elasticity {
  const LowerMatrix& matrix;
  const FactorRows& rows;
};

/// y = M^-½ K M^-½ x, where `scale` is M^-½, and 0 at pinned vertices.
void multiply(const Elasticity& elasticity, const Vector& scale, const Vector& x, Vector& y) {
  const LowerMatrix& K = elasticity.matrix;
  const FactorRows& rows = elasticity.rows;
  y.setZero();
  for (std::size_t i = 0; i < rows.count(); ++i) {
    Real along = 0;
    for (std::size_t e = rows.starts[i]; e < rows.starts[i + 1]; ++e) {
      along += rows.coefficients[e] * scale[rows.vertices[e]] * x[rows.vertices[e]];
    }
    for (std::size_t e = rows.starts[i]; e < rows.starts[i + 1]; ++e) {
      y[rows.vertices[e]] += rows.weights[i] * rows.coefficients[e] * scale[rows.vertices[e]] * along;
    }
  }
  for_each_entry(K, [&](Index row, Index column, std::size_t e) {
    const Real value = K.values[e] * scale[row] * scale[column];
    y[row] += value * x[column];
    if (row != column) y[column] += value * x[row];
  });
}

/// The largest eigenvalue by the Lanczos process (Golub & Van Loan, Matrix Computations, Sec. 10.1), which finds it
/// without keeping its vectors orthogonal.
Real largest_eigenvalue(const Elasticity& K, const Vector& scale) {
  constexpr Index most_steps = 60;
  const auto steps = std::min<Eigen::Index>(most_steps, scale.size());
  Vector v = Vector::Zero(scale.size());
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    if (scale[i] > 0) v[i] = 1 + 0.5 * std::sin(static_cast<Real>(i * i + 1)) * (i % 2 == 0 ? 1 : -2);
  }
  if (!(v.norm() > 0)) return 0;
  v.normalize();
  Vector before = Vector::Zero(v.size());
  Vector w(v.size());
  Vector diagonal = Vector::Zero(steps);
  Vector below = Vector::Zero(steps);
  Eigen::Index taken = 0;
  for (Real beta = 0; taken < steps;) {
    multiply(K, scale, v, w);
    w -= beta * before;
    diagonal[taken] = w.dot(v);
    w -= diagonal[taken] * v;
    beta = w.norm();
    below[taken++] = beta;
    if (!(beta > 1e-12 * std::abs(diagonal[0]))) break;
    before = v;
    v = w / beta;
  }
  if (!diagonal.allFinite() || !below.allFinite()) return std::numeric_limits<Real>::infinity();
  Eigen::SelfAdjointEigenSolver<Eigen::MatrixX<Real>> solver;
  solver.computeFromTridiagonal(diagonal.head(taken), below.head(taken - 1), Eigen::EigenvaluesOnly);
  return std::max(solver.eigenvalues().maxCoeff(), Real(0));
}

}  // namespace

SystemInfo System::describe(std::span<const Real> masses) {
  SystemInfo info;
  info.matrix_entries = static_cast<std::int64_t>(matrix_.matrix().rows.size());
  global_step_.describe(info);
  local_step_.describe(info);
  constexpr auto entry_bytes = static_cast<std::int64_t>(sizeof(Real) + sizeof(Index));
  info.bytes = info.matrix_entries * entry_bytes + info.substitution_bytes;
  info.pinned_vertices = static_cast<Index>(std::ranges::count_if(is_pinned_, [](char pinned) { return pinned != 0; }));

  for (std::size_t i = 0; i < free_components_.count(); ++i) {
    const std::span<const Index> component = free_components_.component(i);
    FreeComponent& free = info.free_components.emplace_back(FreeComponent{vertex_count_, count_of(component)});
    for (const Index vertex : component) {
      free.vertices.push_back(groups_.vertex(vertex));
      free.first_vertex = std::min(free.first_vertex, free.vertices.back());
    }
  }

  std::ranges::sort(info.free_components, {}, &FreeComponent::first_vertex);

  SystemMatrix elastic = matrix_;
  elastic.assemble(masses, std::numeric_limits<Real>::infinity(), groups_.in_use(),
                   is_pinned_);  // M/h² vanishes
  Vector scale(vertex_count_);
  for (Index i = 0; i < vertex_count_; ++i) scale[i] = is_pinned_[at(i)] ? 0 : 1 / std::sqrt(masses[at(i)]);
  info.fastest_frequency = std::sqrt(largest_eigenvalue({elastic.matrix(), passing_.rows(is_pinned_)}, scale));
  return info;
}

}  // namespace pliant
