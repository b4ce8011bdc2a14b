#include <Eigen/SparseCholesky>
#include <fmt/format.h>

#include "bench/solves.h"
#include "pliant/core/error.h"

namespace pliant_bench {
namespace {

using Sparse = Eigen::SparseMatrix<double>;

class EigenSolve final : public Solve {
 public:
  explicit EigenSolve(const pliant::LowerMatrix& matrix)
      : llt_(Eigen::Map<const Sparse>(matrix.size(), matrix.size(), static_cast<int>(matrix.rows.size()),
                                      matrix.column_starts.data(), matrix.rows.data(), matrix.values.data())) {}
  const double* run(const ThreeColumns& b) override {
    x_ = llt_.solve(b);
    return x_.data();
  }

 private:
  Eigen::SimplicialLLT<Sparse> llt_;
  ThreeColumns x_;
};

}  // namespace

std::unique_ptr<Solve> eigen_solve(const pliant::LowerMatrix& matrix) {
  return std::make_unique<EigenSolve>(matrix);
}

std::string eigen_version() {
  return fmt::format("{}.{}.{}", EIGEN_WORLD_VERSION, EIGEN_MAJOR_VERSION, EIGEN_MINOR_VERSION);
}

#ifndef PLIANT_HAS_CHOLMOD
std::unique_ptr<Solve> cholmod_solve(const pliant::LowerMatrix&, CholmodMode) {
  pliant::fail_input("--baselines: this build has no CHOLMOD; build with -DPLIANT_CHOLMOD=ON, or leave it out");
}

std::string cholmod_version() {
  return {};
}
#endif

}  // namespace pliant_bench
