#pragma once
// Y = P L Lᵀ Pᵀ by a library; the solve with it is ours (supernodal_factor.h).
#include <memory>

#include "pliant/solver/factorization/supernodal_factor.h"
#include "pliant/solver/settings.h"
#include "pliant/solver/system_matrix.h"

namespace pliant {

/// One back end. Analyses belong to a pattern, factorizations to values on it.
class Factorization {
 public:
  virtual ~Factorization() = default;

  virtual std::string_view name() const = 0;

  /// Finds the ordering for the pattern of a matrix.
  virtual void analyze(const LowerMatrix& matrix) = 0;

  /// Factorizes a matrix of the pattern analyzed last. Throws Error(input) when it is not positive definite. Returns
  /// how long it took to repack the factor [s].
  virtual double factorize(const LowerMatrix& matrix) = 0;

  /// Solves Y x = b for three right-hand sides (m × 3 each) in one sweep. Never allocates.
  SolveTimes solve(const Positions& b, Positions& x) { return factor_.solve(b, x); }

  const SupernodalFactor& factor() const { return factor_; }

 protected:
  SupernodalFactor factor_;
};

/// Throws Error(input) when this build does not have the back end.
std::unique_ptr<Factorization> make_factorization(Backend backend);

}  // namespace pliant
