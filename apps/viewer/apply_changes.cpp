// Changes of a scene that a program has made, which has no text.
#include <algorithm>

#include "pliant/constraints/position.h"
#include "pliant/simulation/held.h"
#include "viewer/body_materials.h"
#include "viewer/carry_over.h"
#include "viewer/scene_changes.h"

namespace pliant_viewer {

using pliant::Vec3;

namespace {

/// The groups of pins of a name that hold a vertex of the simulation; a program may give a name more than once.
std::vector<pliant::GroupId> holders(const pliant::Simulation& simulation, const std::string& name, Index vertex) {
  std::vector<pliant::GroupId> found;
  for (const auto& [id, group] : simulation.groups()) {
    if (group.name != name || group.type != pliant::Position::info.name) continue;
    if (std::ranges::count(vertices_of_pins(group), vertex) > 0) found.push_back(id);
  }
  return found;
}

void move_pins(const SceneChanges& changes, pliant::Simulation& simulation) {
  for (const auto& [vertex, pin] : changes.moved) {
    for (const pliant::GroupId group : holders(simulation, pin.group, vertex)) {
      const std::vector<Index> held = vertices_of_pins(simulation.groups().at(group));
      simulation.set_target(group, static_cast<Index>(std::ranges::find(held, vertex) - held.begin()), pin.target);
    }
  }
}

void move_colliders(const SceneChanges& changes, pliant::Simulation& simulation) {
  for (const auto& [name, pose] : changes.collider_poses) {
    if (const auto collider = simulation.find_collider(name)) simulation.set_target(*collider, pose);
  }
}

}  // namespace

void UnchangedScene::apply(const SceneChanges& changes, pliant::Scene& scene) const {
  pliant::Simulation& simulation = scene.simulation;
  for (const auto& [name, material] : changes.materials) {
    if (const auto body = find_body(name)) {
      change_material(scene, pliant::BodyId{static_cast<Index>(*body)}, material.name, material.placement);
    }
  }
  for (const auto& [name, what] : changes.switched_off) {
    if (const auto group = simulation.find_group(name); group && !what.body.empty()) simulation.remove(*group);
    const bool is_force = what.body.empty() && !what.is_collider;
    if (const auto force = simulation.find_force(name); force && is_force) simulation.remove(*force);
    if (const auto collider = simulation.find_collider(name); collider && what.is_collider)
      simulation.remove(*collider);
  }
  std::map<std::string, Vec3> values;
  for (const auto& [key, changed] : changes.values) values[key] = changed.value;
  set_values(std::move(values), simulation);
  for (const auto& [name, painted] : changes.painted) {
    const auto group = group_of_body(simulation, name, painted.body);
    const auto body = find_body(painted.body);
    const bool fits = body && (painted.factors.empty() ||
                               painted.factors.size() == static_cast<std::size_t>(bodies_[*body].vertex_count));
    if (group && fits) simulation.set_stiffness_factors(*group, painted.factors);
  }
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyPart& body = bodies_[i];
    const pliant::BodyId id{static_cast<Index>(i)};
    for (const auto& [vertex, pin] : changes.released) {
      const Index of_body = vertex - body.first_vertex;
      if (of_body < 0 || of_body >= body.vertex_count) continue;
      for (const std::string& group : pin.groups) {
        for (const pliant::GroupId holder : holders(simulation, group, vertex)) {
          simulation.release(holder, std::span(&of_body, 1));
        }
      }
    }
    std::vector<Index> held, moved;
    std::vector<Vec3> targets;
    for (const auto& [vertex, target] : changes.pins) {
      const Index of_body = vertex - body.first_vertex;
      if (of_body < 0 || of_body >= body.vertex_count) continue;
      (target ? moved : held).push_back(of_body);
      if (target) targets.push_back(*target);
    }
    if (!held.empty()) simulation.add(id, pliant::Position{.on = pliant::Selection(std::move(held))}, body.pins);
    if (moved.empty()) continue;
    pliant::Position pin;
    pin.on = pliant::Selection(std::move(moved));
    pin.targets = pliant::Points(std::move(targets));
    simulation.add(id, pin, body.moved_pins);
  }
  move_pins(changes, simulation);
  move_colliders(changes, simulation);
}

void UnchangedScene::set_appearances(const SceneChanges& changes, pliant::Scene& scene) const {
  scene.appearances = appearances_;
  for (const auto& [name, appearance] : changes.appearances) {
    if (const auto body = find_body(name)) {
      scene.appearances[pliant::BodyId{static_cast<Index>(*body)}] = appearance;
    }
  }
}

}  // namespace pliant_viewer
