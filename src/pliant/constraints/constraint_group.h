#pragma once
// All that the solver knows of constraints.
//
// A group holds many constraints of one type. Constraint i has the energy  wᵢ/2 ‖zᵢ − pᵢ‖²  with  zᵢ = Aᵢ Sᵢ q  and
// pᵢ the point of its set nearest to zᵢ (Bouaziz et al. 2014, Eq. 7; thesis Eq. 3.7). Sᵢ selects n vertices (the
// stencil), Aᵢ is k × n (the reduction, the same for x, y and z), wᵢ = stiffness × measure. S, A and w are data at
// rest; only the projection z → p is non-linear. So gathering, assembly, energies and threads are written once.
#include <memory>
#include <span>
#include <string_view>

#include "pliant/core/state_view.h"

namespace pliant {

/// The system matrix has an entry for every two vertices of a constraint.
inline constexpr int max_stencil = 4096;
/// The local step holds the rows of a constraint in the cache.
inline constexpr int max_reduction_rows = 4096;

struct GroupShape {
  Index count = 0;   ///< constraints
  int vertices = 1;  ///< n, the size of a stencil, at most max_stencil
  int rows = 1;      ///< k, the rows of a reduction, at most max_reduction_rows
};

class ConstraintGroup {
 public:
  virtual ~ConstraintGroup() = default;

  virtual std::string_view type() const = 0;
  virtual GroupShape shape() const = 0;
  /// Vertex indices, count × n.
  virtual std::span<const Index> stencil() const = 0;
  /// Coefficients of A, count × k × n.
  virtual std::span<const Real> reduction() const = 0;
  /// Rest measure of each constraint (length, area, volume, or 1), times its own stiffness where each has one.
  virtual std::span<const Real> rest_measure() const = 0;

  /// Whether its energy is the same after a rotation of all vertices in the middle of a step, and its forces turn with
  /// them. Components of such groups alone are turned to where contact is in balance.
  virtual bool is_rotation_invariant() const { return false; }

  /// Whether p = 0 whatever z is, and rows of A sum to zero: its forces are linear in the positions, and never change.
  virtual bool is_linear() const { return false; }

  /// Whether w/2 ‖A S q‖² in the system matrix curves at least as much as its energy does anywhere, as with
  /// projections: then no plain global step raises the objective. Where a group says no, moves that do are shortened.
  virtual bool is_projective() const { return true; }

  /// Whether it is a drag or the like: of a few rows with targets, and comes and goes while a simulation runs. Then it
  /// stays out of the factor, whose solves are corrected for it, if it can be reordered(). It is projected constraint
  /// by constraint, without begin_local_step().
  virtual bool comes_and_goes() const { return false; }
  /// The same for a group whose type does not say so, as for pins that come while a simulation runs. A type that says
  /// so stands beside the factor whatever is set here.
  void set_beside_factor(bool is_beside);
  bool is_beside_factor() const { return is_beside_factor_ || comes_and_goes(); }

  /// Called once at the start of a step, before anything reads the group: the place to freeze normals.
  virtual void begin_step(const StateView& state, Real time_step);
  /// Whether begin_step() only freezes numbers that follow from the positions, as normals do. Then energy projection
  /// calls it at the end of a step as well: V is what the next step begins with.
  virtual bool freezes_shape() const { return false; }

  /// The local step for constraints [begin, end). Writes w (p − z), k × 3 numbers a constraint, to `out`, which begins
  /// with the first row of constraint `begin`, and returns Σ w/2 ‖z − p‖² [J]. May be called from several threads.
  virtual Real project(const Positions& positions, std::span<Real> out, Index begin, Index end) const = 0;

  /// The same as forces Σ_rows Aᵀ w (p − z) [N] on the vertices of each constraint, n × 3 numbers a constraint: what
  /// the local step asks of groups with more than one row, since a vertex then has one number to collect and no
  /// coefficient. For groups with at most max_force_rows rows.
  virtual Real project_to_forces(const Positions& positions, std::span<Real> out, Index begin, Index end) const;

  /// Called before and after the projections of a local step, by one thread: a group that is faster with all its
  /// constraints at once projects them here. In between project() is asked for these positions alone; it may be called
  /// outside of a local step as well. The end is told also where a projection throws, but not where the group's own
  /// begin_local_step() did.
  virtual void begin_local_step(const Positions& positions);
  virtual void end_local_step() noexcept;

  /// Vertices that the group pins exactly (hard pins). They leave the system of equations; vertex i of them stands at
  /// the point i of targets().
  virtual std::span<const Index> pinned_vertices() const;
  /// Points in space that may be moved while the simulation runs, count × 3; empty for a type that has none.
  virtual std::span<Real> targets();

  /// Whether what it does comes from outside of the bodies, as a force does: energy projection then counts the work of
  /// its forces, and none of its energy as elastic energy. So do groups with targets (soft pins, drags), and those that
  /// a force brings.
  virtual bool is_external();
  /// The same of this step alone: true of external groups too, and of ties that are drawn together, whose length goes
  /// with the time. begin_step() has found out.
  bool works_from_outside() { return is_driven_ || is_external(); }

