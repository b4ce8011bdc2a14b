// A simulation twice.
#include "pliant/core/error.h"
#include "pliant/simulation/simulation.h"
#include "pliant/solver/solver.h"

namespace pliant {
namespace {

[[noreturn]] void fail_without_copy(const std::string& what, std::string_view type) {
  fail_input(what + ": its type '" + std::string(type) +
             "' cannot be copied; override copy() in it, or make a second simulation as the first was made");
}

Group copy_of(const Group& group) {
  Group copy{group.name,   group.type,       group.body,  group.source, {},
             group.points, group.next_point, group.other, group.factors};
  copy.set.count = group.set.count;
  copy.set.skipped = group.set.skipped;
  copy.set.skipped_reason = group.set.skipped_reason;
  for (const auto& batch : group.set.batches) {
    copy.set.batches.push_back(batch->copy());
    if (copy.set.batches.back() == nullptr) fail_without_copy("group '" + group.name + "'", batch->type());
  }
  return copy;
}

}  // namespace

Simulation Simulation::copy() const {
  Simulation copy(settings_);
  static_cast<Colliders&>(copy) = *this;
  copy.transaction_ = nullptr;
  copy.colliders_changed_ = copy.surfaces_changed_ = true;
  for (const auto& [id, group] : groups_) copy.groups_.emplace(id, copy_of(group));
  copy.group_index_ = group_index_;
  for (const auto& [id, force] : forces_) {
    copy.forces_.emplace(id, force->copy());
    if (copy.forces_.at(id) == nullptr) fail_without_copy("force '" + name(id) + "'", force->type());
  }
  copy.force_records_ = force_records_;
  copy.warnings_ = warnings_;
  copy.warned_forces_ = warned_forces_;
  copy.next_group_ = next_group_;
  copy.next_force_ = next_force_;
  return copy;
}

}  // namespace pliant
