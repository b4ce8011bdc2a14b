#pragma once
// What selected vertices measure: where one is, how far two are apart, how much the edges between them are stretched.
#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "render/render_mesh.h"

namespace pliant_viewer {

using pliant_render::Vec3f;

struct SelectionMeasures {
  std::optional<Vec3f> position;                ///< of a single vertex [m]
  std::optional<Vec3f> between;                 ///< from the first of two to the second [m]
  std::optional<std::array<float, 2>> stretch;  ///< smallest and largest length of an edge by its length at rest
};

/// selected: ascending. The stretch is that of the edges at a single vertex, else of those between selected ones.
SelectionMeasures measure_selection(std::span<const std::uint32_t> selected,
                                    const pliant_render::RenderMesh& render_mesh, std::span<const Vec3f> positions);

/// A vertex as a scene file names it: its body and its number there.
struct VertexName {
  std::uint32_t body = 0;
  std::uint32_t number = 0;
};
VertexName name_of(std::uint32_t vertex, const pliant_render::RenderMesh& render_mesh);

/// What stands behind "on" in a scene file to act on these vertices, "[3, 4, 5]"; where they belong to several bodies,
/// a line for each, with its name before the list.
std::string scene_text_of(std::span<const std::uint32_t> selected, const pliant_render::RenderMesh& render_mesh,
                          const std::vector<std::string>& body_names);

}  // namespace pliant_viewer
