// Events are read in the order in which they act, since each may refer to what the ones before it leave.
#include <algorithm>
#include <cmath>

#include "pliant/simulation/transaction.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/read_motion.h"
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

/// Reads one event as what it does, and keeps the reader's names as the event leaves them.
class EventReader {
 public:
  EventReader(SceneReader& scene, const Node& node) : scene_(scene), node_(node) {}

  Timeline::Edit read();
  Timeline::Edit read_short_move();
  /// To be called once the event has acted.
  void check_added() const;

 private:
  struct Action {
    std::string_view key;
    Timeline::Edit (EventReader::*read)(const Node& value);
  };
  static const std::array<Action, 9> actions;

  Timeline::Edit read_change(const Node& name);
  Timeline::Edit read_group_change(const std::string& name, GroupEntry& entry);
  Timeline::Edit read_force_change(const std::string& name, ForceEntry& entry);
  Timeline::Edit read_settings(const Node& value);
  Timeline::Edit read_gravity(const Node& value);
  Timeline::Edit read_add(const Node& value);
  Timeline::Edit read_remove(const Node& name);
  Timeline::Edit read_release(const Node& name);
  Timeline::Edit read_move(const Node& name);
  Timeline::Edit read_follow(const Node& name);
  Timeline::Edit read_stop(const Node& name);
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

  SceneReader& scene_;
  Node node_;
  std::string added_group_;
};

const std::array<EventReader::Action, 9> EventReader::actions = {{
    {"change", &EventReader::read_change},
    {"settings", &EventReader::read_settings},
    {"gravity", &EventReader::read_gravity},
    {"add", &EventReader::read_add},
    {"remove", &EventReader::read_remove},
    {"release", &EventReader::read_release},
    {"move", &EventReader::read_move},
    {"follow", &EventReader::read_follow},
    {"stop", &EventReader::read_stop},
}};

Timeline::Edit EventReader::read() {
  Keys names;
  for (const Action& action : actions) names.push_back(action.key);
  const std::string_view key = node_.require_one_of(names);
  const auto found = std::ranges::find(actions, key, &Action::key);
  return (this->*found->read)(node_.require(key));
}

void EventReader::fail_unknown(const Node& node) const {
  const std::string name = text_of(node);
  Keys names;
  for (const auto& [known, entry] : scene_.groups) names.push_back(known);
  for (const auto& [known, entry] : scene_.forces) names.push_back(known);
  node.fail(
      fmt::format("no group and no force is called '{}' then; {}", printable(name), suggestion_text(name, names)));
}

