// Events are read in the order in which they act, since each may refer to what the ones before it leave.
#include <algorithm>

#include "pliant/simulation/held.h"
#include "pliant/simulation/transaction.h"
#include "pliant_io/scene/detail/due_order.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/read_motion.h"
#include "pliant_io/scene/detail/read_release.h"
#include "pliant_io/scene/detail/scene_reader.h"

namespace pliant {
namespace {

using Keys = std::vector<std::string_view>;

// What edits of a scene look up when they act: a program may have changed the simulation since.

GroupId find_group(const Simulation& simulation, const std::string& name) {
  const std::optional<GroupId> found = simulation.find_group(name);
  if (!found) fail_input(fmt::format("the group '{}' no longer exists; add it before", printable(name)));
  return *found;
}

ForceId find_force(const Simulation& simulation, const std::string& name) {
  const std::optional<ForceId> found = simulation.find_force(name);
  if (!found) fail_input(fmt::format("the force '{}' no longer exists; add it before", printable(name)));
  return *found;
}

ColliderId find_collider(const Simulation& simulation, const std::string& name) {
  const std::optional<ColliderId> found = simulation.find_collider(name);
  if (!found) fail_input(fmt::format("the collider '{}' no longer exists; add it before", printable(name)));
  return *found;
}

/// Reads one event as what it does, and keeps the reader's names as the event leaves them.
class EventReader {
 public:
  EventReader(SceneReader& scene, const Node& node) : scene_(scene), node_(node) {}

  Timeline::Edit read();
  Timeline::Edit read_short_move();
  /// Whether it acts on what is switched off, and so on nothing.
  bool is_idle() const { return is_idle_; }
  /// To be called once the event has acted.
  void check_added() const;

 private:
  struct Action {
    std::string_view key;
    Timeline::Edit (EventReader::*read)(const Node& value);
    bool acts_on_one;  // a group, a force or a collider, which the value names
  };
  static const std::array<Action, 10> actions;

  Timeline::Edit read_change(const Node& name);
  Timeline::Edit read_group_change(const std::string& name, GroupEntry& entry);
  Timeline::Edit read_force_change(const std::string& name, ForceEntry& entry);
  Timeline::Edit read_collider_change(const std::string& name, ColliderOptions& options);
  Timeline::Edit read_settings(const Node& value);
  Timeline::Edit read_contact(const Node& value);
  Timeline::Edit read_body_contact(const Node& value, BodyId body);
  Timeline::Edit read_gravity(const Node& value);
  Timeline::Edit read_add(const Node& value);
  Timeline::Edit read_remove(const Node& name);
  Timeline::Edit read_release(const Node& name);
  Timeline::Edit read_move(const Node& name);
  Timeline::Edit read_follow(const Node& name);
  Timeline::Edit read_stop(const Node& name);
  /// Whether what is moved is a collider, else a group; refuses a name that neither has.
  bool is_collider(const Node& name) const;
  /// The same, and refuses keys that only groups have.
  bool require_moved(const Node& name) const;
  Timeline::Edit start(const Node& name, EventPath path);

  Keys keys(std::string_view action, Keys more = {}) const {
    more.insert(more.end(), {"step", "time", action});
    return more;
  }
  std::string text_of(const Node& name) const {
    std::string text;
    pliant::read(name, text);
    return text;
  }
  [[noreturn]] void fail_unknown(const Node& name) const;
  bool names_what_is_off(const Node& name);

