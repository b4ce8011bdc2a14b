#include "viewer/vertex_region.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>

namespace pliant_viewer {
namespace {

using pliant_render::RenderMesh;
using Neighbors = std::map<std::uint32_t, std::vector<std::uint32_t>>;

/// The triangles of a picture by where they are in it, to find what hides a point.
class HidingTriangles {
 public:
  explicit HidingTriangles(const Sight& sight) : sight_(sight) {
    const Vec2f& size = sight.screen.size;
    const auto count = static_cast<float>(std::max<std::size_t>(sight.render_mesh.triangles.size() / 3, 1));
    tile_size_ = std::clamp(std::sqrt(triangles_a_tile * size.x() * size.y() / count), 2.0F, 64.0F);
    columns_ = tiles_along(sight.screen.size.x());
    rows_ = tiles_along(sight.screen.size.y());
    tiles_.resize(static_cast<std::size_t>(columns_) * static_cast<std::size_t>(rows_));
    for (std::size_t t = 0; t + 2 < sight.render_mesh.triangles.size(); t += 3) add(t);
  }

  bool hide(std::uint32_t vertex, const Vec2f& place) const {
    const Screen::Ray ray = sight_.screen.ray(place);
    const float depth = sight_.screen.depth_of(sight_.positions[vertex]);
    const auto hides = [&](std::size_t t) {
      const std::array<std::uint32_t, 3> corners = corners_of(t);
      if (std::ranges::find(corners, vertex) != corners.end()) return false;
      const auto& x = sight_.positions;
      const auto hit = meet(ray, x[corners[0]], x[corners[1]], x[corners[2]]);
      constexpr double slack = 1e-4;  // of the depth: sewn panels have vertices in the same place
      return hit && hit->depth < (1 - slack) * static_cast<double>(depth);
    };
    return std::ranges::any_of(at(tile(place.x(), columns_), tile(place.y(), rows_)), hides) ||
           std::ranges::any_of(everywhere_, hides);
  }

 private:
  static constexpr float triangles_a_tile = 4;  // if they filled the picture evenly

  int tiles_along(float size) const { return std::max(1, static_cast<int>(std::ceil(size / tile_size_))); }
  int tile(float place, int count) const {
    return static_cast<int>(std::clamp(std::floor(place / tile_size_), 0.0F, static_cast<float>(count - 1)));
  }
  const std::vector<std::size_t>& at(int column, int row) const {
    return tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) +
                  static_cast<std::size_t>(column)];
  }
  std::array<std::uint32_t, 3> corners_of(std::size_t t) const {
    const std::vector<std::uint32_t>& triangles = sight_.render_mesh.triangles;
    return {triangles[t], triangles[t + 1], triangles[t + 2]};
  }

  void add(std::size_t t) {
    Vec2f low = Vec2f::Constant(1e30F), high = -low;
    int behind = 0;
    for (const std::uint32_t vertex : corners_of(t)) {
      const auto place = sight_.screen.place_of(sight_.positions[vertex]);
      if (!place) {
        ++behind;
        continue;
      }
      low = low.cwiseMin(*place);
      high = high.cwiseMax(*place);
    }
    if (behind == 3) return;
    if (behind > 0) return everywhere_.push_back(t);
    const Vec2f& size = sight_.screen.size;
    if (!(high.x() >= 0 && high.y() >= 0 && low.x() <= size.x() && low.y() <= size.y())) return;
    for (int row = tile(low.y(), rows_); row <= tile(high.y(), rows_); ++row) {
      for (int column = tile(low.x(), columns_); column <= tile(high.x(), columns_); ++column) {
        tiles_[static_cast<std::size_t>(row) * static_cast<std::size_t>(columns_) + static_cast<std::size_t>(column)]
            .push_back(t);
      }
    }
  }

  Sight sight_;
  float tile_size_ = 16;  // units of the mouse
  int columns_ = 1, rows_ = 1;
  std::vector<std::vector<std::size_t>> tiles_;  // first corners of triangles
  std::vector<std::size_t> everywhere_;
};

