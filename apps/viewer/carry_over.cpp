#include "viewer/carry_over.h"

#include <algorithm>
#include <exception>
#include <map>
#include <optional>
#include <set>

#include "pliant/constraints/position.h"
#include "pliant/core/error.h"
#include "pliant/simulation/held.h"

namespace pliant_viewer {
namespace {

using pliant::Group;
using pliant::GroupId;
using pliant::Simulation;
using pliant::Vec3;

/// Numbers of the events of a scene, some of which were left out.
class EventNumbers {
 public:
  EventNumbers(std::size_t count, const std::vector<Index>& left_out) {
    for (Index i = 0; i < static_cast<Index>(count); ++i) {
      if (!std::ranges::binary_search(left_out, i)) all_.push_back(i);
    }
  }
  /// Among all of the scene's own; none for another one.
  std::optional<Index> own(Index event) const {
    if (event < 0 || event >= static_cast<Index>(all_.size())) return {};
    return all_[static_cast<std::size_t>(event)];
  }
  /// Of the scene's own; none for one that was left out.
  std::optional<Index> number(Index own) const {
    const auto found = std::ranges::lower_bound(all_, own);
    if (found == all_.end() || *found != own) return {};
    return static_cast<Index>(found - all_.begin());
  }
  std::size_t count() const { return all_.size(); }

