#include "viewer/select_tool.h"

#include <algorithm>
#include <iterator>

namespace pliant_viewer {
namespace {

constexpr float drag_slack = 4;            // units the mouse may move during a click
constexpr float least_step = 3;            // units between places of a lasso
constexpr double double_click_time = 0.4;  // [s]

}  // namespace

bool SelectTool::handle(const MouseEvent& event, const MouseInteraction::View& view) {
  const bool is_left = event.button == MouseButton::left;
  if (event.kind == MouseEvent::Kind::press && !is_pressed_) {
    if (!is_left || !event.control || view.live == nullptr || view.snapshot->render_mesh == nullptr) return false;
    is_pressed_ = true;
    is_drag_ = false;
    takes_away_ = event.shift;
    path_ = {event.place};
    return true;
  }
  if (!is_pressed_) return false;
  if (event.kind == MouseEvent::Kind::move) {
    is_drag_ = is_drag_ || (event.place - path_.front()).norm() > drag_slack * view.unit;
    if ((event.place - path_.back()).norm() >= least_step * view.unit) path_.push_back(event.place);
  } else if (event.kind == MouseEvent::Kind::release && is_left) {
    is_pressed_ = false;
    release(event.place, view);
  }
  return true;
}

Outline SelectTool::outline() const {
  if (!is_pressed_ || !is_drag_) return {};
  return draws_lasso ? path_ : box_between(path_.front(), path_.back());
}

void SelectTool::release(const Vec2f& at, const MouseInteraction::View& view) {
  if (!is_drag_) return click(path_.front(), view);
  path_.push_back(at);
  const pliant_render::FrameContent& frame = view.snapshot->frame.content;
  const Sight sight{view.screen, *view.snapshot->render_mesh, frame.positions, {}};
  Sight seen = sight;
  if (view.shows_colliders) seen.colliders = frame.colliders;
  const auto inside =
      vertices_inside(draws_lasso ? path_ : box_between(path_.front(), path_.back()), seen, sees_through);
  if (takes_away_) {
    take_away(inside);
  } else {
    add(inside);
  }
}

/// One click selects a vertex or no longer, a second one the border or the rope in place of it.
void SelectTool::click(const Vec2f& at, const MouseInteraction::View& view) {
  const std::span<const Vec3f> positions = view.snapshot->frame.content.positions;
  const MouseInteraction::PickTarget target = MouseInteraction::pick(at, view);
  std::optional<std::uint32_t> vertex = target.pin;
  if (!vertex && target.point) vertex = target.point->nearest_vertex(positions);
  const Clock::time_point now = Clock::now();
  const bool is_second =
      now - last_click_time_ < Seconds(double_click_time) && (at - last_click_).norm() <= drag_slack * view.unit;
  last_click_ = at;
  last_click_time_ = is_second ? Clock::time_point{} : now;
  if (!vertex) {
    if (!takes_away_) clear();
    return;
  }
  if (!is_second) {
    before_click_ = selected_;
    if (std::ranges::binary_search(selected_, *vertex) || takes_away_) {
      take_away({*vertex});
    } else {
      add({*vertex});
    }
    return;
  }
  select(before_click_);
  const auto border = border_at(*view.snapshot->render_mesh, positions, *vertex);
  if (border.empty()) message_ = "this surface is closed: it has no border to select";
  if (takes_away_) {
    take_away(border);
  } else {
    add(border);
  }
}

void SelectTool::select(std::vector<std::uint32_t> vertices) {
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  selected_ = std::move(vertices);
  ++version_;
}

void SelectTool::add(const std::vector<std::uint32_t>& vertices) {
  std::vector<std::uint32_t> all = selected_;
  all.insert(all.end(), vertices.begin(), vertices.end());
  select(std::move(all));
}

void SelectTool::take_away(const std::vector<std::uint32_t>& vertices) {
  std::vector<std::uint32_t> rest;
  std::ranges::set_difference(selected_, vertices, std::back_inserter(rest));
  select(std::move(rest));
}

void SelectTool::select_all(const pliant_render::RenderMesh& render_mesh) {
  select(drawn_vertices(render_mesh));
}

void SelectTool::grow(const pliant_render::RenderMesh& render_mesh) {
  std::vector<std::uint32_t> grown = selected_;
  const auto is_in = [this](std::uint32_t vertex) { return std::ranges::binary_search(selected_, vertex); };
  for (const std::vector<std::uint32_t>* edges : {&render_mesh.edges, &render_mesh.ropes}) {
    for (std::size_t e = 0; e + 1 < edges->size(); e += 2) {
      if (is_in((*edges)[e])) grown.push_back((*edges)[e + 1]);
      if (is_in((*edges)[e + 1])) grown.push_back((*edges)[e]);
    }
  }
  select(std::move(grown));
}

void SelectTool::restart(std::size_t vertex_count) {
  is_pressed_ = false;
  before_click_.clear();
  last_click_time_ = {};
  std::erase_if(selected_, [&](std::uint32_t vertex) { return vertex >= vertex_count; });
  ++version_;
}

}  // namespace pliant_viewer
