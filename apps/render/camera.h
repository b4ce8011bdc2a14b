#pragma once
// From the scene's camera to matrices, and the automatic camera.
#include <limits>
#include <vector>

#include "pliant_io/scene/view_settings.h"
#include "render/vectors.h"

namespace pliant_render {

/// An axis-aligned box around everything to be seen.
struct Bounds {
  Vec3f low = Vec3f::Constant(std::numeric_limits<float>::infinity());
  Vec3f high = -low;
  std::vector<Vec3f> outline{};  ///< points of what is in it that lie furthest out; none: the corners of the box

  void add(const Vec3f& point) {
    if (!point.allFinite()) return;  // beyond the range of single precision
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  bool is_empty() const { return !(low.x() <= high.x()); }
  Vec3f center() const { return (low + high) / 2; }
  float radius() const { return (high - low).norm() / 2; }
};

/// A camera with nothing left open.
struct Viewpoint {
  Vec3f eye = {0, -1, 0};      ///< [m]
  Vec3f target = {0, 0, 0};    ///< that the eye looks at [m]
  Vec3f up = {0, 0, 1};        ///< unit length, perpendicular to the direction of view
  float field_of_view = 0.7F;  ///< vertical [rad]
  float near = 0.01F;          ///< distance of the near plane [m]
  float far = 100;             ///< distance of the far plane [m]
  float inset = 0;             ///< fraction of the width left free on the right, for a legend; negative: on the left

  Vec3f forward() const { return (target - eye).normalized(); }
  Vec3f right() const { return forward().cross(up); }
  Mat4f view() const;
  /// aspect: width over height.
  Mat4f projection(float aspect) const;
};

/// Chooses what the scene leaves open so that the outline fits into the picture: the target at its center, the position
/// by azimuth and elevation, else in front and somewhat above, as far away as necessary; of a camera that turns, so far
/// that it stays in the picture all around. Keyframes are not looked at.
Viewpoint place_camera(const pliant::Camera& camera, const Bounds& bounds, float aspect, float inset = 0);

/// Moves the camera without turning it to where the outline just fits into the picture.
void fit_into_picture(Viewpoint& view, const Bounds& bounds, float aspect);
/// Chooses near and far planes that enclose the box and the ground around it, wherever the eye is.
void set_depth_range(Viewpoint& view, const Bounds& bounds);

}  // namespace pliant_render
