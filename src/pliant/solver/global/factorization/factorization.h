#pragma once
// Y = P L Lᵀ Pᵀ by a library; the solve with it is ours (panel_factor.h).
#include <memory>
#include <string_view>

#include "pliant/solver/global/factorization/supernodes.h"
#include "pliant/solver/global/system_matrix.h"
#include "pliant/solver/settings.h"

namespace pliant {

/// One back end. Analyses belong to a pattern, factorizations to values on it.
class Factorization {
 public:
  virtual ~Factorization() = default;

  virtual std::string_view name() const = 0;

  /// Finds the ordering for the pattern of a matrix.
  virtual void analyze(const LowerMatrix& matrix) = 0;

  /// Factorizes a matrix of the pattern analyzed last. Throws Error(input) when it is not positive definite.
  virtual void factorize(const LowerMatrix& matrix) = 0;

  /// The factor. Its supernodes are the same for all matrices of a pattern.
  virtual FactorView factor() const = 0;
};

/// Throws Error(input) when this build does not have the back end, and when that does not have the ordering.
std::unique_ptr<Factorization> make_factorization(Backend backend, Ordering ordering = Ordering::automatic);

}  // namespace pliant