void join(Neighbors& neighbors, std::uint32_t a, std::uint32_t b) {
  neighbors[a].push_back(b);
  neighbors[b].push_back(a);
}

/// Along edges that belong to one triangle only.
Neighbors border_neighbors(const RenderMesh& render_mesh) {
  std::vector<std::array<std::uint32_t, 2>> edges;
  for (std::size_t t = 0; t + 2 < render_mesh.triangles.size(); t += 3) {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::uint32_t a = render_mesh.triangles[t + i], b = render_mesh.triangles[t + (i + 1) % 3];
      edges.push_back({std::min(a, b), std::max(a, b)});
    }
  }
  std::ranges::sort(edges);
  Neighbors neighbors;
  for (auto first = edges.begin(); first != edges.end();) {
    const auto last = std::find_if(first, edges.end(), [&](const auto& edge) { return edge != *first; });
    if (last - first == 1) join(neighbors, (*first)[0], (*first)[1]);
    first = last;
  }
  return neighbors;
}

std::vector<std::uint32_t> connected(const Neighbors& neighbors, std::uint32_t vertex) {
  std::set<std::uint32_t> reached = {vertex};
  std::vector<std::uint32_t> open = {vertex};
  while (!open.empty()) {
    const std::uint32_t here = open.back();
    open.pop_back();
    for (const std::uint32_t next : neighbors.at(here)) {
      if (reached.insert(next).second) open.push_back(next);
    }
  }
  return {reached.begin(), reached.end()};
}

}  // namespace

std::vector<std::uint32_t> drawn_vertices(const RenderMesh& render_mesh) {
  std::vector<std::uint32_t> vertices = render_mesh.triangles;
  vertices.insert(vertices.end(), render_mesh.ropes.begin(), render_mesh.ropes.end());
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

Outline box_between(const Vec2f& a, const Vec2f& b) {
  return {a, {b.x(), a.y()}, b, {a.x(), b.y()}};
}

bool contains(const Outline& outline, const Vec2f& place) {
  bool is_inside = false;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec2f& a = outline[i];
    const Vec2f& b = outline[(i + 1) % outline.size()];
    if ((a.y() > place.y()) == (b.y() > place.y())) continue;
    const float crossing = a.x() + (place.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x());
    if (place.x() < crossing) is_inside = !is_inside;
  }
  return is_inside;
}

std::vector<std::uint32_t> vertices_inside(const Outline& outline, const Sight& sight, bool sees_through) {
  std::optional<HidingTriangles> triangles;
  if (!sees_through) triangles.emplace(sight);
  std::vector<std::uint32_t> found;
  for (const std::uint32_t vertex : drawn_vertices(sight.render_mesh)) {
    const auto place = sight.screen.place_of(sight.positions[vertex]);
    if (!place || !contains(outline, *place)) continue;
    const bool is_seen = sees_through || (!triangles->hide(vertex, *place) &&
                                          !is_behind_collider(sight.colliders, sight.screen, sight.positions[vertex]));
    if (is_seen) found.push_back(vertex);
  }
  return found;
}

std::vector<std::uint32_t> border_at(const RenderMesh& render_mesh, std::span<const Vec3f> positions,
                                     std::uint32_t vertex) {
  Neighbors ropes;
  for (std::size_t r = 0; r + 1 < render_mesh.ropes.size(); r += 2) {
    join(ropes, render_mesh.ropes[r], render_mesh.ropes[r + 1]);
  }
  if (ropes.contains(vertex)) return connected(ropes, vertex);
  const Neighbors border = border_neighbors(render_mesh);
  if (border.contains(vertex)) return connected(border, vertex);
  std::optional<std::uint32_t> nearest;
  for (const auto& [candidate, unused] : border) {
    if (render_mesh.bodies[candidate] != render_mesh.bodies[vertex]) continue;
    const auto distance = [&](std::uint32_t other) { return (positions[other] - positions[vertex]).norm(); };
    if (!nearest || distance(candidate) < distance(*nearest)) nearest = candidate;
  }
  if (!nearest) return {};
  return connected(border, *nearest);
}

}  // namespace pliant_viewer
