#include <random>
#include <set>
#include <utility>

#include <Eigen/Cholesky>
#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "pliant/constraints/batch.h"
#include "pliant/constraints/builtin.h"
#include "pliant/core/error.h"
#include "pliant/solver/global/factorization/factorization.h"
#include "pliant/solver/global/factorization/panel_factor.h"

namespace test_factor {

using namespace pliant;
using namespace pliant_tests;

namespace {

LowerMatrix lower_of(const Eigen::MatrixXd& dense) {
  LowerMatrix lower;
  for (Index column = 0; column < dense.cols(); ++column) {
    for (Index row = column; row < dense.rows(); ++row) {
      if (row != column && dense(row, column) == 0) continue;
      lower.rows.push_back(row);
      lower.values.push_back(dense(row, column));
    }
    lower.column_starts.push_back(static_cast<Index>(lower.rows.size()));
  }
  return lower;
}

Eigen::MatrixXd dense_of(const LowerMatrix& lower) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(lower.size(), lower.size());
  for (Index column = 0; column < lower.size(); ++column) {
    for (Index e = lower.column_starts[static_cast<std::size_t>(column)];
         e < lower.column_starts[static_cast<std::size_t>(column) + 1]; ++e) {
      const Index row = lower.rows[static_cast<std::size_t>(e)];
      dense(row, column) = dense(column, row) = lower.values[static_cast<std::size_t>(e)];
    }
  }
  return dense;
}

/// Diagonally dominant, with about this share of its entries.
Eigen::MatrixXd random_matrix(Random& random, Index size, Real density) {
  Eigen::MatrixXd dense = Eigen::MatrixXd::Zero(size, size);
  for (Index i = 0; i < size; ++i) {
    for (Index j = 0; j < i; ++j) {
      if (random.uniform(0, 1) > density) continue;
      dense(i, j) = dense(j, i) = random.uniform(-1, 1);
    }
  }
  for (Index i = 0; i < size; ++i) dense(i, i) = dense.row(i).cwiseAbs().sum() + random.uniform(0.01, 1);
  return dense;
}

/// Two dense blocks of so many columns that both meet a third one of `rows`: eliminated first, they have its rows
/// below.
Eigen::MatrixXd joined_blocks(Random& random, Index columns, Index rows) {
  Eigen::MatrixXd dense = random_matrix(random, 2 * columns + rows, 1);
  dense.block(0, columns, columns, columns).setZero();
  dense.block(columns, 0, columns, columns).setZero();
  return dense;  // still diagonally dominant
}

template <class T>
void check_panels(const Factorization& factorization, const Eigen::MatrixXd& dense, Random& random, Real tolerance) {
  ThreadPool threads(1);
  for (const TriangularSolve<T>* solve : all_triangular_solves<T>()) {
    CAPTURE(solve->instruction_set);
    PanelFactor<T> panels(*solve);
    panels.lay_out(factorization.factor());
    panels.fill(factorization.factor(), dense.diagonal().maxCoeff(), threads);
    CHECK(panels.entry_count() >= static_cast<std::size_t>(dense.rows()));
    const Positions b = random.positions(dense.rows(), 1);
    Positions x = random.positions(dense.rows(), 1);  // to be overwritten
    panels.solve(b, 1, x, threads);
    const Positions expected = dense.llt().solve(Eigen::MatrixXd(b));
    CHECK((x - expected).norm() < tolerance * expected.norm());
    // Powers of two change no digit, in either precision.
    Positions small(b.rows(), 3);
    const Real scale = std::ldexp(1.0, -300);
    panels.solve(b * scale, scale, small, threads);
    CHECK(small == x * scale);
    panels.solve(0 * b, 0, x, threads);
    CHECK(x.isZero(0));
  }
}

void check_solve(Factorization& factorization, const Eigen::MatrixXd& dense, Random& random) {
  factorization.factorize(lower_of(dense));
  check_panels<double>(factorization, dense, random, 1e-12);
  check_panels<float>(factorization, dense, random, 1e-5);
}

template <class Check>
void for_each_backend(Check&& check) {
  for (const Backend backend : {Backend::eigen, Backend::cholmod}) {
    std::unique_ptr<Factorization> factorization;
    try {
      factorization = make_factorization(backend);
    } catch (const Error& error) {
      MESSAGE("skipped: ", std::string(error.what()));
      continue;
    }
    CAPTURE(factorization->name());
    check(*factorization);
  }
}

}  // namespace

TEST_CASE("the triangular solves agree with a dense solve, whatever the pattern") {
  for_each_backend([](Factorization& factorization) {
    Random random;
    for (const Index size : {1, 2, 3, 7, 30, 120}) {
      for (const Real density : {0.0, 0.02, 0.1, 0.5, 1.0}) {
        CAPTURE(size);
        CAPTURE(density);
        const Eigen::MatrixXd dense = random_matrix(random, size, density);
        factorization.analyze(lower_of(dense));
        check_solve(factorization, dense, random);
        // Other values on the same pattern need no new analysis.
        check_solve(factorization, 3 * dense + Eigen::MatrixXd(dense.diagonal().asDiagonal()), random);
      }
    }
  });
}

