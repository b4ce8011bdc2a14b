#pragma once
// What a simulation has and what was done on it, reckoned from outside: from states, forces and evaluate() alone.
#include <vector>

#include "pliant/simulation/simulation.h"

namespace pliant_experiments {

/// For simulations whose forces are conservative or constant in a step, as test forces are; a relative wind is neither.
/// Work on pins that move is not known from outside: each step that moves targets begins a new account.
class EnergyLedger {
 public:
  /// Refers to the simulation. Its steps must have no substeps.
  explicit EnergyLedger(pliant::Simulation& simulation);

  void before_step();
  void after_step();

  /// Largest T + V + P − Σ F·Δq above that of the begin of an account, beyond the surplus that the state owns up to
  /// [J].
  double gain() const { return gain_; }
  /// Largest surplus: energy that energy projection knows of as too much and has yet to take back [J].
  double surplus() const { return largest_surplus_; }
  double largest_kinetic() const { return largest_kinetic_; }                         ///< [J]
  double mean_kinetic() const { return kinetic_sum_ / static_cast<double>(steps_); }  ///< of all steps [J]

 private:
  double noted_surplus() const;
  std::vector<pliant::Vec3> targets() const;
  void open_account();

  pliant::Simulation& simulation_;
  pliant::Positions positions_, forces_;  // before a step
  std::vector<pliant::Vec3> targets_;
  double energy_ = 0;   // T + V + P now
  double account_ = 0;  // what it may be: of the begin of the account, less the surplus there, and the work since
  double gain_ = 0;
  double largest_surplus_ = 0;
  double largest_kinetic_ = 0;
  double kinetic_sum_ = 0;
  int steps_ = 0;
};

/// Σ m/2 ‖v‖² [J]
double kinetic_energy(const pliant::State& state);

}  // namespace pliant_experiments
