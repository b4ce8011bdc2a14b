#include "pliant_io/mesh/detail/polygon_builder.h"

#include <algorithm>

#include <fmt/format.h>

namespace pliant {

PolygonBuilder::PolygonBuilder(Mesh& mesh, std::uint64_t file_size, Index first_index)
    : mesh_(mesh), max_corners_(std::min(max_index_count, (1 << 20) + file_size / 2)), first_index_(first_index) {
  mesh_.faces.offsets.assign(1, 0);
}

void PolygonBuilder::reserve(std::uint64_t faces, std::uint64_t corners) {
  const std::uint64_t triangles = corners - std::min(corners, 2 * faces);
  mesh_.faces.offsets.reserve(static_cast<std::size_t>(std::min(faces, max_corners_ / 3)) + 1);
  mesh_.faces.vertices.reserve(static_cast<std::size_t>(std::min(corners, max_corners_ + 256)));
  mesh_.triangles.reserve(static_cast<std::size_t>(std::min(triangles, max_corners_)));
}

void PolygonBuilder::add_corner(Index vertex, Index texture) {
  if (texture >= 0 && !has_texture_) {
    has_texture_ = true;
    mesh_.faces.texture_coordinates.reserve(mesh_.faces.vertices.capacity());
    mesh_.faces.texture_coordinates.assign(mesh_.faces.vertices.size(), -1);
  }
  mesh_.faces.vertices.push_back(vertex);
  if (has_texture_) mesh_.faces.texture_coordinates.push_back(texture);
}

void PolygonBuilder::drop_corners() {
  mesh_.faces.vertices.resize(first_corner_);
  if (has_texture_) mesh_.faces.texture_coordinates.resize(first_corner_);
}

std::string PolygonBuilder::finish_face() {
  const auto face = corners();
  if (face.size() < 3) return fmt::format("a face with {} corners; give it at least 3", face.size());
  if (std::string repeated = repeated_corner(); !repeated.empty()) return repeated;
  if (mesh_.faces.vertices.size() > max_corners_) {
    return fmt::format("more than {} face corners, which a file of this size cannot hold; cut the mesh up",
                       max_corners_);
  }
  for (std::size_t i = 2; i < face.size(); ++i) mesh_.triangles.push_back({face[0], face[i - 1], face[i]});
  first_corner_ = mesh_.faces.vertices.size();
  mesh_.faces.offsets.push_back(static_cast<Index>(first_corner_));
  return {};
}

std::string PolygonBuilder::repeated_corner() {
  const auto face = corners();
  const auto message = [&](Index vertex) {
    return fmt::format("a face with vertex {} at two corners; remove one", vertex + std::int64_t{first_index_});
  };
  if (face.size() == 3) {
    if (face[0] == face[1] || face[0] == face[2]) return message(face[0]);
    return face[1] == face[2] ? message(face[1]) : std::string();
  }
  sorted_corners_.assign(face.begin(), face.end());
  std::ranges::sort(sorted_corners_);
  const auto repeated = std::ranges::adjacent_find(sorted_corners_);
  return repeated == sorted_corners_.end() ? std::string() : message(*repeated);
}

void PolygonBuilder::finish() {
  drop_corners();
  if (mesh_.faces.vertices.empty()) mesh_.faces.offsets.clear();
}

}  // namespace pliant
