#pragma once
// The solver: thesis Algorithm 1 in residual form. step.cpp has the algorithm on one screen; here is what it needs.
#include <functional>
#include <unordered_map>

#include "pliant/core/thread_choice.h"
#include "pliant/core/thread_pool.h"
#include "pliant/forces/force.h"
#include "pliant/solver/global/global_step.h"
#include "pliant/solver/integration/energy_projection.h"
#include "pliant/solver/integration/rigid_damping.h"
#include "pliant/solver/local/local_step.h"
#include "pliant/solver/local/locality.h"
#include "pliant/solver/state.h"
#include "pliant/solver/system_info.h"

namespace pliant {

class Solver {
 public:
  explicit Solver(const SolverSettings& settings);

  /// Takes effect at the next step: a new time step, back end or number of threads costs a factorization or less.
  void set_settings(const SolverSettings& settings);

  /// The problem. Groups and forces must outlive the solver or be replaced here first. New groups cost a numeric
  /// factorization, and an ordering when they connect vertices that were not connected; new forces cost nothing.
  void set_groups(Index vertex_count, std::vector<ConstraintGroup*> groups);
  void set_forces(std::vector<Force*> forces) { forces_ = std::move(forces); }

  /// Asked before each iteration whether the step is to be given up; none: never.
  void set_stop(std::function<bool()> stop) { stop_ = std::move(stop); }

  /// Takes one step, in its substeps. Never allocates, unless a group, a setting or the state has changed. Throws
  /// Error(diverged) and leaves the state as it was when a position would not be finite; Error(interrupted), as well,
  /// when it is given up.
  StepReport step(State& state);

  /// One local step at the positions of the state, against the prediction that the last step made for it; without
  /// one, after a state was replaced, there is no inertia term.
  Evaluation evaluate(const State& state);
  /// To be told when the state is another than the last step left.
  void forget_prediction() { predicted_step_ = 0; }
  /// Elastic energy of a group at the last evaluate() [J]; 0 for a group that it did not have.
  Real elastic_energy(const ConstraintGroup& group) const;

  /// E(q) before each solve of the last step, of its last substep, of the first `history_limit` solves.
  std::span<const Real> objective_history() const { return history_; }
  static constexpr std::size_t history_limit = 4096;

  /// Describes the system as the next step has it; factorizes when something has changed.
  SystemInfo system_info(const State& state);

  Precision precision() const { return global_step_.precision(); }
  Real contraction() const { return global_step_.contraction(); }
  std::string_view backend() const { return global_step_.backend_name(); }
  /// In use: of those that were asked for, or as many as paid in the last step.
  int thread_count() const { return threads_->active(); }

 private:
  /// A group's part of what the factor was made from.
  struct GroupStamp {
    std::uint64_t revision;
    Real stiffness;
  };

  /// What the energy projection works with, in the order of the local groups, but for what has that of the simulation.
  /// Empty where it is not asked for.
  struct EnergyWork {
    Positions velocities, elastic_forces, outside, not_conservative, direction;
    Positions applied, end_positions, end_velocities, end_force;  // order of the simulation
    std::vector<Real> elastic;                                    // of each component
    std::vector<Real> surplus, no_weights, slot;
    std::vector<char> none_pinned;
  };

  void take_substep(State& state, StepReport& report);
  void take_substeps(State& state, StepReport& report);
  Real substep() const { return settings_.time_step / static_cast<Real>(settings_.substeps); }
  void prepare(const State& state, StepReport& report);
  void build_layout();
  void choose_order();
  void begin_groups(const State& state);
  void start_threads(Index asked);
  void lay_out_components(std::span<ConstraintGroup* const> groups);
  void weigh_inertia(const State& state, Real step);
  void factorize(const State& state, SetUpTimes& times);
  bool groups_changed() const;
  bool stiffness_changed() const;
  [[noreturn]] void give_up(const State& state) const;
  void predict(const State& state);
  void initial_guess(const State& state);
  LocalResult local_step(const State& state, StepReport& report);
  void global_step(const LocalResult& local, StepReport& report);
  void start_from_positions(const State& state);
  void apply_pins(Positions& q) const;
  void check_finite(const State& state) const;
  [[noreturn]] void report_divergence(const State& state) const;
  const Force* owner(const ConstraintGroup& group) const;
  std::string force_reason(const State& state, Index vertex) const;
  bool projects_energy() const { return settings_.energy_projection > 0; }
  void evaluate_elastic();
  void add_forces(const State& state);
  void begin_energy(const State& state);
  void find_outside_forces(const State& state);
  void count_external_groups();
  void evaluate_end(const State& state);
  void project_energy(const State& state);
  void commit_energy(State& state);
  void commit(State& state);
  void damp(State& state) const;
  void advance_time(State& state) const;

  SolverSettings settings_;
  std::function<bool()> stop_;
  Index vertex_count_ = 0;
  std::vector<ConstraintGroup*> groups_;
  std::vector<Force*> forces_;

  // All that follows is in the order of the local groups; groups, forces and state are in that of the simulation.
  LocalGroups local_groups_;
  std::unique_ptr<ThreadPool> threads_;
  ThreadChoice thread_choice_;
  LocalStep local_step_;
  SystemMatrix system_matrix_;
  GlobalStep global_step_;
  std::vector<GroupStamp> stamps_;  // of the groups in the factor
  std::unordered_map<const ConstraintGroup*, std::size_t> places_;
  Real factor_step_ = 0;  // η of the matrix that was factorized; 0: there is no factor
  bool groups_laid_out_ = false;
  bool pattern_analyzed_ = false;

  std::vector<char> is_pinned_;
  Components free_components_;
  std::vector<Real> masses_;
  std::vector<Real> inertia_weights_;  // M/η², 0 at pinned vertices
  std::vector<Real>
      translation_weights_;  // the same and what forces' groups add: Y as a translation of a component feels it
  Real predicted_step_ = 0;  // η of s_; 0: s_ does not belong to the state
  Positions s_, q_, residual_;
  Positions force_;  // in the order of the simulation, as are the two that follow
  RigidDamping damping_;
  EnergyProjection energy_;
  EnergyWork energy_work_;
  State step_start_;           // of a step with substeps
  Real substep_fraction_ = 1;  // of the path to their targets that pinned vertices have gone at the end of the substep
  std::vector<Real> history_;
};

}  // namespace pliant
