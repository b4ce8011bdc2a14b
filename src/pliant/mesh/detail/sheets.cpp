#include "pliant/mesh/detail/sheets.h"

#include <algorithm>
#include <numeric>

namespace pliant {

TurnedSheets::TurnedSheets(std::size_t triangle_count) : parent_(triangle_count), marks_(triangle_count, 0) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

std::pair<Index, bool> TurnedSheets::find(Index triangle) {
  auto at = static_cast<std::size_t>(triangle);
  unsigned char is_turned = 0;
  while (parent_[at] != static_cast<Index>(at)) {
    const auto above = static_cast<std::size_t>(parent_[at]);
    // Path halving: the grandparent becomes the parent.
    if (parent_[above] != static_cast<Index>(above)) {
      marks_[at] = static_cast<unsigned char>(marks_[at] ^ (marks_[above] & turned));
      parent_[at] = parent_[above];
    }
    is_turned = static_cast<unsigned char>(is_turned ^ (marks_[at] & turned));
    at = static_cast<std::size_t>(parent_[at]);
  }
  return {static_cast<Index>(at), is_turned != 0};
}

void TurnedSheets::join(Index a, Index b, bool are_turned_alike) {
  const auto [root_a, a_is_turned] = find(a);
  const auto [root_b, b_is_turned] = find(b);
  const bool is_contrary = (a_is_turned == b_is_turned) != are_turned_alike;
  const auto low = static_cast<std::size_t>(std::min(root_a, root_b));
  const auto high = static_cast<std::size_t>(std::max(root_a, root_b));
  if (low == high) {
    if (is_contrary) marks_[low] |= unorientable;
    return;
  }
  marks_[low] = static_cast<unsigned char>(marks_[low] | (marks_[high] & unorientable));
  marks_[high] = is_contrary ? turned : 0;
  parent_[high] = static_cast<Index>(low);
}

Parts::Parts(std::size_t count) : parent_(count) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

Index Parts::find(Index thing) {
  const auto above = [&](Index i) -> Index& { return parent_[static_cast<std::size_t>(i)]; };
  while (above(thing) != thing) {
    above(thing) = above(above(thing));
    thing = above(thing);
  }
  return thing;
}

void Parts::join(Index a, Index b) {
  const auto [low, high] = std::minmax({find(a), find(b)});
  parent_[static_cast<std::size_t>(high)] = low;
}

}  // namespace pliant
