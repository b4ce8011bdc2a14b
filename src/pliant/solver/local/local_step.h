#pragma once
// The local step: every constraint projects by itself, then every vertex collects what its constraints want of it.
//
//   1. constraints, in chunks:   slots ← w (p − z), k rows a constraint, which stay in the cache,
//                                partials ← Aᵀ slots, one for each vertex that the chunk touches
//   2. vertices, in chunks:      r ← M/h² (s − q) + Σ partials, those of one to three chunks as a rule
//
// Groups whose forces are linear write partials at once, by the product of linear_forces.h where that takes less.
//
// So no two threads write to one place, every sum has its fixed order, and the bits are the same for any number of
// threads. r is minus the gradient of the objective: the true residual, for free.
#include <memory>

#include "pliant/constraints/constraint_group.h"
#include "pliant/constraints/kernels/local_kernels.h"
#include "pliant/core/thread_pool.h"
#include "pliant/solver/local/group_layout.h"
#include "pliant/solver/system_info.h"

namespace pliant {

/// What one local step finds at the iterate q.
struct LocalResult {
  Real residual = 0;  ///< largest |r| of a vertex that is not pinned [N]
  Real inertia = 0;   ///< 1/(2h²) ‖M^½ (q − s)‖² [J]
  Real elastic = 0;   ///< Σ wᵢ/2 ‖zᵢ − pᵢ‖² [J]
  Real contact = 0;   ///< of contact, which the solver adds [J]
  /// What rounding may make of `elastic` besides a share of it: linear forces sum up terms that cancel [J].
  Real rounding = 0;
  double seconds_projections = 0;
  double seconds = 0;
  Real objective() const { return inertia + elastic + contact; }
};

class LocalStep {
 public:
  /// Lays out slots and gathers for these groups; what was laid out of a group of the same revision stays,
  /// which copies in an order of our own never have. They must outlive their use here.
  void set_groups(Index vertex_count, std::span<ConstraintGroup* const> groups);

  /// Lets the next run find anew how large the terms of linear forces are.
  void begin_step() { is_rounding_known_ = false; }

  /// Writes r (m × 3) [N], zero at pinned vertices. inertia_weights: M/h² of each vertex, 0 at pinned ones.
  LocalResult run(const Positions& q, const Positions& s, std::span<const Real> inertia_weights,
                  std::span<const char> is_pinned, Positions& r, ThreadPool& threads);

  /// Which component each vertex is in, as elastic_energies() will have it. A constraint is in that of its vertices.
  void set_components(std::span<const Index> component_of_vertex);
  /// Elastic energy of each component in the last run, which was at q, but for external groups [J].
  void elastic_energies(const Positions& q, std::span<Real> of_components);

  /// Elastic energy of a group in the last run [J].
  Real elastic_energy(std::size_t group) const;
  /// Index of the first constraint of a group whose force at finite q is not finite, or -1.
  Index first_not_finite(std::size_t group, const Positions& q) const;
  /// Fills in what the local step reads and writes.
  void describe(SystemInfo& info) const;
  /// Chunks of a group that a vertex is in, on the average: little above 1 where neighbors stand near each other.
  Real chunks_of_vertex() const { return chunks_of_vertex_; }
  /// Rows of all reductions together: a measure of the work.
  std::size_t slot_count() const { return slot_count_; }

 private:
  static constexpr Index mixed = -1;
  struct Chunk {
    std::size_t group;
    const GroupLayout* layout;
    GroupLayout::Chunk part;        // of the group
    std::size_t first_partial = 0;  // of all groups
    bool is_rounding = false;       // all linear forces of its group in the last run were
    Index component = mixed;        // of all its constraints
  };

  template <class Visit>
  void for_each_run(const Chunk& chunk, Visit&& visit) const;
  void lay_out_groups(Index vertex_count);
  void lay_out_chunks();
  Real find_rounding(const Positions& q) const;
  void still_linear();
  void lay_out_vertices(Index vertex_count);
  Real project(Chunk& chunk, const Positions& q, std::vector<Real>& slots);

  std::vector<ConstraintGroup*> groups_;
  std::size_t slot_count_ = 0;
  Real chunks_of_vertex_ = 0;
  std::vector<std::unique_ptr<const GroupLayout>> layouts_;  // of each group
  std::vector<Chunk> chunks_;
  std::vector<Real> chunk_energies_;
  bool is_rounding_known_ = false;
  Real rounding_ = 0;
  std::span<const Index> component_of_vertex_;
  std::vector<GatheredSums> vertex_sums_;  // of each chunk of vertices
  std::vector<std::vector<Real>> slots_;   // of the chunk at hand of each thread

  std::vector<Real> partials_;               // count × 3 chunk after chunk, and read_after_last more
  std::vector<std::size_t> vertex_offsets_;  // vertex i has the partials [offsets[i], offsets[i + 1]) of
  std::vector<std::uint32_t> vertex_partials_;
};

}  // namespace pliant
