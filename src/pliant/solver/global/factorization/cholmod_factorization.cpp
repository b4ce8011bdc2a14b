// SuiteSparse's CHOLMOD, supernodal (Chen et al. 2008). Built only with PLIANT_CHOLMOD: its Supernodal module is GPL.
#include "pliant/solver/global/factorization/cholmod_factorization.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <mutex>

#include <cholmod.h>

extern "C" {
void openblas_set_num_threads(int threads);
int openblas_get_num_threads();
}

#include "pliant/core/error.h"

namespace pliant {
namespace {

/// OpenBLAS waits for ever where it gets no memory for its buffer, of 128 MiB, and OpenMP ends the program where it
/// gets none for the stacks of its threads: better to know beforehand.
void require_library_memory() {
  constexpr std::size_t needed = std::size_t{192} << 20U;
  void* volatile memory = std::malloc(needed);  // volatile: or the pair is optimized away
  if (memory == nullptr) {
    fail_input("the factorization needs 192 MiB of address space; allow more, or choose the back end `eigen`");
  }
  std::free(memory);
}

/// Simulations that factorize at the same time, where the libraries keep something that belongs to the whole process.
class TakeTurns {
 public:
  TakeTurns() = default;
  TakeTurns(const TakeTurns&) = delete;
  TakeTurns& operator=(const TakeTurns&) = delete;

 private:
  static std::mutex& turn() {
    static std::mutex mutex;
    return mutex;
  }

  std::lock_guard<std::mutex> lock_{turn()};
};

/// One thread inside OpenBLAS while it lives: how OpenBLAS splits a product among threads changes the bits, and the
/// number of them belongs to the whole process.
class OneBlasThread : TakeTurns {
 public:
  OneBlasThread() {
    static const bool has_memory = (require_library_memory(), true);  // they keep it
    static_cast<void>(has_memory);
    openblas_set_num_threads(1);
  }
  ~OneBlasThread() { openblas_set_num_threads(threads_); }

 private:
  int threads_ = openblas_get_num_threads();
};

struct FreeFactor {
  cholmod_common* common;
  void operator()(cholmod_factor* factor) const { cholmod_free_factor(&factor, common); }
};

class CholmodFactorization final : public Factorization {
 public:
  explicit CholmodFactorization(Ordering ordering) : ordering_(ordering) {
    cholmod_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.print = 0;
    common_.nmethods = 1;
    // Which columns are joined into one panel although that stores zeros: up to so many columns always, and more of
    // them for ever smaller shares of zeros (benchmarks/NOTES.md, "How many zeros may panels store?").
    std::ranges::copy(std::array{4, 8, 16}, common_.nrelax);
    std::ranges::copy(std::array{0.5, 0.2, 0.1}, common_.zrelax);
  }
  ~CholmodFactorization() override {
    symbolic_.reset();
    cholmod_finish(&common_);
  }

  std::string_view name() const override { return "cholmod"; }

  void analyze(const LowerMatrix& matrix) override {
    const TakeTurns turn;  // METIS draws random numbers from a source that the process has one of
    const double entries = order(matrix, ordering_ == Ordering::nested_dissection ? CHOLMOD_METIS : CHOLMOD_AMD);
    if (ordering_ != Ordering::automatic || entries < entries_worth_it * static_cast<double>(matrix.size())) return;
    if (order(matrix, CHOLMOD_METIS) > entries) order(matrix, CHOLMOD_AMD);
  }

  void factorize(const LowerMatrix& matrix) override {
    const OneBlasThread one_thread;
    cholmod_sparse view = view_of(matrix);
    cholmod_factorize(&view, symbolic_.get(), &common_);
    check(common_.status == CHOLMOD_OK && symbolic_->minor == symbolic_->n);
  }

  FactorView factor() const override {
    const cholmod_factor& L = *symbolic_;
    const auto* super = static_cast<const Index*>(L.super);
    const auto* row_starts = static_cast<const Index*>(L.pi);
    const auto* value_starts = static_cast<const Index*>(L.px);
    const auto* rows = static_cast<const Index*>(L.s);
    const auto* values = static_cast<const Real*>(L.x);
    FactorView view;
    view.permutation = {static_cast<const Index*>(L.Perm), L.n};
    view.supernodes.reserve(L.nsuper);
    for (std::size_t s = 0; s < L.nsuper; ++s) {
      const Index columns = super[s + 1] - super[s];
      view.supernodes.push_back(
          {columns, {rows + row_starts[s] + columns, rows + row_starts[s + 1]}, values + value_starts[s], true});
    }
    return view;
  }

 private:
  /// Entries a column from which METIS, which takes ten times as long as AMD, makes up for it within some ten steps, in
  /// the numeric factorization for a part (benchmarks/NOTES.md, "Which order of elimination?").
  static constexpr double entries_worth_it = 64;

  /// Returns the entries of the factor.
  double order(const LowerMatrix& matrix, int method) {
    common_.method[0].ordering = method;
    cholmod_sparse view = view_of(matrix);
    symbolic_.reset(cholmod_analyze(&view, &common_));
    check(symbolic_ != nullptr);
    return common_.lnz;
  }

  static cholmod_sparse view_of(const LowerMatrix& matrix) {
    cholmod_sparse view{};
    view.nrow = view.ncol = static_cast<std::size_t>(matrix.size());
    view.nzmax = matrix.rows.size();
    // CHOLMOD does not write to its input, though it does not say so in its types.
    view.p = const_cast<Index*>(matrix.column_starts.data());
    view.i = const_cast<Index*>(matrix.rows.data());
    view.x = const_cast<Real*>(matrix.values.data());
    view.stype = -1;
    view.itype = CHOLMOD_INT;
    view.xtype = CHOLMOD_REAL;
    view.dtype = CHOLMOD_DOUBLE;
    view.sorted = 1;
    view.packed = 1;
    return view;
  }

  void check(bool succeeded) const {
    if (succeeded) return;
    if (common_.status == CHOLMOD_OUT_OF_MEMORY || common_.status == CHOLMOD_TOO_LARGE) {
      fail_input("the factor of the system matrix does not fit into memory; use a coarser mesh");
    }
    fail_input("the system matrix is not positive definite to rounding; reduce the ratio of stiffness to m/h²");
  }

  Ordering ordering_;
  cholmod_common common_;
  std::unique_ptr<cholmod_factor, FreeFactor> symbolic_{nullptr, FreeFactor{&common_}};
};

}  // namespace

std::unique_ptr<Factorization> make_cholmod_factorization(Ordering ordering) {
  return std::make_unique<CholmodFactorization>(ordering);
}

}  // namespace pliant
