#include "pliant/collision/pairs/reduced_distances.h"

#include <algorithm>

namespace pliant {
namespace {

/// In which a distance grows from nothing to r [s].
constexpr Real growth_time = 1;
/// So that what lies in one place is pushed apart as well.
constexpr Real least_share = 0.01;

/// Calls visit(vertex, body on the other side) for each corner.
template <class Visit>
void for_each_corner(const Pair& pair, const Surface& surface, Visit&& visit) {
  const auto second_side = static_cast<std::size_t>(pair.first_side());
  const Index first_body = surface.body[at(pair.vertices[0])];
  const Index second_body = surface.body[at(pair.vertices[second_side])];
  for (std::size_t j = 0; j < 4; ++j) visit(pair.vertices[j], j < second_side ? second_body : first_body);
}

}  // namespace

void ReducedDistances::clear() {
  shares_.clear();
  has_share_.clear();
}

void ReducedDistances::set(const ReducedDistance& each, std::size_t vertex_count) {
  shares_[{each.vertex, each.body}] = each.share;
  has_share_.resize(vertex_count);
  has_share_[at(each.vertex)] = 1;
}

void ReducedDistances::reduce(const Pair& pair, const Surface& surface, Real share) {
  has_share_.resize(surface.body.size());
  for_each_corner(pair, surface, [&](Index vertex, Index body) {
    Real& own = shares_.try_emplace({vertex, body}, 1).first->second;
    own = std::min(own, std::max(share, least_share));
    has_share_[at(vertex)] = 1;
  });
}

Real ReducedDistances::share(const Pair& pair, const Surface& surface) const {
  Real least = 1;
  for_each_corner(pair, surface, [&](Index vertex, Index body) {
    if (has_share_[at(vertex)] == 0) return;
    const auto found = shares_.find({vertex, body});
    if (found != shares_.end()) least = std::min(least, found->second);
  });
  return least;
}

void ReducedDistances::grow(Real time) {
  for (auto& [key, share] : shares_) share += time / growth_time;
  std::erase_if(shares_, [](const auto& each) { return each.second >= 1; });
}

}  // namespace pliant
