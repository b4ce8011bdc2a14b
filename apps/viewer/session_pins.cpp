// Pins of a session: set, let go and moved by hand, one or many at a time.
#include <algorithm>

#include <fmt/format.h>

#include "pliant/constraints/position.h"
#include "pliant/core/error.h"
#include "pliant/simulation/held.h"
#include "viewer/session.h"

namespace pliant_viewer {
namespace {

constexpr std::string_view pin_name = "pinned by hand";  // until the scene is made anew

/// "pin", "pin 24 vertices"
std::string text_of_edit(const char* what, std::size_t count) {
  return count == 1 ? what : fmt::format("{} {} vertices", what, count);
}

}  // namespace

std::optional<Pin> Session::find_pin(Index vertex) const {
  const auto found = find_pins({vertex});
  if (found.empty()) return {};
  return found.begin()->second.front();
}

/// Of each of these vertices that is pinned all its pins: one may have soft ones of several groups.
std::map<Index, std::vector<Pin>> Session::find_pins(const std::vector<Index>& vertices) const {
  const std::set<Index> wanted(vertices.begin(), vertices.end());
  std::map<Index, std::vector<Pin>> pins;
  for (const auto& [id, group] : scene_.simulation.groups()) {
    if (group.type != pliant::Position::info.name) continue;
    Index target = 0;
    for (const Index vertex : vertices_of_pins(group)) {
      if (wanted.contains(vertex)) pins[vertex].push_back({id, target});
      ++target;
    }
  }
  return pins;
}

/// By the names that pins of the hand have in saved scenes.
bool Session::was_of_hand(const pliant::Group& group) const {
  const std::string& body = simulation().body(group.body).name;
  return group.name.starts_with(body + ".pins") || group.name.starts_with(body + ".moved_pins");
}

std::vector<char> Session::figures() const {
  std::vector<char> held(simulation().state().masses.size(), 0);
  for (const auto& [id, group] : simulation().groups()) {
    if (of_hand_.contains(id) || was_of_hand(group)) continue;
    for (const auto& batch : group.set.batches) {
      for (const Index vertex : batch->pinned_vertices()) held[static_cast<std::size_t>(vertex)] = 1;
    }
  }
  std::vector<char> figures;
  for (const pliant::Body& body : simulation().bodies()) figures.push_back(is_held(body, held) ? 1 : 0);
  return figures;
}

std::vector<PinnedVertex> Session::pinned_vertices() const {
  const std::vector<char> is_figure = figures();
  std::vector<PinnedVertex> list;
  for (const auto& [id, group] : simulation().groups()) {
    if (group.type != pliant::Position::info.name) continue;
    if (is_figure[static_cast<std::size_t>(group.body)] != 0) continue;
    Index target = 0;
    for (const Index vertex : vertices_of_pins(group)) {
      list.push_back({static_cast<std::uint32_t>(vertex), target_of({id, target++}).cast<float>()});
    }
  }
  std::ranges::stable_sort(list, {}, &PinnedVertex::vertex);
  const auto is_same = [](const PinnedVertex& a, const PinnedVertex& b) { return a.vertex == b.vertex; };
  list.erase(std::unique(list.begin(), list.end(), is_same), list.end());
  return list;
}

void Session::pin(Index vertex) {
  const auto noted = note(action::PinVertex{vertex});
  pin(std::vector{vertex});
}

void Session::unpin(Index vertex) {
  const auto noted = note(action::Unpin{vertex});
  unpin(std::vector{vertex});
}

void Session::pin(const std::vector<Index>& vertices) {
  const auto noted = note(action::PinVertices{vertices});
  const auto pinned = find_pins(vertices);
  std::map<pliant::BodyId, std::set<Index>> fresh;
  for (const Index vertex : vertices) {
    const pliant::BodyId body = body_of(vertex);
    if (!pinned.contains(vertex)) fresh[body].insert(vertex);
  }
  if (fresh.empty()) return;
  Edit edit{.what = "", .before = changes_};
  for (const auto& [body, of_body] : fresh) {
    const Index first = simulation().body(body).first_vertex;
    std::vector<Index> places;
    for (const Index vertex : of_body) places.push_back(vertex - first);
    pliant::Position position;
    position.on = pliant::Selection(std::move(places));
    of_hand_.insert(scene_.simulation.add(body, position, std::string(pin_name)));
    for (const Index vertex : of_body) {
      changes_.pins[vertex] = std::nullopt;
      edit.held[vertex] = simulation().state().positions.row(vertex);
    }
  }
  edit.what = text_of_edit("pin", edit.held.size());
  remember(std::move(edit));
}

void Session::unpin(const std::vector<Index>& vertices) {
  const auto noted = note(action::UnpinVertices{vertices});
  const auto pinned = find_pins(vertices);
  if (pinned.empty()) return;
  Edit edit{.what = text_of_edit("unpin", pinned.size()), .before = changes_};
  std::map<pliant::GroupId, std::vector<Index>> released;
  for (const auto& [vertex, pins] : pinned) {
    edit.held[vertex] = target_of(pins.front());
    for (const Pin& pin : pins) {
      const pliant::Group& group = scene_.simulation.groups().at(pin.group);
      if (!of_hand_.contains(pin.group)) note_release(vertex, group, pin);
      released[pin.group].push_back(vertex - scene_.simulation.body(group.body).first_vertex);
    }
    changes_.pins.erase(vertex);
    changes_.moved.erase(vertex);
  }
  for (const auto& [id, of_body] : released) {
    const bool is_all = scene_.simulation.target_count(id) == static_cast<Index>(of_body.size());
    if (is_all && of_hand_.erase(id) > 0) {
      scene_.simulation.remove(id);
    } else {  // stays, if only as an empty one: events may name it
      scene_.simulation.release(id, of_body);
    }
  }
  remember(std::move(edit));
}

void Session::note_release(Index vertex, const pliant::Group& group, const Pin& pin) {
  ReleasedPin& released = changes_.released[vertex];
  if (std::ranges::find(released.groups, group.name) != released.groups.end()) return;
  if (released.groups.empty()) released.number = group.points[static_cast<std::size_t>(pin.target)];
  released.groups.push_back(group.name);
}

void Session::move_pin(Index vertex, const Vec3f& target) {
  const auto pin = find_pin(vertex);
  if (!pin || !target.allFinite()) return;
  const auto noted = note(action::MovePin{vertex, target});
  const pliant::Group& group = scene_.simulation.groups().at(pin->group);
  scene_.timeline.stop(scene_.simulation, pin->group, {group.points[static_cast<std::size_t>(pin->target)]});
  scene_.simulation.set_target(pin->group, pin->target, target.cast<Real>());
}

void Session::hold_pins(const std::vector<Index>& vertices) {
  const auto noted = note(action::HoldPins{vertices});
  held_pins_.clear();
  have_held_moved_ = false;
  const auto pinned = find_pins(vertices);
  for (const auto& [vertex, pins] : pinned) held_pins_[vertex] = target_of(pins.front());
  stop_motions(pinned);
}

/// The scene's, of pins that are the hand's now.
void Session::stop_motions(const std::map<Index, std::vector<Pin>>& pinned) {
  std::map<pliant::GroupId, std::vector<Index>> points;
  for (const auto& [vertex, pins] : pinned) {
    const pliant::Group& group = scene_.simulation.groups().at(pins.front().group);
    points[pins.front().group].push_back(group.points[static_cast<std::size_t>(pins.front().target)]);
  }
  for (const auto& [group, of_group] : points) scene_.timeline.stop(scene_.simulation, group, of_group);
}

void Session::move_held(const RigidMotion& motion) {
  if (held_pins_.empty() || !motion.is_finite()) return;
  const auto noted = note(action::MoveHeld{motion});
  std::vector<Index> vertices;
  for (const auto& [vertex, start] : held_pins_) vertices.push_back(vertex);
  have_held_moved_ = true;
  const auto pinned = find_pins(vertices);
  stop_motions(pinned);  // also those that have begun since
  for (const auto& [vertex, pins] : pinned) {
    scene_.simulation.set_target(pins.front().group, pins.front().target, motion(held_pins_.at(vertex)));
  }
}

/// Where a pin is before the first step is where the scene begins with it.
void Session::note_moved(Index vertex, const Pin& pin) {
  const pliant::Group& group = simulation().groups().at(pin.group);
  const pliant::Vec3 target = target_of(pin);
  if (changes_.pins.contains(vertex)) {
    changes_.pins[vertex] = target;
  } else {
    changes_.moved[vertex] = {group.name, group.points[static_cast<std::size_t>(pin.target)], target};
  }
}

void Session::drop_pin(Index vertex) {
  const auto noted = note(action::DropPin{vertex});
  const auto pin = find_pin(vertex);
  if (!pin || simulation().state().step > 0) return;
  Edit edit{.what = "move a pin", .before = changes_};
  note_moved(vertex, *pin);
  remember(std::move(edit));
}

void Session::drop_held() {
  const auto noted = note(action::DropHeld{});
  std::vector<Index> vertices;
  for (const auto& [vertex, start] : held_pins_) vertices.push_back(vertex);
  held_pins_.clear();
  const auto pinned = find_pins(vertices);
  if (pinned.empty() || !have_held_moved_ || simulation().state().step > 0) return;
  Edit edit{.what = text_of_edit("move", pinned.size()), .before = changes_};
  if (pinned.size() == 1) edit.what = "move a pin";
  for (const auto& [vertex, pins] : pinned) note_moved(vertex, pins.front());
  remember(std::move(edit));
}

}  // namespace pliant_viewer
