#include "pliant/simulation/transaction.h"

#include <algorithm>

#include "pliant/solver/solver.h"

namespace pliant {

Transaction::Transaction(Simulation& simulation)
    : simulation_(simulation),
      outer_(simulation.transaction_),
      settings_(simulation.settings_),
      body_count_(simulation.bodies_.size()),
      warning_count_(simulation.warnings_.size()),
      warned_forces_(simulation.warned_forces_),
      next_group_(simulation.next_group_),
      next_force_(simulation.next_force_),
      next_collider_(simulation.next_collider_),
      changed_step_(simulation.state_.changed_step),
      contact_settings_(simulation.contact_) {
  simulation_.transaction_ = this;
}

Transaction::~Transaction() {
  simulation_.transaction_ = outer_;
  if (!is_committed_) {
    roll_back();
  } else if (outer_ != nullptr) {
    merge_into(*outer_);
  }
}

void Transaction::save_numbers(GroupId id, const Group& group) {
  if (groups_.contains(id) || numbers_.contains(id)) return;
  Numbers numbers;
  for (const auto& batch : group.set.batches) {
    numbers.stiffnesses.push_back(batch->stiffness());
    numbers.points.emplace_back(batch->targets().begin(), batch->targets().end());
  }
  numbers_.emplace(id, std::move(numbers));
}

void Transaction::save(GroupId id, std::optional<Group> group) {
  groups_.emplace(id, std::move(group));  // the first one counts
}

void Transaction::save(ForceId id, std::optional<SavedForce> force) {
  forces_.emplace(id, std::move(force));
}

void Transaction::save_state() {
  if (!state_) state_ = simulation_.state_;
}

/// With where they are, and what contact remembers of them.
void Transaction::save_colliders() {
  if (!colliders_) colliders_ = simulation_.colliders_;
  if (!state_ && !contact_) contact_ = simulation_.state_.contact;
}

void Transaction::save_body_contacts() {
  if (body_contacts_) return;
  body_contacts_.emplace();
  for (const Body& body : simulation_.bodies_) body_contacts_->push_back(body.contact);
}

/// Of the bodies that there were when it began. True where one touches otherwise than now.
bool Transaction::roll_back_bodies() {
  Simulation& s = simulation_;
  const bool has_changed = body_count_ != s.bodies_.size() || body_contacts_ || s.contact_ != contact_settings_;
  s.bodies_.resize(body_count_);
  if (s.edge_distances_.size() > body_count_) s.edge_distances_.resize(body_count_);
  for (std::size_t i = 0; body_contacts_ && i < body_count_; ++i) {
    s.bodies_[i].contact = std::move((*body_contacts_)[i]);
  }
  s.contact_ = contact_settings_;
  return has_changed;
}

void Transaction::roll_back() {
  Simulation& s = simulation_;
  for (auto& [id, group] : groups_) {
    if (group && group->other) s.colliders_changed_ = s.surfaces_changed_ = true;
    if (const auto now = s.groups_.find(id); now != s.groups_.end()) {
      if (now->second.other) s.colliders_changed_ = s.surfaces_changed_ = true;
      s.group_index_.remove(id, now->second);
      s.groups_.erase(now);
    }
    if (!group) continue;
    const auto placed = s.groups_.emplace(id, std::move(*group));
    s.group_index_.add(id, placed.first->second);
  }
  for (const auto& [id, numbers] : numbers_) {
    const auto& batches = s.groups_.at(id).set.batches;
    for (std::size_t i = 0; i < batches.size(); ++i) {
      batches[i]->set_stiffness(numbers.stiffnesses[i]);
      std::ranges::copy(numbers.points[i], batches[i]->targets().begin());
    }
  }
  for (auto& [id, saved] : forces_) {
    if (const auto now = s.forces_.find(id); now != s.forces_.end()) s.forces_have_changed(*now->second);
    s.forces_.erase(id);
    s.force_records_.erase(id);
    if (!saved) continue;
    s.forces_have_changed(*saved->force);
    s.forces_.emplace(id, std::move(saved->force));
    s.force_records_.emplace(id, std::move(saved->record));
  }
  if (state_) {
    if (state_->masses != s.state_.masses) s.masses_changed_ = true;
    s.state_ = *std::move(state_);
    s.solver_->forget_prediction();
  }
  if (contact_) s.state_.contact = *std::move(contact_);
  if (colliders_) s.colliders_ = *std::move(colliders_);
  if (!groups_.empty() || body_count_ != s.bodies_.size()) s.groups_changed_ = true;
  if (colliders_) s.colliders_changed_ = true;
  if (roll_back_bodies()) s.colliders_changed_ = s.surfaces_changed_ = true;
  s.next_collider_ = next_collider_;
  s.state_.changed_step = changed_step_;
  if (!forces_.empty()) s.forces_changed_ = true;
  if (s.settings_ != settings_) s.solver_->set_settings(settings_);
  s.settings_ = settings_;
  s.warned_forces_ = std::move(warned_forces_);
  s.warnings_.resize(warning_count_);
  s.next_group_ = next_group_;
  s.next_force_ = next_force_;
}

void Transaction::merge_into(Transaction& outer) {
  if (contact_ && !outer.contact_ && !outer.state_) outer.contact_ = std::move(contact_);
  if (colliders_ && !outer.colliders_) outer.colliders_ = std::move(colliders_);
  if (body_contacts_ && !outer.body_contacts_) outer.body_contacts_ = std::move(body_contacts_);
  if (state_ && !outer.state_) outer.state_ = std::move(state_);
  for (auto& [id, numbers] : numbers_) {
    if (!outer.groups_.contains(id)) outer.numbers_.emplace(id, std::move(numbers));
  }
  outer.groups_.merge(groups_);
  outer.forces_.merge(forces_);
}

}  // namespace pliant
