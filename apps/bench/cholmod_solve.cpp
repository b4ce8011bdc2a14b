// CHOLMOD's own solve of the whole system, all three right-hand sides in one call, with the workspace kept between
// calls. Built only with PLIANT_CHOLMOD.
#include <cholmod.h>
#include <fmt/format.h>

#include "bench/solves.h"
#include "pliant/core/error.h"

extern "C" void openblas_set_num_threads(int threads);

namespace pliant_bench {
namespace {

class CholmodSolve final : public Solve {
 public:
  CholmodSolve(const pliant::LowerMatrix& matrix, CholmodMode mode) {
    openblas_set_num_threads(1);
    cholmod_start(&common_);
    common_.print = 0;
    common_.supernodal = mode == CholmodMode::simplicial ? CHOLMOD_SIMPLICIAL : CHOLMOD_SUPERNODAL;
    cholmod_sparse view{};
    view.nrow = view.ncol = static_cast<std::size_t>(matrix.size());
    view.nzmax = matrix.rows.size();
    // CHOLMOD does not write to its input, though it does not say so in its types.
    view.p = const_cast<pliant::Index*>(matrix.column_starts.data());
    view.i = const_cast<pliant::Index*>(matrix.rows.data());
    view.x = const_cast<double*>(matrix.values.data());
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = view.packed = 1;
    factor_ = cholmod_analyze(&view, &common_);
    if (factor_ != nullptr) cholmod_factorize(&view, factor_, &common_);
    if (factor_ != nullptr && common_.status == CHOLMOD_OK) return;
    free_all();
    pliant::fail_input("CHOLMOD does not factorize this system; leave it out with --baselines eigen,textbook");
  }
  ~CholmodSolve() override { free_all(); }
  CholmodSolve(const CholmodSolve&) = delete;
  CholmodSolve& operator=(const CholmodSolve&) = delete;

  const double* run(const ThreeColumns& b) override {
    cholmod_dense view{};
    view.nrow = view.d = static_cast<std::size_t>(b.rows());
    view.ncol = 3;
    view.nzmax = static_cast<std::size_t>(b.size());
    view.x = const_cast<double*>(b.data());
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    cholmod_solve2(CHOLMOD_A, factor_, &view, nullptr, &x_, nullptr, &y_, &e_, &common_);
    return static_cast<const double*>(x_->x);
  }

 private:
  void free_all() {
    for (cholmod_dense** dense : {&x_, &y_, &e_}) cholmod_free_dense(dense, &common_);
    cholmod_free_factor(&factor_, &common_);
    cholmod_finish(&common_);
  }

  cholmod_common common_;
  cholmod_factor* factor_ = nullptr;
  cholmod_dense* x_ = nullptr;
  cholmod_dense* y_ = nullptr;
  cholmod_dense* e_ = nullptr;
};

}  // namespace

std::unique_ptr<Solve> cholmod_solve(const pliant::LowerMatrix& matrix, CholmodMode mode) {
  return std::make_unique<CholmodSolve>(matrix, mode);
}

std::string cholmod_version() {
  return fmt::format("{}.{}.{}", CHOLMOD_MAIN_VERSION, CHOLMOD_SUB_VERSION, CHOLMOD_SUBSUB_VERSION);
}

}  // namespace pliant_bench
