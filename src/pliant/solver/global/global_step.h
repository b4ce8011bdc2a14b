#pragma once
// The global step: x = Y⁻¹ r, as exactly as the factor is. In residual form the factor is a preconditioner: one in
// single precision changes the speed of convergence, not what is converged to.
#include "pliant/solver/global/components.h"
#include "pliant/solver/global/factor_correction.h"
#include "pliant/solver/global/factorization/factorization.h"
#include "pliant/solver/global/factorization/panel_factor.h"
#include "pliant/solver/system_info.h"

namespace pliant {

class GlobalStep {
 public:
  /// Takes effect at the next factorization.
  void set_factorization(std::unique_ptr<Factorization> factorization) { factorization_ = std::move(factorization); }
  bool has_factorization() const { return factorization_ != nullptr; }
  std::string_view backend_name() const { return factorization_->name(); }

  /// Finds the ordering for the pattern of a matrix.
  void analyze(const LowerMatrix& matrix);

  /// Factorizes a matrix of the pattern analyzed last. weights: of each vertex M/h² and what else the
  /// matrix has on the diagonal for it, 0 at pinned ones; components: those that nothing holds. Both must outlive the
  /// solves. Panels are in single precision when asked for and when it does. Throws Error(input) when the matrix is not
  /// positive definite.
  void factorize(const LowerMatrix& matrix, Precision precision, std::span<const Real> weights,
                 const Components& components, ThreadPool& threads, SetUpTimes& times);

  /// From now on, until the next factorization, solves are with Y + Σ k aᵀa. Where only k has changed no system is
  /// solved for that. Returns whether anything has. Throws as FactorCorrection::set() does.
  bool correct(const FactorRows& rows);
  bool is_corrected() const { return !correction_.is_empty(); }

  /// r, x: m × 3. largest: about the largest number in r, which is as it was afterwards. Never allocates.
  SolveTimes solve(Positions& r, Real largest, Positions& x, ThreadPool& threads);
  /// q ← q + x, the same.
  SolveTimes move(Positions& r, Real largest, Positions& q, ThreadPool& threads);

  /// Of the panels in use: `double_` when those in single precision would not do.
  Precision precision() const { return precision_; }
  /// The largest share ‖E x‖ / ‖x‖ of an error that was seen to be left by a solve with panels in single precision,
  /// E = I − (LLᵀ)⁻¹ Y, in a few power iterations. 0 when they were not asked for.
  Real contraction() const { return contraction_; }
  void describe(SystemInfo& info) const;

 private:
  void fill(const LowerMatrix& matrix, Precision precision, ThreadPool& threads);
  Real estimate_contraction(const LowerMatrix& matrix, ThreadPool& threads);
  SolveTimes solve_factorized(const Positions& r, Real largest, Positions& x, ThreadPool& threads);
  SolveTimes solve_corrected(Positions& r, Real largest, Positions& x, ThreadPool& threads, Store how);
  template <class Visit>
  auto visit_panels(Visit&& visit);
  void correct_means(const Positions& r, Positions& x, std::span<const Real> weights, ThreadPool& threads) const;

  std::unique_ptr<Factorization> factorization_;
  PanelFactor<float> single_;
  PanelFactor<double> double_;
  Precision precision_ = Precision::double_;
  Real contraction_ = 0;
  Index vertex_count_ = 0;
  std::span<const Real> weights_;
  std::vector<Real> corrected_weights_;  // those that the correction was made with
  const Components* components_ = nullptr;
  FactorCorrection correction_;
  Positions move_;                    // where components are free, or the factor is corrected
  Positions trial_, image_, solved_;  // of the estimate
};

}  // namespace pliant
