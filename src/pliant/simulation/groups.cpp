// Constraint groups that come, change and go.
#include <algorithm>

#include "pliant/constraints/position.h"
#include "pliant/core/error.h"
#include "pliant/simulation/transaction.h"

namespace pliant {
namespace {

/// Constraints that the set has in a batch, hard pins included.
std::size_t count_of(const ConstraintGroup& batch) {
  const std::size_t held = batch.pinned_vertices().size();
  return held > 0 ? held : batch.rest_measure().size();
}

/// What makes a constraint the same one in another set: its vertices and their coefficients.
using Identity = std::pair<std::vector<Index>, std::vector<Real>>;

Identity identity(const ConstraintGroup& batch, std::size_t i) {
  if (!batch.pinned_vertices().empty()) return {{batch.pinned_vertices()[i]}, {1}};
  const auto n = static_cast<std::size_t>(batch.shape().vertices);
  const std::size_t size = n * static_cast<std::size_t>(batch.shape().rows);
  const std::span<const Index> stencil = batch.stencil().subspan(i * n, n);
  const std::span<const Real> reduction = batch.reduction().subspan(i * size, size);
  return {{stencil.begin(), stencil.end()}, {reduction.begin(), reduction.end()}};
}

struct Anchored {
  Vec3 anchor;
  std::optional<Index> number;  // of a target
};

/// The anchors of a group by the constraints they belong to; those of equal constraints in their order.
std::multimap<Identity, Anchored> anchors_of(const Group& group) {
  std::multimap<Identity, Anchored> anchors;
  std::size_t first_target = 0;
  for (const auto& batch : group.set.batches) {
    const std::size_t targets = batch->targets().size() / 3;
    for (std::size_t i = 0; i < count_of(*batch); ++i) {
      const std::span<const Real> anchor = batch->anchor(static_cast<Index>(i));
      if (anchor.empty()) break;  // a type without
      std::optional<Index> number;
      if (i < targets) number = group.points[first_target + i];
      anchors.emplace(identity(*batch, i), Anchored{Eigen::Map<const Vec3>(anchor.data()), number});
    }
    first_target += targets;
  }
  return anchors;
}

std::size_t count_targets(const ConstraintSet& set) {
  std::size_t numbers = 0;
  for (const auto& batch : set.batches) numbers += batch->targets().size();
  return numbers / 3;
}

/// Numbers 0, 1, ... for targets that are all new.
std::vector<Index> new_points(const ConstraintSet& set) {
  std::vector<Index> points(count_targets(set));
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = static_cast<Index>(i);
  return points;
}

}  // namespace

GroupId Simulation::add_set(BodyId id, ConstraintSet set, std::string type, std::string name) {
  if (name.empty()) name = type;
  const std::string place = name + " on body '" + body(id).name + "'";
  check_set(set, place, std::nullopt);
  warn_of(set, place);
  const GroupId group{next_group_++};
  if (transaction_ != nullptr) transaction_->save(group, std::nullopt);
  std::vector<Index> points = new_points(set);
  const auto next_point = static_cast<Index>(points.size());
  const auto placed = groups_.emplace(
      group, Group{std::move(name), std::move(type), id, std::move(set), std::move(points), next_point});
  group_index_.add(group, placed.first->second);
  groups_changed_ = true;
  return group;
}

void Simulation::check_set(const ConstraintSet& set, const std::string& place, std::optional<GroupId> replaced) const {
  for (const auto& batch : set.batches) {
    if (!batch) fail_input(place + ": a batch of its constraints is null; leave it out");
    check_group(*batch, state_.vertex_count(), place);
    check_pins(*batch, place, replaced);
  }
}

void Simulation::warn_of(const ConstraintSet& set, const std::string& place) {
  if (set.count == 0 && set.skipped == 0) {
    warnings_.push_back(place + ": makes no constraint; does the selection hold whole elements?");
  }
  if (set.skipped > 0) {
    warnings_.push_back(place + ": left out at " + std::to_string(set.skipped) + " " + set.skipped_reason);
  }
}

/// A vertex can be pinned at one place only.
void Simulation::check_pins(const ConstraintGroup& added, const std::string& place,
                            std::optional<GroupId> replaced) const {
  std::vector<Index> pinned(added.pinned_vertices().begin(), added.pinned_vertices().end());
  std::ranges::sort(pinned);
  const auto twice = std::ranges::adjacent_find(pinned);
  if (twice != pinned.end())
    fail_input(place + ": vertex " + std::to_string(*twice) + " is pinned twice; leave one out");
  for (const Index vertex : pinned) {
    const std::optional<GroupId> holder = group_index_.holder(vertex);
    if (!holder || holder == replaced) continue;
    fail_input(place + ": vertex " + std::to_string(vertex) + " is already pinned by '" + group(*holder).name +
               "'; leave it out of one of the two");
  }
}

std::vector<std::string> Simulation::group_names() const {
  std::vector<std::string> names;
  for (const auto& [id, group] : groups_) names.push_back(group.name);
  return names;
}

void Simulation::remove(GroupId id) {
  const auto found = groups_.find(id);
  if (found == groups_.end())
    fail_input("group " + std::to_string(static_cast<Index>(id)) +
               " does not exist; give one that was added and not removed");
  group_index_.remove(id, found->second);
  if (transaction_ != nullptr) transaction_->save(id, std::move(found->second));
  groups_.erase(found);
  groups_changed_ = true;
}

const Group& Simulation::group(GroupId id) const {
  const auto found = groups_.find(id);
  if (found == groups_.end())
    fail_input("group " + std::to_string(static_cast<Index>(id)) +
               " does not exist; give one that was added and not removed");
  return found->second;
}

std::optional<GroupId> Simulation::find_group(std::string_view name) const {
  return group_index_.find(name);
}

void Simulation::replace_set(GroupId id, ConstraintSet set, std::string type, Anchors anchors) {
  const Group& old = group(id);
  const std::string place = old.name + " on body '" + body(old.body).name + "'";
  check_set(set, place, id);
  std::multimap<Identity, Anchored> olds = anchors_of(old);
  Index next_point = old.next_point;
  std::vector<Index> points;
  for (const auto& batch : set.batches) {
    const std::size_t end_of_batch = points.size() + batch->targets().size() / 3;
    for (std::size_t i = 0; i < count_of(*batch); ++i) {
      const std::span<Real> anchor = batch->anchor(static_cast<Index>(i));
      if (anchor.empty()) break;
      const auto same = olds.find(identity(*batch, i));
      if (same != olds.end() && anchors == Anchors::kept) std::ranges::copy(same->second.anchor, anchor.begin());
      const bool has_number = same != olds.end() && same->second.number.has_value();
      if (points.size() < end_of_batch) points.push_back(has_number ? *same->second.number : next_point++);
      if (same != olds.end()) olds.erase(same);
    }
    while (points.size() < end_of_batch) points.push_back(next_point++);
  }
  warn_of(set, place);
  exchange_set(id, std::move(set), std::move(type), std::move(points), next_point);
}

void Simulation::release(GroupId id, std::span<const Index> vertices) {
  const Group& old = group(id);
  std::vector<Index> released;
  for (const Index v : vertices) released.push_back(vertex(old.body, v));
  ConstraintSet rest = pliant::release(old.set, released);
  std::ranges::sort(released);
  std::vector<Index> points;
  std::size_t target = 0;
  for (const auto& batch : old.set.batches) {
    for (std::size_t i = 0; i < count_of(*batch); ++i, ++target) {
      if (!std::ranges::binary_search(released, identity(*batch, i).first[0])) points.push_back(old.points[target]);
    }
  }
  exchange_set(id, std::move(rest), old.type, std::move(points), old.next_point);
}

void Simulation::exchange_set(GroupId id, ConstraintSet set, std::string type, std::vector<Index> points,
                              Index next_point) {
  Group& group = groups_.at(id);
  Group renewed{group.name, std::move(type), group.body, std::move(set), std::move(points), next_point};
  group_index_.remove(id, group);
  if (transaction_ != nullptr) transaction_->save(id, std::move(group));
  group = std::move(renewed);
  group_index_.add(id, group);
  groups_changed_ = true;
}

void Simulation::set_stiffness(GroupId id, Real stiffness) {
  const Group& owner = group(id);
  if (!this->stiffness(id)) fail_input("group '" + owner.name + "' has no stiffness; hard pins have none");
  if (transaction_ != nullptr) transaction_->save_numbers(id, owner);
  for (const auto& batch : owner.set.batches) {
    if (batch->shape().count > 0) batch->set_stiffness(stiffness);
  }
}

std::optional<Real> Simulation::stiffness(GroupId id) const {
  for (const auto& batch : group(id).set.batches) {
    if (batch->shape().count > 0) return batch->stiffness();
  }
  return std::nullopt;
}

std::span<Real> Simulation::target_numbers(GroupId id, Index i) const {
  const Group& owner = group(id);
  auto place = static_cast<std::size_t>(i);
  for (const auto& batch : owner.set.batches) {
    const std::span<Real> targets = batch->targets();
    if (i >= 0 && 3 * place < targets.size()) return targets.subspan(3 * place, 3);
    place -= targets.size() / 3;
  }
  fail_input("group '" + owner.name + "' has no target " + std::to_string(i) +
             "; positions and drags have one for each constraint");
}

Index Simulation::target_count(GroupId id) const {
  return static_cast<Index>(count_targets(group(id).set));
}

Vec3 Simulation::target(GroupId id, Index i) const {
  return Eigen::Map<const Vec3>(target_numbers(id, i).data());
}

void Simulation::set_target(GroupId id, Index i, const Vec3& target) {
  if (!target.allFinite())
    fail_input("group '" + group(id).name + "': the target is not finite; give three finite numbers");
  const std::span<Real> numbers = target_numbers(id, i);
  if (transaction_ != nullptr) transaction_->save_numbers(id, group(id));
  std::ranges::copy(target, numbers.begin());
}

}  // namespace pliant
