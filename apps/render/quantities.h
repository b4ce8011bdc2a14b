#pragma once
// What colors tell: a number for each vertex.
#include "pliant_io/scene/view_settings.h"
#include "render/scenery.h"

namespace pliant_render {

/// Mean of |l/l₀ − 1| of the edges at each vertex, signed by what prevails: positive where they are longer than at
/// rest.
std::vector<float> vertex_stretch(const Scenery& scenery, std::span<const Vec3f> positions);

/// Elastic energy of the constraints [J], in equal parts to their vertices, at the positions of the simulation.
std::vector<float> vertex_energy(const pliant::Simulation& simulation);

/// ‖v‖ [m/s].
std::vector<float> vertex_speed(const pliant::Positions& velocities);

/// What stands beside the color map.
std::string_view quantity_title(pliant::ColorBy color);

/// The ends of a color map for these values: from zero for quantities that are never negative, and symmetric about it
/// for stretch.
std::array<float, 2> quantity_range(pliant::ColorBy color, std::span<const float> values);

/// Colors from the lowest value to the highest, RGB (sRGB): even steps of lightness for energy and speed, two hues
/// away from a light middle for stretch.
std::vector<std::array<std::uint8_t, 3>> color_map(pliant::ColorBy color);

}  // namespace pliant_render
