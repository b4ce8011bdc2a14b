// What bodies look like, and which of their constraints and which forces are switched off.
#include <algorithm>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/materials/change_material.h"
#include "viewer/session.h"

namespace pliant_viewer {

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
  find_body(body);
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

void Session::switch_on(const std::string& name, bool on) {
  const auto noted = note(action::SwitchOn{name, on});
  SceneChanges changes = changes_;
  const auto group = simulation().find_group(name);
  const auto force = simulation().find_force(name);
  if (on ? changes.switched_off.erase(name) == 0 : changes.switched_off.contains(name)) return;
  if (!on) {
    const bool is_group = group && !is_hidden(*group);
    if (!(is_group || force) || !unchanged_.can_switch_off(name, changes)) {
      pliant::fail_input("there is no constraint or force '" + pliant::printable(name) + "' that can be switched off");
    }
    SwitchedOff& off = changes.switched_off[name];
    if (is_group) {
      const pliant::Group& given = simulation().groups().at(*group);
      const auto of_material = groups_of_material(simulation(), given.body);
      off = {given.type, simulation().body(given.body).name, std::ranges::count(of_material, *group) > 0};
    } else if (const auto parameters = list_parameters(simulation(), *force); !parameters.empty()) {
      off.type = parameters.front().type;
    }
  }
  pliant::Scene next = make_with(changes, unchanged_);
  carry_into(next, changes);
  Edit edit{.what = name + (on ? " on" : " off"), .before = changes_};
  take(std::move(next));
  changes_ = std::move(changes);
  remember(std::move(edit));
}

std::map<std::string, bool> Session::switches() const {
  std::map<std::string, bool> switches;
  const auto add = [&](const std::string& name) {
    if (unchanged_.can_switch_off(name, changes_)) switches[name] = true;
  };
  for (const auto& [id, group] : simulation().groups()) {
    if (!is_hidden(id)) add(group.name);
  }
  for (const auto& [id, force] : simulation().forces()) add(simulation().name(id));
  for (const auto& [name, what] : changes_.switched_off) switches[name] = false;
  return switches;
}

}  // namespace pliant_viewer
