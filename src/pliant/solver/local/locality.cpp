#include "pliant/solver/local/locality.h"

#include <algorithm>
#include <numeric>

#include "pliant/solver/constraint_rows.h"

namespace pliant {
namespace {

/// Vertices of a patch: those of two or three thousand constraints, about as many as a chunk has.
constexpr std::size_t patch_size = 512;

/// The constraints of each vertex, numbered through all groups.
struct Incidence {
  std::vector<std::size_t> offsets;
  std::vector<std::uint32_t> constraints;
  std::vector<std::uint32_t> first;  // constraint of each group, then how many there are
};

Incidence find_incidence(Index vertex_count, std::span<ConstraintGroup* const> groups) {
  Incidence incidence;
  incidence.offsets.assign(at(vertex_count) + 1, 0);
  incidence.first = {0};
  for (const ConstraintGroup* group : groups) {
    incidence.first.push_back(incidence.first.back() + static_cast<std::uint32_t>(group->shape().count));
    for (const Index vertex : group->stencil()) ++incidence.offsets[at(vertex) + 1];
  }
  std::partial_sum(incidence.offsets.begin(), incidence.offsets.end(), incidence.offsets.begin());
  incidence.constraints.resize(incidence.offsets.back());
  std::vector<std::size_t> next(incidence.offsets.begin(), incidence.offsets.end() - 1);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const std::span<const Index> stencil = groups[g]->stencil();
    const auto n = static_cast<std::size_t>(groups[g]->shape().vertices);
    for (std::size_t place = 0; place < stencil.size(); ++place) {
      incidence.constraints[next[at(stencil[place])]++] = incidence.first[g] + static_cast<std::uint32_t>(place / n);
    }
  }
  return incidence;
}

/// Numbers vertices patch by patch.
class Patches {
 public:
  Patches(Index vertex_count, std::span<ConstraintGroup* const> groups)
      : groups_(groups),
        incidence_(find_incidence(vertex_count, groups)),
        is_visited_(incidence_.first.back(), 0),
        is_numbered_(at(vertex_count), 0) {
    order_.reserve(at(vertex_count));
    for (Index v = 0; v < vertex_count; ++v) {
      border_.assign(1, v);
      for (std::size_t next = 0; next < border_.size(); ++next) grow_from(border_[next]);
    }
  }
  std::vector<Index> order() && { return std::move(order_); }

 private:
  void grow_from(Index seed) {
    if (is_numbered_[at(seed)] != 0) return;
    queue_.assign(1, seed);
    const std::size_t end = order_.size() + patch_size;
    std::size_t next = 0;
    for (; next < queue_.size() && order_.size() < end; ++next) {
      const Index v = queue_[next];
      if (is_numbered_[at(v)] != 0) continue;
      is_numbered_[at(v)] = 1;
      order_.push_back(v);
      add_neighbors(v);
    }
    border_.insert(border_.end(), queue_.begin() + static_cast<std::ptrdiff_t>(next), queue_.end());
  }

  /// Those over constraints that no vertex came by yet; the others are in a queue already, or in the border.
  void add_neighbors(Index v) {
    for (std::size_t k = incidence_.offsets[at(v)]; k < incidence_.offsets[at(v) + 1]; ++k) {
      const std::uint32_t constraint = incidence_.constraints[k];
      if (is_visited_[constraint] != 0) continue;
      is_visited_[constraint] = 1;
      const auto after = std::ranges::upper_bound(incidence_.first, constraint);
      const auto g = static_cast<std::size_t>(after - incidence_.first.begin()) - 1;
      for (const Index other : stencil_of(*groups_[g], constraint - incidence_.first[g])) {
        if (is_numbered_[at(other)] == 0) queue_.push_back(other);
      }
    }
  }

  std::span<ConstraintGroup* const> groups_;
  Incidence incidence_;
  std::vector<char> is_visited_;  // constraint
  std::vector<char> is_numbered_;
  std::vector<Index> border_;  // where the next patches begin
  std::vector<Index> queue_;
  std::vector<Index> order_;
};

/// By the first of their vertices; those with the same one as they were.
std::vector<Index> sort_constraints(const ConstraintGroup& group, const std::vector<Index>& numbers) {
  const auto count = at(group.shape().count);
  std::vector<Index> keys(count);
  for (std::size_t i = 0; i < count; ++i) {
    Index least = static_cast<Index>(numbers.size());
    for (const Index vertex : stencil_of(group, i)) least = std::min(least, numbers[at(vertex)]);
    keys[i] = least;
  }
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), 0);
  std::ranges::stable_sort(order, {}, [&](Index i) { return keys[at(i)]; });
  return order;
}

}  // namespace

LocalOrder find_local_order(Index vertex_count, std::span<ConstraintGroup* const> groups) {
  LocalOrder order;
  order.vertices = Patches(vertex_count, groups).order();
  order.numbers.resize(order.vertices.size());
  for (std::size_t i = 0; i < order.vertices.size(); ++i) order.numbers[at(order.vertices[i])] = static_cast<Index>(i);
  for (const ConstraintGroup* group : groups) order.constraints.push_back(sort_constraints(*group, order.numbers));
  return order;
}

void LocalGroups::set(std::vector<ConstraintGroup*> groups) {
  groups_ = std::move(groups);
  in_use_ = groups_;
  copies_.clear();
  order_ = {};
}

bool LocalGroups::reorder(Index vertex_count) {
  LocalOrder order = find_local_order(vertex_count, groups_);
  std::vector<std::unique_ptr<ConstraintGroup>> copies;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    copies.push_back(groups_[g]->reordered(order.constraints[g], order.numbers));
    if (!copies.back()) return false;
  }
  copies_ = std::move(copies);
  order_ = std::move(order);
  for (std::size_t g = 0; g < copies_.size(); ++g) in_use_[g] = copies_[g].get();
  sync_parameters();  // what reordered() does not copy
  return true;
}

void LocalGroups::sync_parameters() {
  for (std::size_t g = 0; g < copies_.size(); ++g) copies_[g]->sync_parameters(*groups_[g], order_.constraints[g]);
}

void LocalGroups::gather(const Positions& from, Positions& to) const {
  if (!is_reordered()) {
    to = from;
    return;
  }
  to.resize(from.rows(), 3);
  for (Index i = 0; i < static_cast<Index>(from.rows()); ++i) to.row(i) = from.row(order_.vertices[at(i)]);
}

void LocalGroups::gather(const std::vector<Real>& from, std::vector<Real>& to) const {
  if (!is_reordered()) {
    to = from;
    return;
  }
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) to[i] = from[at(order_.vertices[i])];
}

void LocalGroups::scatter(const Positions& from, Positions& to) const {
  if (!is_reordered()) {
    to = from;
    return;
  }
  to.resize(from.rows(), 3);
  for (Index i = 0; i < static_cast<Index>(from.rows()); ++i) to.row(order_.vertices[at(i)]) = from.row(i);
}

void LocalGroups::scatter(const std::vector<Real>& from, std::vector<Real>& to) const {
  if (!is_reordered()) {
    to = from;
    return;
  }
  to.resize(from.size());
  for (std::size_t i = 0; i < from.size(); ++i) to[at(order_.vertices[i])] = from[i];
}

Index LocalGroups::constraint(std::size_t group, Index local) const {
  return is_reordered() ? order_.constraints[group][at(local)] : local;
}

}  // namespace pliant