Timeline::Edit EventReader::read_change(const Node& node) {
  const std::string name = text_of(node);
  if (const auto group = scene_.groups.find(name); group != scene_.groups.end()) {
    return read_group_change(name, group->second);
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

/// Copies the options whose names are listed.
void copy_options(const std::vector<std::string>& names, const SolverSettings& from, SolverSettings& to) {
  SolverSettings::visit(to, [&]<class Option>(const OptionInfo& info, Option& option) {
    if (std::ranges::find(names, info.name) == names.end()) return;
    SolverSettings::visit(from, [&]<class Other>(const OptionInfo& other_info, const Other& other) {
      if constexpr (std::is_same_v<Option, Other>) {
        if (info.name == other_info.name) option = other;
      }
    });
  });
}

Timeline::Edit EventReader::read_settings(const Node& value) {
  node_.check_keys(keys("settings"));
  SolverSettings given;
  read_options(value, given);
  std::vector<std::string> names;
  SolverSettings::visit(given, [&](const OptionInfo& info, const auto&) {
    if (value.has(info.name)) names.emplace_back(info.name);
  });
  if (names.empty()) value.fail("no setting is given; name one with its new value");
  return [given, names](Simulation& simulation, Timeline&) {
    SolverSettings settings = simulation.settings();
    copy_options(names, given, settings);
    simulation.set_settings(settings);
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
  const Node type = value.require("type");
  if (is_force_type(text_of(type))) {
    const ForceEntry force = read_force_options(value, {}, scene_);
    const std::string name = scene_.force_name(value, type_of(force));
    scene_.forces.emplace(name, force);
    return [name, force](Simulation& simulation, Timeline&) { add(simulation, force, name); };
  }
  const BodyId body = scene_.read_body_name(value);
  ConstraintOptions options = read_constraint_options(value, {"name", "body"}, scene_.body(body));
  added_group_ = scene_.group_name(value, body, type_of(options));
  scene_.groups.emplace(added_group_, GroupEntry{body, options});
  scene_.later_groups.push_back(added_group_);
  return
      [name = added_group_, body, options](Simulation& simulation, Timeline&) { add(simulation, body, options, name); };
}

void EventReader::check_added() const {
  if (added_group_.empty()) return;
  scene_.check_group(node_.require("add"), scene_.simulation.find_group(added_group_).value());
}

Timeline::Edit EventReader::read_remove(const Node& node) {
  node_.check_keys(keys("remove"));
  const std::string name = text_of(node);
  if (scene_.groups.erase(name) > 0) {
    return [name](Simulation& simulation, Timeline&) { simulation.remove(find_group(simulation, name)); };
  }
  if (scene_.forces.erase(name) == 0) fail_unknown(node);
  return [name](Simulation& simulation, Timeline&) { simulation.remove(find_force(simulation, name)); };
}

/// The vertices that a group of positions holds, with the indices of its body, in the order of its targets.
std::vector<Index> pinned_vertices(const Simulation& simulation, const Group& group) {
  std::vector<Index> vertices;
  for (const auto& batch : group.set.batches) {
    const std::span<const Index> pinned =
        batch->pinned_vertices().empty() ? batch->stencil() : batch->pinned_vertices();
    vertices.insert(vertices.end(), pinned.begin(), pinned.end());
  }
  for (Index& vertex : vertices) vertex -= simulation.body(group.body).first_vertex;
  return vertices;
}

bool contains(const std::vector<Index>& sorted, Index number) {
  return std::ranges::binary_search(sorted, number);
}

/// Which of these a selection holds; of a list, all of them must be there.
std::vector<Index> read_released(const Node& node, const SceneBody& body, const std::vector<Index>& pinned) {
  Selection selection = read_selection(node, body);
  if (selection.everything) return pinned;
  if (node.is_list()) return selection.vertices;
  std::ranges::sort(selection.vertices);
  std::vector<Index> released;
  std::ranges::copy_if(pinned, std::back_inserter(released), [&](Index v) { return contains(selection.vertices, v); });
  if (released.empty()) node.fail("the group holds none of these vertices; select others");
  return released;
}

/// The same by the numbers of constraints.
std::vector<Index> read_released_numbers(const Node& node, const Group& group, const std::vector<Index>& pinned) {
  ConstraintNumbers numbers;
  read(node, numbers);
  std::map<Index, Index> vertices;  // by number
  for (std::size_t i = 0; i < pinned.size(); ++i) vertices.emplace(group.points[i], pinned[i]);
  for (Index& number : numbers) {
    const auto found = vertices.find(number);
    if (found == vertices.end()) {
      node.fail(
          fmt::format("the group has no constraint {} then; it began with 0 to {}", number, group.next_point - 1));
    }
    number = found->second;
  }
  return numbers;
}

/// Positions without those of some vertices.
void leave_out(std::vector<Index> released, const std::vector<Index>& pinned, Position& options) {
  std::ranges::sort(released);
  Stencils stencils;
  std::vector<Real> stiffness;
  for (std::size_t i = 0; i < pinned.size(); ++i) {
    if (contains(released, pinned[i])) continue;
    stencils.add({pinned[i]});
    if (options.stiffness.each()) stiffness.push_back(options.stiffness[static_cast<Index>(i)]);
  }
  options.on = stencils.empty() ? Selection(std::vector<Index>{}) : Selection();
  if (options.stiffness.each()) options.stiffness = Values(std::move(stiffness));
  options.stencils = std::move(stencils);
  options.targets = {};  // a group that is made anew keeps those there are
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
  const std::vector<Index> pinned = pinned_vertices(scene_.simulation, group);
  const std::string_view key = node_.require_one_of({"vertices", "index"});
  const std::vector<Index> released = key == "vertices"
                                          ? read_released(node_.require(key), scene_.body(entry.body), pinned)
                                          : read_released_numbers(node_.require(key), group, pinned);
  leave_out(released, pinned, *options);
  return [name, released](Simulation& simulation, Timeline&) {
    simulation.release(find_group(simulation, name), released);
  };
}

Timeline::Edit EventReader::start(const Node& node, EventPath path) {
  scene_.group(node);
  return [name = text_of(node), path = std::move(path)](Simulation& simulation, Timeline& timeline) {
    timeline.start(simulation, find_group(simulation, name), path.path, path.index);
  };
}

Timeline::Edit EventReader::read_move(const Node& node) {
  scene_.group(node);
  return start(node, pliant::read_move(node_, keys("move")));
}

Timeline::Edit EventReader::read_short_move() {
  const Node group = node_.require("group");
  scene_.group(group);
  return start(group, pliant::read_move(node_, keys("group")));
}

Timeline::Edit EventReader::read_follow(const Node& node) {
  scene_.group(node);
  return start(node, pliant::read_follow(node_, keys("follow"), scene_));
}

Timeline::Edit EventReader::read_stop(const Node& node) {
  node_.check_keys(keys("stop", {"index"}));
  scene_.group(node);
  ConstraintNumbers numbers;
  read_optional(node_, "index", numbers);
  return [name = text_of(node), numbers](Simulation& simulation, Timeline& timeline) {
    timeline.stop(simulation, find_group(simulation, name), numbers);
  };
}

/// Events in the order in which they act, for a simulation that takes no steps: as if its clock ran.
class DueOrder {
 public:
  void add(const Node& node) {
    const auto event = static_cast<Index>(whens_.size());
    whens_.push_back(read_when(node));
    if (whens_.back().is_step()) {
      by_step_.emplace(whens_.back().step(), event);
    } else {
      by_time_.emplace(whens_.back().time(), event);
    }
  }
  const When& when(std::size_t event) const { return whens_[event]; }

  /// The events before the next step that has any, in the order of their adding; none when all have come. `time_step`
  /// is that of the simulation until then.
  std::vector<Index> next(Real time_step) {
    std::vector<Index> due;
    if (by_step_.empty() && by_time_.empty()) return due;
    // A number of steps, which may be beyond all integers.
    Real step = std::numeric_limits<Real>::infinity();
    if (!by_step_.empty()) step = static_cast<Real>(by_step_.begin()->first);
    if (!by_time_.empty()) {
      const Real wait = std::ceil((by_time_.begin()->first - time_) / time_step - 1e-9);
      step = std::min(step, step_ + std::max(wait, Real(0)));
    }
    step = std::max(step, step_);
    time_ += (step - step_) * time_step;
    step_ = step;
    while (!by_step_.empty() && static_cast<Real>(by_step_.begin()->first) <= step_) take(by_step_, due);
    while (!by_time_.empty() && is_due(by_time_.begin()->first, time_step)) take(by_time_, due);
    if (due.empty()) take(by_time_, due);  // never for want of digits
    std::ranges::sort(due);
    return due;
  }

 private:
  static When read_when(const Node& node) {
    EventTime given;
    node.require_object();
    const std::string_view key = node.require_one_of({"step", "time"});
    EventTime::visit(given, OptionReader{node});
    if (key == "step" && given.step < 0) {
      node.fail(fmt::format("step {} is before the start; steps count from 0", given.step));
    }
    if (given.time < 0) node.fail(fmt::format("{} s is before the start; times count from 0", given.time));
    return key == "step" ? When::at_step(given.step) : When::at_time(given.time);
  }

  /// With the rounding of a clock that does not count its steps one by one.
  bool is_due(Real time, Real time_step) const { return (time - time_) / time_step <= 1e-9 * (1 + step_); }

  template <class Waiting>
  static void take(Waiting& waiting, std::vector<Index>& due) {
    due.push_back(waiting.begin()->second);
    waiting.erase(waiting.begin());
  }

  std::vector<When> whens_;
  std::multimap<std::int64_t, Index> by_step_;
  std::multimap<Real, Index> by_time_;
  Real step_ = 0;
  Real time_ = 0;  // [s]
};

}  // namespace

void SceneReader::read_events(const Node& root, Timeline& timeline) {
  struct Entry {
    Node node;
    std::string name;
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
      entries.push_back({node, fmt::format("{}: {}", node.origin().name, path), key == "moves"});
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
        EventReader reader(*this, node);
        edits[i] = entries[i].is_short ? reader.read_short_move() : reader.read();
        node.locate([&] { edits[i](simulation, rehearsal); });
        reader.check_added();
      }
    }
  }
  for (std::size_t i = 0; i < entries.size(); ++i) {
    timeline.add(order.when(i), std::move(edits[i]), std::move(entries[i].name));
  }
}

}  // namespace pliant
