#pragma once
// Newton's method on the objective of a step of implicit Euler: the other way to the same minimum.
//
// Each iteration assembles the Hessian at the iterate, factorizes it and goes down the line of its step, halved until
// the objective falls enough (Armijo). A spring's block is
//
//     k (n nᵀ + (1 − L/‖e‖) (I − n nᵀ)),        n = e/‖e‖
//
// A spring that is pressed together makes the second term negative. Far from the minimum it is then left out, so that
// the Hessian is positive definite and every step leads down. After a full step the Hessian is taken as it is, where it
// is positive definite: that makes the convergence quadratic.
#include <Eigen/SparseCholesky>

#include "support/mass_spring.h"

namespace pliant_experiments {

/// Where the time of Newton's iterations goes [s].
struct NewtonTimes {
  double analysis = 0;  ///< pattern, ordering and symbolic factorization, once
  double assembly = 0;  ///< gradients and Hessians
  double factorization = 0;
  double solution = 0;
  double line_search = 0;
  double iterations() const { return assembly + factorization + solution + line_search; }
};

/// What is taken for the Hessian.
enum class Curvature { exact, positive };

class Newton {
 public:
  /// Analyzes the pattern. Keeps a copy of the model.
  explicit Newton(MassSpring model);

  /// One iteration on q (m × 3) in place. Returns whether q moved: false where neither the objective nor, where that
  /// differs by rounding alone, the gradient falls further. Throws Error(diverged) when the Hessian cannot be
  /// factorized.
  bool iterate(const EulerStep& step, pliant::Positions& q);

  /// Iterates until q moves no further, at most `most` times. Returns how often.
  int minimize(const EulerStep& step, pliant::Positions& q, int most);

  /// The Hessian of E at q, 3m × 3m, lower triangle, as it is or without negative terms; rows and columns of pinned
  /// vertices are those of the identity.
  const Eigen::SparseMatrix<double>& assemble(const EulerStep& step, const pliant::Positions& q, Curvature curvature);

  /// Of all iterations so far.
  const NewtonTimes& times() const { return times_; }
  /// Of the Hessian's factor, lower triangle.
  std::int64_t factor_entries() const { return factor_entries_; }

 private:
  using Sparse = Eigen::SparseMatrix<double>;

  /// Where the nine values of a block begin: those of each of its columns lie one below the other.
  struct Block {
    std::array<Eigen::Index, 3> columns{};
  };
  Block block(pliant::Index row, pliant::Index column) const;
  void add(const Block& block, const pliant::Mat3& values, bool is_diagonal);
  bool factorize(const EulerStep& step, const pliant::Positions& q);
  bool search(const EulerStep& step, const Eigen::VectorXd& direction, const pliant::Positions& gradient,
              pliant::Positions& q);

  MassSpring model_;
  Sparse hessian_;
  Curvature curvature_ = Curvature::positive;  // to be tried next
  std::vector<Block> diagonal_;                // one a vertex
  std::vector<Block> off_diagonal_;            // one a spring
  Eigen::SimplicialLLT<Sparse, Eigen::Lower> llt_;
  std::int64_t factor_entries_ = 0;
  NewtonTimes times_;
};

}  // namespace pliant_experiments
