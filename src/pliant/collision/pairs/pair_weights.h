#pragma once
// How much each near pair counts, so that every contact counts once: two edges only as far as none of their vertices
// does their work, pairs of one vertex that mean the same place as one in all. Frozen between refreshes, so that all
// that pairs do is a potential.
#include "pliant/collision/pairs/pair_list.h"

namespace pliant {

class PairWeights {
 public:
  void clear() { weighed_.clear(); }
  /// Weighs all near pairs at q anew but those that are far apart. list.go_to(q) was called.
  void refresh(const PairList& list, const Surface& surface, const Positions& q, ThreadPool& threads);
  /// Weighs those that are new since the last call; q: where they were listed.
  void update(const PairList& list, const Surface& surface, const Positions& q, ThreadPool& threads);

  /// From 0 to 1, of the near pairs of the list.
  std::span<const Real> weights() const { return weights_; }
  /// Of those whose weight is above 0 and that are nearer than r, where they were weighed.
  std::span<const Gap> gaps() const { return gaps_; }

 private:
  struct Weighed {
    Pair pair;
    Real weight;
  };
  using NearPairs = std::span<const PairList::Near>;

  void weigh(NearPairs near, const Surface& surface, const Positions& q, ThreadPool& threads);
  void weigh_edges(std::size_t i, const Surface& surface, const PairList::Near& near, const Positions& q);
  void weigh_vertex(NearPairs near, std::size_t begin, std::size_t end, const Positions& q);
  void remember(NearPairs near);

  static constexpr std::size_t pairs_of_chunk = 256;
  static constexpr Real none = -1;  // weighed yet

  std::vector<Real> weights_;
  std::span<const Gap> gaps_;
  std::vector<Gap> own_gaps_;      // measured, or the distance a lower bound
  std::vector<char> is_counting_;  // whether it stands for its contact
  std::vector<Real> vertex_gaps_;  // the least of each vertex' own pairs
  std::vector<Weighed> weighed_;   // of the last list
};

}  // namespace pliant
