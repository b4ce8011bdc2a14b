// Forces that come, change and go.
#include <algorithm>

#include "pliant/core/error.h"
#include "pliant/mesh/geometry.h"
#include "pliant/simulation/undo.h"
#include "pliant/solver/solver.h"

namespace pliant {
namespace {

[[noreturn]] void fail_missing(ForceId id) {
  fail_input("force " + std::to_string(static_cast<Index>(id)) +
             " does not exist; give one that was added and not removed");
}

/// Triangles of bodies with the indices of the simulation, and their areas at rest.
struct Sails {
  std::vector<Triangle> triangles;
  std::vector<Real> areas;

  void add(const Body& body) {
    for (const Triangle& t : body.mesh.triangles) {
      triangles.push_back({body.first_vertex + t[0], body.first_vertex + t[1], body.first_vertex + t[2]});
    }
    const std::vector<Real> more = triangle_areas(body.mesh.vertices, body.mesh.triangles);
    areas.insert(areas.end(), more.begin(), more.end());
  }
};

}  // namespace

void Simulation::check_force(const Force* force) const {
  if (force == nullptr) fail_input("force: there is none; give one");
  if (const std::optional<Index> vertex = force->vertex_out_of_range(state_.vertex_count())) {
    fail_input(std::string(force->type()) + ": vertex " + std::to_string(*vertex) +
               " is out of range; the simulation has " + std::to_string(state_.vertex_count()) + " vertices");
  }
  if (settings_.integrator == Integrator::bdf2) check_under_bdf2(*force);
}

void Simulation::check_under_bdf2(const Force& force) {
  if (!force.is_explicit_spring()) return;
  fail_input(
      std::string(force.type()) +
      ": an explicit spring gains energy under the integrator `bdf2`, however small the time step; use a drag, which "
      "is implicit, or the integrator `implicit_euler`");
}

ForceId Simulation::add_force(std::unique_ptr<Force> force, std::string name) {
  check_force(force.get());
  if (name.empty()) {
    name = force->type();
    for (int i = 2; find_force(name); ++i) name = std::string(force->type()) + " " + std::to_string(i);
  }
  const ForceId id{next_force_++};
  if (undo_ != nullptr) undo_->save(id, std::nullopt);
  forces_.emplace(id, std::move(force));
  force_names_.emplace(id, std::move(name));
  forces_changed_ = true;
  return id;
}

std::unique_ptr<Force> Simulation::make_wind(const WindOptions& options) const {
  Sails sails;
  for (const Body& body : bodies_) sails.add(body);
  return std::make_unique<Wind>(std::move(sails.triangles), std::move(sails.areas), options);
}

std::unique_ptr<Force> Simulation::make_wind(BodyId id, const WindOptions& options) const {
  Sails sails;
  sails.add(body(id));
  return std::make_unique<Wind>(std::move(sails.triangles), std::move(sails.areas), options);
}

ForceId Simulation::add_wind(const WindOptions& options, std::string name) {
  return add_force(make_wind(options), std::move(name));
}

ForceId Simulation::add_wind(BodyId id, const WindOptions& options, std::string name) {
  return add_force(make_wind(id, options), std::move(name));
}

void Simulation::replace(ForceId id, std::unique_ptr<Force> force) {
  check_force(force.get());
  const auto found = forces_.find(id);
  if (found == forces_.end()) fail_missing(id);
  std::swap(found->second, force);
  if (undo_ != nullptr) undo_->save(id, Undo::NamedForce{std::move(force), force_names_.at(id)});
  warned_forces_.erase(id);
  forces_changed_ = true;
}

void Simulation::remove(ForceId id) {
  const auto found = forces_.find(id);
  if (found == forces_.end()) fail_missing(id);
  if (undo_ != nullptr) undo_->save(id, Undo::NamedForce{std::move(found->second), force_names_.at(id)});
  forces_.erase(found);
  force_names_.erase(id);
  warned_forces_.erase(id);
  forces_changed_ = true;
}

const std::string& Simulation::name(ForceId id) const {
  const auto found = force_names_.find(id);
  if (found == force_names_.end()) fail_missing(id);
  return found->second;
}

std::optional<ForceId> Simulation::find_force(std::string_view name) const {
  const auto found =
      std::ranges::find(force_names_, name, [](const auto& entry) -> std::string_view { return entry.second; });
  return found == force_names_.end() ? std::nullopt : std::optional(found->first);
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
