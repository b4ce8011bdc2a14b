// Forces that come, change and go.
#include <algorithm>

#include "pliant/core/error.h"
#include "pliant/simulation/transaction.h"
#include "pliant/solver/solver.h"

namespace pliant {
namespace {

[[noreturn]] void fail_missing(ForceId id) {
  fail_input("force " + std::to_string(static_cast<Index>(id)) +
             " does not exist; give one that was added and not removed");
}

}  // namespace

void Simulation::check_force(const Force* force) const {
  if (force == nullptr) fail_input("force: there is none; give one");
  if (const std::optional<Index> vertex = force->vertex_out_of_range(state_.vertex_count())) {
    fail_input(std::string(force->type()) + ": vertex " + std::to_string(*vertex) +
               " is out of range; the simulation has " + std::to_string(state_.vertex_count()) + " vertices");
  }
  for (ConstraintGroup* group : force->groups()) check_group(*group, state_.vertex_count(), force->type());
  if (settings_.integrator == Integrator::bdf2) check_under_bdf2(*force);
}

void Simulation::check_under_bdf2(const Force& force) {
  if (!force.is_explicit_spring()) return;
  fail_input(
      std::string(force.type()) +
      ": an explicit spring gains energy under the integrator `bdf2`, however small the time step; use a drag, which "
      "is implicit, or the integrator `implicit_euler`");
}

ForceScope Simulation::scope(std::optional<BodyId> id) const {
  ForceScope scope;
  const auto add = [&](const Body& body) { scope.bodies.push_back({body.mesh, body.first_vertex, body.name}); };
  scope.is_whole = !id;
  if (id) {
    add(body(*id));
  } else {
    for (const Body& each : bodies_) add(each);
  }
  return scope;
}

ForceId Simulation::add_force(std::unique_ptr<Force> force, std::string name) {
  return add_force(ForceRecord{std::move(name)}, std::move(force));
}

ForceId Simulation::add_force(ForceRecord record, std::unique_ptr<Force> force) {
  check_force(force.get());
  if (record.name.empty()) {
    record.name = force->type();
    for (int i = 2; find_force(record.name); ++i) record.name = std::string(force->type()) + " " + std::to_string(i);
  }
  const ForceId id{next_force_++};
  if (transaction_ != nullptr) transaction_->save(id, std::nullopt);
  forces_have_changed(*force);
  forces_.emplace(id, std::move(force));
  force_records_.emplace(id, std::move(record));
  note_change();
  return id;
}

void Simulation::replace(ForceId id, std::unique_ptr<Force> force) {
  exchange_force(id, ForceRecord{name(id)}, std::move(force));
}

void Simulation::exchange_force(ForceId id, ForceRecord record, std::unique_ptr<Force> force) {
  check_force(force.get());
  std::unique_ptr<Force>& place = forces_.at(id);
  forces_changed_ = true;
  if (!place->exchange(*force)) {
    std::swap(place, force);
    forces_have_changed(*force);
    forces_have_changed(*place);
  }
  std::swap(force_records_.at(id), record);
  if (transaction_ != nullptr) transaction_->save(id, Transaction::SavedForce{std::move(force), std::move(record)});
  warned_forces_.erase(id);
  forces_changed_ = true;
  note_change();
}

void Simulation::remove(ForceId id) {
  const auto found = forces_.find(id);
  if (found == forces_.end()) fail_missing(id);
  forces_have_changed(*found->second);
  if (transaction_ != nullptr)
    transaction_->save(id, Transaction::SavedForce{std::move(found->second), force_records_.at(id)});
  forces_.erase(found);
  force_records_.erase(id);
  warned_forces_.erase(id);
  note_change();
}

/// To be told of a force that comes or goes.
void Simulation::forces_have_changed(const Force& force) {
  forces_changed_ = true;
  if (!force.groups().empty()) groups_changed_ = true;
}

const ForceRecord& Simulation::record(ForceId id) const {
  const auto found = force_records_.find(id);
  if (found == force_records_.end()) fail_missing(id);
  return found->second;
}

std::optional<ForceId> Simulation::find_force(std::string_view name) const {
  const auto found =
      std::ranges::find(force_records_, name, [](const auto& entry) -> std::string_view { return entry.second.name; });
  return found == force_records_.end() ? std::nullopt : std::optional(found->first);
}

void Simulation::check_forces() {
  for (const auto& [id, force] : forces_) {
    std::optional<std::string> warning =
        force->warning(state_.view(), settings_.time_step / static_cast<Real>(settings_.substeps));
    if (!warning) {
      warned_forces_.erase(id);  // to be warned of again
    } else if (warned_forces_.insert(id).second && std::ranges::find(warnings_, *warning) == warnings_.end()) {
      warnings_.push_back(*std::move(warning));
    }
  }
}

}  // namespace pliant
