#pragma once
// The solver: thesis Algorithm 1 in residual form. step.cpp has the algorithm on one screen; here is what it needs.
#include <functional>

#include "pliant/solver/applied_forces.h"
#include "pliant/solver/balanced_guess.h"
#include "pliant/solver/descent.h"
#include "pliant/solver/integration/contact_energy.h"
#include "pliant/solver/integration/energy_projection.h"
#include "pliant/solver/state.h"
#include "pliant/solver/step_context.h"
#include "pliant/solver/system.h"
#include "pliant/solver/system_info.h"
#include "pliant/solver/threads.h"
#include "pliant/solver/working_state.h"

namespace pliant {

class Solver {
 public:
  explicit Solver(const SolverSettings& settings);

  /// Takes effect at the next step: a new time step, back end or number of threads costs a factorization or less.
  void set_settings(const SolverSettings& settings);

  /// The problem. Groups and forces must outlive the solver or be replaced here first. New groups cost a numeric
  /// factorization, and an ordering when they connect vertices that were not connected; a few that come and go a solve
  /// for three of their rows; new forces nothing.
  void set_groups(Index vertex_count, std::vector<ConstraintGroup*> groups);
  void set_forces(std::vector<Force*> forces) { forces_.set(std::move(forces)); }
  /// Colliders by number, and how near to them each vertex comes to rest [m]. They cost nothing.
  void set_colliders(std::vector<SolverCollider> colliders, std::vector<Real> radii, std::vector<Real> frictions,
                     std::vector<char> inner) {
    contact_.set(std::move(colliders), std::move(radii), std::move(frictions), std::move(inner));
  }

  /// What each vertex touched at the end of the last step; forgotten once the order of the vertices is another.
  void add_touches(std::span<VertexTouch> touches) const { contact_.add_touches(system_, touches); }

  /// Surfaces that touch each other and themselves; they take r of set_colliders().
  void set_surfaces(SolverSurfaces surfaces) { contact_.set_surfaces(std::move(surfaces)); }

  /// Asked before each iteration whether the step is to be given up; none: never.
  void set_stop(std::function<bool()> stop) { stop_ = std::move(stop); }

  /// Takes one step, in its substeps. Never allocates, unless a group, a setting or the state has changed. Throws
  /// Error(diverged) and leaves the state as it was when a position would not be finite; Error(interrupted), as well,
  /// when it is given up.
  StepReport step(State& state);

  /// One local step at the positions of the state, against the prediction that the last step made for it; without
  /// one, after a state was replaced, there is no inertia term.
  Evaluation evaluate(const State& state);
  /// To be told when masses are others.
  void forget_factor() { system_.forget_factor(); }
  /// To be told when the state is another than the last step left.
  void forget_prediction() { work_.predicted_step = 0; }
  /// What touched in the last step.
  const Contact& contact() const { return contact_.contact(); }
  /// Elastic energy of a group at the last evaluate() [J]; 0 for a group that it did not have.
  Real elastic_energy(const ConstraintGroup& group) const { return system_.elastic_energy(group); }

  /// E(q) before each solve of the last step, of its last substep, of the first `history_limit` solves.
  std::span<const Real> objective_history() const { return history_; }
  static constexpr std::size_t history_limit = 4096;

  /// Describes the system as the next step has it; factorizes when something has changed.
  SystemInfo system_info(const State& state);

  Precision precision() const { return system_.factor().precision(); }
  Real contraction() const { return system_.factor().contraction(); }
  std::string_view backend() const { return system_.factor().backend_name(); }
  /// In use: of those that were asked for, or as many as paid in the last step.
  int thread_count() const { return threads_.active(); }

 private:
  /// In each substep: given, or found for this state.
  Index iterations(const State& state) const { return iterations_of(settings_, state.iterations); }
  Real substep() const { return settings_.time_step / static_cast<Real>(settings_.substeps); }
  bool projects_energy() const { return settings_.energy_projection > 0; }
  StepContext context(const State& state);

  void take_substeps(State& state, StepReport& report);
  void take_substep(State& state, StepReport& report);
  void prepare(const State& state, StepReport& report);
  void lay_out();
  void predict(const State& state);
  void initial_guess();
  void apply_pins();
  void begin_contact(const State& state);
  LocalResult local_step(const State& state, Index iteration, StepReport& report);
  void global_step(const State& state, const LocalResult& local, StepReport& report);
  void find_velocities();
  void add_momentum_lost(ContactReport& report) const;
  void limit_energy(const State& state, ContactReport& report);
  void commit(State& state, StepReport& report);

  SolverSettings settings_;
  std::function<bool()> stop_;
  SolverThreads threads_;
  System system_;
  AppliedForces forces_;
  WorkingState work_;
  BalancedGuess balanced_guess_;
  Descent descent_;
  ContactSolver contact_;
  EnergyProjection energy_;
  ContactEnergy contact_energy_;
  State step_start_;           // of a step with substeps
  Real substep_fraction_ = 1;  // of the path to their targets that pinned vertices have gone at the end of the substep
  std::vector<Real> history_;
};

}  // namespace pliant
