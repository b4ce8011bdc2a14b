#include "pliant/mesh/detail/sheets.h"

#include <algorithm>
#include <numeric>

namespace pliant {

TurnedSheets::TurnedSheets(std::size_t triangle_count)
    : parent_(triangle_count), is_turned_(triangle_count, 0), is_unorientable_(triangle_count, 0) {
  std::iota(parent_.begin(), parent_.end(), 0);
}

std::pair<Index, bool> TurnedSheets::find(Index triangle) {
  auto at = static_cast<std::size_t>(triangle);
  char is_turned = 0;
  while (parent_[at] != static_cast<Index>(at)) {
    const auto above = static_cast<std::size_t>(parent_[at]);
    // Path halving: the grandparent becomes the parent.
    if (parent_[above] != static_cast<Index>(above)) {
      is_turned_[at] = static_cast<char>(is_turned_[at] ^ is_turned_[above]);
      parent_[at] = parent_[above];
    }
    is_turned = static_cast<char>(is_turned ^ is_turned_[at]);
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
    if (is_contrary) is_unorientable_[low] = 1;
    return;
  }
  parent_[high] = static_cast<Index>(low);
  is_turned_[high] = is_contrary ? 1 : 0;
  is_unorientable_[low] = static_cast<char>(is_unorientable_[low] | is_unorientable_[high]);
}

CornerFans::CornerFans(std::size_t triangle_count) : parent_(3 * triangle_count) {
  std::iota(parent_.begin(), parent_.end(), 0u);
}

std::size_t CornerFans::find(std::size_t corner) {
  while (parent_[corner] != corner) {
    parent_[corner] = parent_[parent_[corner]];
    corner = parent_[corner];
  }
  return corner;
}

void CornerFans::join(std::size_t a, std::size_t b) {
  const auto [low, high] = std::minmax({find(a), find(b)});
  parent_[high] = static_cast<std::uint32_t>(low);
}

}  // namespace pliant
