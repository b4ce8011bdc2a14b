#include "viewer/scene_changes.h"

#include <algorithm>
#include <array>
#include <functional>

#include <fmt/format.h>

#include "pliant/constraints/attachment.h"
#include "pliant/constraints/position.h"
#include "pliant/materials/change_material.h"
#include "viewer/body_materials.h"
#include "viewer/carry_over.h"
#include "viewer/collider_entry.h"
#include "viewer/json_of.h"

namespace pliant_viewer {
namespace {

using pliant::Parameter;
using pliant::ParameterKind;
using pliant::SceneDocument;
using pliant::Vec3;

Json material_json(const ChangedMaterial& material) {
  Json json = {{"name", material.name}};
  json.update(json_of(material.placement));
  return json.size() == 1 ? Json(material.name) : json;
}

/// Stiffnesses, of which a row has the common factor, times that; nothing: a map that cannot be told so.
std::optional<Json> multiplied(Json given, Real factor) {
  const auto multiply = [factor](Json& number) { number = number.get<Real>() * factor; };
  if (given.is_array()) {
    std::ranges::for_each(given, multiply);
    return given;
  }
  if (!given.contains("from") || !given.contains("to")) return {};
  multiply(given["from"]);
  multiply(given["to"]);
  return given;
}

void set(SceneDocument& document, const std::string& path, const Json& value) {
  document.set(path, value.dump());
}

/// An event that acts before the first step.
void append_event(SceneDocument& document, const std::string& action, const std::string& group, const Json& more) {
  Json event = {{"step", 0}, {action, group}};
  event.update(more);
  document.append("events", event.dump());
}

}  // namespace

UnchangedScene::UnchangedScene(const pliant::Scene& scene) {
  as_read_.source = scene.source;
  as_read_.places = scene.places;
  as_read_.later_places = scene.later_places;
  as_read_.implied_bodies = scene.implied_bodies;
  as_read_.group_names = scene.group_names;
  as_read_.collider_names = scene.collider_names;
  const pliant::Simulation& simulation = scene.simulation;
  const std::vector<std::string> names = simulation.group_names();
  groups_ = {names.begin(), names.end()};
  for (const auto& [id, group] : simulation.groups()) {
    if (group.type == pliant::Position::info.name)
      pin_numbers_[group.name] = {group.points.begin(), group.points.end()};
  }
  for (const auto& [id, group] : simulation.groups()) {
    const bool is_tie = group.type == pliant::Attachment::info.name && !scene.places.contains(group.name);
    if (is_tie && std::ranges::find(scene.group_names, group.name) != scene.group_names.end()) ties_.insert(group.name);
  }
  for (const auto& [id, group] : simulation.groups()) {
    if (!group.factors.empty()) factors_[group.name] = {simulation.body(group.body).name, group.factors};
  }
  has_surfaces_ = simulation.contact().surfaces;
  appearances_ = scene.appearances;
  const auto is_read = [&](const std::string& name) {
    return scene.places.contains(name) || std::ranges::find(scene.group_names, name) != scene.group_names.end();
  };
  has_text_ = !scene.source.texts.empty() && std::ranges::all_of(groups_, is_read);
  for (const auto& [id, collider] : simulation.colliders()) has_text_ = has_text_ && is_read(collider.name);
  for (const auto& [id, force] : simulation.forces()) has_text_ = has_text_ && is_read(simulation.name(id));
  event_count_ = scene.timeline.event_count();
  for (Index i = 0; i < pliant::count_of(simulation.bodies()); ++i) {
    const pliant::Body& body = simulation.body(pliant::BodyId{i});
    BodyPart& part = bodies_.emplace_back(BodyPart{body.name, body.first_vertex, body.mesh.vertex_count(), {}, {}, {}});
    for (const pliant::GroupId id : groups_of_material(simulation, pliant::BodyId{i})) {
      const auto found = scene.places.find(simulation.groups().at(id).name);
      if (found != scene.places.end()) part.replaced.push_back(found->second);
    }
    part.pins = free_name(body.name + ".pins");
    part.moved_pins = free_name(body.name + ".moved_pins");
  }
  if (has_text_) read_disabled(scene);
}

std::string UnchangedScene::free_name(const std::string& base, const SceneChanges& changes) const {
  const auto is_taken = [&](const std::string& name) {
    return groups_.contains(name) || as_read_.places.contains(name) || as_read_.later_places.contains(name) ||
           changes.added.contains(name) ||
           std::ranges::find(as_read_.group_names, name) != as_read_.group_names.end() ||
           std::ranges::find(as_read_.collider_names, name) != as_read_.collider_names.end();
  };
  std::string name = base;
  for (int number = 2; is_taken(name); ++number) name = fmt::format("{} {}", base, number);
  return name;
}

bool UnchangedScene::is_of_hand(const std::string& group) const {
  return std::ranges::any_of(bodies_,
                             [&](const BodyPart& body) { return group == body.pins || group == body.moved_pins; });
}

/// Of a group of pins, as the scene has it at its start.
bool UnchangedScene::has_number(const std::string& group, Index number) const {
  const auto found = pin_numbers_.find(group);
  return found != pin_numbers_.end() && found->second.contains(number);
}

std::optional<std::size_t> UnchangedScene::find_body(const std::string& name) const {
  const auto found = std::ranges::find(bodies_, name, &BodyPart::name);
  if (found == bodies_.end()) return {};
  return static_cast<std::size_t>(found - bodies_.begin());
}

/// Of a group that has no place of its own.
bool UnchangedScene::is_of_material(const std::string& group, const SceneChanges& changes) const {
  if (ties_.contains(group)) return false;
  if (groups_.contains(group) || off_.contains(group)) return true;
  if (as_read_.later_places.contains(group)) return false;
  const auto is_of = [&](const auto& entry) { return group.starts_with(entry.first + "."); };
  return std::ranges::any_of(changes.materials, is_of);
}

SceneDocument UnchangedScene::with(const SceneChanges& changes, std::vector<std::string>* unwritten) const {
  if (!document_) document_.emplace(as_read_);
  SceneDocument document = *document_;
  // Whatever takes constraints out comes last: places count from the start of their list.
  write_colliders(changes, document);
  write_values(changes, document, unwritten);
  write_pins(changes, document);
  write_names(changes, document);
  write_appearances(changes, document);
  write_factors(changes, document);
  write_materials(changes, document);
  write_added(changes, document);
  write_switches(changes, document);
  for (const std::string& group : removed_by_events(changes)) append_event(document, "remove", group, Json::object());
  remove_entries(changes, document);
  return document;
}

pliant::SceneText UnchangedScene::text_with(const SceneChanges& changes) const {
  SceneChanges of_text = changes;
  for (const auto& [key, value] : factors(changes)) of_text.values.erase(key);
  const pliant::SceneText& own = as_read_.source.texts.at(0);
  return {own.name, own.folder, with(of_text).text()};
}

std::map<std::string, Vec3> UnchangedScene::factors(const SceneChanges& changes) const {
  std::map<std::string, Vec3> found;
  if (!has_text_) return found;
  if (!document_) document_.emplace(as_read_);
  for (const auto& [key, changed] : changes.values) {
    const Parameter& parameter = changed.parameter;
    const std::optional<std::string> path = path_of(parameter, changes);
    const std::string given = path ? document_->get(*path) : "";
    const bool is_factor = parameter.kind == ParameterKind::real && (given.starts_with('[') || given.starts_with('{'));
    if (is_factor || ties_.contains(parameter.name)) found[key] = changed.value;
  }
  return found;
}

void UnchangedScene::remove_events(const std::vector<std::pair<Index, std::string>>& left_out,
                                   SceneDocument& document) {
  const std::string moves = document.get("moves");
  const Index move_count = moves.empty() ? 0 : static_cast<Index>(Json::parse(moves).size());
  for (auto entry = left_out.rbegin(); entry != left_out.rend(); ++entry) {
    const Index number = entry->first;
    document.remove(number < move_count ? fmt::format("moves[{}]", number)
                                        : fmt::format("events[{}]", number - move_count));
  }
}

bool UnchangedScene::is_replaced(const std::string& place, const SceneChanges& changes) const {
  return std::ranges::any_of(bodies_, [&](const BodyPart& body) {
    return changes.materials.contains(body.name) && std::ranges::find(body.replaced, place) != body.replaced.end();
  });
}

/// Nothing where the scene has no such place.
std::optional<std::string> UnchangedScene::path_of(const Parameter& parameter, const SceneChanges& changes) const {
  const pliant::ParameterOwner& owner = parameter.handle.owner;
  const std::string& option = parameter.handle.option;
  if (std::holds_alternative<std::monostate>(owner)) return "settings." + option;
  if (std::holds_alternative<pliant::ContactOwner>(owner)) return "contact." + option;
  if (std::holds_alternative<pliant::BodyId>(owner)) {
    const auto body = find_body(parameter.name);
    if (!body) return {};
    return fmt::format("bodies[{}].contact.{}", *body, option);
  }
  const auto found = as_read_.places.find(parameter.name);
  if (found == as_read_.places.end() || is_replaced(found->second, changes)) return {};
  const bool is_vector = found->second == "gravity" && !(document_ && document_->get("gravity").starts_with('{'));
  return is_vector ? found->second : found->second + "." + option;
}

/// Names that follow from the order of a list stay when entries of it go, which those of other materials do.
void UnchangedScene::write_names(const SceneChanges& changes, SceneDocument& document) const {
  if (changes.materials.empty()) return;
  const auto write = [&](const std::string& name, const std::string& place) {
    if (document.get(place + ".name").empty()) set(document, place + ".name", name);
  };
  for (const auto& [name, place] : as_read_.places) {
    if (place.ends_with(']') && !is_replaced(place, changes)) write(name, place);
  }
  for (const auto& [name, place] : as_read_.later_places) {
    if (place.ends_with(".add")) write(name, place);
  }
}

void UnchangedScene::write_values(const SceneChanges& changes, SceneDocument& document,
                                  std::vector<std::string>* unwritten) const {
  std::map<std::string, Json> of_groups;  // that have no place, being of a material: by events
  for (const auto& [key, changed] : changes.values) {
    const Parameter& parameter = changed.parameter;
    std::optional<Json> value = value_json(parameter, changed.value);
    const std::optional<std::string> path = path_of(parameter, changes);
    if (!path) {
      if (std::holds_alternative<pliant::GroupId>(parameter.handle.owner)) {
        if (!ties_.contains(parameter.name)) {
          of_groups[parameter.name][parameter.handle.option] = *value;
        } else if (unwritten != nullptr) {
          unwritten->push_back(key);
        }
      }
      continue;
    }
    const std::string given = document.get(*path);
    const bool is_common_factor =
        parameter.kind == ParameterKind::real && (given.starts_with('[') || given.starts_with('{'));
    if (is_common_factor) value = multiplied(Json::parse(given), changed.value[0]);
    if (!value && unwritten != nullptr) unwritten->push_back(key);
    if (!value) continue;
    // With this key surfaces would touch.
    if (path->starts_with("contact.") && document.get("contact").empty())
      set(document, "contact.surfaces", has_surfaces_);
    set(document, *path, *value);
  }
  for (const auto& [group, values] : of_groups) {
    if (is_of_material(group, changes)) append_event(document, "change", group, values);
  }
}

void UnchangedScene::write_materials(const SceneChanges& changes, SceneDocument& document) const {
  for (const auto& [name, material] : changes.materials) {
    const auto body = find_body(name);
    if (!body) continue;
    const std::string place = fmt::format("bodies[{}]", *body);
    set(document, place + ".material", material_json(material));
    document.remove(place + ".mass");
    if (!changes.values.contains("contact:" + name + ".friction")) document.remove(place + ".contact.friction");
  }
}

void UnchangedScene::write_pins(const SceneChanges& changes, SceneDocument& document) const {
  const std::map<std::string, SwitchedOff> off = switched_off(changes);
  const auto is_off = [&](const std::string& group) { return off.contains(group); };
  for (std::size_t i = 0; i < bodies_.size(); ++i) {
    const BodyPart& body = bodies_[i];
    Json held = Json::array(), moved = Json::array(), targets = Json::array();
    for (const auto& [vertex, target] : changes.pins) {
      if (vertex < body.first_vertex || vertex >= body.first_vertex + body.vertex_count) continue;
      const auto released = changes.released.find(vertex);
      const bool is_of_scene = released != changes.released.end() && !is_off(released->second.groups.front());
      if (is_of_scene) continue;  // by its group
      (target ? moved : held).push_back(vertex - body.first_vertex);
      if (target) targets.push_back(json_of(without_single_precision(*target)));
    }
    const std::string list = fmt::format("bodies[{}].constraints", i);
    if (!held.empty()) {
      document.append(list, Json{{"type", "position"}, {"name", body.pins}, {"on", held}}.dump());
    }
    if (moved.empty()) continue;
    const Json pins = {{"type", "position"}, {"name", body.moved_pins}, {"stencils", moved}, {"targets", targets}};
    document.append(list, pins.dump());
  }
  std::map<std::string, Json> released;
  const auto is_there = [&](const std::string& group) { return as_read_.places.contains(group); };
  struct Moves {
    Json numbers = Json::array(), targets = Json::array();
  };
  std::map<std::string, Moves> moves;  // by group: one event each
  const auto move = [&](const std::string& group, Index number, const Vec3& target) {
    if (!has_number(group, number)) return;  // an event that names it would be left out as a whole
    moves[group].numbers.push_back(number);
    moves[group].targets.push_back(json_of(without_single_precision(target)));
  };
  for (const auto& [vertex, pin] : changes.released) {
    const auto body = std::ranges::find_if(bodies_, [v = vertex](const BodyPart& each) {
      return v >= each.first_vertex && v < each.first_vertex + each.vertex_count;
    });
    const auto again = changes.pins.find(vertex);
    if (again != changes.pins.end() && again->second) move(pin.groups.front(), pin.number, *again->second);
    if (body == bodies_.end() || again != changes.pins.end()) continue;
    for (const std::string& group : pin.groups) released[group].push_back(vertex - body->first_vertex);
  }
  for (const auto& [vertex, pin] : changes.moved) {
    if (!changes.released.contains(vertex)) move(pin.group, pin.number, pin.target);
  }
  for (auto& [group, of_group] : moves) {
    if (!is_there(group)) continue;
    const bool is_one = of_group.numbers.size() == 1;
    append_event(document, "move", group,
                 {{"index", is_one ? of_group.numbers[0] : of_group.numbers},
                  {"target", is_one ? of_group.targets[0] : of_group.targets}});
  }
  for (const auto& [group, vertices] : released) {
    if (is_there(group)) append_event(document, "release", group, {{"vertices", vertices}});
  }
}

void UnchangedScene::write_appearances(const SceneChanges& changes, SceneDocument& document) const {
  for (const auto& [name, appearance] : changes.appearances) {
    if (const auto body = find_body(name)) {
      set(document, fmt::format("bodies[{}].appearance", *body), json_of(appearance));
    }
  }
}

/// Constraints that a material takes the place of.
void UnchangedScene::remove_entries(const SceneChanges& changes, SceneDocument& document) const {
  std::map<std::string, std::set<int, std::greater<>>> numbers;  // of entries, by list: the last one goes first
  const auto add = [&](const std::string& place) {
    const std::size_t bracket = place.rfind('[');
    if (bracket != std::string::npos) numbers[place.substr(0, bracket)].insert(std::stoi(place.substr(bracket + 1)));
  };
  for (const BodyPart& body : bodies_) {
    if (changes.materials.contains(body.name)) std::ranges::for_each(body.replaced, add);
  }
  for (const auto& [list, entries] : numbers) {
    for (const int number : entries) document.remove(fmt::format("{}[{}]", list, number));
  }
}

void UnchangedScene::write_colliders(const SceneChanges& changes, SceneDocument& document) const {
  for (const auto& [name, pose] : changes.collider_poses) {
    const auto place = as_read_.places.find(name);
    if (place == as_read_.places.end()) continue;
    const std::string entry = document.get(place->second);
    if (entry.empty()) continue;
    const Json keys = pose_keys(Json::parse(entry), pose);
    for (const auto& [key, value] : keys.items()) {
      set(document, place->second + "." + key, value);
    }
  }
}

}  // namespace pliant_viewer
