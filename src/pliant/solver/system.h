#pragma once
// The system of equations of a simulation: which constraints there are, in which order the solver has them, which
// vertices are pinned or hang together, what the vertices weigh, and the factor of Y = M/η² + Σ w SᵀAᵀAS, beside which
// what comes and goes stands. It knows when each of these has to be made anew. All vertices are in the solver's order,
// but in set_groups(), begin_step() and the numbers that vertex() and constraint() give.
#include <unordered_map>

#include "pliant/solver/global/global_step.h"
#include "pliant/solver/local/local_step.h"
#include "pliant/solver/local/locality.h"
#include "pliant/solver/passing_groups.h"
#include "pliant/solver/settings.h"
#include "pliant/solver/state.h"
#include "pliant/solver/system_info.h"

namespace pliant {

class System {
 public:
  System() = default;
  System(const System&) = delete;
  System& operator=(const System&) = delete;

  /// Groups, with stencils in the order of the simulation. They must outlive their use here. Where only such have come
  /// or gone as come and go, the layout and the factor stay.
  void set_groups(Index vertex_count, std::vector<ConstraintGroup*> groups);
  /// Another back end or ordering: the next factor is analyzed anew.
  void set_factorization(std::unique_ptr<Factorization> factorization);
  bool has_factorization() const { return global_step_.has_factorization(); }
  bool has_factor() const { return factor_step_ > 0; }
  /// The next step factorizes, whatever else has changed.
  void forget_factor() { factor_step_ = 0; }

  /// Lets the groups take what they need of the state that a step of length h [s] begins with.
  void begin_step(const State& state, Integrator integrator, Real h);
  /// Lets groups whose begin_step() freezes the shape alone take that of q, in which a step of length h [s] ends.
  void freeze_shapes(const Positions& q, const State& state, Real h);
  /// Whether groups were set since the last begin_step().
  bool needs_begin_step() const { return needs_begin_step_; }
  /// Whether a group was added, or has another stencil, reduction, measure or pin, since the layout was made.
  bool needs_layout() const;
  /// Order, slots, pattern and components. What was gathered before is in another order then.
  void lay_out();
  /// Takes up numbers of the groups that may have changed otherwise: targets, normals, stiffness.
  void sync_parameters();

  /// Masses [kg] of the vertices, and η of a step [s]. What was factorized with Y counts in translations as before.
  void set_inertia(std::span<const Real> masses, Real step);
  /// Whether the factor is of another η, of other stiffnesses, or has another diagonal D added.
  bool needs_factor(Real step, std::span<const Real> diagonal) const;
  /// Sums Y and factorizes it, with D added, a number for each vertex [N/m]; empty: nothing. Throws Error(input) where
  /// it is not positive definite.
  void factorize(std::span<const Real> masses, std::span<const Real> diagonal, Real step, Precision precision,
                 ThreadPool& threads, SetUpTimes& times);

  /// Whether something is not in the factor, or was so in the last step.
  bool is_factor_corrected() const { return !passing_.is_empty() || global_step_.is_corrected(); }
  /// Lets solves know of what is not in the factor; to be called in every step with such.
  void correct_factor();

  /// r = M/η² (s − q) + Σ w SᵀAᵀ (p − z), zero at pinned vertices.
  LocalResult local_step(const Positions& q, const Positions& s, Positions& r, ThreadPool& threads);
  /// −∇V at q, pinned vertices among them, and V of each component without external groups [J].
  void elastic_step(const Positions& q, Positions& forces, std::span<Real> energies, ThreadPool& threads);
  /// V of each component without external groups in the last local step, which was at q or turned from there [J].
  void elastic_energies(const Positions& q, std::span<Real> energies) { local_step_.elastic_energies(q, energies); }
  /// q ← q + Y⁻¹ r; largest: about the largest number in r.
  SolveTimes global_step(Positions& r, Real largest, Positions& q, ThreadPool& threads);
  /// x = Y⁻¹ r; r is as it was afterwards.
  SolveTimes solve(Positions& r, Real largest, Positions& x, ThreadPool& threads);
  void solve(Positions& r, Positions& x, ThreadPool& threads) { solve(r, r.cwiseAbs().maxCoeff(), x, threads); }