TEST_CASE("the triangular solves agree with a dense solve, whatever the widths of panels and the rows below them") {
  for_each_backend([](Factorization& factorization) {
    Random random;
    std::set<std::pair<Index, Index>> shapes;
    for (const Index columns : {1, 2, 3, 4, 5, 6, 7, 8, 9, 12, 13, 16, 17, 20, 31, 64, 65}) {
      for (const Index below : {1, 3, 4, 5, 9, 17}) {
        CAPTURE(columns);
        CAPTURE(below);
        const Eigen::MatrixXd dense = joined_blocks(random, columns, below);
        factorization.analyze(lower_of(dense));
        check_solve(factorization, dense, random);
        for (const Supernode& s : factorization.factor().supernodes) {
          shapes.emplace(s.columns, static_cast<Index>(s.rows_below.size()));
        }
      }
    }
    // Panels of every width that kernels treat in a way of its own, with full and partial blocks of rows below.
    for (const Index columns : {5, 6, 7, 8, 9, 16, 17, 64, 65}) {
      CAPTURE(columns);
      for (const Index below : {4, 5}) CHECK(shapes.contains({columns, below}));
    }
  });
}

TEST_CASE("a matrix that is not positive definite is refused, and the next good one is taken") {
  for_each_backend([](Factorization& factorization) {
    Random random;
    const Eigen::MatrixXd good = random_matrix(random, 20, 0.3);
    factorization.analyze(lower_of(good));
    const std::string message = error_of([&] { factorization.factorize(lower_of(-good)); });
    CHECK(contains(message, "not positive definite"));
    check_solve(factorization, good, random);
  });
}

TEST_CASE("the system matrix is M/h² plus the sum of w SᵀAᵀAS") {
  Random random;
  const Index vertex_count = 9;
  const Real time_step = 0.02;
  Batch<TriangleStrainProjection> triangles(3);
  Batch<EdgeStrainProjection> edges(5);
  Batch<DragProjection> drags(7, 4);
  const std::array<Real, 3> fields = {1, 1, 1};
  std::vector<Real> masses;
  for (Index i = 0; i < vertex_count; ++i) masses.push_back(random.uniform(0.5, 2));
  const std::array<ConstraintGroup*, 3> groups = {&triangles, &edges, &drags};
  Eigen::MatrixXd expected = Eigen::MatrixXd::Zero(vertex_count, vertex_count);
  std::vector<char> is_pinned(static_cast<std::size_t>(vertex_count), 0);

  const auto add = [&](auto& batch, Index rows, Index n, std::size_t field_count) {
    std::vector<Index> stencil;
    while (static_cast<Index>(stencil.size()) < n) {
      const Index vertex = random.index(vertex_count);
      if (std::ranges::find(stencil, vertex) == stencil.end()) stencil.push_back(vertex);
    }
    Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> A(rows, n);
    for (Index i = 0; i < A.size(); ++i) A.data()[i] = random.uniform(-1, 1);
    if (rows * n != 4) A.col(0) -= A.rowwise().sum();  // all but the drag are translation-invariant
    const Real measure = random.uniform(0.1, 2);
    batch.add(stencil, {A.data(), static_cast<std::size_t>(A.size())}, measure,
              std::span<const Real>(fields).first(field_count));
    Eigen::MatrixXd AS = Eigen::MatrixXd::Zero(rows, vertex_count);
    for (Index j = 0; j < n; ++j) AS.col(stencil[static_cast<std::size_t>(j)]) = A.col(j);
    expected += batch.stiffness() * measure * AS.transpose() * AS;
  };
  for (int i = 0; i < 12; ++i) {
    add(triangles, 2, 3, 2);
    add(edges, 1, 2, 2);
    add(drags, 1, 4, 3);
  }
  for (Index i = 0; i < vertex_count; ++i) {
    expected(i, i) += masses[static_cast<std::size_t>(i)] / (time_step * time_step);
  }

  SystemMatrix system;
  system.set_groups(vertex_count, groups);
  SUBCASE("of free vertices") {}
  SUBCASE("with pinned vertices, whose rows keep their diagonal alone") {
    for (const Index pinned : {2, 5}) {
      is_pinned[static_cast<std::size_t>(pinned)] = 1;
      const Real diagonal = expected(pinned, pinned);
      expected.row(pinned).setZero();
      expected.col(pinned).setZero();
      expected(pinned, pinned) = diagonal;
    }
  }
  system.assemble(masses, time_step, groups, is_pinned);
  CHECK((dense_of(system.matrix()) - expected).cwiseAbs().maxCoeff() < 1e-12 * expected.maxCoeff());
}

TEST_CASE("every ordering gives the same solution, and one that a back end does not have is refused") {
  CHECK(contains(error_of([] { make_factorization(Backend::eigen, Ordering::nested_dissection); }),
                 "ordering: nested dissection is METIS's"));
  Random random;
  const Eigen::MatrixXd dense = random_matrix(random, 120, 0.05);
  for (const Ordering ordering : {Ordering::minimum_degree, Ordering::nested_dissection}) {
    try {
      const auto factorization = make_factorization(Backend::cholmod, ordering);
      factorization->analyze(lower_of(dense));
      check_solve(*factorization, dense, random);
    } catch (const Error& error) {
      MESSAGE("skipped: ", std::string(error.what()));
    }
  }
  const auto eigen = make_factorization(Backend::eigen, Ordering::minimum_degree);
  eigen->analyze(lower_of(dense));
  check_solve(*eigen, dense, random);
}

}  // namespace test_factor
