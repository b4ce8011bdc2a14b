#pragma once
// Projective Dynamics as papers print it and libraries write it: one object with a virtual call for each constraint,
// the right-hand side b = M/h² s + Σ w SᵀAᵀ p in full, double precision, and Eigen's solve of Y q = b. Only the
// constraints' data come from Pliant; the system is put together and solved by other means.
#include <memory>
#include <vector>

#include <Eigen/SparseCholesky>

#include "pliant/simulation/simulation.h"

namespace pliant_bench {

/// Coordinates in columns, one for each vertex or each row of a reduction.
using Columns = Eigen::Matrix<double, 3, Eigen::Dynamic>;

/// One constraint. It writes its projection to columns of its own.
class TextbookConstraint {
 public:
  virtual ~TextbookConstraint() = default;
  virtual void project(const Columns& points, Columns& projections) const = 0;
};

enum class GlobalForm {
  by_coordinate,   ///< Y is m × m: one solve for each of x, y and z (Bouaziz et al. 2014)
  all_coordinates  ///< Y is 3m × 3m: one solve for all (the thesis; Liu et al. 2013)
};

class Textbook {
 public:
  /// Takes over masses, constraints, forces and the state. Groups of types that no workload has are refused, and so are
  /// hard pins.
  Textbook(const pliant::Simulation& simulation, GlobalForm form);

  /// s = q + h v + h² M⁻¹ f; the iterations begin there.
  void begin_step();
  /// One local and one global step.
  void iterate();
  /// v = (q − qₙ)/h
  void end_step();

  /// m × 3
  pliant::Positions positions() const { return points_.transpose(); }
  double set_up_seconds() const { return set_up_seconds_; }

 private:
  using Sparse = Eigen::SparseMatrix<double>;

  void add_group(const pliant::ConstraintGroup& group, const pliant::Positions& rest);
  void assemble();
  void solve_by_coordinate();
  void solve_all_coordinates();

  GlobalForm form_;
  double time_step_;
  std::vector<std::unique_ptr<TextbookConstraint>> constraints_;
  std::vector<Eigen::Triplet<double>> reduction_;  // of A, all constraints' rows one below the other
  std::vector<double> weights_;                    // of each row
  Eigen::VectorXd inertia_weights_;                // M/h²
  Columns force_;                                  // constant in a step
  Sparse weighted_transpose_;                      // AᵀW, or that for all coordinates
  Eigen::SimplicialLLT<Sparse> llt_;
  Columns points_, start_, velocities_, predicted_, projections_;
  Columns momentum_;  // M/h² s
  double set_up_seconds_ = 0;
};

}  // namespace pliant_bench
