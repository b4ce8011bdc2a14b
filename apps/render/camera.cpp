#include "render/camera.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

namespace pliant_render {
namespace {

constexpr float picture_margin = 1.12F;  // of the picture around what is in it
// From the front, somewhat from the right and from above [degrees].
constexpr pliant::Real default_azimuth = 24.2, default_elevation = 21;

Vec3f to_float(const pliant::Vec3& x) {
  return x.cast<float>();
}

/// Any vector at right angles to `direction`, as near to `up` as can be.
Vec3f upright(const Vec3f& up, const Vec3f& direction) {
  Vec3f result = up - up.dot(direction) * direction;
  if (result.norm() < 1e-4F * up.norm()) result = direction.cross(Vec3f(direction.z(), direction.x(), direction.y()));
  return result.normalized();
}

/// What has to fit into the picture. A single point has no room around it.
std::vector<Vec3f> points_of(const Bounds& given) {
  if (!given.outline.empty() && given.radius() > 0) return given.outline;
  Bounds bounds = given;
  bounds.add(bounds.center() + Vec3f::Constant(1e-3F));
  std::vector<Vec3f> corners;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3f& p = corners.emplace_back(bounds.low);
    for (int axis = 0; axis < 3; ++axis) {
      if ((corner >> axis & 1) != 0) p[axis] = bounds.high[axis];
    }
  }
  return corners;
}

/// Where points get to that turn about an axis.
std::vector<Vec3f> turned_around(const std::vector<Vec3f>& points, const Vec3f& center, const Vec3f& axis) {
  constexpr int parts = 72;
  std::vector<Vec3f> swept;
  for (int part = 0; part < parts; ++part) {
    const auto angle = static_cast<float>(2 * std::numbers::pi * part / parts);
    const Eigen::Matrix3f turn = Eigen::AngleAxisf(angle, axis).toRotationMatrix();
    for (const Vec3f& point : points) swept.emplace_back(center + turn * (point - center));
  }
  return swept;
}

/// The nearest eye that sees all points in this direction: each edge of the picture asks for a distance.
Vec3f fit(const std::vector<Vec3f>& points, const Vec3f& forward, const Vec3f& up, float tan_x, float tan_y) {
  const Vec3f right = forward.cross(up);
  constexpr float lowest = -std::numeric_limits<float>::infinity();
  float left_edge = lowest, right_edge = lowest, lower_edge = lowest, upper_edge = lowest;
  for (const Vec3f& p : points) {
    const float x = p.dot(right), y = p.dot(up), depth = p.dot(forward);
    right_edge = std::max(right_edge, x - tan_x * depth);
    left_edge = std::max(left_edge, -x - tan_x * depth);
    upper_edge = std::max(upper_edge, y - tan_y * depth);
    lower_edge = std::max(lower_edge, -y - tan_y * depth);
  }
  const float depth = std::min(-(right_edge + left_edge) / (2 * tan_x), -(upper_edge + lower_edge) / (2 * tan_y));
  return (right_edge - left_edge) / 2 * right + (upper_edge - lower_edge) / 2 * up + depth * forward;
}

/// The same with a point in the middle of the picture, which is before the eye.
Vec3f fit_around(const std::vector<Vec3f>& points, const Vec3f& middle, const Vec3f& forward, const Vec3f& up,
                 float tan_x, float tan_y) {
  const Vec3f right = forward.cross(up);
  float depth = -1e-3F;  // of the eye, from the middle
  for (const Vec3f& p : points) {
    const Vec3f away = p - middle;
    const float distance = std::max(std::abs(away.dot(right)) / tan_x, std::abs(away.dot(up)) / tan_y);
    depth = std::min(depth, away.dot(forward) - distance);
  }
  return middle + depth * forward;
}

/// Moves the camera without turning it to where the points just fit into the picture, and looks at what is at the depth
/// of `middle`, or at that itself.
void fit_points(Viewpoint& view, const std::vector<Vec3f>& points, const Vec3f& middle, bool is_in_middle,
                float aspect) {
  const Vec3f forward = view.forward();
  const float tan_y = std::tan(view.field_of_view / 2) / picture_margin;
  const float tan_x = tan_y * aspect * (1 - std::min(std::abs(view.inset), 0.9F));
  view.eye = is_in_middle ? fit_around(points, middle, forward, view.up, tan_x, tan_y)
                          : fit(points, forward, view.up, tan_x, tan_y);
  view.target = view.eye + (middle - view.eye).dot(forward) * forward;
}

/// From the eye to what it looks at, by azimuth and elevation, whatever is up.
Vec3f direction_of(const pliant::Camera& camera, const Vec3f& up) {
  const auto radians = [](pliant::Real degrees) { return static_cast<float>(degrees * std::numbers::pi / 180); };
  const float azimuth = radians(camera.azimuth.value_or(default_azimuth));
  const float elevation = radians(camera.elevation.value_or(default_elevation));
  const Vec3f front = upright(std::abs(up.y()) < 0.9F ? Vec3f(0, -1, 0) : Vec3f(0, 0, 1), up);
  const Vec3f side = std::cos(azimuth) * front + std::sin(azimuth) * up.cross(front);
  return -(std::cos(elevation) * side + std::sin(elevation) * up);
}

}  // namespace

