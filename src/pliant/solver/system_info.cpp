#include "pliant/solver/system_info.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Eigenvalues>

#include "pliant/solver/solver.h"

namespace pliant {
namespace {

using Vector = Eigen::VectorX<Real>;

std::size_t at(Index i) {
  return static_cast<std::size_t>(i);
}

/// y = M^-½ K M^-½ x, where `scale` is M^-½, and 0 at held vertices.
void multiply(const LowerMatrix& K, const Vector& scale, const Vector& x, Vector& y) {
  y.setZero();
  for (Index column = 0; column < K.size(); ++column) {
    for (Index e = K.column_starts[at(column)]; e < K.column_starts[at(column) + 1]; ++e) {
      const Index row = K.rows[at(e)];
      const Real value = K.values[at(e)] * scale[row] * scale[column];
      y[row] += value * x[column];
      if (row != column) y[column] += value * x[row];
    }
  }
}

/// The largest eigenvalue by the Lanczos process (Golub & Van Loan, Matrix Computations, Sec. 10.1), which finds it
/// without keeping its vectors orthogonal.
Real largest_eigenvalue(const LowerMatrix& K, const Vector& scale) {
  constexpr Index most_steps = 60;
  const auto steps = std::min<Eigen::Index>(most_steps, K.size());
  Vector v = Vector::Zero(K.size());
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

/// Marks the vertices of constraints that a translation does not leave as they are.
void mark_anchored(const ConstraintGroup& group, std::vector<char>& is_anchored) {
  const GroupShape shape = group.shape();
  const auto n = static_cast<std::size_t>(shape.vertices);
  const auto k = static_cast<std::size_t>(shape.rows);
  const std::span<const Real> reduction = group.reduction();
  for (std::size_t i = 0; i < static_cast<std::size_t>(shape.count); ++i) {
    bool holds = false;
    for (std::size_t r = 0; r < k; ++r) {
      const std::span<const Real> row = reduction.subspan((i * k + r) * n, n);
      const Real sum = std::accumulate(row.begin(), row.end(), Real(0));
      Real size = 0;
      for (const Real coefficient : row) size += std::abs(coefficient);
      holds = holds || std::abs(sum) > 1e-6 * size;
    }
    for (std::size_t a = 0; holds && a < n; ++a) is_anchored[at(group.stencil()[i * n + a])] = 1;
  }
  for (const Index vertex : group.held_vertices()) is_anchored[at(vertex)] = 1;
}

/// The connected parts of the matrix's pattern in which no vertex is anchored.
std::vector<FreePart> find_free_parts(const LowerMatrix& matrix, const std::vector<char>& is_anchored) {
  std::vector<Index> parent(at(matrix.size()));
  std::iota(parent.begin(), parent.end(), Index{0});
  const auto root_of = [&](Index vertex) {
    while (parent[at(vertex)] != vertex) vertex = parent[at(vertex)] = parent[at(parent[at(vertex)])];
    return vertex;
  };
  for (Index column = 0; column < matrix.size(); ++column) {
    for (Index e = matrix.column_starts[at(column)]; e < matrix.column_starts[at(column) + 1]; ++e) {
      const Index a = root_of(column);
      const Index b = root_of(matrix.rows[at(e)]);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  }
  std::vector<Index> counts(parent.size(), 0);
  std::vector<char> is_held(parent.size(), 0);
  for (Index vertex = 0; vertex < matrix.size(); ++vertex) {
    const std::size_t root = at(root_of(vertex));
    ++counts[root];
    is_held[root] = static_cast<char>(is_held[root] | is_anchored[at(vertex)]);
  }
  std::vector<FreePart> parts;
  for (std::size_t root = 0; root < counts.size(); ++root) {
    if (counts[root] > 0 && !is_held[root]) parts.push_back({static_cast<Index>(root), counts[root]});
  }
  return parts;
}

}  // namespace

SystemInfo Solver::system_info(const State& state) {
  prepare(state);
  SystemInfo info;
  const LowerMatrix& matrix = system_matrix_.matrix();
  info.matrix_entries = static_cast<std::int64_t>(matrix.rows.size());
  info.factor_entries = static_cast<std::int64_t>(factorization_->factor().entry_count());
  info.supernodes = factorization_->factor().supernode_count();
  info.sweep_bytes = static_cast<std::int64_t>(factorization_->factor().sweep_bytes());
  constexpr auto entry_bytes = static_cast<std::int64_t>(sizeof(Real) + sizeof(Index));
  info.bytes = info.matrix_entries * entry_bytes + info.factor_entries * static_cast<std::int64_t>(sizeof(Real));
  info.held_vertices = static_cast<Index>(std::ranges::count_if(is_held_, [](char held) { return held != 0; }));

  std::vector<char> is_anchored(is_held_.size(), 0);
  for (const ConstraintGroup* group : groups_) mark_anchored(*group, is_anchored);
  info.free_parts = find_free_parts(matrix, is_anchored);

  SystemMatrix elastic = system_matrix_;
  const std::vector<const ConstraintGroup*> groups(groups_.begin(), groups_.end());
  elastic.sum(state.masses, std::numeric_limits<Real>::infinity(), groups, is_held_);  // M/h² vanishes
  Vector scale(vertex_count_);
  for (Index i = 0; i < vertex_count_; ++i) scale[i] = is_held_[at(i)] ? 0 : 1 / std::sqrt(state.masses[at(i)]);
  info.fastest_frequency = std::sqrt(largest_eigenvalue(elastic.matrix(), scale));
  return info;
}

}  // namespace pliant
