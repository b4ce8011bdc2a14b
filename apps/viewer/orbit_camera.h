#pragma once
// A camera that the mouse moves.
#include "viewer/picking.h"

namespace pliant_viewer {

class OrbitCamera {
 public:
  /// up: the axis of the orbit, which stays upright in the picture.
  OrbitCamera(const pliant_render::Viewpoint& viewpoint, const Vec3f& up);

  /// Orbits the target; `by` is the motion of the mouse to the right and down, in fractions of the picture height.
  /// The eye does not go below `floor` [m], a height along the up direction, unless it is there already.
  void orbit(const Vec2f& by, std::optional<float> floor = {});
  /// Moves sideways, so that points at the depth of the target stay under the mouse; in fractions of the height.
  void pan(const Vec2f& by);
  /// Multiplies the distance from the target by `factor`, > 0.
  void zoom(float factor);
  /// Moves to where the box fits into the picture; `inset` as in Viewpoint.
  void frame(const pliant_render::Bounds& bounds, float aspect, float inset);

  /// Where it stands, for a scene file.
  pliant::Camera placed() const;
  /// Whether both see the same.
  bool is_like(const OrbitCamera& other) const;

  /// The viewpoint, with near and far planes chosen for the box; `inset` as in Viewpoint.
  pliant_render::Viewpoint viewpoint(const pliant_render::Bounds& bounds, float inset) const;

 private:
  pliant_render::Viewpoint viewpoint_;
  Vec3f axis_;
};

}  // namespace pliant_viewer