  Index vertex_count() const { return vertex_count_; }
  const LocalGroups& order() const { return groups_; }
  /// All, those that come and go last.
  std::span<ConstraintGroup* const> groups() const { return all_groups_; }
  /// Those that set_groups() was given, but for those that come and go: the groups of projections().
  std::span<ConstraintGroup* const> groups_in_layout() const { return layout_groups_; }
  const PassingGroups& passing_groups() const { return passing_; }
  const Components& components() const { return components_; }
  /// The component of each vertex.
  std::span<const Index> components_of_vertices() const { return component_of_vertex_; }
  /// Those that nothing holds.
  const Components& free_components() const { return free_components_; }
  RigidFreedom freedom(std::size_t free_component) const { return freedom_[free_component]; }
  std::span<const char> is_pinned() const { return is_pinned_; }
  /// M/η² [N/m], 0 at pinned vertices.
  std::span<const Real> inertia_weights() const { return inertia_weights_; }
  /// Of Y, as the last step had it [N/m].
  std::span<const Real> diagonal() const { return diagonal_; }
  std::size_t slot_count() const { return local_step_.slot_count(); }
  const GlobalStep& factor() const { return global_step_; }
  const LocalStep& projections() const { return local_step_; }

  /// Elastic energy of a group of the simulation in the last local step [J]; 0 for one that it did not have.
  Real elastic_energy(const ConstraintGroup& group) const;
  SystemInfo describe(std::span<const Real> masses);

 private:
  /// What the layout and the factor have of a group.
  struct Stamp {
    std::uint64_t revision;
    Real stiffness;
  };

  void sum(std::span<const Real> masses, Real step);
  void factorize_sum(Precision precision, ThreadPool& threads, SetUpTimes& times);
  void choose_order();
  void find_pinned();
  void find_free();
  bool has_stamped_revisions() const;
  bool has_layout_of(Index vertex_count, std::span<ConstraintGroup* const> groups) const;
  void take_passing();

  Index vertex_count_ = 0;
  std::vector<ConstraintGroup*> simulation_groups_;
  std::vector<ConstraintGroup*> layout_groups_, passing_groups_;  // these, in two parts
  LocalGroups groups_;
  PassingGroups passing_;
  std::vector<std::uint64_t> passing_revisions_;
  std::vector<ConstraintGroup*> all_groups_;  // in the order of the solver
  std::vector<Stamp> stamps_;                 // of the groups
  std::unordered_map<const ConstraintGroup*, std::size_t> places_;
  bool is_laid_out_ = false;
  bool needs_begin_step_ = false;

  LocalStep local_step_;
  std::vector<char> is_pinned_in_factor_;  // the others are held beside it
  std::vector<char> is_pinned_;
  std::vector<char> none_pinned_;
  Components components_;
  Components free_in_layout_;  // without regard to what comes and goes
  std::vector<RigidFreedom> freedom_in_layout_;
  Components free_components_;
  std::vector<Index> component_of_vertex_;
  std::vector<RigidFreedom> freedom_;  // of each free component

  Positions shape_;  // in the order of the simulation

  std::vector<Real> inertia_weights_;
  std::vector<Real> no_weights_;
  std::vector<Real> translation_weights_;  // with what forces' groups add: Y as a translation of a component feels it
  SystemMatrix matrix_;
  std::vector<Real> diagonal_in_factor_, diagonal_;
  GlobalStep global_step_;
  Real factor_step_ = 0;  // η of the matrix that was factorized; 0: there is no factor
  std::vector<Real> added_diagonal_;
  bool is_analyzed_ = false;
};

}  // namespace pliant