 private:
  std::vector<Index> all_;
};

/// The state of a timeline for that of another scene.
pliant::TimelineState timeline_for(const pliant::Scene& from, const pliant::Scene& to, const NotCarried& rules) {
  pliant::TimelineState state = from.timeline.state();
  const EventNumbers before(rules.event_count, rules.left_out_of_from), after(rules.event_count, rules.left_out_of_to);
  const auto is_idle = [](const std::vector<Index>& idle, Index own) { return std::ranges::binary_search(idle, own); };
  // Those that begin outside of events, -1, do so in both.
  const auto number = [&](Index event) {
    const auto own = before.own(event);
    return event < 0 ? std::optional(event) : own ? after.number(*own) : std::nullopt;
  };
  // What has acted on nothing, and now acts on something, is still to come.
  const auto has_acted = [&](Index event) {
    const auto own = before.own(event);
    return !own || !is_idle(rules.idle_of_from, *own) || is_idle(rules.idle_of_to, *own);
  };
  const auto goes_on = [&](Index event) {
    const auto own = before.own(event);
    return !own || !is_idle(rules.idle_of_to, *own);
  };
  pliant::TimelineState renumbered;
  const auto act = [&renumbered](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) renumbered.applied.push_back(static_cast<Index>(i));
  };
  // What takes groups away acts behind the scene's own, which may change these.
  const std::size_t count = to.timeline.event_count();
  const std::size_t first_removal = std::max(after.count(), count - std::min(count, rules.removed.size()));
  act(after.count(), first_removal);
  for (const Index event : state.applied) {
    if (const auto now = number(event); now && has_acted(event)) renumbered.applied.push_back(*now);
  }
  act(first_removal, count);
  const auto take_over = [&](auto& motions, auto& list) {
    for (auto& motion : motions) {
      const auto now = number(motion.event);
      if (!now || !goes_on(motion.event)) continue;
      motion.event = *now;
      list.push_back(std::move(motion));
    }
  };
  take_over(state.motions, renumbered.motions);
  take_over(state.collider_motions, renumbered.collider_motions);
  for (pliant::StiffnessRamp& ramp : state.ramps) {
    const auto group = from.simulation.groups().find(ramp.group);
    if (group == from.simulation.groups().end()) continue;
    const auto same = find_same(to.simulation, ramp.group, group->second);
    if (!same || rules.removed.contains(group->second.name)) continue;
    ramp.group = *same;
    renumbered.ramps.push_back(ramp);
  }
  return renumbered;
}

void carry_values(const Simulation& from, Simulation& to, const NotCarried& rules) {
  std::map<std::string, Vec3> values;
  for (const Slider& slider : list_sliders(from, rules.is_hidden)) {
    const auto* group = std::get_if<GroupId>(&slider.parameter.handle.owner);
    const auto* body = std::get_if<pliant::BodyId>(&slider.parameter.handle.owner);
    if (rules.values.contains(slider.key)) continue;
    if (group != nullptr && rules.bodies.contains(from.body(from.groups().at(*group).body).name)) continue;
    if (body != nullptr && rules.bodies.contains(from.body(*body).name)) continue;
    values[slider.key] = slider.parameter.value;
  }
  for (const Slider& slider : list_sliders(to)) {
    const auto found = values.find(slider.key);
    if (found != values.end() && found->second == slider.parameter.value) values.erase(found);
  }
  set_values(std::move(values), to);
}

bool have_same_numbers(const Group& a, const Group& b) {
  return std::ranges::equal(a.set.batches, b.set.batches, [](const auto& one, const auto& other) {
    return one->parameters().size() == other->parameters().size();
  });
}

/// Rest lengths that have crept, origins, whatever else constraints but pins keep.
void carry_numbers(const Simulation& from, Simulation& to, const NotCarried& rules) {
  std::map<GroupId, std::string> keys;
  for (const Slider& slider : list_sliders(to)) {
    const auto* owner = std::get_if<GroupId>(&slider.parameter.handle.owner);
    if (owner != nullptr && slider.parameter.handle.option == "stiffness") keys[*owner] = slider.key;
  }
  for (const auto& [id, group] : to.groups()) {
    const auto found = find_same(from, id, group);
    if (!found || group.type == pliant::Position::info.name || rules.bodies.contains(to.body(group.body).name))
      continue;
    const Group& same = from.groups().at(*found);
    if (same.type != group.type || !have_same_numbers(same, group)) continue;
    for (std::size_t i = 0; i < group.set.batches.size(); ++i) {
      std::ranges::copy(same.set.batches[i]->parameters(), group.set.batches[i]->parameters().begin());
    }
    const auto key = keys.find(id);
    const bool is_given = key != keys.end() && rules.values.contains(key->second);
    if (const auto stiffness = from.stiffness(*found); stiffness && !is_given) {
      to.set_stiffness(id, *stiffness);
    }
  }
}

/// Pins are where those of the same vertex and group were, or else of the same vertex.
void carry_pins(const Simulation& from, Simulation& to, const NotCarried& rules) {
  const auto for_each_pin = [](const Simulation& simulation, auto&& visit) {
    for (const auto& [id, group] : simulation.groups()) {
      if (group.type != pliant::Position::info.name) continue;
      const std::vector<Index> vertices = vertices_of_pins(group);
      for (std::size_t i = 0; i < vertices.size(); ++i) visit(id, group.name, static_cast<Index>(i), vertices[i]);
    }
  };
  std::map<std::pair<std::string, Index>, Vec3> of_groups;
  std::map<Index, Vec3> of_vertices;
  for_each_pin(from, [&](GroupId id, const std::string& name, Index target, Index vertex) {
    of_groups.insert_or_assign({name, vertex}, from.target(id, target));
    of_vertices.insert_or_assign(vertex, from.target(id, target));
  });
  for_each_pin(to, [&](GroupId id, const std::string& name, Index target, Index vertex) {
    if (rules.pins.contains(vertex)) return;
    const auto of_group = of_groups.find({name, vertex});
    const auto of_vertex = of_vertices.find(vertex);
    if (of_group != of_groups.end()) {
      to.set_target(id, target, of_group->second);
    } else if (of_vertex != of_vertices.end()) {
      to.set_target(id, target, of_vertex->second);
    }
  });
}

/// Pins that came while it ran stay beside the factor, in whatever group they are now, so that what goes on has the
/// same bits.
void carry_pins_beside_factor(const Simulation& from, const Simulation& to) {
  const auto is_beside = [](const Group& group) {
    return std::ranges::any_of(group.set.batches, [](const auto& batch) { return batch->is_beside_factor(); });
  };
  std::set<Index> beside;
  for (const auto& [id, group] : from.groups()) {
    if (group.type != pliant::Position::info.name || !is_beside(group)) continue;
    for (const Index vertex : vertices_of_pins(group)) beside.insert(vertex);
  }
  for (const auto& [id, group] : to.groups()) {
    if (group.type != pliant::Position::info.name) continue;
    const auto was_beside = [&](Index vertex) { return beside.contains(vertex); };
    const bool are_beside = std::ranges::all_of(vertices_of_pins(group), was_beside);
    for (const auto& batch : group.set.batches) batch->set_beside_factor(are_beside);
  }
}

/// Numbers of colliders of `from` in `to`, of those that have the same name in both.
std::map<Index, Index> collider_numbers(const Simulation& from, const Simulation& to) {
  std::map<Index, Index> numbers;
  for (const auto& [id, collider] : from.colliders()) {
    if (const auto same = to.find_collider(collider.name)) {
      numbers[static_cast<Index>(id)] = static_cast<Index>(*same);
    }
  }
  return numbers;
}

/// Colliders are where those of the same name were; what has come is where it begins.
void carry_colliders(const Simulation& from, const Simulation& to, pliant::ContactState& contact) {
  const std::map<Index, Index> numbers = collider_numbers(from, to);
  std::vector<pliant::ColliderState> colliders = to.state().contact.colliders;
  for (const pliant::ColliderState& before : contact.colliders) {
    const auto number = numbers.find(before.collider);
    if (number == numbers.end()) continue;
    const auto now = std::ranges::find(colliders, number->second, &pliant::ColliderState::collider);
    if (now != colliders.end()) *now = {number->second, before.pose, before.target};
  }
  contact.colliders = std::move(colliders);
  std::erase_if(contact.memory, [&](const auto& touch) { return !numbers.contains(touch.collider); });
  for (pliant::ContactMemory& touch : contact.memory) touch.collider = numbers.at(touch.collider);
  const auto key = [](const pliant::ContactMemory& touch) { return std::pair{touch.vertex, touch.collider}; };
  std::ranges::sort(contact.memory, {}, key);
}

}  // namespace

