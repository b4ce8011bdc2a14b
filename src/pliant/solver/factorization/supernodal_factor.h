#pragma once
// The Cholesky factor L as the triangular solves want it.
//
// A supernode is a run of columns that share their rows below the diagonal block:
//
//        c0 .. c0+nc
//       ┌──┐
//       │D ╲            D: nc × nc, lower triangle by rows, the diagonal as reciprocals
//       ├────┤
//       │ B  │  rows    B: nr × nc, by rows; row r belongs to row `rows[r]` of L
//       └────┘
//
// The values stand in the order in which the forward sweep reads them: D, then B, supernode after supernode. All three
// coordinates of a vertex, and a zero, go through a sweep together in four lanes, so each entry of L is read once a
// sweep and serves three right-hand sides.
#include "pliant/solver/factorization/sweeps.h"
#include "pliant/solver/state.h"

namespace pliant {

class SupernodalFactor {
 public:
  SupernodalFactor() = default;
  SupernodalFactor(const SupernodalFactor&) = delete;
  SupernodalFactor& operator=(const SupernodalFactor&) = delete;

  /// Forgets the factor and begins another of this size; permutation[i] is the vertex in place i.
  void begin(std::span<const Index> permutation);
  /// Adds the next supernode: columns [c0, c0 + columns), rows below the block ascending. entry(r, c) gives L at local
  /// row r (the block's rows first, then the others) and local column c ≤ r.
  template <class Entry>
  void add_supernode(Index columns, std::span<const Index> rows_below, Entry&& entry);
  void finish();

  /// Solves L Lᵀ x = b in the order of the vertices (m × 3 each). Never allocates.
  SolveTimes solve(const Positions& b, Positions& x);

  Index size() const { return static_cast<Index>(permutation_.size()); }
  Index supernode_count() const { return static_cast<Index>(supernodes_.size()); }
  /// Stored entries of L, the zeros that panels carry along included.
  std::size_t entry_count() const { return values_.size(); }
  /// What one sweep reads besides x: values, rows and panels.
  std::size_t sweep_bytes() const {
    return sizeof(Real) * values_.size() + sizeof(Index) * rows_.size() + sizeof(Supernode) * supernodes_.size();
  }

 private:
  std::vector<Index> permutation_;
  std::vector<Supernode> supernodes_;
  std::vector<Index> rows_;
  std::vector<Real> values_;
  std::vector<Real> storage_;  // of x: four lanes a row, aligned by hand
  Real* x_ = nullptr;
};

template <class Entry>
void SupernodalFactor::add_supernode(Index columns, std::span<const Index> rows_below, Entry&& entry) {
  const Index first_column = supernodes_.empty() ? 0 : supernodes_.back().first_column + supernodes_.back().columns;
  const auto below = static_cast<Index>(rows_below.size());
  supernodes_.push_back({first_column, columns, below, rows_.size(), values_.size()});
  rows_.insert(rows_.end(), rows_below.begin(), rows_below.end());
  for (Index r = 0; r < columns; ++r) {
    for (Index c = 0; c < r; ++c) values_.push_back(entry(r, c));
    values_.push_back(1 / entry(r, r));
  }
  for (Index r = columns; r < columns + below; ++r) {
    for (Index c = 0; c < columns; ++c) values_.push_back(entry(r, c));
  }
}

}  // namespace pliant
