#include "viewer/brush_tool.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

namespace pliant_viewer {
namespace {

constexpr float dabs_a_radius = 3;
constexpr int most_dabs = 8;  // between two pictures

/// Units of the mouse that a length [m] at a point takes.
float shown_length(float length, const Vec3f& point, const Screen& screen) {
  const auto place = screen.place_of(point);
  if (!place) return 0;
  const float depth = screen.depth_of(point);
  const float unit = (screen.point_at(*place + Vec2f(1, 0), depth) - screen.point_at(*place, depth)).norm();
  return unit > 0 ? length / unit : 0;
}

}  // namespace

DrawnNeighbors::DrawnNeighbors(const pliant_render::RenderMesh& render_mesh) : begins_(render_mesh.bodies.size() + 1) {
  const auto for_each_edge = [&](auto&& visit) {
    for (const auto* list : {&render_mesh.edges, &render_mesh.ropes}) {
      for (std::size_t e = 0; e + 1 < list->size(); e += 2) visit((*list)[e], (*list)[e + 1]);
    }
  };
  for_each_edge([&](std::uint32_t a, std::uint32_t b) {
    ++begins_[a + 1];
    ++begins_[b + 1];
  });
  for (std::size_t v = 1; v < begins_.size(); ++v) begins_[v] += begins_[v - 1];
  list_.resize(begins_.back());
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  for_each_edge([&](std::uint32_t a, std::uint32_t b) {
    list_[next[a]++] = b;
    list_[next[b]++] = a;
  });
}

std::vector<std::pair<std::uint32_t, Real>> brush_mark(const SurfacePoint& point, float radius,
                                                       const DrawnNeighbors& neighbors,
                                                       std::span<const std::uint32_t> bodies,
                                                       std::span<const Vec3f> positions) {
  const Vec3f center = point.position(positions);
  const std::uint32_t nearest = point.nearest_vertex(positions);
  std::vector<std::pair<std::uint32_t, Real>> mark;
  std::vector<char> is_seen(bodies.size(), 0);
  const auto take = [&](std::uint32_t vertex) {
    is_seen[vertex] = 1;
    const auto way = static_cast<Real>((positions[vertex] - center).norm() / radius);
    if (!(way < 1) && vertex != nearest) return false;
    const Real rest = std::max<Real>(0, 1 - way * way);
    // The nearest one always, also of a coarse mesh under a fine brush.
    mark.emplace_back(vertex, vertex == nearest ? std::max<Real>(rest * rest, 0.1) : rest * rest);
    return true;
  };
  take(nearest);
  for (std::size_t i = 0; i < mark.size(); ++i) {
    for (const std::uint32_t next : neighbors.of(mark[i].first)) {
      if (is_seen[next] == 0) take(next);
    }
  }
  for (std::uint32_t v = 0; v < bodies.size(); ++v) {
    if (bodies[v] == bodies[nearest] && !neighbors.is_drawn(v) && is_seen[v] == 0) take(v);
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
    if (event.kind != Kind::wheel) mouse_ = event.place;
    if (event.kind == Kind::release && event.button == MouseButton::left) finish(view);
    return true;
  }
  const bool begins = event.kind == Kind::press && event.button == MouseButton::left && !event.control;
  if (!begins || !point_at(event.place, view)) return false;
  finish(view);
  is_painting_ = true;
  erases_ = event.shift;
  last_ = mouse_ = event.place;
  dab(event.place, view);
  return true;
}

void BrushTool::dab(const Vec2f& at, const MouseInteraction::View& view) {
  const auto point = point_at(at, view);
  if (!point) return;
  if (std::exchange(mesh_, view.snapshot->render_mesh) != view.snapshot->render_mesh) neighbors_.emplace(*mesh_);
  const std::vector<Vec3f>& positions = view.snapshot->frame.content.positions;
  for (const auto& [vertex, share] : brush_mark(*point, radius, *neighbors_, mesh_->bodies, positions)) {
    Real& waiting = waiting_[vertex];
    waiting = std::max(waiting, share);
  }
}

/// However fast the hand was, without gaps.
void BrushTool::paint_way(const MouseInteraction::View& view) {
  const float length = (mouse_ - last_).norm();
  if (!is_painting_ || !(length > 0)) return;
  const auto point = point_at(mouse_, view);
  const std::vector<Vec3f>& positions = view.snapshot->frame.content.positions;
  const float size = point ? shown_length(radius, point->position(positions), view.screen) : length;
  const int count =
      std::clamp(static_cast<int>(std::ceil(dabs_a_radius * length / std::max(size, 1.0F))), 1, most_dabs);
  for (int i = 1; i <= count; ++i) {
    const float share = static_cast<float>(i) / static_cast<float>(count);
    dab(last_ + share * (mouse_ - last_), view);
  }
  last_ = mouse_;
}

void BrushTool::flush(const MouseInteraction::View& view) {
  if (view.live == nullptr || view.snapshot == nullptr) return;
  paint_way(view);
  if (view.snapshot->commands >= sent_) send(view);
}

void BrushTool::finish(const MouseInteraction::View& view) {
  if (view.live == nullptr || view.snapshot == nullptr) return cancel();
  paint_way(view);
  send(view);
  is_painting_ = goes_on_ = false;
}

void BrushTool::send(const MouseInteraction::View& view) {
  if (waiting_.empty()) return;
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
  is_painting_ = goes_on_ = false;
  waiting_.clear();
}

void BrushTool::draw(const SurfacePoint& point, const MouseInteraction::View& view, ImDrawList& list) const {
  constexpr ImU32 halo = IM_COL32(255, 255, 255, 210), ink = IM_COL32(40, 40, 44, 255);
  const std::vector<Vec3f>& positions = view.snapshot->frame.content.positions;
  const Vec3f center = point.position(positions);
  const auto place = view.screen.place_of(center);
  const float size = shown_length(radius, center, view.screen);
  if (!place || !(size > 0)) return;
  const ImVec2 middle = {place->x(), place->y()};
  list.AddCircle(middle, size, halo, 0, 4 * view.unit);
  list.AddCircle(middle, size, ink, 0, 1.6F * view.unit);
  const auto& looks = view.snapshot->render_mesh->looks;
  const std::uint32_t nearest = point.nearest_vertex(positions);
  if (nearest >= looks.vertices.size()) return;
  const std::string text = fmt::format("× {:.3g}", std::pow(10.0F, looks.vertices[nearest].place.x()));
  const ImVec2 corner = {middle.x + 0.72F * size + 6 * view.unit, middle.y + 0.72F * size};
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  const float room = 4 * view.unit;
  list.AddRectFilled({corner.x - room, corner.y - room / 2},
                     {corner.x + extent.x + room, corner.y + extent.y + room / 2}, halo, room);
  list.AddText(corner, ink, text.c_str());
}

}  // namespace pliant_viewer
