#pragma once
// The local step: every constraint projects by itself, then every vertex collects what its constraints want of it.
//
//   1. constraints, in chunks:   slots ← w (p − z), k rows a constraint        (each writes only its own slots)
//   2. vertices, in chunks:      r ← M/h² (s − q) + Σ Aᵀ slots                 (each reads its slots in a fixed order)
//
// So no two threads write to one place, no sum depends on who came first, and the bits are the same for any number of
// threads. r is minus the gradient of the objective: the true residual, for free.
#include "pliant/constraints/constraint_group.h"
#include "pliant/core/thread_pool.h"

namespace pliant {

/// What one local step finds at the iterate q.
struct LocalResult {
  Real residual = 0;  ///< largest |r| of a vertex that is not held [N]
  Real inertia = 0;   ///< 1/(2h²) ‖M^½ (q − s)‖² [J]
  Real elastic = 0;   ///< Σ wᵢ/2 ‖zᵢ − pᵢ‖² [J]
  double seconds_projections = 0;
};

class LocalStep {
 public:
  /// Lays out slots and gathers for these groups. They must outlive their use here.
  void set_groups(Index vertex_count, std::span<ConstraintGroup* const> groups);

  /// Writes r (m × 3) [N], zero at held vertices. inertia_weights: M/h² of each vertex, 0 at held ones.
  LocalResult run(const Positions& q, const Positions& s, std::span<const Real> inertia_weights,
                  std::span<const char> is_held, Positions& r, ThreadPool& threads);

  /// Elastic energy of a group in the last run [J].
  Real elastic_energy(std::size_t group) const;
  /// Index of the first constraint of a group whose force was not finite in the last run, or -1.
  Index first_not_finite(std::size_t group) const;
  /// Rows of all reductions together: a measure of the work.
  std::size_t slot_count() const { return slots_.size() / 3; }

 private:
  struct Chunk {
    std::size_t group;
    Index begin;  // constraints of the group
    Index end;
    std::size_t first_slot;
  };
  struct VertexSums {
    Real squared_residual = 0;
    Real inertia = 0;
  };

  void lay_out_slots(std::span<ConstraintGroup* const> groups);
  void lay_out_gathers(Index vertex_count);
  VertexSums gather(Index begin, Index end, const Positions& q, const Positions& s,
                    std::span<const Real> inertia_weights, std::span<const char> is_held, Positions& r) const;

  std::vector<ConstraintGroup*> groups_;
  std::vector<std::size_t> group_slots_;  // first slot of each group
  std::vector<Chunk> chunks_;
  std::vector<Real> chunk_energies_;
  std::vector<VertexSums> vertex_sums_;      // of each chunk of vertices
  std::vector<Real> slots_;                  // rows × 3
  std::vector<std::size_t> gather_offsets_;  // vertex i gathers [offsets[i], offsets[i + 1])
  std::vector<std::uint32_t> gather_slots_;  // which slot,
  std::vector<Real> gather_coefficients_;    // times which entry of A
};

}  // namespace pliant
