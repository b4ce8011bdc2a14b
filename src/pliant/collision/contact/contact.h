#pragma once
// Contact with colliders, all that the solver knows of it. A vertex at the signed distance d < r from a collider has
//
//     E = k/2 (r − d)² + H(u),        k = κ 50 m/h²,
//
// with the slide u over the collider's surface in the step, added to what friction has let slide before, and Huber's
// function H, whose limit μλ has the normal force λ of an earlier iterate. λ and the normal that u is across are
// frozen between refreshes, so that all of it is a potential. h is the substep: with that of the integrator's inertia,
// contact would be stiffer in the second step of BDF2 than in its first.
//
// No vertex passes a collider: where the straight way of a vertex from its place at the beginning of the substep, in
// the frame of the collider, goes in at one side and on towards another, the collider is to it, for this substep, the
// half-space behind its tangent plane where the way goes in. After each move no vertex is deeper than a twentieth of r
// outside the surface: what would be is held back there.
//
// All vertices are in the order of the solver, but in what State and ContactPoint have.
#include <algorithm>

#include "pliant/collision/contact/candidate.h"
#include "pliant/collision/contact/contact_state.h"
#include "pliant/collision/contact/contact_step.h"
#include "pliant/collision/contact/rigid_resistance.h"
#include "pliant/core/thread_pool.h"

namespace pliant {

/// A vertex that touches a collider at the end of a step.
struct ContactPoint {
  Index vertex = 0;
  Index collider = 0;
  Vec3 point = Vec3::Zero();    ///< on the surface [m]
  Vec3 normal = Vec3::UnitZ();  ///< away from the collider
  Real distance = 0;            ///< d [m]
  Vec3 force = Vec3::Zero();    ///< on the vertex, normal and friction [N]
  Real friction_power = 0;      ///< that friction takes away [W]
};

/// What a collider feels.
struct Wrench {
  Vec3 force = Vec3::Zero();   ///< [N]
  Vec3 torque = Vec3::Zero();  ///< about its position [N m]
};

/// What adding up the contacts has found.
struct ContactSums {
  Real energy = 0;            ///< [J]
  Real squared_residual = 0;  ///< largest |r|² of a vertex, with its contacts [N²]
};

/// What holding back has done.
struct HeldBack {
  bool has_moved = false;          ///< a vertex
  bool has_new_potential = false;  ///< a vertex meets a half-space from now on
};

class Contact {
 public:
  /// Forgets the substep before, but not what touched in it.
  void set_colliders(std::vector<ContactCollider> colliders);
  std::span<ContactCollider> colliders() { return colliders_; }
  bool is_active() const { return !colliders_.empty(); }
  /// Forgets the substep before: the order of the vertices is another, or which are pinned.
  void forget_substep() { step_.reset(); }
  /// Whether there is a substep that was not forgotten: find_forces() and what follows it ask for one.
  bool has_begun() const { return step_.has_value(); }

  /// A substep begins at the iterate q, which is held back.
  void begin_substep(const ContactStep& step, const ContactState& state, Positions& q, ThreadPool& threads);

  /// Holds back what is too deep in q, and finds the forces where it then is.
  HeldBack hold_back(Positions& q, ThreadPool& threads);
  /// Finds the forces at q as it is.
  void find_forces(const Positions& q, ThreadPool& threads);
  /// Adds the forces that were found last to r [N].
  ContactSums add(Positions& r, ThreadPool& threads);
  /// Takes the forces that were found last from r [N].
  void subtract(Positions& r, ThreadPool& threads);
  bool is_anything_near() const;
  /// Adds the vertices that may touch a collider.
  void add_touching(std::vector<Index>& vertices) const;
  /// Adds up what contact does to each component with those vertices at q, of which others are not asked, and resists
  /// rigid motions from there with. Forces that were found last stay as they are.
  void add_resistance(const Positions& q, std::span<const Index> component_of_vertex,
                      std::span<RigidResistance> components) const;
  /// Adds up the energies of the forces that were found last, of each component [J].
  void add_energies(std::span<const Index> component_of_vertex, std::span<Real> components) const;
  /// The same without what friction takes away: what contact may give back.
  void add_stored_energies(std::span<const Index> component_of_vertex, std::span<Real> components) const;
  /// Marks components that are near a collider that moves, or whose surface does.
  void mark_driven(std::span<const Index> component_of_vertex, std::span<char> components) const;
  /// After add(): where vertices are held back and r [N] drives them on all the same, makes their contacts stiffer and
  /// corrects r. diagonal: of Y [N/m]. Returns the new sums; nothing where there are no such vertices.
  std::optional<ContactSums> stiffen(Positions& r, std::span<const Real> diagonal, ThreadPool& threads);
  /// After add(): takes the present loads for friction and corrects r. Returns the new sums.
  ContactSums refresh(Positions& r, ThreadPool& threads);

