#include "viewer/orbit_camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>

namespace pliant_viewer {
namespace {

constexpr float turn_a_height = 1.2F * std::numbers::pi_v<float>;  // [rad]
constexpr float tilt_a_height = 0.7F * std::numbers::pi_v<float>;  // [rad]
constexpr float clearance = 0.02F;                                 // of the distance, over the floor
constexpr float steepest = 0.49F * std::numbers::pi_v<float>;      // of the view, from the horizon [rad]
constexpr float least_distance = 1e-4F;                            // [m]
constexpr float largest_distance = 1e7F;                           // [m]

}  // namespace

OrbitCamera::OrbitCamera(const pliant_render::Viewpoint& viewpoint, const Vec3f& up)
    : viewpoint_(viewpoint), axis_(up.normalized()) {}

void OrbitCamera::orbit(const Vec2f& by, std::optional<float> floor) {
  const Vec3f forward = viewpoint_.forward();
  const float height = std::asin(std::clamp(-forward.dot(axis_), -1.0F, 1.0F));  // of the eye over the horizon
  const float distance = (viewpoint_.target - viewpoint_.eye).norm();
  float lowest = -steepest;
  if (floor) {
    const float below = (*floor - viewpoint_.target.dot(axis_)) / std::max(distance, least_distance);
    lowest = std::max(lowest, std::asin(std::clamp(below + clearance, -1.0F, 1.0F)));
  }
  lowest = std::min(lowest, height);
  const float turned = std::clamp(height + by.y() * tilt_a_height, lowest, std::max(steepest, height));
  const Eigen::AngleAxisf sideways(-by.x() * turn_a_height, axis_);
  const Eigen::AngleAxisf upwards(-(turned - height), viewpoint_.right().normalized());
  const Vec3f new_forward = (sideways * (upwards * forward)).normalized();
  const Vec3f new_up = sideways * (upwards * viewpoint_.up);
  viewpoint_.eye = viewpoint_.target - distance * new_forward;
  viewpoint_.up = (new_up - new_up.dot(new_forward) * new_forward).normalized();
}

void OrbitCamera::pan(const Vec2f& by) {
  const float distance = (viewpoint_.target - viewpoint_.eye).norm();
  const float height = 2 * distance * std::tan(viewpoint_.field_of_view / 2);
  const Vec3f shift = height * (by.y() * viewpoint_.up - by.x() * viewpoint_.right());
  viewpoint_.eye += shift;
  viewpoint_.target += shift;
}

void OrbitCamera::zoom(float factor) {
  const Vec3f forward = viewpoint_.forward();
  const float distance = (viewpoint_.target - viewpoint_.eye).norm() * factor;
  viewpoint_.eye = viewpoint_.target - std::clamp(distance, least_distance, largest_distance) * forward;
}

void OrbitCamera::frame(const pliant_render::Bounds& bounds, float aspect, float inset) {
  if (bounds.is_empty()) return;
  viewpoint_.inset = inset;
  fit_into_picture(viewpoint_, bounds, aspect);
}

pliant_render::Viewpoint OrbitCamera::viewpoint(const pliant_render::Bounds& bounds, float inset) const {
  pliant_render::Viewpoint view = viewpoint_;
  view.inset = inset;
  if (!bounds.is_empty()) set_depth_range(view, bounds);
  return view;
}

pliant::Camera OrbitCamera::placed() const {
  // A tenth of a millimeter is more than can be seen.
  const auto rounded = [](const Vec3f& point) {
    return pliant::Vec3((point.cast<double>() * 1e4).array().round() / 1e4);
  };
  pliant::Camera camera;
  camera.position = rounded(viewpoint_.eye);
  camera.target = rounded(viewpoint_.target);
  camera.up = axis_.cast<double>();
  camera.field_of_view = std::round(viewpoint_.field_of_view * 1800 / std::numbers::pi_v<float>) / 10;
  return camera;
}

bool OrbitCamera::is_like(const OrbitCamera& other) const {
  return viewpoint_.eye == other.viewpoint_.eye && viewpoint_.target == other.viewpoint_.target;
}

}  // namespace pliant_viewer
