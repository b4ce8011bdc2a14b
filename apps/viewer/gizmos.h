#pragma once
// What the mouse does, drawn on top of the picture: the spring of a pull, rings around pins.
#include "render/annotations.h"
#include "viewer/vertex_region.h"

namespace pliant_viewer {

/// A coil from a point of a body to the mouse.
void draw_spring(const Screen& screen, const Vec3f& from, const Vec3f& to, float unit, ImDrawList& list);

/// A ring around a vertex whose pin is under the mouse, dragged, or just being set or removed.
void draw_ring(const Screen& screen, const Vec3f& point, float unit, ImDrawList& list);

/// A dot on the vertex of a body that a click would pin.
void draw_grip(const Screen& screen, const Vec3f& point, float unit, ImDrawList& list);

/// A box or a lasso that is being drawn.
void draw_outline(const Outline& outline, float unit, ImDrawList& list);

}  // namespace pliant_viewer
