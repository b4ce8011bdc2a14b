#pragma once
// Contact in the steps of a solver: where a step takes the colliders, when friction is refreshed, the order of
// vertices.
#include "pliant/collision/contact/contact.h"
#include "pliant/collision/contact/rigid_couplings.h"
#include "pliant/collision/contact/vertex_touch.h"
#include "pliant/collision/pairs/pair_contact.h"
#include "pliant/solver/system.h"
#include "pliant/solver/working_state.h"

namespace pliant {

/// A collider as the simulation has it; where it is, State knows.
struct SolverCollider {
  Index number = 0;
  std::shared_ptr<const ColliderShape> shape;
  ColliderMotion motion;
  Vec3 surface_velocity = Vec3::Zero();  ///< in its frame [m/s]
  Real friction = 0;                     ///< μ
  bool has_own_friction = false;         ///< else it is that of the contact settings
};

/// The surfaces of all bodies, in the order of the simulation.
struct SolverSurfaces {
  std::vector<SurfacePart> parts;  ///< what they refer to must stay as it is
  Positions rest;                  ///< m × 3 [m]
  SurfaceFrictions frictions;      ///< of the parts
  std::vector<char> ignored;       ///< which of their groups ignore each other, see Surface::ignored
  std::vector<Joint> joints;       ///< what is sewn together
};

class ContactSolver {
 public:
  /// Colliders by number; of each vertex of the simulation r [m] and μ of its body, below 0 where it has none of its
  /// own (empty: for all), and whether it touches nothing (empty: none does).
  void set(std::vector<SolverCollider> colliders, std::vector<Real> radii, std::vector<Real> frictions,
           std::vector<char> inner);
  /// Surfaces that touch each other and themselves; no parts: none do.
  void set_surfaces(SolverSurfaces surfaces);
  bool is_active() const { return contact_.is_active() || has_pairs(); }
  bool has_pairs() const { return !surfaces_.parts.empty(); }
  /// The order of the vertices is another, or which are pinned.
  void forget_order();
  /// Whether there is a substep that was not forgotten.
  bool has_begun() const { return contact_.has_begun() && (!has_pairs() || pairs_.has_begun()); }

  /// What the factor is to have of contact.
  void gather(const State& state, const System& system, WorkingState& work) const;
  /// A step of length h [s] begins. The state has these colliders, in their order.
  void begin_step(const State& state, Real h);
  /// One of its substeps, of length h [s], from share `begin` to share `end` of it, at the iterate of `work`.
  void begin_substep(const State& state, Real begin, Real end, Real h, System& system, WorkingState& work,
                     ThreadPool& threads);
  void find_forces(const Positions& q, ThreadPool& threads);
  /// Adds the forces that were found last to the residual, and their energy to what the local step found.
  void add(WorkingState& work, LocalResult& local, ThreadPool& threads);
  /// The same in two parts; hold_back_at_surfaces() may come in between where it moves nothing.
  void add_colliders(WorkingState& work, LocalResult& local, ThreadPool& threads);
  void add_pairs(WorkingState& work, LocalResult& local);
  /// Whether it is time to refresh the loads of friction: at three and eight tenths of the iterations, or once they
  /// have converged before.
  bool is_refresh_due(Index iteration, Index iterations, bool has_converged) const;
  /// Where a collider holds vertices back that it pushes too little, makes it push more: true, with another objective
  /// and residual from here on.
  bool stiffen(const System& system, WorkingState& work, LocalResult& local, ThreadPool& threads);
  void refresh(WorkingState& work, LocalResult& local, ThreadPool& threads);
  /// The loads alone: without friction the objective stays as it is.
  void refresh_loads(WorkingState& work, LocalResult& local, ThreadPool& threads);
  /// Takes the forces that were found last from r [N].
  void subtract(Positions& r, ThreadPool& threads);
  /// Holds q back on its way from `from`, and finds the forces where it then is.
  HeldBack hold_back(const Positions& from, Positions& q, ThreadPool& threads);
  /// The same in two parts: by colliders, by surfaces.
  HeldBack hold_back_at_colliders(Positions& q, ThreadPool& threads);
  HeldBack hold_back_at_surfaces(const Positions& from, Positions& q, ThreadPool& threads);
  /// pᵀ C p [N m] with the curvature C of where the forces were found last; of the contacts alone that are far stiffer
  /// than at first.
  Real curvature(const Positions& p) const;
  Real stiffened_curvature(const Positions& p) const;
  /// Adds D ⪰ C of each vertex [N/m].
  void add_diagonal(std::span<Real> diagonal) const;
  /// Of components that move as rigid bodies: vertices that may touch something, and what that does to the components
  /// with those vertices at q; see pair_resistance.h.
  bool is_anything_near() const { return contact_.is_anything_near() || (has_pairs() && !pairs_.near().empty()); }
  void add_touching(std::span<const Index> component_of_vertex, std::vector<Index>& vertices,
                    RigidCouplings& couplings) const;
  void add_resistance(const Positions& q, std::span<const Index> component_of_vertex,
                      std::span<RigidResistance> components, RigidCouplings& couplings) const;
  /// The energies where the forces were found last, and which components may touch each other.
  void add_energies(std::span<const Index> component_of_vertex, std::span<Real> components) const;
  /// What of them contact may give back: without what friction takes away.
  void add_stored_energies(std::span<const Index> component_of_vertex, std::span<Real> components) const;
  /// Of each component the least of those that it touches, or did at the beginning, directly or by way of others, and
  /// whether it does or a move of it was cut; whether a collider that moves is near.
  void find_touching(std::span<const Index> component_of_vertex, std::span<std::size_t> least, std::span<char> touches,
                     std::span<char> is_driven) const;
  void join_components(std::span<const Index> component_of_vertex, std::span<std::size_t> least) const;
  void commit_substep(const System& system, WorkingState& work, ThreadPool& threads, State& state,
                      ContactReport& report);
  void commit_step(State& state) const;

  /// What each vertex of the simulation touched at the end of the last substep: there is one for each.
  void add_touches(const System& system, std::span<VertexTouch> touches) const;

  /// Whether surfaces pushed each other where forces were added last.
  bool pairs_push() const { return pair_energy_ > 0; }
  /// Of these, what is in pairs that are pressed into the logarithm of their potential [J].
  Real steep_energy() const;

  const Contact& contact() const { return contact_; }
  const PairContact& pairs() const { return pairs_; }

 private:
  void lay_out_surfaces(const System& system);
  void start_as_a_whole(System& system, WorkingState& work, ThreadPool& threads);
  void start_with_loads(const State& state, const System& system, WorkingState& work);
  void finish(WorkingState& work, LocalResult& local, const ContactSums& sums);

  std::vector<SolverCollider> colliders_;
  std::vector<Real> radii_, frictions_;              // in the order of the simulation
  std::vector<char> is_inner_;                       // the same
  std::vector<Real> local_radii_, local_frictions_;  // in that of the solver
  std::vector<Pose> begin_, end_;                    // of the step
  Contact contact_;
  SolverSurfaces surfaces_;
  bool is_laid_out_ = false;  // the surfaces, in the order of the solver
  PairContact pairs_;
  std::vector<char> has_load_;             // of each vertex, whether the substep began with loads
  std::vector<char> is_loaded_component_;  // scratch
  Positions held_back_;                    // scratch
  ContactSums of_colliders_;               // of add_colliders()
  Real pair_energy_ = 0;                   // where forces were added last [J]
  Index refreshes_ = 0;                    // in this substep
  double seconds_ = 0;                     // in this step
};

}  // namespace pliant
