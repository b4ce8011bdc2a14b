#include "viewer/transform_gizmo.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "viewer/drawing.h"

namespace pliant_viewer {
namespace {

using Part = TransformGizmo::Part;
using View = MouseInteraction::View;

constexpr float ring_radius = 70;                                  // units
constexpr float stem = 1.1F, tip = 1.5F;                           // of an arrow, in radii of the rings
constexpr float plane_reach = 9, arrow_reach = 8, ring_reach = 6;  // units around a part that count as the part
constexpr int ring_points = 72;
constexpr float from_the_end = 0.97F;  // cosine of the angle from which on an arrow is seen from its end
constexpr float from_the_edge = 0.2F;  // of that below which a ring is seen from its edge
constexpr float click_way = 4;         // units the mouse may move during a click
constexpr float snap = std::numbers::pi_v<float> / 12;

constexpr std::array<ImU32, 3> axis_colors = {IM_COL32(222, 58, 62, 255), IM_COL32(92, 168, 50, 255),
                                              IM_COL32(48, 116, 232, 255)};

bool is_arrow(Part part) {
  return part >= Part::move_x && part <= Part::move_z;
}
bool is_ring(Part part) {
  return part >= Part::turn_x;
}
int axis_of(Part part) {
  return static_cast<int>(part) - static_cast<int>(is_ring(part) ? Part::turn_x : Part::move_x);
}
Part arrow(int axis) {
  return static_cast<Part>(static_cast<int>(Part::move_x) + axis);
}
Part ring_part(int axis) {
  return static_cast<Part>(static_cast<int>(Part::turn_x) + axis);
}

/// Where on a line through a point along an axis of length 1 it comes nearest to a ray [m]; none where both are almost
/// parallel.
std::optional<float> nearest_on_axis(const Vec3f& point, const Vec3f& axis, const Screen::Ray& ray) {
  constexpr float least_angle = 7.6e-3F;  // of the square of its sine: 5°
  const Vec3f direction = ray.direction.normalized(), from_eye = point - ray.origin;
  const float across = axis.dot(direction);
  const float determinant = 1 - across * across;
  if (determinant < least_angle) return {};
  const float along = (across * direction.dot(from_eye) - axis.dot(from_eye)) / determinant;
  // Beyond the point where the axis vanishes the nearest point is behind the eye, before it far away.
  constexpr float farthest = 5;  // of the way to the point
  const float way = direction.dot(from_eye + along * axis);
  if (!(way > 0) || way > farthest * from_eye.norm()) return {};
  return along;
}

Vec3f toward_eye(const Vec3f& point, const View& view) {
  return (view.screen.viewpoint.eye - point).normalized();
}

/// A line that stands out from bright and dark.
void draw_line(const std::vector<ImVec2>& line, ImU32 color, float width, ImDrawList& list) {
  const auto count = static_cast<int>(line.size());
  list.AddPolyline(line.data(), count, halo, 0, width + 1.6F);
  list.AddPolyline(line.data(), count, color, 0, width);
}

}  // namespace

void TransformGizmo::stand_at(const Place& place) {
  place_ = place;
  motion_ = {.center = place.middle};
  is_shown_ = true;
}

bool TransformGizmo::has(Part part) const {
  return std::ranges::count(place_.left_out, part) == 0;
}

/// The radius of the rings [m].
float TransformGizmo::reach(const View& view) const {
  const float half = std::tan(view.screen.viewpoint.field_of_view / 2);
  return view.screen.depth_of(middle()) * 2 * half / view.screen.size.y() * ring_radius * view.unit;
}

/// The half of it that faces the eye.
std::vector<Vec3f> TransformGizmo::ring(int axis, const View& view) const {
  const Vec3f to_eye = toward_eye(middle(), view);
  const Vec3f u = direction((axis + 1) % 3), v = direction((axis + 2) % 3);
  // From the middle of the half that is hidden on, so that what is seen is one piece.
  const float hidden = std::atan2(-to_eye.dot(v), -to_eye.dot(u));
  const bool is_whole = std::abs(to_eye.dot(direction(axis))) > from_the_end;
  std::vector<Vec3f> points;
  for (int i = 0; i <= ring_points; ++i) {
    const float angle = hidden + 2 * std::numbers::pi_v<float> * static_cast<float>(i) / ring_points;
    const Vec3f spoke = std::cos(angle) * u + std::sin(angle) * v;
    if (is_whole || spoke.dot(to_eye) >= -0.02F) points.emplace_back(middle() + reach(view) * spoke);
  }
  return points;
}

std::optional<Vec2f> TransformGizmo::place_of(Part part, const View& view) const {
  if (!is_shown() || part == Part::none) return {};
  if (part == Part::plane) return view.screen.place_of(middle());
  if (is_arrow(part)) {
    return view.screen.place_of(middle() + (stem + tip) / 2 * reach(view) * direction(axis_of(part)));
  }
  const std::vector<Vec3f> points = ring(axis_of(part), view);
  // Beside the middle, where another ring may cross it.
  return view.screen.place_of(points[points.size() * 3 / 8]);
}

Part TransformGizmo::part_at(const Vec2f& at, const View& view) const {
  if (!is_shown() || !(view.screen.depth_of(middle()) > 0)) return Part::none;
  const auto center = view.screen.place_of(middle());
  if (has(Part::plane) && center && (*center - at).norm() <= plane_reach * view.unit) return Part::plane;
  const Vec3f to_eye = toward_eye(middle(), view);
  for (int axis = 0; axis < 3; ++axis) {
    if (!has(arrow(axis)) || std::abs(to_eye.dot(direction(axis))) > from_the_end) continue;
    const auto from = view.screen.place_of(middle() + stem * reach(view) * direction(axis));
    const auto to = view.screen.place_of(middle() + tip * reach(view) * direction(axis));
    if (from && to && distance_to_segment(*from, *to, at) <= arrow_reach * view.unit) return arrow(axis);
  }
  Part nearest = Part::none;
  float least = ring_reach * view.unit;
  for (int axis = 0; axis < 3; ++axis) {
    if (!has(ring_part(axis))) continue;
    const std::vector<Vec3f> points = ring(axis, view);
    for (std::size_t i = 0; i + 1 < points.size(); ++i) {
      const auto a = view.screen.place_of(points[i]), b = view.screen.place_of(points[i + 1]);
      if (!a || !b || distance_to_segment(*a, *b, at) > least) continue;
      least = distance_to_segment(*a, *b, at);
      nearest = ring_part(axis);
    }
  }
  return nearest;
}

bool TransformGizmo::handle(const MouseEvent& event, const View& view) {
  const bool is_left = event.button == MouseButton::left;
  switch (event.kind) {
    case MouseEvent::Kind::press: {
      if (is_busy()) return true;
      const Part part = is_left && !event.shift && !event.control ? part_at(event.place, view) : Part::none;
      if (part == Part::none || view.live == nullptr) return false;
      begin(part, event.place);
      return true;
    }
    case MouseEvent::Kind::move:
      if (!is_busy()) return false;
      if (!is_held_ && (event.place - pressed_).norm() <= click_way * view.unit) return true;
      if (!is_held_) hold(view);
      if (!is_busy()) return true;
      drag(event.place, view);
      if (is_ring(held_) && event.control) {
        motion_.rotation = std::round(turned_ / snap) * snap * direction(axis_of(held_));
      }
      return true;
    case MouseEvent::Kind::release:
      if (!is_busy() || !is_left) return is_busy();
      if (has_moved_) send(view);
      held_ = Part::none;
      if (!is_held_) return true;
      command_ = let_go(view);
      return true;
    case MouseEvent::Kind::wheel:
      return is_busy();  // what is held keeps its depth
  }
  return false;
}

void TransformGizmo::begin(Part part, const Vec2f& at) {
  // The scene may not have come to the last motion yet: this one begins where that ended.
  go_on_from(motion_);
  motion_ = {.center = middle()};
  held_ = part;
  is_held_ = has_moved_ = false;
  pressed_ = last_ = at;
  turned_ = 0;
}

/// By where the mouse took the part.
void TransformGizmo::aim(const View& view) {
  last_angle_.reset();
  grip_ = middle() - view.screen.point_at(pressed_, view.screen.depth_of(middle()));
  if (is_arrow(held_)) {
    along_ = nearest_on_axis(middle(), direction(axis_of(held_)), view.screen.ray(pressed_)).value_or(0);
  } else if (is_ring(held_)) {
    last_angle_ = angle_at(pressed_, view);
    if (!last_angle_) {  // along the picture of the ring where it was taken
      const auto distance = [&](const Vec3f& point) {
        const auto place = view.screen.place_of(point);
        return place ? (*place - pressed_).norm() : 1e30F;
      };
      const std::vector<Vec3f> points = ring(axis_of(held_), view);
      const Vec3f taken = *std::ranges::min_element(points, {}, distance);
      constexpr float small_angle = 0.01F;
      const Vec3f on = taken + small_angle * direction(axis_of(held_)).cross(taken - middle());
      const auto from = view.screen.place_of(taken), to = view.screen.place_of(on);
      const Vec2f way = from && to ? Vec2f((*to - *from) / small_angle) : Vec2f(1, 0);
      const float least = 0.3F * ring_radius * view.unit;  // where the ring goes away from the eye it seems to stand
      tangent_ = way / std::max(way.squaredNorm(), least * least);
    }
  }
}

void TransformGizmo::hold(const View& view) {
  // The scene may have moved what is held since the press.
  if (view.snapshot->commands >= command_) {
    const Part part = std::exchange(held_, Part::none);
    look_again(view);
    if (!is_shown_) return;  // it was let go
    held_ = part;
  }
  aim(view);
  is_held_ = true;
  take(view);
}

/// Around the middle, in the plane of the ring that is held; none where that is seen from its edge.
std::optional<float> TransformGizmo::angle_at(const Vec2f& at, const View& view) const {
  const int axis = axis_of(held_);
  const Vec3f normal = direction(axis);
  if (std::abs(toward_eye(middle(), view).dot(normal)) < from_the_edge) return {};
  const Screen::Ray ray = view.screen.ray(at);
  const float way = (middle() - ray.origin).dot(normal) / ray.direction.dot(normal);
  if (!(way > 0) || !std::isfinite(way)) return {};
  const Vec3f from_middle = ray.origin + way * ray.direction - middle();
  return std::atan2(from_middle.dot(direction((axis + 2) % 3)), from_middle.dot(direction((axis + 1) % 3)));
}

void TransformGizmo::drag(const Vec2f& to, const View& view) {
  const Vec2f by = to - last_;
  last_ = to;
  if (held_ == Part::plane) {
    motion_.translation = view.screen.point_at(to, view.screen.depth_of(motion_.center)) + grip_ - motion_.center;
  } else if (is_arrow(held_)) {
    const Vec3f axis = direction(axis_of(held_));
    const auto now = nearest_on_axis(motion_.center, axis, view.screen.ray(to));
    if (now) motion_.translation = (*now - along_) * axis;
  } else {
    if (last_angle_) {
      const auto angle = angle_at(to, view);
      if (!angle) return;
      turned_ += std::remainder(*angle - *last_angle_, 2 * std::numbers::pi_v<float>);
      last_angle_ = angle;
    } else {
      turned_ += by.dot(tangent_);
    }
    motion_.rotation = turned_ * direction(axis_of(held_));
  }
  has_moved_ = true;
}

void TransformGizmo::flush(const View& view) {
  // Many pins take a while to move, and only the last motion counts.
  if (is_busy() && has_moved_ && view.snapshot->commands >= motion_command_) send(view);
}

void TransformGizmo::send(const View& view) {
  has_moved_ = false;
  motion_command_ = move(view);
}

void TransformGizmo::draw_arrow(int axis, const View& view, bool is_lit, ImDrawList& list) const {
  const Vec3f along_axis = direction(axis);
  if (std::abs(toward_eye(middle(), view).dot(along_axis)) > from_the_end) return;
  const auto center = view.screen.place_of(middle());
  const auto from = view.screen.place_of(middle() + stem * reach(view) * along_axis);
  const auto to = view.screen.place_of(middle() + tip * reach(view) * along_axis);
  if (!center || !from || !to) return;
  const ImU32 color = is_lit ? amber : axis_colors[static_cast<std::size_t>(axis)];
  list.AddLine(to_imgui(*center), to_imgui(*from), color, 1.2F * view.unit);
  const Vec2f way = *to - *from;
  const float length = way.norm();
  const Vec2f along = length > 0 ? Vec2f(way / length) : Vec2f(0, -1);
  const Vec2f across(-along.y(), along.x());
  const float head = std::min(13 * view.unit, 0.8F * length + 2), half = 0.42F * head;
  draw_line({to_imgui(*from), to_imgui(*to - 0.8F * head * along)}, color, (is_lit ? 4.0F : 3.0F) * view.unit, list);
  list.AddTriangleFilled(to_imgui(*to), to_imgui(*to - head * along + half * across),
                         to_imgui(*to - head * along - half * across), color);
}

void TransformGizmo::draw_ring_of(int axis, const View& view, bool is_lit, ImDrawList& list) const {
  std::vector<ImVec2> line;
  for (const Vec3f& point : ring(axis, view)) {
    if (const auto place = view.screen.place_of(point)) line.push_back(to_imgui(*place));
  }
  const ImU32 color = is_lit ? amber : axis_colors[static_cast<std::size_t>(axis)];
  draw_line(line, color, (is_lit ? 3.8F : 2.6F) * view.unit, list);
}

void TransformGizmo::draw_dot(const View& view, const Vec3f& from, const Vec3f& to, ImDrawList& list) {
  const auto here = view.screen.place_of(from), there = view.screen.place_of(to);
  if (!here || !there || (*there - *here).norm() < 2 * view.unit) return;
  list.AddCircleFilled(to_imgui(*there), 2.6F * view.unit, ink);
  list.AddCircleFilled(to_imgui(*there), 1.8F * view.unit, amber);
}

void TransformGizmo::draw(const View& view, Part hovered, ImDrawList& list) const {
  if (!is_shown() || !(view.screen.depth_of(middle()) > 0)) return;
  if (!view.snapshot->is_playing) draw_targets(view, list);
  const Part lit = is_busy() ? held_ : hovered;
  const auto is_drawn = [&](Part part) { return has(part) && (!is_busy() || part == held_); };
  for (int axis = 0; axis < 3; ++axis) {
    if (is_drawn(ring_part(axis))) draw_ring_of(axis, view, lit == ring_part(axis), list);
  }
  for (int axis = 0; axis < 3; ++axis) {
    if (is_drawn(arrow(axis))) draw_arrow(axis, view, lit == arrow(axis), list);
  }
  const auto center = view.screen.place_of(middle());
  if (!center || !has(Part::plane)) return;
  list.AddCircleFilled(to_imgui(*center), 7 * view.unit, halo);
  list.AddCircleFilled(to_imgui(*center), 5.2F * view.unit, lit == Part::plane ? amber : ink);
}

}  // namespace pliant_viewer
