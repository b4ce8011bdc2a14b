#include "pliant/simulation/undo.h"

#include <algorithm>

#include "pliant/solver/solver.h"

namespace pliant {

Undo::Undo(Simulation& simulation)
    : simulation_(simulation),
      outer_(simulation.undo_),
      settings_(simulation.settings_),
      body_count_(simulation.bodies_.size()),
      warning_count_(simulation.warnings_.size()),
      warned_forces_(simulation.warned_forces_),
      next_group_(simulation.next_group_),
      next_force_(simulation.next_force_) {
  simulation_.undo_ = this;
}

Undo::~Undo() {
  simulation_.undo_ = outer_;
  if (!is_kept_) {
    take_back();
  } else if (outer_ != nullptr) {
    hand_on(*outer_);
  }
}

void Undo::save_numbers(GroupId id, const Group& group) {
  if (groups_.contains(id) || numbers_.contains(id)) return;
  Numbers numbers;
  for (const auto& part : group.set.parts) {
    numbers.stiffnesses.push_back(part->stiffness());
    numbers.points.emplace_back(part->targets().begin(), part->targets().end());
  }
  numbers_.emplace(id, std::move(numbers));
}

void Undo::save(GroupId id, std::optional<Group> group) {
  groups_.emplace(id, std::move(group));  // the first one counts
}

void Undo::save(ForceId id, std::optional<SavedForce> force) {
  forces_.emplace(id, std::move(force));
}

void Undo::save_state() {
  if (!state_) state_ = simulation_.state_;
}

void Undo::take_back() {
  Simulation& s = simulation_;
  for (auto& [id, group] : groups_) {
    if (const auto now = s.groups_.find(id); now != s.groups_.end()) {
      s.group_index_.remove(id, now->second);
      s.groups_.erase(now);
    }
    if (!group) continue;
    const auto placed = s.groups_.emplace(id, std::move(*group));
    s.group_index_.add(id, placed.first->second);
  }
  for (const auto& [id, numbers] : numbers_) {
    const auto& parts = s.groups_.at(id).set.parts;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      parts[i]->set_stiffness(numbers.stiffnesses[i]);
      std::ranges::copy(numbers.points[i], parts[i]->targets().begin());
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
    s.state_ = *std::move(state_);
    s.solver_->forget_prediction();
  }
  if (!groups_.empty() || body_count_ != s.bodies_.size()) s.groups_changed_ = true;
  if (!forces_.empty()) s.forces_changed_ = true;
  s.bodies_.resize(body_count_);
  if (s.settings_ != settings_) s.solver_->set_settings(settings_);
  s.settings_ = settings_;
  s.warned_forces_ = std::move(warned_forces_);
  s.warnings_.resize(warning_count_);
  s.next_group_ = next_group_;
  s.next_force_ = next_force_;
}

void Undo::hand_on(Undo& outer) {
  if (state_ && !outer.state_) outer.state_ = std::move(state_);
  for (auto& [id, numbers] : numbers_) {
    if (!outer.groups_.contains(id)) outer.numbers_.emplace(id, std::move(numbers));
  }
  outer.groups_.merge(groups_);
  outer.forces_.merge(forces_);
}

}  // namespace pliant
