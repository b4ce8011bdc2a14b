// The permissive back end: Eigen's SimplicialLLT with an AMD ordering (MPL 2).
#include "pliant/solver/global/factorization/eigen_factorization.h"

#include <algorithm>

#include <Eigen/SparseCholesky>

#include "pliant/core/error.h"

namespace pliant {
namespace {

using EigenMatrix = Eigen::SparseMatrix<Real, Eigen::ColMajor, Index>;

Eigen::Map<const EigenMatrix> view(const LowerMatrix& matrix) {
  return {matrix.size(),      matrix.size(),       static_cast<Index>(matrix.rows.size()), matrix.column_starts.data(),
          matrix.rows.data(), matrix.values.data()};
}

class EigenFactorization final : public Factorization {
 public:
  std::string_view name() const override { return "eigen"; }

  void analyze(const LowerMatrix& matrix) override { llt_.analyzePattern(EigenMatrix(view(matrix))); }

  void factorize(const LowerMatrix& matrix) override {
    llt_.factorize(EigenMatrix(view(matrix)));
    if (llt_.info() == Eigen::Success) return;
    fail_input("the system matrix is not positive definite to rounding; reduce the ratio of stiffness to m/h²");
  }

  FactorView factor() const override {
    const EigenMatrix& L = llt_.matrixL().nestedExpression();
    const auto& permutation = llt_.permutationPinv().indices();
    FactorView factor;
    factor.permutation = {permutation.data(), static_cast<std::size_t>(permutation.size())};
    const Index* p = L.outerIndexPtr();
    for (Index first = 0; first < L.cols();) {
      Index end = first + 1;
      while (end < L.cols() && continues(L, end - 1)) ++end;
      const Index columns = end - first;
      factor.supernodes.push_back({columns,
                                   {L.innerIndexPtr() + p[first] + columns, L.innerIndexPtr() + p[first + 1]},
                                   L.valuePtr() + p[first],
                                   false});
      first = end;
    }
    return factor;
  }

 private:
  /// True when columns j and j + 1 belong to one supernode: column j has the rows of j + 1 and that one itself.
  static bool continues(const EigenMatrix& L, Index j) {
    const Index* p = L.outerIndexPtr();
    if (p[j + 1] - p[j] != p[j + 2] - p[j + 1] + 1) return false;
    return std::equal(L.innerIndexPtr() + p[j] + 1, L.innerIndexPtr() + p[j + 1], L.innerIndexPtr() + p[j + 1]);
  }

  Eigen::SimplicialLLT<EigenMatrix, Eigen::Lower> llt_;
};

}  // namespace

std::unique_ptr<Factorization> make_eigen_factorization() {
  return std::make_unique<EigenFactorization>();
}

}  // namespace pliant
