#include "viewer/brush_tool.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <imgui.h>

namespace pliant_viewer {
namespace {

/// Of a body's vertices: whether they are drawn.
std::vector<char> drawn_flags(const pliant_render::RenderMesh& render_mesh) {
  std::vector<char> is_drawn(render_mesh.bodies.size(), 0);
  for (const auto* list : {&render_mesh.triangles, &render_mesh.ropes}) {
    for (const std::uint32_t vertex : *list) is_drawn[vertex] = 1;
  }
  return is_drawn;
}

/// Vertices that are joined to some within the radius, from a first one on.
std::set<std::uint32_t> reach(std::uint32_t first, const std::vector<char>& is_near,
                              const pliant_render::RenderMesh& render_mesh) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (const auto* list : {&render_mesh.edges, &render_mesh.ropes}) {
    for (std::size_t e = 0; e + 1 < list->size(); e += 2) {
      const std::array edge = {(*list)[e], (*list)[e + 1]};
      if (is_near[edge[0]] != 0 && is_near[edge[1]] != 0) edges.push_back(edge);
    }
  }
  std::map<std::uint32_t, std::vector<std::uint32_t>> beside;
  for (const auto& [a, b] : edges) {
    beside[a].push_back(b);
    beside[b].push_back(a);
  }
  std::set<std::uint32_t> found = {first};
  std::vector<std::uint32_t> front = {first};
  while (!front.empty()) {
    const std::uint32_t vertex = front.back();
    front.pop_back();
    for (const std::uint32_t next : beside[vertex]) {
      if (found.insert(next).second) front.push_back(next);
    }
  }
  return found;
}

}  // namespace

std::vector<std::pair<std::uint32_t, Real>> brush_mark(const SurfacePoint& point, float radius,
                                                       const pliant_render::RenderMesh& render_mesh,
                                                       std::span<const Vec3f> positions) {
  const Vec3f center = point.position(positions);
  const std::uint32_t nearest = point.nearest_vertex(positions);
  const std::uint32_t body = render_mesh.bodies[nearest];
  std::vector<char> is_near(render_mesh.bodies.size(), 0);
  for (std::size_t v = 0; v < is_near.size(); ++v) {
    is_near[v] = render_mesh.bodies[v] == body && (positions[v] - center).norm() < radius ? 1 : 0;
  }
  is_near[nearest] = 1;  // also of a coarse mesh under a fine brush
  const std::vector<char> is_drawn = drawn_flags(render_mesh);
  const std::set<std::uint32_t> reached = reach(nearest, is_near, render_mesh);
  std::vector<std::pair<std::uint32_t, Real>> mark;
  for (std::uint32_t v = 0; v < is_near.size(); ++v) {
    if (is_near[v] == 0 || (is_drawn[v] != 0 && !reached.contains(v))) continue;
    const auto way = static_cast<Real>((positions[v] - center).norm() / radius);
    const Real rest = std::max<Real>(0, 1 - way * way);
    mark.emplace_back(v, v == nearest ? std::max<Real>(rest * rest, 0.1) : rest * rest);
  }
  return mark;
}

std::optional<SurfacePoint> BrushTool::point_at(const Vec2f& place, const MouseInteraction::View& view) const {
  if (!is_on() || view.snapshot == nullptr) return {};
  const MouseInteraction::PickTarget under = MouseInteraction::pick(place, view);
  const std::vector<Vec3f>& positions = view.snapshot->frame.content.positions;
  // A pin is painted over as well.
  const auto point =
      under.pin ? pick_surface(*view.snapshot->render_mesh, positions, view.screen, place, 6 * view.unit) : under.point;
  if (!point || view.snapshot->render_mesh->bodies[point->vertices[0]] != subject.body) return {};
  return point;
}

bool BrushTool::handle(const MouseEvent& event, const MouseInteraction::View& view) {
  using Kind = MouseEvent::Kind;
  if (is_painting_) {
    if (event.kind == Kind::move) dab(event.place, view);
    if (event.kind == Kind::release && event.button == MouseButton::left) is_painting_ = false;
    return true;
  }
  const bool begins = event.kind == Kind::press && event.button == MouseButton::left && !event.control;
  if (!begins || !point_at(event.place, view)) return false;
  is_painting_ = true;
  erases_ = event.shift;
  goes_on_ = false;
  dab(event.place, view);
  return true;
}

void BrushTool::dab(const Vec2f& at, const MouseInteraction::View& view) {
  const auto point = point_at(at, view);
  if (!point) return;
  const std::vector<Vec3f>& positions = view.snapshot->frame.content.positions;
  for (const auto& [vertex, share] : brush_mark(*point, radius, *view.snapshot->render_mesh, positions)) {
    Real& waiting = waiting_[vertex];
    waiting = std::max(waiting, share);
  }
}

void BrushTool::flush(const MouseInteraction::View& view) {
  if (waiting_.empty() || view.live == nullptr || view.snapshot == nullptr || view.snapshot->commands < sent_) return;
  PaintDab sent;
  sent.factor = erases_ ? 1 : factor;
  for (const auto& [vertex, share] : waiting_) {
    sent.vertices.push_back(static_cast<Index>(vertex));
    sent.shares.push_back(share);
  }
  waiting_.clear();
  sent_ = post(view, LiveScene::Kind::changes,
               [group = subject.group, sent = std::move(sent), goes_on = goes_on_](Session& session) {
                 session.paint(group, sent, goes_on);
               });
  goes_on_ = true;
}

void BrushTool::cancel() {
  is_painting_ = false;
  waiting_.clear();
}

void BrushTool::draw(const Vec3f& point, const MouseInteraction::View& view, ImDrawList& list) const {
  const auto place = view.screen.place_of(point);
  if (!place) return;
  const float depth = view.screen.depth_of(point);
  const Vec3f beside = view.screen.point_at(*place + Vec2f(1, 0), depth);
  const float unit_length = (beside - view.screen.point_at(*place, depth)).norm();  // [m] of a unit of the mouse
  if (!(unit_length > 0)) return;
  const float size = radius / unit_length;
  const ImVec2 middle = {place->x(), place->y()};
  list.AddCircle(middle, size, IM_COL32(255, 255, 255, 200), 0, 4 * view.unit);
  list.AddCircle(middle, size, IM_COL32(40, 40, 44, 255), 0, 1.6F * view.unit);
}

}  // namespace pliant_viewer