  /// pᵀ C p [N m] with the curvature C where the forces were found last.
  Real curvature(const Positions& p) const;
  /// Adds D ⪰ C of each vertex [N/m].
  void add_diagonal(std::span<Real> diagonal) const;
  /// The same, of those alone that are far stiffer than at first, κ > 4.
  Real stiffened_curvature(const Positions& p) const;

  /// What stays when the substep has ended at q. diagonal: of Y [N/m]. κ stands for every vertex then.
  void commit(const Positions& q, std::span<const Real> diagonal, ContactState& state, ThreadPool& threads);

  /// Of the last substep, by vertex of the simulation, then collider.
  std::span<const ContactPoint> points() const { return points_; }
  /// Zero for a collider that was not in it.
  Wrench wrench(Index collider) const;
  /// Vertices that were held back in the substep, each as often as it was.
  Index held_back() const { return held_back_; }

 private:
  static constexpr Index vertices_of_chunk = 256;

  using Candidate = ContactCandidate;
  struct Force {
    Index vertex = 0;
    Vec3 force = Vec3::Zero();
    Real energy = 0;
  };
  /// Some vertices in a row, and those of them that may touch something, by vertex, then collider.
  struct Chunk {
    std::vector<Candidate> candidates;
    std::vector<Candidate> before;  // scratch
    std::vector<Force> forces;      // of each candidate
    std::vector<Real> reaches;      // of each collider
    ContactSums sums;
    Index held_back = 0;
    HeldBack done;
    bool is_stiffer = false;
  };

  struct Turn {
    Mat3 rotation;
    bool is_none;
  };

  bool is_current(Index begin, Index end, const Positions& q) const;
  void find_reaches(Chunk& chunk, Index begin, Index end, const Positions& q) const;
  void find_candidates(Chunk& chunk, Index begin, Index end, const Positions& q);
  Candidate make_candidate(Index vertex, Index collider, const Vec3& begin, Real begin_distance) const;
  void recall(const ContactState& state, const Positions& q, Candidate& candidate) const;
  /// Its distance and normal at x, unless they are known, or it is known to touch nothing.
  void look_at(Candidate& candidate, const Vec3& x) const {
    if (!candidate.is_out_of_reach(x) && candidate.place != x) find_distance(candidate, x);
  }
  void find_distance(Candidate& candidate, const Vec3& x) const;
  SignedDistance distance_at(const Candidate& candidate, const Vec3& x) const;
  static void add_resistance(const Candidate& each, const Vec3& x, const SignedDistance& found, RigidResistance& sum);
  bool guard(Candidate& candidate) const;
  void hold_back(Chunk& chunk, Index begin, Index end, Positions& q);
  void hold_back(std::span<Candidate> of_vertex, Chunk& chunk, Positions& q) const;
  Real coefficient(Index vertex, const ContactCollider& collider) const;
  Real least_stiffness(Index vertex) const;
  Real curvature(const Candidate& candidate, const Vec3& way) const;
  void freeze(Candidate& candidate) const;
  Vec3 carried(const Candidate& candidate, const Vec3& point) const;
  static Force force(const Candidate& candidate);
  static void renew_force(Chunk& chunk, std::size_t i, Positions& r);
  bool stiffen(Chunk& chunk, const Positions& r, std::span<const Real> diagonal);
  static void add_up(Chunk& chunk, Index begin, Index end, const Positions& r);
  void keep(Candidate& candidate, ContactState& state);
  void stiffen(const Candidate& candidate, std::span<const Real> diagonal, ContactState& state) const;
  ContactMemory memory_of(const Candidate& candidate) const;
  ContactPoint point_of(const Candidate& candidate) const;
  void add_up_wrenches();
  ContactSums total() const;
  Index number_of(Index vertex) const { return step_->vertices.empty() ? vertex : step_->vertices[at(vertex)]; }
  bool is_inner(Index vertex) const { return !step_->is_inner.empty() && step_->is_inner[at(number_of(vertex))] != 0; }
  /// Calls visit(chunk, first vertex, vertex behind the last).
  template <class Visit>
  void for_each_chunk(ThreadPool& threads, Visit&& visit) {
    const auto count = static_cast<Index>(step_->begin.rows());
    threads.parallel_for(count_of(chunks_), [&](Index i) {
      const Index begin = i * vertices_of_chunk;
      visit(chunks_[at(i)], begin, std::min(count, begin + vertices_of_chunk));
    });
  }

  std::vector<ContactCollider> colliders_;
  std::vector<Turn> turns_;  // of the colliders at the end of the substep
  std::optional<ContactStep> step_;
  std::vector<Real> stiffening_;           // κ, in the order of the simulation; empty: 1
  std::vector<Index> memory_of_vertices_;  // the first of each vertex of the simulation
  std::vector<Chunk> chunks_;
  Positions reference_;                            // where the candidates were looked for
  std::vector<Real> margins_;                      // how far from there each vertex may go before others matter [m]
  std::vector<std::span<Candidate>> of_vertices_;  // scratch
  std::vector<ContactPoint> points_;
  std::vector<std::pair<Index, Wrench>> wrenches_;  // by number of the collider
  Index held_back_ = 0;
};

}  // namespace pliant
