#pragma once
// Solves with Y + Σ k aᵀa, where Y alone is factorized (the formula of Sherman, Morrison and Woodbury): what comes and
// goes while a simulation runs costs no factorization. With the rows a in A, the diagonal matrix K of k, Y = U S Uᵀ
// (panel_factor.h), Z = U⁻¹ Aᵀ, V = S⁻¹ Z, and r = r₀ + Aᵀ f for any f,
//
//     y = S⁻¹ U⁻¹ r₀,      (K⁻¹ + ZᵀV) μ = K⁻¹ f − Zᵀ y,      Uᵀ x = y + V μ.
//
// A column of V has numbers on the way from its vertices to the root of the elimination tree alone, so the products are
// short. Of a row that holds a vertex K⁻¹ is 0. f is what pulls at the rows' vertices, so that r₀ is small there: with
// f = 0 a stiff spring far from its target would leave x as the small difference of two large vectors.
//
// On a component that nothing holds in Y the factor is not exact for translations, and x is moved by the mean of what
// is missing (GlobalStep). For each that has a row Z has a column more, U⁻¹ w, with w as there: A Y⁻¹ r₀ then is
// Zᵀ y + α (Σ r₀ − (U⁻¹ w)ᵀ y) / Σ w, with the sum α of the row's coefficients there.
#include <span>
#include <vector>

#include <Eigen/Cholesky>

#include "pliant/core/types.h"
#include "pliant/solver/global/components.h"
#include "pliant/solver/global/factorization/panel_factor.h"

namespace pliant {

/// Rows a, each with its k.
struct FactorRows {
  std::vector<std::size_t> starts = {0};
  std::vector<Index> vertices;
  std::vector<Real> coefficients;
  std::vector<Real> weights;  ///< k [N/m], > 0
  std::vector<char> holds;    ///< the one vertex of the row stays where it is: k counts as infinite

  std::size_t count() const { return starts.size() - 1; }
  /// Adds the diagonal of Σ k aᵀa [N/m], but for what is held.
  void add_to_diagonal(std::span<Real> diagonal) const;
  bool has_same_rows(const FactorRows& other) const {
    return starts == other.starts && vertices == other.vertices && coefficients == other.coefficients &&
           holds == other.holds;
  }
  void clear();
  /// A row that has no vertex is left out, one that is there already gets stiffer.
  void add(std::span<const Index> of_vertices, std::span<const Real> of_coefficients, Real weight);
  void hold(Index vertex);
};

/// Components that nothing holds in Y, and w of each vertex; both must outlive their use.
struct FreeInFactor {
  const Components& components;
  std::span<const Real> weights;
};

class FactorCorrection {
 public:
  static constexpr int most_rows = 40;

  bool is_empty() const { return rows_.count() == 0; }
  const FactorRows& rows() const { return rows_; }
  void clear() { rows_.clear(); }

  /// At most most_rows. For every three columns write_columns(), a sparse forward substitution and read_columns() are
  /// to follow, then finish_columns(), which throws Error(input) where numbers of 64 bits do not hold the sum.
  void set(FactorRows rows, const FreeInFactor& free);
  std::size_t column_count() const { return rows_.count() + free_.size(); }
  /// Columns from `first` on, three at most, as right-hand sides m × 3. Returns the largest number.
  Real write_columns(std::size_t first, const FreeInFactor& free, Positions& b) const;
  template <class T>
  void read_columns(std::size_t first, const InFactorOrder<T>& z, const InFactorOrder<T>& v);
  void finish_columns();
  /// Other k for the same rows. Throws as finish_columns() does.
  void set_weights(std::span<const Real> weights);

  // A solve: these in their order, the substitutions around the second one.
  /// r ← r₀. What is held stays where it is in x, or is 0 there.
  void take_out(Positions& r, const Positions* x = nullptr);
  /// y ← y + V μ.
  template <class T>
  void correct(const InFactorOrder<T>& y, const Positions& r, const Components& free_components);
  /// r₀ ← r₀ + Aᵀ μ: x = Y⁻¹ of that.
  void add_pull(Positions& r) const;
  /// r as it was, to the last bit, and held vertices in x.
  void put_back(Positions& r, Positions& x) const;

 private:
  using Matrix = Eigen::Matrix<Real, Eigen::Dynamic, Eigen::Dynamic, Eigen::ColMajor, most_rows, most_rows>;
  using OfRows = Eigen::Matrix<Real, Eigen::Dynamic, 3, Eigen::ColMajor, most_rows, 3>;
  /// One that has a row.
  struct Free {
    std::size_t component;
    Real weight;                // Σ w
    std::vector<Real> shares;   // α of each row
    std::vector<Real> missing;  // (α − wᵀY⁻¹a) / Σ w of each row
  };

  /// Numbers of a column that follow each other, from a place in the order of the factor on.
  struct Run {
    std::size_t place, count;
  };
  /// Of a column, in runs_ and in columns_.
  struct Start {
    std::size_t run = 0, value = 0;
  };
  /// Of Z and V, as far as either is not zero.
  template <class T>
  struct Columns {
    std::vector<T> z, v;
  };

  void find_free(const FreeInFactor& free);
  template <class Body>
  void for_each_run(std::size_t column, Body&& body) const;
  Real product(std::size_t i, std::span<const Real> whole) const;
  void multiply_columns();
  template <class T>
  const Columns<T>& columns() const;
  template <class T>
  Vec3 dot(std::size_t c, const InFactorOrder<T>& y) const;
  template <class T>
  void add_column(std::size_t i, const InFactorOrder<T>& y) const;
  Vec3 times(std::size_t row, const Positions& x) const;
  void find_forces();

  FactorRows rows_;
  std::vector<Free> free_;
  std::size_t vector_size_ = 0;
  std::vector<Start> starts_ = {{}};  // of columns of Z and V: rows, then free components
  std::vector<Run> runs_;
  Columns<Real> columns_;
  Columns<float> single_;      // the same where panels, and so the products, are in single precision
  Matrix meeting_;             // A Y⁻¹ Aᵀ
  Matrix scaled_;              // D (K⁻¹ + A Y⁻¹ Aᵀ) D, which has 1 on its diagonal
  std::vector<Real> scales_;   // D
  std::vector<Real> shares_;   // D K⁻¹
  Eigen::LLT<Matrix> solver_;  // of scaled_, or a little more
  std::vector<Vec3> dots_;     // Zᵀ y
  OfRows taken_;               // f
  OfRows forces_;              // D⁻¹ μ, then μ
  std::vector<Vec3> held_;     // x of held vertices
  std::vector<Vec3> before_;   // r of the rows' vertices, in their order
};

}  // namespace pliant
