#pragma once
// What other libraries take for the global solve alone: Y x = b for three right-hand sides.
#include <memory>
#include <string>

#include "pliant/solver/global/system_matrix.h"

namespace pliant_bench {

/// Right-hand sides and solutions in columns, m × 3, as these libraries want them.
using ThreeColumns = Eigen::Matrix<double, Eigen::Dynamic, 3>;

class Solve {
 public:
  virtual ~Solve() = default;
  /// Y⁻¹ b, m × 3 numbers in columns that stay until the next call.
  virtual const double* run(const ThreeColumns& b) = 0;
};

/// Eigen::SimplicialLLT with AMD. Factorizes; the matrix is not kept.
std::unique_ptr<Solve> eigen_solve(const pliant::LowerMatrix& matrix);

enum class CholmodMode { simplicial, supernodal };

/// CHOLMOD with its own choice of an ordering. Throws Error(input) where this build has none.
std::unique_ptr<Solve> cholmod_solve(const pliant::LowerMatrix& matrix, CholmodMode mode);

/// "3.4.0"
std::string eigen_version();
/// "3.2.0", or nothing where the build has none
std::string cholmod_version();

}  // namespace pliant_bench
