#pragma once
// Where the camera is at each time of a film.
#include "pliant_io/scene/camera.h"
#include "render/camera.h"

namespace pliant_render {

/// The scene's camera over time: it stands, or turns about its target, or goes through keyframes by a curve that does
/// not swing past them; before the first and after the last it stands still.
class CameraPath {
 public:
  /// bounds: what fits into the picture where the scene leaves the place open; aspect: width over height; inset: see
  /// Viewpoint.
  CameraPath(pliant::Camera camera, const Bounds& bounds, float aspect, float inset = 0);

  /// time: simulated [s].
  Viewpoint at(pliant::Real time) const;

 private:
  pliant::Camera camera_;
  Bounds bounds_;
  float aspect_, inset_;
  Viewpoint start_;
};

}  // namespace pliant_render
