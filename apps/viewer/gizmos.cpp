#include "viewer/gizmos.h"

#include <algorithm>
#include <vector>

#include "viewer/drawing.h"

namespace pliant_viewer {
namespace {

constexpr ImU32 red = IM_COL32(219, 26, 33, 255);
constexpr int half_windings = 18;

/// A zigzag between two short straight ends; a straight line where the spring is too short.
std::vector<ImVec2> coil(const Vec2f& from, const Vec2f& to, float unit) {
  const Vec2f along = to - from;
  const float length = along.norm();
  std::vector<ImVec2> line = {to_imgui(from)};
  if (length > 1) {
    const Vec2f direction = along / length;
    const Vec2f side(-direction.y(), direction.x());
    const float end = std::min(10 * unit, length / 4);
    const float width = std::min(5 * unit, length / 8);
    for (int i = 0; i <= half_windings; ++i) {
      const float share = static_cast<float>(i) / half_windings;
      const bool is_end = i == 0 || i == half_windings;
      const float sideways = is_end ? 0 : i % 2 == 0 ? width : -width;
      line.push_back(to_imgui(from + (end + share * (length - 2 * end)) * direction + sideways * side));
    }
  }
  line.push_back(to_imgui(to));
  return line;
}

}  // namespace

void draw_spring(const Screen& screen, const Vec3f& from, const Vec3f& to, float unit, ImDrawList& list) {
  const auto start = screen.place_of(from), end = screen.place_of(to);
  if (!start || !end) return;
  // Far outside the window nothing is visible, and ImGui's lines lose precision.
  const auto is_near = [&](const Vec2f& p) { return (p - screen.size / 2).norm() < 4 * screen.size.norm(); };
  if (!is_near(*start) || !is_near(*end)) return;
  const std::vector<ImVec2> line = coil(*start, *end, unit);
  const auto count = static_cast<int>(line.size());
  list.AddPolyline(line.data(), count, halo, 0, 4.5F * unit);
  list.AddPolyline(line.data(), count, ink, 0, 1.8F * unit);
  list.AddCircleFilled(to_imgui(*start), 5 * unit, halo);
  list.AddCircleFilled(to_imgui(*start), 3.6F * unit, ink);
  list.AddCircleFilled(to_imgui(*end), 6.5F * unit, halo);
  list.AddCircle(to_imgui(*end), 5 * unit, ink, 0, 1.8F * unit);
}

void draw_ring(const Screen& screen, const Vec3f& point, float unit, ImDrawList& list) {
  const auto place = screen.place_of(point);
  if (!place) return;
  list.AddCircle(to_imgui(*place), 8.5F * unit, halo, 0, 4 * unit);
  list.AddCircle(to_imgui(*place), 8.5F * unit, red, 0, 1.8F * unit);
}

void draw_grip(const Screen& screen, const Vec3f& point, float unit, ImDrawList& list) {
  const auto place = screen.place_of(point);
  if (!place) return;
  list.AddCircleFilled(to_imgui(*place), 5.2F * unit, halo);
  list.AddCircleFilled(to_imgui(*place), 3.6F * unit, amber);
}

void draw_outline(const Outline& outline, float unit, ImDrawList& list) {
  if (outline.size() < 2) return;
  std::vector<ImVec2> line;
  for (const Vec2f& place : outline) line.push_back(to_imgui(place));
  const auto count = static_cast<int>(line.size());
  list.AddPolyline(line.data(), count, halo, ImDrawFlags_Closed, 3.6F * unit);
  list.AddPolyline(line.data(), count, ink, ImDrawFlags_Closed, 1.4F * unit);
}

}  // namespace pliant_viewer
