#include "viewer/hand.h"

#include <algorithm>
#include <cmath>

namespace pliant_viewer {
namespace {

constexpr float click_slack = 4;  // units that a click may move
constexpr float pin_reach = 9;    // units about a pin that count as the pin
constexpr float rope_reach = 7;   // units about a rope that count as the rope
constexpr float zoom_a_notch = 0.88F;

/// Lets something act on the scene that is seen; after a restart, which may have another mesh, nothing happens.
std::uint64_t post(const Hand::Place& place, LiveScene::Kind kind, std::function<void(Session&)> act) {
  return place.live->post(
      [act = std::move(act), restarts = place.snapshot->restarts](Workshop& workshop) {
        if (workshop.restarts == restarts) act(workshop.session);
      },
      kind);
}

}  // namespace

void Hand::handle(const MouseEvent& event, const Place& place) {
  switch (event.kind) {
    case MouseEvent::Kind::press:
      if (action_ == Action::none) press(event, place);
      break;
    case MouseEvent::Kind::move:
      move(event.place, place);
      break;
    case MouseEvent::Kind::release:
      if (action_ != Action::none && event.button == button_) {
        move(event.place, place);
        release(event, place);
      }
      break;
    case MouseEvent::Kind::wheel:
      if (pull_ || action_ == Action::move_pin) break;  // the depth of what is held stays
      place.camera.zoom(std::pow(zoom_a_notch, event.wheel));
      break;
  }
}

void Hand::press(const MouseEvent& event, const Place& place) {
  pressed_ = last_ = event.place;
  button_ = event.button;
  if (event.button == MouseButton::middle || event.shift) {
    action_ = Action::pan;
  } else if (event.button == MouseButton::right) {
    action_ = Action::orbit;
  } else {
    press_left(event.place, place);
  }
}

Hand::Aim Hand::aim(const Vec2f& at, const Place& place) {
  if (place.live == nullptr || place.snapshot->scenery == nullptr) return {};
  const std::span<const Vec3f> positions = place.snapshot->frame.content.positions;
  Aim aim;
  aim.point = pick_surface(*place.snapshot->scenery, positions, place.screen, at, rope_reach * place.unit);
  aim.pin = pick_vertex(place.snapshot->pins, positions, place.screen, at, pin_reach * place.unit);
  if (!aim.pin || !aim.point) return aim;
  // A pin behind the surface is not the one that is meant.
  constexpr float nearly = 1.02F;
  const float depth = place.screen.depth_of(aim.point->position(positions));
  if (place.screen.depth_of(positions[*aim.pin]) > nearly * depth) aim.pin.reset();
  return aim;
}

void Hand::press_left(const Vec2f& at, const Place& place) {
  action_ = Action::orbit;
  const Aim aimed = aim(at, place);
  const std::span<const Vec3f> positions = place.snapshot != nullptr
                                               ? std::span<const Vec3f>(place.snapshot->frame.content.positions)
                                               : std::span<const Vec3f>();
  if (aimed.pin) {
    action_ = Action::touch_pin;
    vertex_ = *aimed.pin;
    depth_ = place.screen.depth_of(positions[vertex_]);
    grip_ = positions[vertex_] - place.screen.point_at(at, depth_);
  } else if (aimed.point) {
    action_ = Action::touch_body;
    point_ = *aimed.point;
    depth_ = place.screen.depth_of(point_.position(positions));
    grip_ = Vec3f::Zero();
  }
}

Vec3f Hand::target(const Vec2f& at, const Place& place) const {
  return place.screen.point_at(at, depth_) + grip_;
}

void Hand::move(const Vec2f& to, const Place& place) {
  const Vec2f by = (to - last_) / place.screen.size.y();
  last_ = to;
  const bool is_click = (to - pressed_).norm() <= click_slack * place.unit;
  switch (action_) {
    case Action::orbit:
      place.camera.orbit(by, place.floor);
      break;
    case Action::pan:
      place.camera.pan(by);
      break;
    case Action::touch_body:
      if (!is_click) begin_pull(place);
      break;
    case Action::touch_pin:
      if (is_click) break;
      action_ = Action::move_pin;
      last_target_ = target(to, place);
      has_moved_ = true;
      break;
    case Action::pull:
    case Action::move_pin:
      has_moved_ = true;
      break;
    case Action::none:
      break;
  }
}

void Hand::begin_pull(const Place& place) {
  action_ = Action::pull;
  pull_ = Pull{point_, target(last_, place), stiffness_};
  post(place, LiveScene::Kind::changes, [pull = *pull_](Session& session) { session.grab(pull); });
}

void Hand::release(const MouseEvent& event, const Place& place) {
  const Action action = std::exchange(action_, Action::none);
  if (action == Action::pull) {
    pull_.reset();
    post(place, LiveScene::Kind::changes, [](Session& session) { session.let_go(); });
  } else if (action == Action::move_pin) {
    action_ = action;
    flush(place);
    action_ = Action::none;
  } else if (action == Action::touch_pin) {
    toggle_pin(vertex_, true, place);
  } else if (action == Action::touch_body && (event.place - pressed_).norm() <= click_slack * place.unit) {
    toggle_pin(point_.nearest_vertex(place.snapshot->frame.content.positions), false, place);
  }
}

void Hand::toggle_pin(std::uint32_t vertex, bool is_pinned, const Place& place) {
  const auto index = static_cast<Index>(vertex);
  const std::uint64_t command = post(place, LiveScene::Kind::changes, [index, is_pinned](Session& session) {
    if (is_pinned) {
      session.unpin(index);
    } else {
      session.pin(index);
    }
  });
  pending_.push_back({vertex, command});
}

void Hand::flush(const Place& place) {
  if (!has_moved_) return;
  has_moved_ = false;
  const Vec3f to = target(last_, place);
  last_target_ = to;
  if (action_ == Action::pull) {
    pull_->target = to;
    post(place, LiveScene::Kind::steers, [to](Session& session) { session.pull_to(to); });
  } else if (action_ == Action::move_pin) {
    const auto vertex = static_cast<Index>(vertex_);
    post(place, LiveScene::Kind::steers, [to, vertex](Session& session) { session.move_pin(vertex, to); });
  }
}

void Hand::set_stiffness(Real stiffness, LiveScene& live) {
  stiffness_ = stiffness;
  if (!pull_) return;
  pull_->stiffness = stiffness;
  live.post([stiffness](Workshop& workshop) { workshop.session.set_pull_stiffness(stiffness); });
}

std::vector<std::uint32_t> Hand::pending(const Snapshot& snapshot) {
  std::erase_if(pending_, [&](const Pending& pending) { return pending.command <= snapshot.commands; });
  std::vector<std::uint32_t> vertices;
  for (const Pending& pending : pending_) {
    if (pending.vertex < snapshot.frame.content.positions.size()) vertices.push_back(pending.vertex);
  }
  return vertices;
}

}  // namespace pliant_viewer
