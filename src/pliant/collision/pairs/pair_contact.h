#pragma once
// Contact of bodies with each other and with themselves, all that the solver knows of it. Two features of surfaces at
// a distance d < r have the energy
//
//     E = φ(d) + H(u),      k = κ 50 m/h²,
//
// with the potential of pair_potential.h and the friction of contact/potential.h; a vertex that is near a triangle or a
// loose edge has the stiffness of its own mass, or of what it meets where it is pinned. Two edges push only as far as
// none of their vertices does that work: k is the largest of the four times a weight w between 0 and 1. Loads, normals,
// closest points that friction goes by, and w are frozen between refreshes, so that all of it is a potential.
//
// Nothing passes through anything: each iterate is free of crossings if the one before was, see planes.h. What crosses
// at the start, and what follows from that, is let go, see tangles.h.
//
// All vertices are in the order of the solver; pairs are numbered in that of the simulation.
#include "pliant/collision/contact/body_contact.h"
#include "pliant/collision/contact/contact.h"
#include "pliant/collision/pairs/common_motion.h"
#include "pliant/collision/pairs/held_up_vertices.h"
#include "pliant/collision/pairs/near_pair.h"
#include "pliant/collision/pairs/pair_weights.h"
#include "pliant/collision/pairs/planes.h"
#include "pliant/collision/pairs/tangles.h"

namespace pliant {

/// What pairs of a substep have come to.
struct PairReport {
  Index pairs = 0;      ///< nearer than twice r
  Index active = 0;     ///< that push
  Index shortened = 0;  ///< vertices whose moves were cut, each as often as it was
  Real smallest_gap = std::numeric_limits<Real>::infinity();  ///< [m]
  Real lag = 0;                                               ///< of pinned vertices behind where they should be [m]
  Index let_go = 0;  ///< edges that pass through a triangle, and pinned vertices that may pass what held them up
  std::vector<LetGoBodies> let_go_bodies{};  ///< of which nothing was let go before
};

class PairContact {
 public:
  /// Surfaces at rest (m × 3) [m]; friction of the parts; r of each vertex [m].
  void set_surface(Surface surface, const Positions& rest, SurfaceFrictions frictions, std::vector<Real> radii);
  /// Nothing touches from now on.
  void clear();
  bool is_active() const { return surface_.has_value(); }
  bool is_pinned(Index vertex) const { return step_->is_pinned[at(vertex)] != 0; }
  bool has_begun() const { return step_.has_value(); }
  void forget_substep() { step_.reset(); }

  /// Of each vertex, whether a pair in which it was pushed in the step before: where bodies lie on each other.
  void find_loaded_vertices(const ContactState& state, std::vector<char>& is_loaded) const;
  /// A substep begins with the iterate q, which is held back. Throws Error(input) where too many pairs are near each
  /// other.
  void begin_substep(const ContactStep& step, const ContactState& state, Positions& q, ThreadPool& threads);
  /// Where it was held back, and pinned surfaces push nothing: takes q to where components come to that are held back
  /// as a whole. Returns whether it has.
  bool shorten_components(std::span<const Index> component_of_vertex, Positions& q, ThreadPool& threads);
  /// It begins there. has_load: of each vertex, whether q is in the balance of the last step, so that its loads are
  /// right; empty: of none.
  void begin_at(const Positions& q, std::span<const char> has_load, ThreadPool& threads);

  /// Takes pinned vertices on to where they should be, if they are held up, and q back so far that nothing passes
  /// through anything on the way from `from`, where the last forces were found. Pinned vertices that have moved make
  /// another objective.
  HeldBack hold_back(const Positions& from, Positions& q, ThreadPool& threads);
  /// Finds the forces at q.
  void find_forces(const Positions& q, ThreadPool& threads);
  /// Adds the forces that were found last to r [N]; returns their energy [J].
  Real add(Positions& r) const;
  void subtract(Positions& r) const;
  /// Takes the present loads for friction, and weighs edges anew.
  void refresh(const Positions& q, ThreadPool& threads);
  /// The loads alone, at q, where the forces were found last.
  void refresh_loads(const Positions& q);

