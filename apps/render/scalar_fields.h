#pragma once
// Scalar fields that colors can show: one value per vertex.
#include "pliant_io/scene/view_settings.h"
#include "render/render_mesh.h"

namespace pliant_render {

/// Mean of l/l₀ − 1 over the edges at each vertex: positive where they are longer than at rest.
std::vector<float> vertex_stretch(const RenderMesh& render_mesh, std::span<const Vec3f> positions);

/// Elastic energy of the constraints [J] at the simulation's positions, split equally between their vertices.
std::vector<float> vertex_energy(const pliant::Simulation& simulation);

/// Norms of the velocities [m/s].
std::vector<float> vertex_speed(const pliant::Positions& velocities);

/// The title of the legend.
std::string_view field_title(pliant::ColorBy color);

/// The ends of a color map for these values: from zero for fields that are never negative, symmetric about zero for
/// stretch.
std::array<float, 2> field_range(pliant::ColorBy color, std::span<const float> values);

/// RGB (sRGB) colors from the lowest value to the highest: lightness rising evenly for energy and speed, two hues
/// diverging from a light middle for stretch.
std::vector<std::array<std::uint8_t, 3>> color_map(pliant::ColorBy color);

}  // namespace pliant_render
