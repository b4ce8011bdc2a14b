#include "pliant/solver/rigid_system.h"

#include <algorithm>
#include <numeric>

namespace pliant {
namespace {

/// Of a set: with more it has no factor.
constexpr std::size_t most_bodies = 200;
/// Products of blocks that a factor may take, 0.2 µs each.
constexpr std::size_t most_products = 5000;

std::size_t least_of(std::span<std::size_t> least, std::size_t body) {
  while (least[body] != body) body = least[body] = least[least[body]];
  return body;
}

/// Of sorted numbers: adds one that is not there yet.
void insert(std::vector<std::size_t>& sorted, std::size_t number) {
  const auto place = std::ranges::lower_bound(sorted, number);
  if (place == sorted.end() || *place != number) sorted.insert(place, number);
}

void erase(std::vector<std::size_t>& sorted, std::size_t number) {
  sorted.erase(std::ranges::lower_bound(sorted, number));
}

}  // namespace

void RigidSystem::lay_out(std::size_t count, std::span<const RigidLink> links) {
  if (count == count_ && std::ranges::equal(links, links_)) return;
  count_ = count;
  links_.assign(links.begin(), links.end());
  find_sets();
  places_.assign(count, 0);
  order_.clear();
  starts_.assign(1, 0);
  rows_.clear();
  link_blocks_.resize(links.size());
  std::vector<std::vector<std::size_t>> neighbors(count);
  for (Set& set : sets_) {
    if (set.bodies.size() <= most_bodies) eliminate(set, neighbors);
  }
  diagonal_.resize(order_.size());
  blocks_.resize(rows_.size());
}

void RigidSystem::find_sets() {
  std::vector<std::size_t> least(count_);
  std::iota(least.begin(), least.end(), std::size_t{0});
  for (const RigidLink& link : links_) {
    const std::size_t a = least_of(least, link.first);
    const std::size_t b = least_of(least, link.second);
    least[std::max(a, b)] = std::min(a, b);
  }
  sets_.clear();
  std::vector<std::size_t> set_of(count_, 0);
  for (std::size_t i = 0; i < count_; ++i) {
    const std::size_t first = least_of(least, i);
    if (first == i) {
      set_of[i] = sets_.size();
      sets_.emplace_back();
    }
    sets_[set_of[first]].bodies.push_back(i);
  }
  for (std::size_t i = 0; i < links_.size(); ++i) {
    sets_[set_of[least_of(least, links_[i].first)]].links.push_back(i);
  }
}

/// Finds the neighbors of each body when its turn comes.
std::vector<std::size_t> RigidSystem::order_of(const Set& set, std::vector<std::vector<std::size_t>>& neighbors) const {
  std::vector<std::size_t> left = set.bodies;
  std::vector<std::size_t> order;
  while (!left.empty()) {
    const auto next = std::ranges::min_element(left, {}, [&](std::size_t i) { return neighbors[i].size(); });
    const std::size_t body = *next;
    left.erase(next);
    order.push_back(body);
    for (const std::size_t i : neighbors[body]) {
      erase(neighbors[i], body);
      for (const std::size_t j : neighbors[body]) {
        if (j != i) insert(neighbors[i], j);
      }
    }
  }
  return order;
}

void RigidSystem::eliminate(Set& set, std::vector<std::vector<std::size_t>>& neighbors) {
  for (const std::size_t link : set.links) {
    insert(neighbors[links_[link].first], links_[link].second);
    insert(neighbors[links_[link].second], links_[link].first);
  }
  set.first = order_.size();
  for (const std::size_t body : order_of(set, neighbors)) {
    places_[body] = order_.size();
    order_.push_back(body);
  }
  for (std::size_t place = set.first; place < order_.size(); ++place) {
    std::vector<std::size_t>& below = neighbors[order_[place]];
    for (std::size_t& body : below) body = places_[body];
    std::ranges::sort(below);
    rows_.insert(rows_.end(), below.begin(), below.end());
    starts_.push_back(rows_.size());
  }
  for (std::size_t place = set.first; place < order_.size(); ++place) {
    for (std::size_t j = starts_[place]; j < starts_[place + 1]; ++j) {
      set.targets.push_back(rows_[j]);
      for (std::size_t i = j + 1; i < starts_[place + 1]; ++i) set.targets.push_back(block_of(rows_[i], rows_[j]));
    }
  }
  for (const std::size_t link : set.links) {
    const std::size_t a = places_[links_[link].first];
    const std::size_t b = places_[links_[link].second];
    link_blocks_[link] = block_of(std::max(a, b), std::min(a, b));
  }
}

std::size_t RigidSystem::block_of(std::size_t row, std::size_t column) const {
  const auto begin = rows_.begin() + static_cast<std::ptrdiff_t>(starts_[column]);
  const auto end = rows_.begin() + static_cast<std::ptrdiff_t>(starts_[column + 1]);
  return static_cast<std::size_t>(std::lower_bound(begin, end, row) - rows_.begin());
}

bool RigidSystem::is_small(std::size_t set) const {
  return sets_[set].bodies.size() <= most_bodies && sets_[set].targets.size() <= most_products;
}

void RigidSystem::begin(std::size_t set) {
  const std::size_t first = sets_[set].first;
  const std::size_t end = first + sets_[set].bodies.size();
  for (std::size_t i = starts_[first]; i < starts_[end]; ++i) blocks_[i].setZero();
}

void RigidSystem::set_link(std::size_t link, const Matrix& block) {
  const RigidLink& bodies = links_[link];
  Matrix& to = blocks_[link_blocks_[link]];
  if (places_[bodies.first] > places_[bodies.second]) {
    to = block;
  } else {
    to = block.transpose();
  }
}

/// L Lᵀ, column after column; each subtracts from those behind it what it has in their rows.
bool RigidSystem::factorize(std::size_t set) {
  const Set& mine = sets_[set];
  std::size_t next = 0;
  for (std::size_t place = mine.first; place < mine.first + mine.bodies.size(); ++place) {
    const Eigen::LLT<Matrix> factor(diagonal_[place]);
    if (factor.info() != Eigen::Success) return false;
    diagonal_[place] = factor.matrixL();
    const auto upper = diagonal_[place].transpose().triangularView<Eigen::Upper>();
    for (std::size_t i = starts_[place]; i < starts_[place + 1]; ++i) {
      upper.solveInPlace<Eigen::OnTheRight>(blocks_[i]);
    }
    for (std::size_t j = starts_[place]; j < starts_[place + 1]; ++j) {
      diagonal_[mine.targets[next++]].noalias() -= blocks_[j] * blocks_[j].transpose();
      for (std::size_t i = j + 1; i < starts_[place + 1]; ++i) {
        blocks_[mine.targets[next++]].noalias() -= blocks_[i] * blocks_[j].transpose();
      }
    }
  }
  return true;
}

void RigidSystem::solve(std::size_t set, std::span<Vector> x) const {
  const std::size_t first = sets_[set].first;
  const std::size_t end = first + sets_[set].bodies.size();
  for (std::size_t place = first; place < end; ++place) {
    Vector& mine = x[order_[place]];
    diagonal_[place].triangularView<Eigen::Lower>().solveInPlace(mine);
    for (std::size_t i = starts_[place]; i < starts_[place + 1]; ++i) x[order_[rows_[i]]] -= blocks_[i] * mine;
  }
  for (std::size_t place = end; place-- > first;) {
    Vector& mine = x[order_[place]];
    for (std::size_t i = starts_[place]; i < starts_[place + 1]; ++i) {
      mine -= blocks_[i].transpose() * x[order_[rows_[i]]];
    }
    diagonal_[place].transpose().triangularView<Eigen::Upper>().solveInPlace(mine);
  }
}

}  // namespace pliant