  SceneReader& scene_;
  Node node_;
  std::string added_group_;
  bool is_idle_ = false;
};

void do_nothing(Simulation&, Timeline&) {}

const std::array<EventReader::Action, 10> EventReader::actions = {{
    {"change", &EventReader::read_change, true},
    {"settings", &EventReader::read_settings, false},
    {"contact", &EventReader::read_contact, false},
    {"gravity", &EventReader::read_gravity, false},
    {"add", &EventReader::read_add, false},
    {"remove", &EventReader::read_remove, true},
    {"release", &EventReader::read_release, true},
    {"move", &EventReader::read_move, true},
    {"follow", &EventReader::read_follow, true},
    {"stop", &EventReader::read_stop, true},
}};

Timeline::Edit EventReader::read() {
  Keys names;
  for (const Action& action : actions) names.push_back(action.key);
  const std::string_view key = node_.require_one_of(names);
  const auto found = std::ranges::find(actions, key, &Action::key);
  const Node value = node_.require(key);
  if (found->acts_on_one && names_what_is_off(value)) {
    if (key == "remove") scene_.off.erase(std::string(value.text()));  // the name is free from then on
    return do_nothing;
  }
  return (this->*found->read)(value);
}

bool EventReader::names_what_is_off(const Node& name) {
  is_idle_ = name.is_text() && scene_.off.contains(name.text());
  return is_idle_;
}

void EventReader::fail_unknown(const Node& node) const {
  const std::string name = text_of(node);
  Keys names;
  for (const auto& [known, entry] : scene_.groups) names.push_back(known);
  for (const auto& [known, entry] : scene_.forces) names.push_back(known);
  for (const auto& [known, entry] : scene_.colliders) names.push_back(known);
  node.fail(fmt::format("no group, force or collider is called '{}' then; {}", printable(name),
                        suggestion_text(name, names)));
}

Timeline::Edit EventReader::read_change(const Node& node) {
  const std::string name = text_of(node);
  if (const auto group = scene_.groups.find(name); group != scene_.groups.end()) {
    return read_group_change(name, group->second);
  }
  if (const auto collider = scene_.colliders.find(name); collider != scene_.colliders.end()) {
    return read_collider_change(name, collider->second);
  }
  const auto force = scene_.forces.find(name);
  if (force == scene_.forces.end()) fail_unknown(node);
  return read_force_change(name, force->second);
}

Timeline::Edit EventReader::read_group_change(const std::string& name, GroupEntry& entry) {
  RampOptions ramp;
  Keys known = keys("change");
  RampOptions::visit(ramp, [&](const OptionInfo& info, const auto&) { known.push_back(info.name); });
  RampOptions::visit(ramp, OptionReader{node_});
  node_.locate([&] { check_options("change", ramp); });
  const bool was_single = !stiffness_of(entry.options).each();
  read_changed_options(node_, known, scene_.body(entry.body), entry.options);
  if (node_.size() <= 2) node_.fail("nothing is changed; give an option of the group with its new value");

  // Options other than the stiffness want the group made anew.
  const bool has_stiffness = node_.has("stiffness");
  const auto ramp_keys = static_cast<std::size_t>(node_.has("over")) + static_cast<std::size_t>(node_.has("ease"));
  const bool is_single = !stiffness_of(entry.options).each();
  const bool has_others = node_.size() > 2 + static_cast<std::size_t>(has_stiffness) + ramp_keys;
  const bool is_factor =
      has_stiffness && was_single && is_single && scene_.simulation.stiffness(find_group(scene_.simulation, name));
  const bool is_ramp = node_.has("over") && ramp.over > 0;
  if (ramp_keys > 0 && !is_factor) {
    node_.fail(
        "'over' and 'ease' lead from one stiffness for all to another; give such a 'stiffness', or leave them out");
  }
  const bool is_renewed = has_others || (has_stiffness && !is_factor);
  const Anchors anchors = node_.has("targets") || node_.has("origin") ? Anchors::given : Anchors::kept;
  return [=, options = entry.options](Simulation& simulation, Timeline& timeline) {
    const GroupId group = find_group(simulation, name);
    const std::optional<Real> before = simulation.stiffness(group);
    if (is_renewed) replace(simulation, group, options, anchors);
    if (is_renewed && before && (!has_stiffness || is_ramp) && simulation.stiffness(group)) {
      simulation.set_stiffness(group, *before);
    }
    if (!has_stiffness) return;
    timeline.stop_ramp(group);
    if (is_ramp) {
      timeline.ramp_stiffness(simulation, group, stiffness_of(options)[0], ramp.over, ramp.ease);
    } else if (is_factor) {
      simulation.set_stiffness(group, stiffness_of(options)[0]);
    }
  };
}

Timeline::Edit EventReader::read_force_change(const std::string& name, ForceEntry& entry) {
  read_changed_force(node_, keys("change"), scene_, entry);
  if (node_.size() <= 2) node_.fail("nothing is changed; give an option of the force with its new value");
  return [name, force = entry](Simulation& simulation, Timeline&) {
    replace(simulation, find_force(simulation, name), force);
  };
}

Timeline::Edit EventReader::read_collider_change(const std::string& name, ColliderOptions& options) {
  read_changed_collider(node_, keys("change"), options);
  if (node_.size() <= 2) node_.fail("nothing is changed; give an option of the collider with its new value");
  return [name, changed = options](Simulation& simulation, Timeline&) {
    replace(simulation, find_collider(simulation, name), changed);
  };
}

/// Some of the options of settings, to be put over others.
template <class Settings>
class SomeSettings {
 public:
  explicit SomeSettings(const Node& node, Keys more_keys = {}) {
    read_options(node, given_, more_keys);
    Settings::visit(given_, [&](const OptionInfo& info, const auto&) {
      if (node.has(info.name)) names_.emplace_back(info.name);
    });
    const bool has_more = std::ranges::any_of(more_keys, [&](std::string_view key) { return node.has(key); });
    if (names_.empty() && !has_more) node.fail("no setting is given; name one with its new value");
  }

