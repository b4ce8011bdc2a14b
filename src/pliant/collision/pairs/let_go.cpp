#include "pliant/collision/pairs/let_go.h"

#include <algorithm>

namespace pliant {

void LetGo::clear() {
  pairs_.clear();
  is_related_.clear();
}

void LetGo::set(std::vector<Vertices> pairs, std::size_t vertex_count) {
  pairs_ = std::move(pairs);
  is_related_.assign(pairs_.empty() ? 0 : vertex_count, 0);
  for (Vertices& each : pairs_) {
    if (each[1] < each[0]) std::swap(each[0], each[1]);
    for (const Index v : each) is_related_[at(v)] = 1;
  }
  std::ranges::sort(pairs_);
  pairs_.erase(std::unique(pairs_.begin(), pairs_.end()), pairs_.end());
}

bool LetGo::add(std::span<const Vertices> pairs, std::size_t vertex_count) {
  const std::size_t count = pairs_.size();
  std::vector<Vertices> all = pairs_;
  all.insert(all.end(), pairs.begin(), pairs.end());
  set(std::move(all), vertex_count);
  return pairs_.size() > count;
}

bool LetGo::has(Index a, Index b) const {
  return std::ranges::binary_search(pairs_, Vertices{std::min(a, b), std::max(a, b)});
}

bool LetGo::has(const Pair& pair) const {
  if (is_empty()) return false;
  bool has_one = false;
  for_each_across(pair, [&](Index a, Index b) { has_one = has_one || (has(a) && has(b) && has(a, b)); });
  return has_one;
}

}  // namespace pliant
