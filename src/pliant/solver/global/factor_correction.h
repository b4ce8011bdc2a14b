#pragma once
// Solves with Y + Σ k aᵀa, where Y alone is factorized (the formula of Sherman, Morrison and Woodbury): what comes and
// goes while a simulation runs costs no factorization. With the rows a in A, the diagonal matrix K of k, W = Y⁻¹ Aᵀ,
// and r = r₀ + Aᵀ f for any f,
//
//     x = Y⁻¹ r₀ + W μ,      (K⁻¹ + A W) μ = K⁻¹ f − A Y⁻¹ r₀.
//
// f is what pulls at the rows' vertices, so that r₀ is small there: with f = 0 a stiff spring far from its target would
// leave x as the small difference of two large vectors.
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Cholesky>

#include "pliant/core/types.h"

namespace pliant {

/// Rows a, each with its k.
struct FactorRows {
  std::vector<std::size_t> starts = {0};
  std::vector<Index> vertices;
  std::vector<Real> coefficients;
  std::vector<Real> weights;  ///< k [N/m], > 0

  std::size_t count() const { return starts.size() - 1; }
  /// Adds the diagonal of Σ k aᵀa [N/m].
  void add_to_diagonal(std::span<Real> diagonal) const;
  bool has_same_rows(const FactorRows& other) const {
    return starts == other.starts && vertices == other.vertices && coefficients == other.coefficients;
  }
  void clear();
  /// A row that has no vertex is left out, one that is there already gets stiffer.
  void add(std::span<const Index> of_vertices, std::span<const Real> of_coefficients, Real weight);
};

class FactorCorrection {
 public:
  static constexpr int most_rows = 8;

  bool is_empty() const { return rows_.count() == 0; }
  const FactorRows& rows() const { return rows_; }
  void clear() { rows_.clear(); }
  /// At most most_rows. solve(): x = Y⁻¹ r, asked for once for three rows; r, x: scratch, m × 3. Throws Error(input)
  /// where numbers of 64 bits do not hold the sum.
  void set(FactorRows rows, Positions& r, Positions& x, const std::function<void()>& solve);
  /// Other k for the same rows. Throws as set() does.
  void set_weights(std::span<const Real> weights);

  /// r ← r₀; returns the largest number that was there before at its vertices [N].
  Real take_out(Positions& r);
  /// r as it was, to the last bit.
  void put_back(Positions& r) const;
  /// x = Y⁻¹ r₀ ← (Y + Σ k aᵀa)⁻¹ r, for the r that was taken out last.
  void finish(Positions& x) const;

 private:
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_rows, most_rows>;
  using OfRows = Eigen::Matrix<Real, Eigen::Dynamic, 3, Eigen::ColMajor, most_rows, 3>;

  Vec3 times(std::size_t row, const Positions& x) const;

  FactorRows rows_;
  std::vector<Real> columns_;  // W, the numbers of a vertex side by side
  Matrix meeting_;             // A W
  Eigen::LLT<Matrix> solver_;  // of 1 + K^½ A W K^½, or a little more
  OfRows taken_;               // f
  std::vector<Vec3> before_;   // r of the rows' vertices, in their order
};

}  // namespace pliant