  Settings over(Settings settings) const {
    Settings::visit(settings, [&]<class Option>(const OptionInfo& info, Option& option) {
      if (std::ranges::find(names_, info.name) == names_.end()) return;
      Settings::visit(given_, [&]<class Other>(const OptionInfo& other_info, const Other& other) {
        if constexpr (std::is_same_v<Option, Other>) {
          if (info.name == other_info.name) option = other;
        }
      });
    });
    return settings;
  }

 private:
  Settings given_;
  std::vector<std::string> names_;
};

Timeline::Edit EventReader::read_settings(const Node& value) {
  node_.check_keys(keys("settings"));
  return [some = SomeSettings<SolverSettings>(value)](Simulation& simulation, Timeline&) {
    simulation.set_settings(some.over(simulation.settings()));
  };
}

Timeline::Edit EventReader::read_contact(const Node& value) {
  node_.check_keys(keys("contact", {"body"}));
  if (const auto body = node_.find("body")) return read_body_contact(value, scene_.named_body(*body));
  const SomeSettings<ContactSettings> some(value);
  scene_.has_later_surfaces |= some.over(scene_.simulation.contact()).surfaces;
  return [some](Simulation& simulation, Timeline&) { simulation.set_contact(some.over(simulation.contact())); };
}

Timeline::Edit EventReader::read_body_contact(const Node& value, BodyId body) {
  std::optional<std::vector<BodyId>> ignored;
  if (const auto names = value.find("ignores")) ignored = scene_.read_ignored(*names, body);
  return [some = SomeSettings<BodyContact>(value, {"ignores"}), ignored, body](Simulation& simulation, Timeline&) {
    BodyContact contact = some.over(simulation.contact(body));
    if (ignored) contact.ignores = *ignored;
    simulation.set_contact(body, contact);
  };
}

Timeline::Edit EventReader::read_gravity(const Node& value) {
  node_.check_keys(keys("gravity"));
  const std::string name(Gravity::info.name);
  if (value.is_null()) {
    scene_.forces.erase(name);
    return [name](Simulation& simulation, Timeline&) {
      if (const auto force = simulation.find_force(name)) simulation.remove(*force);
    };
  }
  Gravity gravity;
  pliant::read(value, gravity.acceleration);
  scene_.forces.insert_or_assign(name, ForceEntry{std::nullopt, gravity});
  scene_.later_places[name] = scene_.entry;
  return [name, gravity](Simulation& simulation, Timeline&) {
    if (const auto force = simulation.find_force(name)) {
      simulation.replace(*force, gravity);
    } else {
      simulation.add(gravity, name);
    }
  };
}

Timeline::Edit EventReader::read_add(const Node& value) {
  node_.check_keys(keys("add"));
  scene_.entry += ".add";
  const Node type = value.require("type");
  if (is_force_type(text_of(type))) {
    const ForceEntry force = read_force_options(value, {}, scene_);
    const std::string name = scene_.own_name(value, type_of(force));
    scene_.forces.emplace(name, force);
    scene_.later_places[name] = scene_.entry;
    return [name, force](Simulation& simulation, Timeline&) { add(simulation, force, name); };
  }
  if (is_collider_type(text_of(type))) {
    const ColliderOptions collider = read_collider_options(value);
    const std::string name = scene_.own_name(value, type_of(collider));
    scene_.read_collider_appearance(value, name);
    scene_.colliders.emplace(name, collider);
    scene_.later_colliders.push_back(name);
    scene_.later_places[name] = scene_.entry;
    return [name, collider](Simulation& simulation, Timeline&) { add(simulation, collider, name); };
  }
  const GroupEntry entry = scene_.read_added_group(value);
  added_group_ = scene_.group_name(value, entry.body, type_of(entry.options));
  scene_.groups.emplace(added_group_, entry);
  scene_.later_groups.push_back(added_group_);
  scene_.later_places[added_group_] = scene_.entry;
  return [name = added_group_, entry](Simulation& simulation, Timeline&) {
    add(simulation, entry.body, entry.options, name);
  };
}

void EventReader::check_added() const {
  if (added_group_.empty()) return;
  const GroupId group = scene_.simulation.find_group(added_group_).value();
  check_constraints(node_.require("add"), scene_.simulation.groups().at(group).set);
}

Timeline::Edit EventReader::read_remove(const Node& node) {
  node_.check_keys(keys("remove"));
  const std::string name = text_of(node);
  if (scene_.groups.erase(name) > 0) {
    return [name](Simulation& simulation, Timeline&) { simulation.remove(find_group(simulation, name)); };
  }
  if (scene_.colliders.erase(name) > 0) {
    return [name](Simulation& simulation, Timeline&) { simulation.remove(find_collider(simulation, name)); };
  }
  if (scene_.forces.erase(name) == 0) fail_unknown(node);
  return [name](Simulation& simulation, Timeline&) { simulation.remove(find_force(simulation, name)); };
}

Timeline::Edit EventReader::read_release(const Node& node) {
  node_.check_keys(keys("release", {"vertices", "index"}));
  GroupEntry& entry = scene_.group(node);
  const std::string name = text_of(node);
  auto* options = std::get_if<Position>(&entry.options);
  if (options == nullptr) {
    node.fail(fmt::format("'{}' is a group of type {}; only positions can be released: remove the group, or change it",
                          printable(name), type_of(entry.options)));
  }
  const Group& group = scene_.simulation.groups().at(find_group(scene_.simulation, name));
  std::vector<Index> pinned = vertices_of_pins(group);
  for (Index& vertex : pinned) vertex -= scene_.simulation.body(group.body).first_vertex;
  const std::string_view key = node_.require_one_of({"vertices", "index"});
  const std::vector<Index> released = key == "vertices"
                                          ? read_released(node_.require(key), scene_.body(entry.body), pinned)
                                          : read_released_numbers(node_.require(key), group, pinned);
  leave_out(released, pinned, *options);
  return [name, released](Simulation& simulation, Timeline&) {
    simulation.release(find_group(simulation, name), released);
  };
}

bool EventReader::is_collider(const Node& node) const {
  const std::string name = text_of(node);
  if (scene_.colliders.empty() || scene_.groups.contains(name)) return false;
  if (scene_.colliders.contains(name)) return true;
  Keys names;
  for (const auto& [known, entry] : scene_.groups) names.push_back(known);
  for (const auto& [known, entry] : scene_.colliders) names.push_back(known);
  node.fail(fmt::format("unknown group or collider '{}'; {}", printable(name), suggestion_text(name, names)));
}

Timeline::Edit EventReader::start(const Node& node, EventPath path) {
  const std::string name = text_of(node);
  if (!is_collider(node)) {
    return [name, path = std::move(path)](Simulation& simulation, Timeline& timeline) {
      timeline.start(simulation, find_group(simulation, name), path.path, path.index);
    };
  }
  for (const char* key : {"target", "offset"}) {
    const auto points = node_.find(key);
    if (points && (*points)[0].is_list()) points->fail("a collider goes to one point; give [x, y, z]");
  }
  return [name, path = path.path](Simulation& simulation, Timeline& timeline) {
    timeline.start(simulation, find_collider(simulation, name), path);
  };
}

bool EventReader::require_moved(const Node& node) const {
  if (!is_collider(node)) {
    scene_.group(node);
    return false;
  }
  if (const auto index = node_.find("index")) {
    index->fail("a collider has no constraints, it moves as a whole; leave out 'index'");
  }
  return true;
}

Timeline::Edit EventReader::read_move(const Node& node) {
  require_moved(node);
  return start(node, pliant::read_move(node_, keys("move")));
}

Timeline::Edit EventReader::read_short_move() {
  const Node moved = node_.require("group");
  if (names_what_is_off(moved)) return do_nothing;
  require_moved(moved);
  return start(moved, pliant::read_move(node_, keys("group")));
}

Timeline::Edit EventReader::read_follow(const Node& node) {
  require_moved(node);
  return start(node, pliant::read_follow(node_, keys("follow"), scene_));
}

Timeline::Edit EventReader::read_stop(const Node& node) {
  node_.check_keys(keys("stop", {"index"}));
  if (require_moved(node)) {
    return [name = text_of(node)](Simulation& simulation, Timeline& timeline) {
      timeline.stop(simulation, find_collider(simulation, name));
    };
  }
  ConstraintNumbers numbers;
  read_optional(node_, "index", numbers);
  return [name = text_of(node), numbers](Simulation& simulation, Timeline& timeline) {
    timeline.stop(simulation, find_group(simulation, name), numbers);
  };
}

}  // namespace

void SceneReader::read_events(const Node& root) {
  struct Entry {
    Node node;
    std::string name;
    std::string place;
    bool is_short;
  };
  std::vector<Entry> entries;
  DueOrder order;
  for (const std::string_view key : {"moves", "events"}) {
    const std::optional<Node> list = root.find(key);
    if (!list) continue;
    list->require_list();
    const SourcePlace place = list->place();
    for (std::size_t i = 0; i < list->size(); ++i) {
      const Node node = (*list)[i];
      const std::string path = node.has_own_place() ? node.place().path : fmt::format("{}[{}]", place.path, i);
      entries.push_back(
          {node, fmt::format("{}: {}", node.origin().name, path), fmt::format("{}[{}]", key, i), key == "moves"});
      order.add(node);
    }
  }
  std::vector<Timeline::Edit> edits(entries.size());
  {
    const Transaction transaction(simulation);
    Timeline rehearsal;
    for (std::vector<Index> due; !(due = order.next(simulation.settings().time_step)).empty();) {
      for (const Index event : due) {
        const auto i = static_cast<std::size_t>(event);
        const Node& node = entries[i].node;
        entry = entries[i].place;
        try {
          EventReader reader(*this, node);
          edits[i] = entries[i].is_short ? reader.read_short_move() : reader.read();
          node.locate([&] { edits[i](simulation, rehearsal); });
          reader.check_added();
          if (reader.is_idle()) idle_events.push_back(event);
        } catch (const Error& error) {
          if (left_out == nullptr || error.kind() != ErrorKind::input) throw;
          edits[i] = nullptr;
          left_out->emplace_back(event, error.what());
        }
      }
    }
  }
  if (left_out != nullptr) std::ranges::sort(*left_out);
  std::ranges::sort(idle_events);
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (edits[i] == nullptr) continue;
    timeline.add(order.when(i), std::move(edits[i]), std::move(entries[i].name));
  }
}

}  // namespace pliant
