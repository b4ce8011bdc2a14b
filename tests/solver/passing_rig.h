#pragma once
// What tests of groups that stand beside the factor share.
#include <cmath>
#include <cstring>

#include <doctest/doctest.h>

#include "pliant/pliant.h"
#include "pliant/solver/global/factorization/factorization.h"
#include "pliant/solver/global/global_step.h"
#include "tests/core/random.h"
#include "tests/mesh/meshes.h"

namespace pliant_tests::passing {

using namespace pliant;

inline constexpr Index side = 13;

/// Springs between the neighbors of a grid, and a mass that holds each vertex [N/m].
inline LowerMatrix springs(Index n, Real mass, Real stiffness) {
  LowerMatrix matrix;
  for (Index v = 0; v < n * n; ++v) {
    const Index i = v % n, j = v / n;
    const Index neighbors = (i > 0) + (i + 1 < n) + (j > 0) + (j + 1 < n);
    const auto add = [&](Index row, Real value) {
      matrix.rows.push_back(row);
      matrix.values.push_back(value);
    };
    add(v, mass + stiffness * neighbors);
    if (i + 1 < n) add(v + 1, -stiffness);
    if (j + 1 < n) add(v + n, -stiffness);
    matrix.column_starts.push_back(static_cast<Index>(matrix.rows.size()));
  }
  return matrix;
}

/// The sum, with empty rows and columns of what is held.
inline Eigen::MatrixXd dense(const LowerMatrix& matrix, const FactorRows& rows) {
  Eigen::MatrixXd Y = Eigen::MatrixXd::Zero(matrix.size(), matrix.size());
  for_each_entry(matrix,
                 [&](Index row, Index column, std::size_t e) { Y(row, column) = Y(column, row) = matrix.values[e]; });
  for (std::size_t i = 0; i < rows.count(); ++i) {
    Eigen::VectorXd a = Eigen::VectorXd::Zero(matrix.size());
    for (std::size_t e = rows.starts[i]; e < rows.starts[i + 1]; ++e) a[rows.vertices[e]] += rows.coefficients[e];
    if (rows.holds[i] == 0) Y += rows.weights[i] * a * a.transpose();
  }
  for (std::size_t i = 0; i < rows.count(); ++i) {
    if (rows.holds[i] == 0) continue;
    const Index v = rows.vertices[rows.starts[i]];
    Y.row(v).setZero();
    Y.col(v).setZero();
    Y(v, v) = 1;
  }
  return Y;
}

/// Rows of one to four vertices near each other, some of them twice and some on the same vertices.
inline FactorRows some_rows(std::size_t count, Real weight, Random& random) {
  FactorRows rows;
  for (std::size_t i = 0; i < count; ++i) {
    const auto size = static_cast<Index>(i % 4 + 1);
    std::vector<Index> vertices;
    std::vector<Real> coefficients;
    for (Index j = 0; j < size; ++j) {
      vertices.push_back(static_cast<Index>(7 * (i / 2)) + j);
      coefficients.push_back(random.uniform(0.1, 1));
    }
    rows.add(vertices, coefficients, weight * random.uniform(0.5, 2));
  }
  return rows;
}

struct Factor {
  GlobalStep step;
  Components free;
  std::vector<Real> weights;
  ThreadPool threads{1};

  Factor(const LowerMatrix& matrix, Precision precision, const Components& free_components = {}, Real mass = 0)
      : free(free_components), weights(static_cast<std::size_t>(matrix.size()), mass) {
    SetUpTimes times;
    step.set_factorization(make_factorization(Backend::automatic));
    step.analyze(matrix);
    step.factorize(matrix, precision, weights, free, threads, times);
  }
};

inline bool same_bits(const Positions& a, const Positions& b) {
  return a.rows() == b.rows() &&
         std::memcmp(a.data(), b.data(), sizeof(Real) * static_cast<std::size_t>(a.size())) == 0;
}

/// That a solve is that of the whole matrix, leaves r as it was, and that a move is such a solve. Returns the solution.
inline Positions check_solution(Factor& factor, const LowerMatrix& matrix, const FactorRows& rows, Positions r,
                                Real rounding) {
  const Positions before = r;
  Positions x(r.rows(), 3);
  factor.step.solve(r, r.cwiseAbs().maxCoeff(), x, factor.threads);
  CHECK(same_bits(r, before));
  const Positions exact = dense(matrix, rows).ldlt().solve(r);
  CHECK((x - exact).cwiseAbs().maxCoeff() < rounding * exact.cwiseAbs().maxCoeff());
  Positions q = before;
  factor.step.move(r, r.cwiseAbs().maxCoeff(), q, factor.threads);
  CHECK(same_bits(q, before + x));
  return x;
}

/// Sheets that hang by two vertices, one of which is dragged by a point of a triangle.
struct Hung {
  Simulation simulation;
  BodyId body{};
  GroupId drag{};

  explicit Hung(const SolverSettings& settings, bool is_shuffled = false, bool is_free = false) {
    const Index size = is_shuffled ? 4 * side : side;  // a mesh so large has an order of its own in the solver
    simulation.set_settings(settings);
    simulation.add(Gravity{});
    Mesh mesh = grid({.columns = size, .rows = size, .size = {1, 1}});
    if (is_shuffled) number_at_random(mesh);
    body = simulation.add_body(mesh, Mass::area_density(0.2));
    simulation.add(body, TriangleStrain{.stiffness = 500});
    if (!is_free) simulation.add(body, Position{.on = {0, size - 1}});
  }
  void add_drag(Real stiffness) {
    const Triangle& triangle = simulation.bodies()[0].mesh.triangles[40];
    const Vec3 at_start = row(simulation.bodies()[0].mesh.vertices, triangle[0]);
    drag = simulation.add(body, Drag{.stencils = {{triangle[0], triangle[1], triangle[2]}},
                                     .weights = {{0.5, 0.3, 0.2}},
                                     .stiffness = stiffness,
                                     .targets = {Vec3(at_start + Vec3(0.1, 0.2, 0.3))}});
  }
};

inline Real rms(const Simulation& simulation) {
  return std::sqrt(simulation.state().velocities.rowwise().squaredNorm().mean());
}

inline Real difference(const Simulation& a, const Simulation& b) {
  return (a.state().positions - b.state().positions).cwiseAbs().maxCoeff();
}

}  // namespace pliant_tests::passing
