#pragma once
// From the scene's camera to matrices, and the automatic one.
#include "pliant_io/scene/view_settings.h"
#include "render/gl_objects.h"

namespace pliant_render {

/// The smallest box along the axes around everything that shall be seen.
struct Bounds {
  Vec3f low = Vec3f::Constant(std::numeric_limits<float>::infinity());
  Vec3f high = -low;

  void add(const Vec3f& point) {
    if (!point.allFinite()) return;  // past what single precision holds
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  bool is_empty() const { return !(low.x() <= high.x()); }
  Vec3f center() const { return (low + high) / 2; }
  float radius() const { return (high - low).norm() / 2; }
};

/// A camera with everything decided.
struct Viewpoint {
  Vec3f eye = {0, -1, 0};
  Vec3f target = {0, 0, 0};
  Vec3f up = {0, 0, 1};        ///< at right angles to the direction of view, of length 1
  float field_of_view = 0.7F;  ///< from the lower edge of the picture to the upper [rad]
  float near = 0.01F;
  float far = 100;
  float inset = 0;  ///< share of the width that is left free on the right, for a legend; negative: on the left

  Vec3f forward() const { return (target - eye).normalized(); }
  Vec3f right() const { return forward().cross(up); }
  Mat4f view() const;
  /// aspect: width over height.
  Mat4f projection(float aspect) const;
};

/// What the scene leaves open is chosen so that the box is in the picture: a target in its middle, a position in front
/// of it and somewhat above, as far away as it needs.
Viewpoint place_camera(const pliant::Camera& camera, const Bounds& bounds, float aspect, float inset = 0);

/// Moves the camera, without turning it, to where the box just fits into the picture.
void fit_into_picture(Viewpoint& view, const Bounds& bounds, float aspect);
/// Chooses near and far so that the box and the ground about it are between them, wherever the eye is.
void set_depth_range(Viewpoint& view, const Bounds& bounds);

}  // namespace pliant_render
