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

bool are_same(pliant::ConstraintGroup& a, pliant::ConstraintGroup& b) {
  return std::ranges::equal(a.stencil(), b.stencil()) && std::ranges::equal(a.reduction(), b.reduction()) &&
         std::ranges::equal(a.rest_measure(), b.rest_measure()) &&
         std::ranges::equal(a.pinned_vertices(), b.pinned_vertices()) &&
         std::ranges::equal(a.parameters(), b.parameters()) && std::ranges::equal(a.targets(), b.targets());
}

bool have_same_constraints(const Simulation& a, const Simulation& b) {
  return std::ranges::equal(a.groups(), b.groups(), [](const auto& one, const auto& other) {
    return one.first == other.first &&
           std::ranges::equal(one.second.set.batches, other.second.set.batches,
                              [](const auto& x, const auto& y) { return are_same(*x, *y); });
  });
}

/// On the same bodies, and doing the same now.
bool have_same_forces(const Simulation& a, const Simulation& b) {
  const auto force_of = [](const Simulation& simulation, pliant::ForceId id) {
    pliant::Positions sum = pliant::Positions::Zero(simulation.state().vertex_count(), 3);
    const std::unique_ptr<pliant::Force> copy = simulation.forces().at(id)->copy();
    if (copy != nullptr) copy->add_to(sum, simulation.state().view(), simulation.settings().time_step);
    return sum;
  };
  return std::ranges::equal(a.forces(), b.forces(), [&](const auto& one, const auto& other) {
    return one.first == other.first && a.record(one.first).body == b.record(other.first).body &&
           force_of(a, one.first) == force_of(b, other.first);
  });
}

bool have_same_contacts(const Simulation& a, const Simulation& b) {
  return std::ranges::equal(a.bodies(), b.bodies(), [](const pliant::Body& one, const pliant::Body& other) {
    return one.name == other.name && one.contact.ignores == other.contact.ignores;
  });
}

/// What is to come, and what is under way: animated bodies are from the start.
bool have_same_plans(const pliant::Timeline& a, const pliant::Timeline& b) {
  const pliant::TimelineState one = a.state(), other = b.state();
  const auto is_same_motion = [](const auto& x, const auto& y) { return x.event == y.event && x.order == y.order; };
  return a.event_count() == b.event_count() && one.applied == other.applied &&
         std::ranges::equal(one.motions, other.motions, is_same_motion) &&
         one.collider_motions.size() == other.collider_motions.size() && one.ramps.size() == other.ramps.size();
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
         have_same_parameters(now, then) && have_same_constraints(now, then) && have_same_forces(now, then) &&
         have_same_contacts(now, then) && have_same_plans(scene.timeline, read.timeline);
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
  copy.collider_appearances = scene.collider_appearances;
  copy.own_materials = scene.own_materials;
  copy.group_names = scene.group_names;
  copy.collider_names = scene.collider_names;
  copy.has_surfaces = scene.has_surfaces;
  copy.places = scene.places;
  copy.later_places = scene.later_places;
  copy.implied_bodies = scene.implied_bodies;
  copy.left_out = scene.left_out;
  copy.disabled = scene.disabled;
  copy.idle_events = scene.idle_events;
  copy.warnings = scene.warnings;
  return copy;
}

/// What a program may change of a scene without a change of its text, beside the scene that was read from that.
void take_run(const Scene& from, Scene& to) {
  to.name = from.name;
  to.description = from.description;
  to.steps = from.steps;
  to.output = from.output;
  to.view = from.view;
  to.appearances = from.appearances;
  to.collider_appearances = from.collider_appearances;
}

}  // namespace

Remaker remaker_of(const Scene& scene, bool is_program) {
  std::string reason;
  try {
    if (!is_program && is_as_read(scene)) {
      auto run = std::make_shared<Scene>();
      take_run(scene, *run);
      const auto make = [source = scene.source, run] {
        Scene again = parse_scene(source);
        take_run(*run, again);
        return again;
      };
      return {make, true};
    }
  } catch (const std::exception&) {  // its files have gone or changed
  }
  try {
    return {[start = std::make_shared<Scene>(copy_of(scene))] { return copy_of(*start); }, false};
  } catch (const std::exception& error) {
    reason = error.what();
  }
  return {[reason]() -> Scene { pliant::fail_input("this cannot start over: " + reason); }, false};
}

MakeScene maker_of(Scene scene, Remaker again) {
  if (!again.reads_text) scene.source = {};
  const auto first = std::make_shared<std::optional<Scene>>(std::move(scene));
  return [first, again = std::move(again.make)] {
    if (first->has_value()) return std::move(*std::exchange(*first, std::nullopt));
    return again();
  };
}

}  // namespace pliant_viewer
