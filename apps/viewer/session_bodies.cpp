// What bodies look like, which constraints and forces are switched off, and what is added to a scene.
#include <algorithm>
#include <limits>
#include <numeric>

#include "pliant/collision/colliders/builtin.h"
#include "pliant/constraints/position.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/forces/builtin.h"
#include "pliant/materials/change_material.h"
#include "pliant/simulation/held.h"
#include "pliant_io/scene/texture_file.h"
#include "viewer/added_parts.h"
#include "viewer/session.h"

namespace pliant_viewer {
namespace {

/// Throws Error(input) on what a scene file could not have.
void check(const pliant::BodyAppearance& appearance) {
  const auto is_share = [](Real share) { return share >= 0 && share <= 1; };
  const auto is_color = [&](const std::optional<pliant::Color>& color) {
    return !color || (is_share(color->red) && is_share(color->green) && is_share(color->blue));
  };
  if (!is_color(appearance.front) || !is_color(appearance.back) || !is_color(appearance.pattern_color)) {
    pliant::fail_input("red, green and blue of a color are from 0 to 1");
  }
  const auto is_size = [](Real size) { return size >= 1e-6 && size <= 1e6; };
  if (!is_size(appearance.pattern_size) || !is_size(appearance.texture_size)) {
    pliant::fail_input("the size of a pattern or a texture is from 1e-6 to 1e6 m");
  }
  if (appearance.weave && !(*appearance.weave >= 0 && *appearance.weave <= 1)) {
    pliant::fail_input("from thread to thread it is 0 to 1 m");
  }
}

/// Of the highest plane that faces up [m]; minus infinity without one.
Real floor_height(const pliant::Simulation& simulation) {
  constexpr Real nearly_up = 0.9;
  Real height = -std::numeric_limits<Real>::infinity();
  for (const auto& [id, collider] : simulation.colliders()) {
    const auto* plane = simulation.options<pliant::PlaneCollider>(id);
    if (plane == nullptr || !(plane->normal.normalized().z() > nearly_up)) continue;
    height = std::max(height, simulation.pose(id).position.z());
  }
  return height;
}

/// On earth [N].
Real weight_of(const pliant::Body& body, const pliant::Simulation& simulation) {
  const std::vector<Real>& masses = simulation.state().masses;
  const auto first = masses.begin() + body.first_vertex;
  const pliant::Gravity usual;
  return usual.acceleration.norm() * std::accumulate(first, first + body.mesh.vertex_count(), Real{0});
}

/// How often each name is given: programs may give one twice.
std::map<std::string, int> count_names(const pliant::Simulation& simulation) {
  std::map<std::string, int> counts;
  for (const auto& [id, group] : simulation.groups()) ++counts[group.name];
  for (const auto& [id, force] : simulation.forces()) ++counts[simulation.name(id)];
  for (const auto& [id, collider] : simulation.colliders()) ++counts[collider.name];
  return counts;
}

}  // namespace

pliant::BodyId Session::find_body(const std::string& name) const {
  const std::vector<pliant::Body>& bodies = simulation().bodies();
  const auto found = std::ranges::find(bodies, name, &pliant::Body::name);
  if (found == bodies.end()) pliant::fail_input("there is no body '" + pliant::printable(name) + "'");
  return pliant::BodyId{static_cast<Index>(found - bodies.begin())};
}

void Session::set_looks(const SceneChanges& changes) {
  unchanged_.set_appearances(changes, scene_);
  ++look_changes_;
}

void Session::set_appearance(const std::string& body, const pliant::BodyAppearance& appearance, bool goes_on) {
  const auto noted = note(action::SetAppearance{body, appearance, goes_on});
  const auto before = scene_.appearances.find(find_body(body));
  check(appearance);
  const bool has_texture = before != scene_.appearances.end() && before->second.texture == appearance.texture;
  if (!has_texture && !appearance.texture.empty() && !is_replaying()) pliant::check_texture_file(appearance.texture);
  Edit edit{.what = body + ": appearance", .before = changes_};
  changes_.appearances[body] = appearance;
  set_looks(changes_);
  if (goes_on && !done_.empty() && done_.back().what == edit.what && done_.back().after == edit.before) {
    done_.back().after = changes_;
    undone_.clear();
  } else {
    remember(std::move(edit));
  }
}

SwitchedOff Session::what_is_switched_off(const std::string& name) const {
  const pliant::Simulation& scene = simulation();
  const auto type_of = [&](const pliant::ParameterOwner& owner) {
    const std::vector<pliant::Parameter> parameters = list_parameters(scene, owner);
    return parameters.empty() ? std::string() : parameters.front().type;
  };
  if (unchanged_.can_switch_off(name, changes_) && count_names(scene)[name] == 1) {
    const auto id = scene.find_group(name);
    if (id && !is_hidden(*id)) {
      const pliant::Group& group = scene.groups().at(*id);
      const bool is_of_material = std::ranges::count(groups_of_material(scene, group.body), *id) > 0;
      return {.type = group.type,
              .body = scene.body(group.body).name,
              .pinned = group.type == pliant::Position::info.name ? vertices_of_pins(group) : std::vector<Index>(),
              .goes_with_material = is_of_material};
    }
    if (const auto force = scene.find_force(name)) return {.type = type_of(*force)};
    if (const auto collider = scene.find_collider(name)) return {.type = type_of(*collider), .is_collider = true};
  }
  pliant::fail_input("there is nothing called '" + pliant::printable(name) + "' that can be switched off");
}

void Session::switch_on(const std::string& name, bool on) {
  const auto noted = note(action::SwitchOn{name, on});
  SceneChanges changes = changes_;
  const std::map<std::string, SwitchedOff> all = switched_off();
  const auto off = all.find(name);
  if (on == (off == all.end())) return;
  if (on) {
    for (const Index vertex : off->second.pinned) changes.pins.erase(vertex);  // it holds them again
    if (changes.switched_off.erase(name) == 0) changes.switched_on.insert(name);
  } else {
    SwitchedOff part = what_is_switched_off(name);
    if (changes.switched_on.erase(name) == 0) changes.switched_off[name] = std::move(part);
  }
  change_parts(std::move(changes), name + (on ? " on" : " off"));
}

/// Makes the scene anew with other parts, where it is.
void Session::change_parts(SceneChanges changes, std::string what) {
  pliant::Scene next = make_with(changes, unchanged_);
  carry_into(next, changes);
  Edit edit{.what = std::move(what), .before = changes_};
  take(std::move(next));
  changes_ = std::move(changes);
  remember(std::move(edit));
}

void Session::add(const std::string& type, const std::string& body) {
  const auto noted = note(action::Add{type, body});
  if (!has_text()) pliant::fail_input("this scene was made by a program, which is the place to add something to it");
  if (!body.empty()) find_body(body);
  SceneChanges changes = changes_;
  const std::string name = unchanged_.free_name(type, changes);
  const pliant::BoundingBox box = pliant::bounding_box(simulation().state().positions);
  changes.added[name] = make_part(type, name, body, box, floor_height(simulation()));
  change_parts(std::move(changes), "add " + name);
}

void Session::push(const std::vector<Index>& vertices) {
  const auto noted = note(action::Push{vertices});
  if (!has_text()) pliant::fail_input("this scene was made by a program, which is the place to add something to it");
  std::map<pliant::BodyId, std::vector<Index>> of_bodies;
  for (const Index vertex : vertices) {
    const pliant::BodyId body = body_of(vertex);
    of_bodies[body].push_back(vertex - simulation().body(body).first_vertex);
  }
  SceneChanges changes = changes_;
  for (const auto& [id, numbers] : of_bodies) {
    const pliant::Body& body = simulation().body(id);
    const std::string name = unchanged_.free_name(std::string(pliant::TestForce::info.name), changes);
    const Real weight = weight_of(body, simulation());
    const pliant::Vec3 force(0, 0, weight / static_cast<Real>(numbers.size()));
    changes.added[name] = make_push(name, body.name, numbers, force);
  }
  if (!of_bodies.empty()) change_parts(std::move(changes), "push");
}

std::map<std::string, bool> Session::switches() const {
  std::map<std::string, bool> switches;
  for (const auto& [name, count] : count_names(simulation())) {
    const auto group = simulation().find_group(name);
    if (count > 1 || (group && is_hidden(*group))) continue;
    if (unchanged_.can_switch_off(name, changes_)) switches[name] = true;
  }
  for (const auto& [name, what] : switched_off()) switches[name] = false;
  return switches;
}

}  // namespace pliant_viewer
