#include "viewer/copied_scene.h"

#include <algorithm>
#include <memory>
#include <utility>

#include "pliant/core/error.h"

namespace pliant_viewer {
namespace {

using pliant::Parameter;
using pliant::Scene;
using pliant::Simulation;

bool have_same_parameters(const Simulation& a, const Simulation& b) {
  const auto is_same = [](const Parameter& one, const Parameter& other) {
    return one.handle == other.handle && one.name == other.name && one.type == other.type && one.value == other.value;
  };
  return std::ranges::equal(list_parameters(a), list_parameters(b), is_same);
}

/// Targets, rest lengths and whatever else constraints keep.
bool have_same_constraint_numbers(const Simulation& a, const Simulation& b) {
  const auto is_same_batch = [](const auto& one, const auto& other) {
    return std::ranges::equal(one->parameters(), other->parameters()) &&
           std::ranges::equal(one->targets(), other->targets());
  };
  return std::ranges::equal(a.groups(), b.groups(), [&](const auto& one, const auto& other) {
    return one.first == other.first &&
           std::ranges::equal(one.second.set.batches, other.second.set.batches, is_same_batch);
  });
}

bool have_same_state(const pliant::State& a, const pliant::State& b) {
  const auto is_same_place = [](const pliant::ColliderState& one, const pliant::ColliderState& other) {
    return one.collider == other.collider && one.pose == other.pose && one.target == other.target;
  };
  return a.step == b.step && a.masses == b.masses && a.positions.rows() == b.positions.rows() &&
         a.positions == b.positions && a.velocities == b.velocities &&
         std::ranges::equal(a.contact.colliders, b.contact.colliders, is_same_place);
}

/// Whether it is what its text says.
bool is_as_read(const Scene& scene) {
  if (scene.source.texts.empty() || scene.simulation.state().step > 0) return false;
  const Scene read = parse_scene(scene.source);
  const Simulation &now = scene.simulation, &then = read.simulation;
  return have_same_state(now.state(), then.state()) && now.group_names() == then.group_names() &&
         now.forces().size() == then.forces().size() && have_same_parameters(now, then) &&
         have_same_constraint_numbers(now, then) && scene.timeline.event_count() == read.timeline.event_count();
}

/// All but what it was read from.
Scene copy_of(const Scene& scene) {
  Scene copy;
  copy.name = scene.name;
  copy.description = scene.description;
  copy.steps = scene.steps;
  copy.output = scene.output;
  copy.view = scene.view;
  copy.simulation = scene.simulation.copy();
  copy.timeline = scene.timeline;
  copy.files = scene.files;
  copy.materials = scene.materials;
  copy.appearances = scene.appearances;
  copy.own_materials = scene.own_materials;
  copy.group_names = scene.group_names;
  copy.collider_names = scene.collider_names;
  copy.has_surfaces = scene.has_surfaces;
  copy.places = scene.places;
  copy.later_places = scene.later_places;
  copy.implied_bodies = scene.implied_bodies;
  copy.left_out = scene.left_out;
  copy.warnings = scene.warnings;
  return copy;
}

MakeScene read_again(Scene scene) {
  return [source = scene.source, name = scene.name, view = scene.view, appearances = scene.appearances,
          first = std::make_shared<std::optional<Scene>>(std::move(scene))] {
    if (first->has_value()) return std::move(*std::exchange(*first, std::nullopt));
    Scene again = parse_scene(source);
    again.name = name;
    again.view = view;
    again.appearances = appearances;
    return again;
  };
}

}  // namespace

MakeScene maker_of(Scene scene, bool is_program) {
  if (!is_program && is_as_read(scene)) return read_again(std::move(scene));
  scene.source = {};
  std::shared_ptr<Scene> at_start;
  std::string reason;
  try {
    at_start = std::make_shared<Scene>(copy_of(scene));
  } catch (const pliant::Error& error) {
    reason = error.what();
  }
  return [at_start, reason, first = std::make_shared<std::optional<Scene>>(std::move(scene))] {
    if (first->has_value()) return std::move(*std::exchange(*first, std::nullopt));
    if (at_start == nullptr) pliant::fail_input("this cannot start over: " + reason);
    return copy_of(*at_start);
  };
}

}  // namespace pliant_viewer
