#include "viewer/mouse_interaction.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pliant_viewer {
namespace {

constexpr float click_slack = 4;  // units the mouse may move during a click
constexpr float pin_reach = 9;    // units around a pin that count as the pin
constexpr float rope_reach = 7;   // units around a rope that count as the rope
constexpr float zoom_a_notch = 0.88F;

}  // namespace

std::uint64_t post(const MouseInteraction::View& view, LiveScene::Kind kind, std::function<void(Session&)> act) {
  return view.live->post(
      [act = std::move(act), restarts = view.snapshot->restarts](CommandContext& context) {
        if (context.session.restarts() == restarts) act(context.session);
      },
      kind);
}

void MouseInteraction::handle(const MouseEvent& event, const View& view) {
  switch (event.kind) {
    case MouseEvent::Kind::press:
      if (action_ == Action::none) press(event, view);
      break;
    case MouseEvent::Kind::move:
      move(event.place, view);
      break;
    case MouseEvent::Kind::release:
      if (action_ != Action::none && event.button == button_) {
        move(event.place, view);
        release(event, view);
      }
      break;
    case MouseEvent::Kind::wheel:
      if (pull_ || action_ == Action::move_pin || action_ == Action::move_collider)
        break;  // what is held keeps its depth
      view.camera.zoom(std::pow(zoom_a_notch, event.wheel));
      break;
  }
}

void MouseInteraction::press(const MouseEvent& event, const View& view) {
  pressed_ = last_ = event.place;
  button_ = event.button;
  if (event.button == MouseButton::middle || event.shift) {
    action_ = Action::pan;
  } else if (event.button == MouseButton::right) {
    action_ = Action::orbit;
  } else {
    press_left(event.place, view);
  }
}

MouseInteraction::PickTarget MouseInteraction::pick(const Vec2f& at, const View& view) {
  if (view.live == nullptr || view.snapshot->render_mesh == nullptr) return {};
  const std::span<const Vec3f> positions = view.snapshot->frame.content.positions;
  PickTarget target;
  target.point = pick_surface(*view.snapshot->render_mesh, positions, view.screen, at, rope_reach * view.unit);
  target.pin = pick_vertex(view.snapshot->pins, positions, view.screen, at, pin_reach * view.unit);
  if (view.shows_colliders) {
    target.collider = pick_collider(view.snapshot->frame.content.colliders, view.screen, at);
  }
  constexpr float none = std::numeric_limits<float>::infinity();
  const float body_depth = target.point ? view.screen.depth_of(target.point->position(positions)) : none;
  const float collider_depth = target.collider ? view.screen.depth_of(target.collider->position) : none;
  if (body_depth < collider_depth) {
    target.collider.reset();
  } else {
    target.point.reset();
  }
  // A pin behind the surface is not the one the user means.
  constexpr float nearly = 1.02F;
  const float depth = std::min(body_depth, collider_depth);
  if (target.pin && view.screen.depth_of(positions[*target.pin]) > nearly * depth) target.pin.reset();
  return target;
}

void MouseInteraction::press_left(const Vec2f& at, const View& view) {
  action_ = Action::orbit;
  const PickTarget aimed = pick(at, view);
  const std::span<const Vec3f> positions = view.snapshot != nullptr
                                               ? std::span<const Vec3f>(view.snapshot->frame.content.positions)
                                               : std::span<const Vec3f>();
  if (aimed.pin) {
    action_ = Action::touch_pin;
    vertex_ = *aimed.pin;
    depth_ = view.screen.depth_of(positions[vertex_]);
    grip_ = positions[vertex_] - view.screen.point_at(at, depth_);
  } else if (aimed.point) {
    action_ = Action::touch_body;
    point_ = *aimed.point;
    depth_ = view.screen.depth_of(point_.position(positions));
    grip_ = Vec3f::Zero();
  } else if (aimed.collider) {
    action_ = Action::touch_collider;
    collider_ = aimed.collider->number;
    depth_ = view.screen.depth_of(aimed.collider->position);
    for (const pliant_render::DrawnCollider& each : view.snapshot->frame.content.colliders) {
      if (each.number == collider_) grip_ = each.pose.position.cast<float>() - aimed.collider->position;
    }
  }
}

Vec3f MouseInteraction::target(const Vec2f& at, const View& view) const {
  return view.screen.point_at(at, depth_) + grip_;
}

