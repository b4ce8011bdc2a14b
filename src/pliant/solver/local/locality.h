#pragma once
// Constraints and vertices in an order in which neighbors stand near each other, whatever the order of the mesh.
#include "pliant/constraints/constraint_group.h"

namespace pliant {

/// An order for the constraints and vertices of a simulation.
struct LocalOrder {
  std::vector<Index> vertices;                  ///< vertex i of the new order is vertex vertices[i] of the simulation
  std::vector<Index> numbers;                   ///< the inverse
  std::vector<std::vector<Index>> constraints;  ///< of each group, the same as `vertices`
};

/// Vertices in patches that grow over constraints from a first one, each patch beside an earlier one; constraints by
/// the first of their vertices. A function of the stencils alone; takes time in proportion to their size.
LocalOrder find_local_order(Index vertex_count, std::span<ConstraintGroup* const> groups);

/// The groups as the solver works on them: those of the simulation, or copies in a local order.
class LocalGroups {
 public:
  /// Those of the simulation. They must outlive their use here.
  void set(std::vector<ConstraintGroup*> groups);
  /// Copies in a local order. False where a group cannot be copied so; then nothing changes.
  bool reorder(Index vertex_count);
  /// To be called after the groups of the simulation may have changed numbers: targets, normals, stiffness.
  void sync_parameters();

  std::span<ConstraintGroup* const> in_use() const { return in_use_; }
  /// The vertex of the simulation, for one of the groups in use.
  Index vertex(Index local) const { return is_reordered() ? order_.vertices[static_cast<std::size_t>(local)] : local; }
  /// That of each vertex; empty: they have the order of the simulation.
  std::span<const Index> vertices() const {
    return is_reordered() ? std::span<const Index>(order_.vertices) : std::span<const Index>();
  }
  /// The inverse of vertices().
  std::span<const Index> numbers() const {
    return is_reordered() ? std::span<const Index>(order_.numbers) : std::span<const Index>();
  }
  /// The constraint of the group of the simulation, for one of the group in use.
  Index constraint(std::size_t group, Index local) const;
  bool is_reordered() const { return !copies_.empty(); }
  /// What each vertex has, from the order of the simulation into that of the groups in use, and back. `to` takes the
  /// size of `from`; that must be the number of vertices, or zero.
  void gather(const Positions& from, Positions& to) const;
  void gather(const std::vector<Real>& from, std::vector<Real>& to) const;
  void scatter(const Positions& from, Positions& to) const;
  void scatter(const std::vector<Real>& from, std::vector<Real>& to) const;

 private:
  std::vector<ConstraintGroup*> groups_;
  std::vector<std::unique_ptr<ConstraintGroup>> copies_;
  std::vector<ConstraintGroup*> in_use_;
  LocalOrder order_;
};

}  // namespace pliant
