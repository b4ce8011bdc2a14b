#pragma once
// From which side a scene shows most.
#include <span>

#include "render/render_mesh.h"

namespace pliant_render {

/// Gives a camera whose place is open the azimuth and elevation, of eight three-quarter views, from which most of
/// the free bodies is seen in the mean of these frames, each body counting alike; all others are returned as they are.
/// What stands before a body hides it. bounds, aspect: see CameraPath.
pliant::Camera choose_direction(pliant::Camera camera, const RenderMesh& render_mesh,
                                std::span<const FrameContent> frames, const Bounds& bounds, float aspect);

}  // namespace pliant_render
