#pragma once
// What the mouse does, drawn onto the picture: the spring of a pull, rings about pins.
#include "render/signs.h"
#include "viewer/picking.h"

namespace pliant_viewer {

/// A coil from a point of a body to the mouse.
void draw_spring(const Screen& screen, const Vec3f& from, const Vec3f& to, float unit, ImDrawList& list);

/// A ring about a vertex: what a click would do, or has done.
void draw_ring(const Screen& screen, const Vec3f& point, float unit, ImDrawList& list);

}  // namespace pliant_viewer