std::optional<GroupId> find_same(const Simulation& in, GroupId id, const Group& group) {
  const auto found = in.groups().find(id);
  const bool is_same = found != in.groups().end() && found->second.name == group.name &&
                       found->second.type == group.type && found->second.body == group.body;
  return is_same ? std::optional(id) : in.find_group(group.name);
}

void set_values(std::map<std::string, Vec3> values, Simulation& simulation) {
  const auto set = [&](const std::string& key, const Vec3& value) {
    const std::vector<Slider> all = list_sliders(simulation);  // anew, since one value may bring or take others
    const auto found = std::ranges::find(all, key, &Slider::key);
    if (found != all.end()) set_parameter(simulation, found->parameter.handle, value);
  };
  while (!values.empty()) {
    const std::size_t count = values.size();
    std::exception_ptr refused;
    std::erase_if(values, [&](const auto& entry) {
      try {
        set(entry.first, entry.second);
        return true;
      } catch (const pliant::Error&) {
        refused = std::current_exception();
        return false;
      }
    });
    if (values.size() == count) std::rethrow_exception(refused);
  }
}

void carry_over(const pliant::Scene& from, pliant::Scene& to, const NotCarried& rules) {
  to.timeline.replay(to.simulation, timeline_for(from, to, rules));
  carry_values(from.simulation, to.simulation, rules);
  carry_numbers(from.simulation, to.simulation, rules);
  carry_pins(from.simulation, to.simulation, rules);
  carry_pins_beside_factor(from.simulation, to.simulation);
  pliant::State state = from.simulation.state();
  state.masses = to.simulation.state().masses;
  carry_colliders(from.simulation, to.simulation, state.contact);
  to.simulation.restore(state);
}

}  // namespace pliant_viewer
