#pragma once
// Which vertices are meant by a line drawn around them, or by the border of a surface.
#include <span>
#include <vector>

#include "viewer/picking.h"

namespace pliant_viewer {

/// A closed line on the screen, in units of the mouse; the last place is joined to the first.
using Outline = std::vector<Vec2f>;

/// The four corners of a box.
Outline box_between(const Vec2f& a, const Vec2f& b);
/// Whether a place is inside, by the number of times that the line goes around it, even or odd.
bool contains(const Outline& outline, const Vec2f& place);

/// A picture with what is seen in it.
struct Sight {
  const Screen& screen;
  const pliant_render::RenderMesh& render_mesh;
  std::span<const Vec3f> positions;
  std::span<const pliant_render::DrawnCollider> colliders = {};  ///< those that are shown
};

/// Those of triangles and ropes, ascending.
std::vector<std::uint32_t> drawn_vertices(const pliant_render::RenderMesh& render_mesh);

/// The drawn vertices that appear inside the outline, ascending. `sees_through`: also those behind surfaces and
/// colliders. Lattices of solids that have a surface of their own are not drawn.
std::vector<std::uint32_t> vertices_inside(const Outline& outline, const Sight& sight, bool sees_through);

/// The vertices of the rope or, of a surface, the border that the vertex belongs to, ascending; of a vertex inside a
/// surface that of the border nearest to it. Empty where the surface is closed.
std::vector<std::uint32_t> border_at(const pliant_render::RenderMesh& render_mesh, std::span<const Vec3f> positions,
                                     std::uint32_t vertex);

}  // namespace pliant_viewer
