#pragma once
// Scalar fields that colors can show: one value per vertex.
#include "pliant_io/scene/view_settings.h"
#include "render/render_mesh.h"

namespace pliant_render {

/// Mean of l/l₀ − 1 over the edges at each vertex: positive where they are longer than at rest.
std::vector<float> vertex_stretch(const RenderMesh& render_mesh, std::span<const Vec3f> positions);

/// Elastic energy of the constraints [J] at the simulation's positions, split equally between their vertices.
/// What a lattice carries has that of the lattice at its place.
std::vector<float> vertex_energy(const pliant::Simulation& simulation);

/// Norms of the velocities [m/s].
std::vector<float> vertex_speed(const pliant::Positions& velocities);

/// From each vertex to the nearest of what pushes it [m], or where nothing does its contact distance.
std::vector<float> vertex_gap(const pliant::Simulation& simulation);

/// Norms of the forces that colliders and surfaces exert on each vertex [N].
std::vector<float> vertex_contact_force(const pliant::Simulation& simulation);

/// Whether the positions of a recorded run say the values; those of others only a simulation knows.
bool is_known_of_runs(pliant::ColorBy color);

/// Refuses a color that a recorded run does not say. Throws pliant::Error (input).
void check_known_of_runs(pliant::ColorBy color);

/// The title of the legend, and what values are multiplied by there.
std::string_view field_title(pliant::ColorBy color);
float field_scale(pliant::ColorBy color);

/// The ends of a color map for these values: from zero for fields that are never negative, symmetric about zero for
/// stretch; up to the median of those above zero for forces of contact, since impacts are short and far larger.
std::array<float, 2> field_range(pliant::ColorBy color, std::span<const float> values);

/// RGB (sRGB) colors from the lowest value to the highest: two hues diverging from a light middle for stretch,
/// lightness rising evenly for all others.
std::vector<std::array<std::uint8_t, 3>> color_map(pliant::ColorBy color);

}  // namespace pliant_render
