// Colliders that come, move and go.
#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "pliant/simulation/transaction.h"
#include "pliant/solver/solver.h"

namespace pliant {
namespace {

[[noreturn]] void fail_no_collider(ColliderId id) {
  fail_input("collider " + std::to_string(static_cast<Index>(id)) +
             " does not exist; give one that was added and not removed");
}

bool is_sound(const Pose& pose) {
  return pose.position.allFinite() && std::abs(pose.rotation.norm() - 1) < 1e-6;
}

void check_pose(const Pose& pose, std::string_view where) {
  if (!is_sound(pose)) fail_input(std::string(where) + ": give a finite position and a rotation of length 1");
}

void check_motion(const ColliderMotion& motion, std::string_view where) {
  for (const Vec3& velocity : {motion.velocity, motion.angular_velocity, motion.surface_velocity}) {
    if (!velocity.allFinite()) fail_input(std::string(where) + ": a velocity is not finite; give finite numbers");
  }
  if (motion.friction && !(*motion.friction >= 0 && std::isfinite(*motion.friction))) {
    fail_input(std::string(where) + ": friction is out of range; give a finite number from 0");
  }
}

}  // namespace

void Colliders::check_projection(const SolverSettings& settings, bool has_colliders) {
  if (!has_colliders || !(settings.energy_projection > 0)) return;
  fail_input(
      "energy_projection: it does not know the work of contact yet; set it to 0, or remove the colliders and set "
      "contact.surfaces to false");
}

ColliderId Colliders::add_collider(std::shared_ptr<const ColliderShape> shape, const Pose& pose,
                                   const ColliderMotion& motion, std::string name) {
  if (shape == nullptr) fail_input("collider: there is no shape; give one");
  check_pose(pose, shape->type());
  check_motion(motion, shape->type());
  return add_collider({std::move(name), nullptr, std::move(shape), pose, motion});
}

ColliderId Colliders::add_collider(ColliderRecord record) {
  check_projection(settings_, true);
  if (transaction_ != nullptr) transaction_->save_colliders();
  if (record.name.empty()) {
    record.name = record.shape->type();
    for (int i = 2; find_collider(record.name); ++i) {
      record.name = std::string(record.shape->type()) + " " + std::to_string(i);
    }
  }
  const ColliderId id{next_collider_++};
  state_.contact.colliders.push_back({static_cast<Index>(id), record.pose});
  colliders_.emplace(id, std::move(record));
  colliders_changed_ = true;
  note_change();
  return id;
}

void Colliders::exchange_collider(ColliderId id, ColliderRecord record) {
  if (transaction_ != nullptr) transaction_->save_colliders();
  ColliderRecord& place = colliders_.at(id);
  if (!(record.pose == place.pose)) state_.contact.colliders[place_in_state(id)].target = record.pose;
  place = std::move(record);
  colliders_changed_ = true;
  note_change();
}

void Colliders::remove(ColliderId id) {
  collider(id);
  if (transaction_ != nullptr) transaction_->save_colliders();
  colliders_.erase(id);  // found above
  const auto number = static_cast<Index>(id);
  ContactState& contact = state_.contact;
  std::erase_if(contact.colliders, [&](const ColliderState& each) { return each.collider == number; });
  std::erase_if(contact.memory, [&](const ContactMemory& each) { return each.collider == number; });
  if (colliders_.empty() && !contact_.surfaces) contact = {};
  colliders_changed_ = true;
  note_change();
}

const ColliderRecord& Colliders::collider(ColliderId id) const {
  const auto found = colliders_.find(id);
  if (found == colliders_.end()) fail_no_collider(id);
  return found->second;
}

std::optional<ColliderId> Colliders::find_collider(std::string_view name) const {
  const auto found =
      std::ranges::find(colliders_, name, [](const auto& entry) -> std::string_view { return entry.second.name; });
  return found == colliders_.end() ? std::nullopt : std::optional(found->first);
}

/// Of a collider in the state.
std::size_t Colliders::place_in_state(ColliderId id) const {
  const auto& states = state_.contact.colliders;
  const auto found = std::ranges::find(states, static_cast<Index>(id), &ColliderState::collider);
  if (found == states.end()) fail_no_collider(id);
  return static_cast<std::size_t>(found - states.begin());
}

const Pose& Colliders::pose(ColliderId id) const {
  return state_.contact.colliders[place_in_state(id)].pose;
}

void Colliders::set_target(ColliderId id, const Pose& target) {
  const std::size_t place = place_in_state(id);
  if (!is_sound(target)) check_pose(target, "target of the collider '" + name(id) + "'");
  if (transaction_ != nullptr) transaction_->save_colliders();
  state_.contact.colliders[place].target = target;
}

void Colliders::clear_target(ColliderId id) {
  const std::size_t place = place_in_state(id);
  if (transaction_ != nullptr) transaction_->save_colliders();
  state_.contact.colliders[place].target.reset();
}

const std::optional<Pose>& Colliders::target(ColliderId id) const {
  return state_.contact.colliders[place_in_state(id)].target;
}

void Colliders::set_contact(const ContactSettings& settings) {
  check_options("contact", settings);
  check_projection(settings_, settings.surfaces || !colliders_.empty());
  if (!settings.surfaces && !(state_.contact.pairs.empty() && state_.contact.let_go.is_empty())) {
    if (transaction_ != nullptr) transaction_->save_colliders();
    state_.contact.pairs.clear();
    state_.contact.let_go = {};
  }
  contact_ = settings;
  colliders_changed_ = true;
  surfaces_changed_ = true;
  note_change();
}

void Colliders::check_let_go(const LetGoState& let_go) const {
  const auto check = [](bool is_right, const std::string& what) {
    if (!is_right) fail_input("restore: " + what + "; give a state that state() has returned");
  };
  const auto is_vertex = [&](Index vertex) { return vertex >= 0 && vertex < state_.vertex_count(); };
  check(std::ranges::is_sorted(let_go.pairs, {}, &LetGoVertices::vertices), "what is let go is not in order");
  for (const auto& [vertices, is_held_up] : let_go.pairs) {
    check(std::ranges::all_of(vertices, is_vertex), "a vertex is let go that there is not");
  }
  const auto key = [](const ReducedDistance& each) { return std::pair{each.vertex, each.body}; };
  check(std::ranges::is_sorted(let_go.reduced, {}, key), "the reduced distances are not in order");
  for (const ReducedDistance& each : let_go.reduced) {
    const bool is_body = each.body >= 0 && each.body < count_of(bodies_);
    check(is_vertex(each.vertex) && is_body, "a distance is reduced of a vertex or from a body that there is not");
    check(each.share > 0 && each.share < 1, "a share of a distance is not between 0 and 1");
  }
  check(std::ranges::is_sorted(let_go.held_up, {}, &HeldUpVertex::vertex), "the vertices held up are not in order");
  for (const auto& [vertex, substeps] : let_go.held_up) {
    check(is_vertex(vertex) && substeps > 0, "a vertex is held up that there is not");
  }
}

/// Refuses what is not of this simulation.
void Colliders::check_contact(const ContactState& contact) const {
  const auto fail = [](const std::string& what) {
    fail_input("restore: " + what + "; give a state that state() has returned");
  };
  if (!std::ranges::equal(contact.colliders, colliders_, {}, &ColliderState::collider,
                          [](const auto& entry) { return static_cast<Index>(entry.first); })) {
    fail("its colliders are others");
  }
  for (const ColliderState& each : contact.colliders) {
    check_pose(each.pose, "restore: collider");
    if (each.target) check_pose(*each.target, "restore: collider");
  }
  const auto key = [](const ContactMemory& each) { return std::pair{each.vertex, each.collider}; };
  if (!std::ranges::is_sorted(contact.memory, {}, key)) fail("the contacts are not in order");
  for (const ContactMemory& each : contact.memory) {
    const bool is_known =
        each.vertex >= 0 && each.vertex < state_.vertex_count() && colliders_.contains(ColliderId{each.collider});
    if (!is_known) fail("a contact is of a vertex or a collider that there is not");
    if (!each.anchor.allFinite() || !(each.load >= 0 && std::isfinite(each.load))) fail("a contact is not finite");
  }
  const auto key_of_pair = [](const PairMemory& each) { return std::tuple{each.kind, each.features}; };
  if (!std::ranges::is_sorted(contact.pairs, {}, key_of_pair)) fail("the pairs of surfaces are not in order");
  for (const PairMemory& each : contact.pairs) {
    if (each.kind > PairKind::vertex_edge || each.features[0] < 0 || each.features[1] < 0) fail("a pair is none");
    if (!each.slide.allFinite()) fail("a pair of surfaces is not finite");
  }
  check_let_go(contact.let_go);
  const auto fits = [&](const std::vector<Real>& numbers, Real least) {
    const auto is_in_range = [least](Real number) { return number >= least && std::isfinite(number); };
    return (numbers.empty() || numbers.size() == state_.masses.size()) && std::ranges::all_of(numbers, is_in_range);
  };
  if (!fits(contact.stiffening, 1)) fail("a stiffness of contacts is out of range");
  if (!fits(contact.energies, std::numeric_limits<Real>::lowest())) fail("an energy of contact is not finite");
  if (!fits(contact.in_factor, 0)) fail("what the factor has of contact is out of range");
}

}  // namespace pliant