Mat4f Viewpoint::view() const {
  const Vec3f f = forward();
  const Vec3f r = f.cross(up);
  Mat4f m = Mat4f::Identity();
  m.block<1, 3>(0, 0) = r.transpose();
  m.block<1, 3>(1, 0) = up.transpose();
  m.block<1, 3>(2, 0) = -f.transpose();
  m.block<3, 1>(0, 3) = Vec3f(-r.dot(eye), -up.dot(eye), f.dot(eye));
  return m;
}

Mat4f Viewpoint::projection(float aspect) const {
  const float scale = 1 / std::tan(field_of_view / 2);
  Mat4f m = Mat4f::Zero();
  m(0, 0) = scale / aspect;
  m(0, 2) = inset;  // moves everything to the left
  m(1, 1) = scale;
  m(2, 2) = (far + near) / (near - far);
  m(2, 3) = 2 * far * near / (near - far);
  m(3, 2) = -1;
  return m;
}

Viewpoint place_camera(const pliant::Camera& camera, const Bounds& given, float aspect, float inset) {
  Bounds bounds = given;
  if (bounds.is_empty()) bounds.add(Vec3f::Zero());
  Viewpoint view;
  view.inset = inset;
  view.field_of_view = static_cast<float>(camera.field_of_view * std::numbers::pi / 180);
  view.target = camera.target ? to_float(*camera.target) : bounds.center();
  const Vec3f up = to_float(camera.up).normalized();
  if (camera.position) {
    view.eye = to_float(*camera.position);
    if ((view.target - view.eye).norm() < 1e-6F * std::max(bounds.radius(), 1e-3F))
      view.target = view.eye + Vec3f(0, 1, 0);
    view.up = upright(up, view.forward());
  } else {
    const Vec3f forward = direction_of(camera, up);
    view.up = upright(up, forward);
    view.eye = bounds.center() - forward;
    view.target = bounds.center();
    Vec3f middle = camera.target ? to_float(*camera.target) : bounds.center();
    std::vector<Vec3f> points = points_of(bounds);
    if (camera.turn_rate != 0) points = turned_around(points, middle, up);
    fit_points(view, points, middle, camera.target.has_value() || camera.turn_rate != 0, aspect);
  }
  set_depth_range(view, bounds);
  return view;
}

void fit_into_picture(Viewpoint& view, const Bounds& bounds, float aspect) {
  fit_points(view, points_of(bounds), bounds.center(), false, aspect);
}

void set_depth_range(Viewpoint& view, const Bounds& bounds) {
  const float radius = std::max(bounds.radius(), 1e-3F);
  const float distance = (bounds.center() - view.eye).norm();
  view.far = distance + 30 * radius;
  view.near = std::max(distance - 3 * radius, 1e-3F * std::max(distance, radius));
}

}  // namespace pliant_render