void MouseInteraction::move(const Vec2f& to, const View& view) {
  const Vec2f by = (to - last_) / view.screen.size.y();
  last_ = to;
  const bool is_click = (to - pressed_).norm() <= click_slack * view.unit;
  switch (action_) {
    case Action::orbit:
      view.camera.orbit(by, view.floor);
      break;
    case Action::pan:
      view.camera.pan(by);
      break;
    case Action::touch_body:
      if (!is_click) begin_pull(view);
      break;
    case Action::touch_pin:
      if (is_click) break;
      action_ = Action::move_pin;
      last_target_ = target(to, view);
      has_moved_ = true;
      break;
    case Action::touch_collider:
      if (is_click) break;
      action_ = Action::move_collider;
      last_target_ = target(to, view);
      has_moved_ = true;
      break;
    case Action::pull:
    case Action::move_pin:
    case Action::move_collider:
      has_moved_ = true;
      break;
    case Action::none:
      break;
  }
}

void MouseInteraction::begin_pull(const View& view) {
  action_ = Action::pull;
  pull_ = Pull{point_, target(last_, view), stiffness_};
  post(view, LiveScene::Kind::changes, [pull = *pull_](Session& session) { session.grab(pull); });
}

void MouseInteraction::release(const MouseEvent& event, const View& view) {
  const Action action = std::exchange(action_, Action::none);
  const bool is_click = (event.place - pressed_).norm() <= click_slack * view.unit;
  if (action == Action::pull) {
    pull_.reset();
    post(view, LiveScene::Kind::changes, [](Session& session) { session.let_go(); });
  } else if (action == Action::move_pin || action == Action::move_collider) {
    action_ = action;
    flush(view);
    action_ = Action::none;
    post(view, LiveScene::Kind::changes,
         [is_pin = action == Action::move_pin, vertex = static_cast<Index>(vertex_),
          collider = pliant::ColliderId{collider_}](Session& session) {
           if (is_pin) return session.drop_pin(vertex);
           session.drop_collider(collider);
         });
  } else if (action == Action::touch_pin) {
    toggle_pin(vertex_, true, view);
  } else if (!is_click) {
    return;
  } else if (action == Action::touch_body) {
    toggle_pin(point_.nearest_vertex(view.snapshot->frame.content.positions), false, view);
  } else if (action == Action::touch_collider) {
    click_ = Click{collider_};
  } else if (action == Action::orbit && button_ == MouseButton::left && view.snapshot != nullptr) {
    const auto plane =
        view.shows_colliders && view.live != nullptr
            ? pick_collider(view.snapshot->frame.content.colliders, view.screen, event.place, Planes::too)
            : std::nullopt;
    click_ = Click{plane ? std::optional(plane->number) : std::nullopt};
  }
}

void MouseInteraction::toggle_pin(std::uint32_t vertex, bool is_pinned, const View& view) {
  const auto index = static_cast<Index>(vertex);
  const std::uint64_t command = post(view, LiveScene::Kind::changes, [index, is_pinned](Session& session) {
    if (is_pinned) {
      session.unpin(index);
    } else {
      session.pin(index);
    }
  });
  pending_.push_back({vertex, command});
}

void MouseInteraction::flush(const View& view) {
  if (!has_moved_) return;
  has_moved_ = false;
  const Vec3f to = target(last_, view);
  last_target_ = to;
  if (action_ == Action::pull) {
    pull_->target = to;
    post(view, LiveScene::Kind::steers, [to](Session& session) { session.pull_to(to); });
  } else if (action_ == Action::move_pin) {
    const auto vertex = static_cast<Index>(vertex_);
    post(view, LiveScene::Kind::steers, [to, vertex](Session& session) { session.move_pin(vertex, to); });
  } else if (action_ == Action::move_collider) {
    post(view, LiveScene::Kind::steers,
         [to, collider = collider_](Session& session) { session.move_collider(pliant::ColliderId{collider}, to); });
  }
}

void MouseInteraction::set_stiffness(Real stiffness, LiveScene& live) {
  stiffness_ = stiffness;
  if (!pull_) return;
  pull_->stiffness = stiffness;
  live.post([stiffness](CommandContext& context) { context.session.set_pull_stiffness(stiffness); });
}

std::vector<std::uint32_t> MouseInteraction::pending(const Snapshot& snapshot) {
  std::erase_if(pending_, [&](const Pending& pending) { return pending.command <= snapshot.commands; });
  std::vector<std::uint32_t> vertices;
  for (const Pending& pending : pending_) {
    if (pending.vertex < snapshot.frame.content.positions.size()) vertices.push_back(pending.vertex);
  }
  return vertices;
}

}  // namespace pliant_viewer