  /// pᵀ C p [N m] with the curvature C where the forces were found last; of those alone whose κ > 4.
  Real curvature(const Positions& p) const;
  Real stiffened_curvature(const Positions& p) const;
  /// Adds D ⪰ C of each vertex [N/m].
  void add_diagonal(std::span<Real> diagonal) const;

  /// What stays when the substep has ended at q. diagonal: of Y [N/m]. Raises κ in `state`, which has those of the next
  /// substep.
  void commit(const Positions& q, std::span<const Real> diagonal, ContactState& state, ThreadPool& threads);
  /// Joins components that touch now, or did in the step before, and marks them and those of which a move was cut; see
  /// join_touching().
  void join_touching(std::span<const Index> component_of_vertex, std::span<std::size_t> least,
                     std::span<char> touches) const;
  const PairReport& report() const { return report_; }
  std::span<const NearPair> near() const { return near_; }
  /// Where the substep began [m].
  const Positions& begin() const { return begin_; }

 private:
  Index number_of(Index vertex) const { return step_->vertices.empty() ? vertex : step_->vertices[at(vertex)]; }
  void begin_exceptions(const ContactState& state, ThreadPool& threads);
  void begin_to_touch(ThreadPool& threads);
  void go_along(const Positions& q, ThreadPool& threads);
  void begin_ways(Positions& q, ThreadPool& threads);
  void look_ahead(const Positions& q, ThreadPool& threads);
  Index parts_of_ways(const Positions& q, ThreadPool& threads);
  void push_ahead(Real farthest, Positions& q);
  bool push_ahead(const Pair& pair, std::span<const Index> side, Real farthest, Positions& q);
  bool shorten(const Positions& from, Positions& q, ThreadPool& threads);
  bool shorten_way(const Positions& from, Positions& q, ThreadPool& threads);
  bool shorten_halves(const Positions& from, Positions& q, ThreadPool& threads);
  void list(const Positions& q, ThreadPool& threads);
  void collect();
  Index stiffest_vertex(const Pair& pair) const;
  NearPair make_near(const Pair& pair, Real radius) const;
  void commit_exceptions(const Positions& q, LetGoState& state, ThreadPool& threads);
  void keep_distances(const LetGo& before, const Positions& q, ThreadPool& threads);
  void let_go_of_stuck();

  static constexpr std::size_t pairs_of_chunk = 256;
  static constexpr Real least_gap_apart = 1e-6;  // of r: what is nearer lies in one place

  std::optional<Surface> surface_;
  SurfaceFrictions frictions_;
  std::vector<Real> radii_;

  std::optional<ContactStep> step_;
  Positions begin_;  // qₙ, of which forces are still asked when the state has gone on
  Positions start_;  // where the last part of the first way begins
  Positions aims_;   // where it is to lead, with what was pushed ahead
  CommonMotions common_;
  std::vector<Real> stiffening_;    // κ, in the solver's order
  std::vector<PairMemory> memory_;  // of the step before
  std::vector<Index> pinned_;       // vertices of the surface
  Positions targets_;               // where they should be, and where the others were to begin
  Positions wish_;                  // where a move would lead
  Positions whole_;                 // where the substep would begin if nothing were in the way
  bool has_pushed_ahead_ = false, is_shortened_ = false;
  std::vector<char> was_shortened_;           // of each vertex, whether a move of it was, in this substep
  std::vector<Real> shares_, shares_before_;  // scratch, of components
  Positions passed_;                          // where it has let go more than before
  Tangles tangles_;
  ReducedDistances reduced_;
  HeldUpVertices held_up_;
  int halvings_ = 0;         // of the present way
  bool has_let_go_ = false;  // more than what is listed
  Positions met_;            // scratch: the corners of a pair
  PairList list_;
  PairWeights weights_;
  std::vector<NearPair> near_;         // whose weight is above 0, in the order of pairs
  std::vector<NearPair> near_before_;  // scratch
  Planes planes_;
  PairReport report_;
};

}  // namespace pliant
