#pragma once
// Distances of vertices from other bodies that are less than r for a while: what begins nearer than that, or is no
// longer let go, keeps the distance it has, which grows back to r in a second.
#include <map>

#include "pliant/collision/contact/let_go_state.h"
#include "pliant/collision/pairs/pair.h"

namespace pliant {

class ReducedDistances {
 public:
  void clear();
  void set(const ReducedDistance& each, std::size_t vertex_count);
  bool is_empty() const { return shares_.empty(); }

  /// All corners of the pair keep no more than this share of r from the body on the other side.
  void reduce(const Pair& pair, const Surface& surface, Real share);
  /// The least share of its corners; 1 where none has one.
  Real share(const Pair& pair, const Surface& surface) const;
  /// All shares grow as they do in a time [s].
  void grow(Real time);
  /// Calls visit(vertex, body, share) by vertex, then body.
  template <class Visit>
  void for_each(Visit&& visit) const {
    for (const auto& [key, share] : shares_) visit(key[0], key[1], share);
  }

 private:
  std::map<std::array<Index, 2>, Real> shares_;  // of a vertex and a body
  std::vector<char> has_share_;                  // of each vertex
};

}  // namespace pliant
