#pragma once
// A camera that is led by the mouse.
#include "viewer/picking.h"

namespace pliant_viewer {

class OrbitCamera {
 public:
  /// up: direction about which it orbits, and which stays upright.
  OrbitCamera(const pliant_render::Viewpoint& viewpoint, const Vec3f& up);

  /// Turns about the target: `by` in shares of the height of the picture, to the right and down.
  /// The eye does not go below `floor`, a height along the up direction, unless it is there already.
  void orbit(const Vec2f& by, std::optional<float> floor = {});
  /// Moves sideways, so that what is at the depth of the target keeps under the mouse; in shares of the height.
  void pan(const Vec2f& by);
  /// Goes to `factor` times the distance from the target, > 0.
  void zoom(float factor);
  /// Goes to where the box fits into the picture.
  void frame(const pliant_render::Bounds& bounds, float aspect, float inset);

  /// The viewpoint with near and far for a box, and room on the left or the right (Viewpoint::inset).
  pliant_render::Viewpoint viewpoint(const pliant_render::Bounds& bounds, float inset) const;

 private:
  pliant_render::Viewpoint viewpoint_;
  Vec3f axis_;
};

}  // namespace pliant_viewer