  /// Whether z of its constraints is a stretch or a gradient made of stretches, and ‖z − p‖ how far these are past
  /// their limits.
  virtual bool limits_stretches() const;

  /// Moves the guess that a step begins with, q = s of every vertex, to where this group and the inertia M/η² [N/m] of
  /// each vertex (0: it is pinned) would have it. A group that a force brings says so: s has every other force in it,
  /// and few iterations are not to find out about this one.
  virtual void move_guess(Positions& q, std::span<const Real> inertia) const;

  /// The point of constraint i that its builder puts where the vertices are, unless it is told where: a target, the
  /// origin of a line. Three numbers, or none for a type without; as a rule point i of targets().
  virtual std::span<Real> anchor(Index i);
  /// Every number by which this group may differ from one that was made anew of the same options: what a checkpoint
  /// must hold of it, besides the stiffness. A type that keeps others than its targets says so here.
  virtual std::span<Real> parameters();

  /// The same constraints in another order, on renumbered vertices: constraint i of it is constraint order[i] of this
  /// group, vertex v has the number numbers[v]. Its projections are the same to the bit. Null from a group that cannot:
  /// a mesh in random order is then left so, at the cost of some speed.
  virtual std::unique_ptr<ConstraintGroup> reordered(std::span<const Index> order,
                                                     std::span<const Index> numbers) const;
  /// For what reordered() returns: takes the stiffness and all numbers that may have changed from the group that it was
  /// made of. Never allocates.
  virtual void sync_parameters(const ConstraintGroup& from, std::span<const Index> order);

  /// For a copy of the simulation. Null from a group that cannot.
  virtual std::unique_ptr<ConstraintGroup> copy() const;

  /// Multiplies the rest measures, by constraint. False, with nothing changed, from a group that cannot.
  bool scale_measures(std::span<const Real> factors);

  /// Common factor of all weights; 1 where each constraint has a stiffness of its own.
  Real stiffness() const { return stiffness_; }
  /// A changed stiffness is taken up at the next step, with one numeric factorization unless the group comes and goes.
  /// Refuses what is not positive.
  void set_stiffness(Real stiffness);
  /// The same of one that is set anew before each step, as in a ramp: the factor has factor_stiffness(), so that only
  /// each doubling factorizes. For that step: no checkpoint knows of it, so set_stiffness() is to follow.
  void set_passing_stiffness(Real stiffness);
  /// What the factor is to have of it: the stiffness, or the nearest power of two while it is a passing one. That is
  /// at least 0.7 of it, and above a half no plain global step raises the objective. Chebyshev needs all of it.
  Real factor_stiffness() const { return factor_stiffness_; }
  /// The factor has this share of the stiffness: below 1 for what does nothing most of the time, and would hold up what
  /// the others want; above 1 for potentials that curve more than w/2 ‖z‖². Below a half moves may raise the
  /// objective, and are guarded. Throws Error(input) unless it is above 0 and finite.
  void set_factor_share(Real share);
  Real factor_share() const { return factor_share_; }

  /// Raised whenever stencil, reduction, measure or the pinned vertices change: the matrix is then summed anew. No two
  /// groups that differ in these have the same one.
  std::uint64_t revision() const { return revision_; }

 protected:
  explicit ConstraintGroup(Real stiffness = 1) { set_stiffness(stiffness); }
  void changed() { revision_ = next_revision(); }
  void set_driven(bool is_driven) { is_driven_ = is_driven; }

 private:
  /// Those of rest_measure(); none from a group that does not let them be scaled.
  virtual std::span<Real> own_measures() { return {}; }

  static std::uint64_t next_revision();

  Real stiffness_ = 1;
  Real factor_stiffness_ = 1;
  Real factor_share_ = 1;
  std::uint64_t revision_ = next_revision();
  bool is_driven_ = false;
  bool is_beside_factor_ = false;
};

/// Rows of a constraint that are turned into forces at once.
inline constexpr int max_force_rows = 64;

/// Of a group with several rows a vertex collects one force of each of its constraints; of others, and where the rows
/// are many, the rows, times their coefficients.
inline bool takes_forces(const ConstraintGroup& group) {
  return group.shape().rows > 1 && group.shape().rows <= max_force_rows;
}

/// What the local step asks of a group: its forces or its rows, three numbers each.
inline Real project_to_slots(const ConstraintGroup& group, const Positions& positions, std::span<Real> out, Index begin,
                             Index end) {
  return takes_forces(group) ? group.project_to_forces(positions, out, begin, end)
                             : group.project(positions, out, begin, end);
}

/// Throws Error(input), naming the constraint and the remedy, on a group that does not keep to its own shape: lists of
/// the wrong length, a vertex out of range or twice in a stencil, a coefficient that is not finite, a measure that is
/// not positive, a pinned vertex without a target.
void check_group(ConstraintGroup& group, Index vertex_count, std::string_view name);

}  // namespace pliant
