#pragma once
// What the local step goes by in one group: chunks of its constraints, and what each of their vertices collects. The
// group and the size of chunks alone decide, so that it stays while others come, go or change.
#include "pliant/constraints/constraint_group.h"
#include "pliant/constraints/kernels/local_kernels.h"
#include "pliant/constraints/linear_forces.h"

namespace pliant {

/// Rows that the local step asks of a constraint, three numbers each.
std::size_t slots_of(const ConstraintGroup& group);

class GroupLayout {
 public:
  /// Two numbers for each vertex, all zero between one layout and the next.
  struct Scratch {
    explicit Scratch(Index vertex_count) : entry_counts(at(vertex_count), 0), is_met(at(vertex_count), 0) {}
    std::vector<std::uint32_t> entry_counts;
    std::vector<char> is_met;
  };
  enum class Coefficients { ones, signs, any };  // 1; 1 and −1, which an entry says by itself
  struct Chunk {
    Index begin = 0;  // constraints of the group, or rows of its linear forces
    Index end = 0;
    std::size_t first_partial = 0;
    std::size_t last_partial = 0;
    std::size_t first_entry = 0;
    std::size_t first_coefficient = 0;
    Coefficients coefficients = Coefficients::any;
  };

  /// Chunks of about so many slots.
  GroupLayout(const ConstraintGroup& group, std::size_t chunk_slots, Scratch& scratch);
  /// Whether it would be the same.
  bool is_of(const ConstraintGroup& group, std::size_t chunk_slots) const;
  /// That of the group.
  std::uint64_t revision() const { return revision_; }

  std::span<const Chunk> chunks() const { return chunks_; }
  /// Whether its forces are a product; then chunks are of rows.
  bool is_linear() const { return is_linear_; }
  const LinearForces& linear() const { return linear_; }
  /// The vertex of each partial, chunk after chunk.
  std::span<const Index> partial_vertices() const { return partial_vertices_; }
  /// Vertices of the group, and how often one is in a chunk; none of linear forces.
  std::size_t vertices_met() const { return vertices_met_; }
  std::size_t partials_met() const { return is_linear_ ? 0 : partial_vertices_.size(); }

  /// sums ← Aᵀ slots of a chunk that is not linear.
  void collect(const Chunk& chunk, const Real* slots, Real* sums) const;
  /// Of the lists that a local step reads.
  std::size_t bytes() const;

 private:
  static Index constraints_in_chunk(const ConstraintGroup& group, std::size_t chunk_slots);
  void lay_out_rows();
  void lay_out(Chunk& chunk, const ConstraintGroup& group, Scratch& scratch);
  void place_entries(const Chunk& chunk, const ConstraintGroup& group, std::span<const Index> touched,
                     Scratch& scratch);

  std::uint64_t revision_;
  Index chunk_size_;  // constraints
  bool is_linear_ = false;
  std::size_t vertices_met_ = 0;
  std::vector<Chunk> chunks_;
  LinearForces linear_;
  std::vector<Index> partial_vertices_;
  std::vector<std::uint32_t> partial_ends_;  // entries of the partial, counted from the first of its chunk
  std::vector<std::uint16_t> entries_;       // twice the slot of the chunk, plus one where the coefficient is −1
  std::vector<Real> coefficients_;           // of the entries of chunks that have any
};

}  // namespace pliant
