// The values of panels, for every instruction set at hand, against dense matrices.
#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include <Eigen/Dense>
#include <doctest/doctest.h>

#include "../core/random.h"
#include "pliant/solver/global/factorization/diagonal_blocks.h"
#include "pliant/solver/global/factorization/supernodes.h"
#include "pliant/solver/global/factorization/triangular_solve.h"

namespace test_panel_values {

using namespace pliant;
using namespace pliant_tests;
using Eigen::MatrixXd;

namespace {

constexpr Real unit = 4;

struct Columns {
  MatrixXd D, B;
  std::vector<Index> rows_below;
  std::vector<Real> values;  // exactly as many as there are, so that a sanitizer sees what is read past them
  Supernode supernode;

  Columns(Random& random, Index n, Index below, bool is_rectangle)
      : D(MatrixXd::Zero(n, n)), B(below, n), rows_below(static_cast<std::size_t>(below)) {
    for (Index c = 0; c < n; ++c) {
      for (Index r = c; r < n; ++r) D(r, c) = random.uniform(-1, 1);
      D(c, c) = random.uniform(1, 2) * std::sqrt(static_cast<Real>(n));
    }
    for (Real& number : B.reshaped()) number = random.uniform(-1, 1);
    for (Index c = 0; c < n; ++c) {
      const Real above = std::numeric_limits<Real>::quiet_NaN();  // CHOLMOD leaves anything there
      if (is_rectangle) values.insert(values.end(), static_cast<std::size_t>(c), above);
      values.insert(values.end(), &D(c, c), &D(c, c) + (n - c));
      const MatrixXd column = B.col(c);
      values.insert(values.end(), column.data(), column.data() + below);
    }
    values.shrink_to_fit();
    supernode = {n, rows_below, values.data(), is_rectangle};
  }
};

/// In blocks of four rows, column after column; `columns_of(block)` of them.
template <class ColumnsOf>
void append_blocks(const MatrixXd& matrix, ColumnsOf columns_of, std::vector<Real>& all) {
  for (Index first = 0; first < matrix.rows(); first += panel_lanes) {
    for (Index c = 0; c < columns_of(first); ++c) {
      for (Index r = first; r < first + panel_lanes; ++r) all.push_back(r < matrix.rows() ? matrix(r, c) : 0);
    }
  }
}

std::vector<Real> expected_panel(const Columns& columns) {
  const auto n = static_cast<Index>(columns.D.cols());
  const MatrixXd inverse = columns.D.triangularView<Eigen::Lower>().solve(MatrixXd::Identity(n, n));
  std::vector<Real> all;
  const auto every = [n](Index) { return n; };
  if (n <= most_whole_columns) {
    append_blocks(unit * unit * inverse.transpose() * inverse, every, all);
  } else {
    append_blocks(
        unit * inverse, [n](Index first) { return std::min(n, first + panel_lanes); }, all);
  }
  append_blocks(columns.B * inverse, every, all);
  return all;
}

template <class T>
void check_panel(const TriangularSolve<T>& kernels, const Columns& columns) {
  const std::vector<Real> expected = expected_panel(columns);
  const Supernode& s = columns.supernode;
  std::vector<Real> work(panel_work(static_cast<std::size_t>(s.columns)), std::numeric_limits<Real>::quiet_NaN());
  std::vector<T> written(expected.size(), T(1e30));
  kernels.write_panel({s.values, s.columns, static_cast<Index>(s.rows_below.size()), s.is_rectangle, unit}, work.data(),
                      written.data());
  Real largest = 0, off = 0;
  for (std::size_t i = 0; i < expected.size(); ++i) {
    largest = std::max(largest, std::abs(expected[i]));
    const Real error = std::abs(static_cast<Real>(written[i]) - expected[i]);
    off = error >= 0 ? std::max(off, error) : std::numeric_limits<Real>::infinity();
  }
  CHECK(off < 8 * static_cast<Real>(std::numeric_limits<T>::epsilon()) * largest * (sizeof(T) == 8 ? s.columns : 1));
}

template <class T>
void check_all(Random& random) {
  for (const TriangularSolve<T>* kernels : all_triangular_solves<T>()) {
    CAPTURE(std::string(kernels->instruction_set));
    for (const Index n : {1, 2, 3, 4, 5, 7, 8, 9, 12, 15, 16, 17, 20, 23, 24, 25, 64, 65, 130}) {
      CAPTURE(n);
      for (const Index below : {0, 1, 2, 3, 4, 5, 7, 8, 9, 12, 13, 16, 31}) {
        CAPTURE(below);
        for (const bool is_rectangle : {false, true}) {
          CAPTURE(is_rectangle);
          check_panel(*kernels, Columns(random, n, below, is_rectangle));
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("panels hold the inverses of their diagonal blocks, and what is below times them") {
  Random random;
  SUBCASE("single precision") {
    check_all<float>(random);
  }
  SUBCASE("double precision") {
    check_all<double>(random);
  }
}

}  // namespace test_panel_values
