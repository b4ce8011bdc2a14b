#pragma once
// What a simulation looks like at one moment.
#include <optional>
#include <vector>

#include "pliant_io/scene/scene.h"
#include "render/annotations.h"
#include "render/render_mesh.h"

namespace pliant_render {

struct ClipFrame {
  pliant::Real time = 0;               ///< [s]
  FrameContent content;                ///< positions, values and markers
  std::optional<WindAnnotation> wind;  ///< none where no wind blows
};

/// Of the bodies as they are held now, see make_render_mesh of the bodies.
RenderMesh make_render_mesh(const pliant::Simulation& simulation);
/// The same with what bodies look like.
RenderMesh make_render_mesh(const pliant::Scene& scene);

/// A frame of the current state of the simulation. Whoever takes many keeps the surfaces of the colliders for the next.
ClipFrame capture_frame(const pliant::Simulation& simulation, const RenderMesh& render_mesh, pliant::ColorBy color,
                        ColliderSurfaces& surfaces);
ClipFrame capture_frame(const pliant::Simulation& simulation, const RenderMesh& render_mesh, pliant::ColorBy color);

// The parts of such a frame:
/// Vertices that are pinned, or under a test force at that step, ascending.
std::vector<std::uint32_t> find_markers(const pliant::Simulation& simulation, std::int64_t step);
/// Vertices of bodies that are held as a whole, ascending.
std::vector<std::uint32_t> find_held(const pliant::Simulation& simulation);
/// The first wind that blows.
std::optional<WindAnnotation> find_wind(const pliant::Simulation& simulation);

}  // namespace pliant_render
