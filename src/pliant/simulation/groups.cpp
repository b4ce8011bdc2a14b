// Constraint groups that come, change and go.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pliant/constraints/position.h"
#include "pliant/core/error.h"
#include "pliant/simulation/transaction.h"
#include "pliant/solver/passing_groups.h"

namespace pliant {

void check_stiffness_factors(std::span<const Real> factors, const std::string& place) {
  for (std::size_t i = 0; i < factors.size(); ++i) {
    if (factors[i] > 0 && std::isfinite(factors[i])) continue;
    fail_input(fmt::format("{}: the factor of the stiffness at vertex {} is {}; give a finite number above 0", place, i,
                           factors[i]));
  }
}

namespace {

/// Constraints that the set has in a batch, hard pins included.
std::size_t count_of(const ConstraintGroup& batch) {
  const std::size_t pinned = batch.pinned_vertices().size();
  return pinned > 0 ? pinned : batch.rest_measure().size();
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

/// One for each of the constraints that stay, where there is one for each.
template <class List>
List those_of(const List& given, std::span<const Index> stays) {
  auto list = given.list();
  list.clear();
  for (const Index i : stays) list.push_back(given[i]);
  return List(std::move(list));
}

/// The options of the positions that stay, given their places among all and their stencils within the body.
Position with_rest(const Position& given, std::span<const Index> stays, const Stencils& stencils) {
  Position rest = given;
  rest.on = stencils.empty() ? Selection(std::vector<Index>{}) : Selection();
  rest.stencils = stencils;
  if (given.stiffness.each() && !given.stiffness.of_vertices()) rest.stiffness = those_of(given.stiffness, stays);
  if (given.targets.each()) rest.targets = those_of(given.targets, stays);
  return rest;
}

/// "stretch on body 'cloth'".
std::string place_of(const Group& group, const Body& body) {
  return group.name + " on body '" + body.name + "'";
}

/// The mean of the factors over the vertices of each constraint of a batch; none where one is not on the body.
std::vector<Real> means_of(const std::vector<Real>& factors, const ConstraintGroup& batch, Index first_vertex) {
  const auto n = static_cast<std::size_t>(batch.shape().vertices);
  std::vector<Real> means(batch.rest_measure().size());
  for (std::size_t i = 0; i < means.size(); ++i) {
    for (const Index vertex : batch.stencil().subspan(i * n, n)) {
      const auto place = static_cast<std::size_t>(vertex - first_vertex);
      if (vertex < first_vertex || place >= factors.size()) return {};
      means[i] += factors[place];
    }
    means[i] /= static_cast<Real>(n);  // exactly 1 of ones
  }
  return means;
}

/// Of a group that was just made: multiplies its stiffnesses by its factors.
void scale(Group& made, const Body& body) {
  if (made.factors.empty()) return;
  for (const auto& batch : made.set.batches) {
    const std::vector<Real> means = means_of(made.factors, *batch, body.first_vertex);
    if (!batch->scale_measures(means)) {
      fail_input(place_of(made, body) + ": its type '" + std::string(batch->type()) +
                 "' takes no factors of the stiffness; override own_measures() in it, and keep to its body");
    }
    const auto is_sound = [](Real measure) { return measure > 0 && std::isfinite(measure); };
    if (!std::ranges::all_of(batch->rest_measure(), is_sound)) {
      fail_input(place_of(made, body) + ": the factors of the stiffness are too large or too small for it");
    }
  }
  if (std::ranges::all_of(made.factors, [](Real factor) { return factor == 1; })) made.factors.clear();
}

/// What may have changed of constraints since they were made, for the same ones made again.
void keep_numbers(const ConstraintSet& from, ConstraintSet& to) {
  if (from.batches.size() != to.batches.size()) return;
  for (std::size_t i = 0; i < to.batches.size(); ++i) {
    if (to.batches[i]->shape().count > 0) to.batches[i]->set_stiffness(from.batches[i]->stiffness());
    const std::span<Real> before = from.batches[i]->parameters(), now = to.batches[i]->parameters();
    if (before.size() == now.size()) std::ranges::copy(before, now.begin());
  }
}

void check_factors(const std::vector<Real>& factors, const Group& group, const Body& body) {
  const std::string place = place_of(group, body);
  if (group.other) fail_input(place + ": ties between bodies take no factors of the stiffness");
  if (!factors.empty() && factors.size() != static_cast<std::size_t>(body.mesh.vertex_count())) {
    fail_input(place + ": " + std::to_string(factors.size()) + " factors of the stiffness for " +
               std::to_string(body.mesh.vertex_count()) + " vertices; give one for each");
  }
  check_stiffness_factors(factors, place);
}

bool is_late_pin(const ConstraintGroup& batch) {
  return batch.is_beside_factor() && !batch.comes_and_goes();
}

/// Pins that come while the simulation runs cost no factorization so, as far as there is room beside those of the other
/// groups; what stands there from the start is in the factor.
void put_pins_beside_factor(Group& group, const std::map<GroupId, Group>& groups, std::optional<GroupId> but) {
  if (group.type != Position::info.name) return;
  std::int64_t rows = 0;
  for (const auto& batch : group.set.batches) rows += rows_beside_factor(*batch);
  for (const auto& [id, other] : groups) {
    for (const auto& batch : other.set.batches) {
      if (id != but && is_late_pin(*batch)) rows += rows_beside_factor(*batch);
    }
  }
  if (rows > most_rows_of_pins) return;
  for (const auto& batch : group.set.batches) batch->set_beside_factor(true);
}

/// The vertices that a group pins, ascending.
std::vector<Index> sorted_pins(const ConstraintGroup& group) {
  std::vector<Index> pinned(group.pinned_vertices().begin(), group.pinned_vertices().end());
  std::ranges::sort(pinned);
  return pinned;
}

}  // namespace

Values with_factor(const Values& given, Real factor) {
  if (!given.each()) return factor;
  if (factor == 1) return given;
  std::vector<Real> list = given.list();
  for (Real& number : list) number *= factor;
  return given.of_vertices() ? Values::of_vertices(std::move(list)) : Values(std::move(list));
}

GroupId Simulation::add_set(BodyId id, ConstraintSet set, std::string type, std::string name) {
  return add_group({std::move(name), std::move(type), id, nullptr, std::move(set)});
}

GroupId Simulation::add_group(Group added) {
  if (added.name.empty()) added.name = added.type;
  check_group_of(added, std::nullopt);
  warn_of(added);
  const GroupId id{next_group_++};
  if (transaction_ != nullptr) transaction_->save(id, std::nullopt);
  if (state_.step > 0) put_pins_beside_factor(added, groups_, std::nullopt);
  added.points = new_points(added.set);
  added.next_point = static_cast<Index>(added.points.size());
  const auto placed = groups_.emplace(id, std::move(added));
  group_index_.add(id, placed.first->second);
  groups_changed_ = true;
  note_change();
  if (placed.first->second.other) join_anew();
  return id;
}

/// Refuses constraints that do not keep to their shape, and a vertex that is pinned twice: it can be at one place only.
void Simulation::check_group_of(const Group& added, std::optional<GroupId> replaced) const {
  const std::string place = place_of(added, body(added.body));
  for (const auto& batch : added.set.batches) {
    if (!batch) fail_input(place + ": a batch of its constraints is null; leave it out");
    check_group(*batch, state_.vertex_count(), place);
    const std::vector<Index> pinned = sorted_pins(*batch);
    const auto twice = std::ranges::adjacent_find(pinned);
    if (twice != pinned.end()) {
      fail_input(place + ": vertex " + std::to_string(*twice) + " is pinned twice; leave one out");
    }
    for (const Index vertex : pinned) {
      const std::optional<GroupId> holder = group_index_.holder(vertex);
      if (!holder || holder == replaced) continue;
      fail_input(place + ": vertex " + std::to_string(vertex) + " is already pinned by '" + group(*holder).name +
                 "'; leave it out of one of the two");
    }
  }
}

void Simulation::warn_of(const Group& added) {
  const std::string place = place_of(added, body(added.body));
  const ConstraintSet& set = added.set;
  if (set.count == 0 && set.skipped == 0) {
    warnings_.push_back(place + ": makes no constraint; does the selection hold whole elements?");
  }
  if (set.skipped > 0) {
    warnings_.push_back(place + ": left out at " + std::to_string(set.skipped) + " " + set.skipped_reason);
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
  if (found->second.other) join_anew();
  if (transaction_ != nullptr) transaction_->save(id, std::move(found->second));
  groups_.erase(found);
  groups_changed_ = true;
  note_change();
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
  replace_group(id, {old.name, std::move(type), old.body, nullptr, std::move(set)}, anchors);
}

void Simulation::replace_group(GroupId id, Group renewed, Anchors anchors, bool warns) {
  const Group& old = group(id);
  if (renewed.factors.empty() && !renewed.other) renewed.factors = old.factors;
  check_group_of(renewed, id);
  scale(renewed, body(renewed.body));
  std::multimap<Identity, Anchored> olds = anchors_of(old);
  renewed.next_point = old.next_point;
  std::vector<Index>& points = renewed.points;
  for (const auto& batch : renewed.set.batches) {
    const std::size_t end_of_batch = points.size() + batch->targets().size() / 3;
    for (std::size_t i = 0; i < count_of(*batch); ++i) {
      const std::span<Real> anchor = batch->anchor(static_cast<Index>(i));
      if (anchor.empty()) break;
      const auto same = olds.find(identity(*batch, i));
      if (same != olds.end() && anchors == Anchors::kept) std::ranges::copy(same->second.anchor, anchor.begin());
      const bool has_number = same != olds.end() && same->second.number.has_value();
      if (points.size() < end_of_batch) points.push_back(has_number ? *same->second.number : renewed.next_point++);
      if (same != olds.end()) olds.erase(same);
    }
    while (points.size() < end_of_batch) points.push_back(renewed.next_point++);
  }
  if (warns) warn_of(renewed);
  exchange_group(id, std::move(renewed));
}

void Simulation::release(GroupId id, std::span<const Index> vertices) {
  const Group& old = group(id);
  std::vector<Index> released;
  for (const Index v : vertices) released.push_back(vertex(old.body, v));
  Group rest{old.name, old.type, old.body, nullptr, pliant::release(old.set, released), {}, old.next_point};
  rest.factors = old.factors;
  std::ranges::sort(released);
  std::vector<Index> stays;  // places of constraints
  Stencils stencils;         // of the body
  Index place = 0;
  for (const auto& batch : old.set.batches) {
    for (std::size_t i = 0; i < count_of(*batch); ++i, ++place) {
      const Index vertex = identity(*batch, i).first[0];
      if (std::ranges::binary_search(released, vertex)) continue;
      stays.push_back(place);
      stencils.add({vertex - body(old.body).first_vertex});
      rest.points.push_back(old.points[static_cast<std::size_t>(place)]);
    }
  }
  if (const auto* given = options_in<Position>(old)) rest.source = source_of(with_rest(*given, stays, stencils));
  exchange_group(id, std::move(rest));
}

void Simulation::exchange_group(GroupId id, Group renewed) {
  Group& group = groups_.at(id);
  const bool was_late = std::ranges::any_of(group.set.batches, [](const auto& batch) { return is_late_pin(*batch); });
  const bool was_empty = group.set.batches.empty() && state_.step > 0;
  if (was_late || was_empty) put_pins_beside_factor(renewed, groups_, id);
  group_index_.remove(id, group);
  if (group.other || renewed.other) join_anew();
  if (transaction_ != nullptr) transaction_->save(id, std::move(group));
  group = std::move(renewed);
  group_index_.add(id, group);
  groups_changed_ = true;
  note_change();
}

void Simulation::set_stiffness(GroupId id, Real stiffness) {
  const Group& owner = group(id);
  const std::optional<Real> before = this->stiffness(id);
  if (!before) fail_input("group '" + owner.name + "' has no stiffness; hard pins have none");
  if (transaction_ != nullptr) transaction_->save_numbers(id, owner);
  for (const auto& batch : owner.set.batches) {
    if (batch->shape().count > 0) batch->set_stiffness(stiffness);
  }
  if (stiffness != *before) note_change();
}

void Simulation::set_stiffness_factors(GroupId id, std::vector<Real> factors) {
  const Group& owner = group(id);
  check_factors(factors, owner, body(owner.body));
  if (owner.source == nullptr) {
    fail_input(place_of(owner, body(owner.body)) + ": constraints that were made elsewhere take no factors of the " +
               "stiffness; make them with those");
  }
  const auto see = [this](BodyId body) { return view(body); };
  std::optional<Group> renewed = owner.source->make_group(owner.body, owner.name, see);
  keep_numbers(owner.set, renewed->set);
  if (factors.empty()) factors.assign(static_cast<std::size_t>(body(owner.body).mesh.vertex_count()), 1);
  renewed->factors = std::move(factors);
  replace_group(id, *std::move(renewed), Anchors::kept, false);
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
