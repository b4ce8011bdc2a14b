#pragma once
// Contact in the steps of a solver: where a step takes the colliders, when friction is refreshed, the order of
// vertices.
#include "pliant/collision/contact/contact.h"
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
};

class ContactSolver {
 public:
  /// Colliders by number; r of each vertex of the simulation [m].
  void set(std::vector<SolverCollider> colliders, std::vector<Real> radii);
  bool is_active() const { return contact_.is_active(); }

  /// What the factor is to have of contact.
  void gather(const State& state, const System& system, WorkingState& work) const;
  /// A step of length h [s] begins. The state has these colliders, in their order.
  void begin_step(const State& state, Real h);
  /// One of its substeps, of length h [s], from share `begin` to share `end` of it, at the iterate of `work`.
  void begin_substep(const State& state, Real begin, Real end, Real h, const System& system, WorkingState& work,
                     ThreadPool& threads);
  /// Adds the forces that were found last to the residual, and their energy to what the local step found.
  void add(WorkingState& work, LocalResult& local, ThreadPool& threads);
  /// Refreshes the loads of friction when it is time: at three and eight tenths of the iterations, or once they have
  /// converged before. Returns whether it has.
  bool refresh(Index iteration, Index iterations, bool has_converged, WorkingState& work, LocalResult& local,
               ThreadPool& threads);
  HeldBack hold_back(Positions& q, ThreadPool& threads);
  void commit_substep(const System& system, WorkingState& work, ThreadPool& threads, State& state,
                      ContactReport& report);
  void commit_step(State& state) const;

  Contact& contact() { return contact_; }
  const Contact& contact() const { return contact_; }

 private:
  std::vector<SolverCollider> colliders_;
  std::vector<Real> radii_;        // in the order of the simulation
  std::vector<Real> local_radii_;  // in that of the solver
  std::vector<Pose> begin_, end_;  // of the step
  Contact contact_;
  Index refreshes_ = 0;  // in this substep
  double seconds_ = 0;   // in this step
};

}  // namespace pliant
