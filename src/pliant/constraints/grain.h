#pragma once
// Which way the threads of a cloth run in each of its triangles.
#include <vector>

#include "pliant/constraints/constraint_set.h"

namespace pliant {

/// What directions follow from where none is given.
enum class Grain { automatic, uv, edge };
constexpr std::array<std::string_view, 3> choice_names(Grain) {
  return {"automatic", "uv", "edge"};
}

/// The direction of the warp in each of these triangles of the body: a unit vector in the frame that `rest_triangle`
/// has (x along x₁ − x₀, y in the plane of the triangle, to the left of it).
///
/// `direction`, one for all or one for each triangle, is laid into the plane of the triangle. Where there is none:
/// `uv`: the way in which v of the texture coordinates grows; `edge`: from the first vertex to the second; `automatic`:
/// by v where a triangle has texture coordinates, else by the axis of space that lies best in the whole surface (z
/// before x before y where they lie alike), or the next best where that is nearly normal to a triangle.
///
/// Throws Error(input), naming `type`, body and triangle, on a direction that is zero or normal to a triangle, on lists
/// of the wrong length, and with `uv` on a triangle whose texture coordinates are missing or have no area.
std::vector<Vec2> warp_directions(std::string_view type, const BodyView& body, const Stencils& triangles,
                                  const Points& direction, Grain grain);

}  // namespace pliant
