#include "render/camera_path.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>

namespace pliant_render {
namespace {

using pliant::CameraKeyframe;
using pliant::Real;
using pliant::Vec3;

/// What moves from keyframe to keyframe: position, target, field of view [degrees].
using Numbers = Eigen::Matrix<Real, 7, 1>;

/// A curve through values whose extremes are at these (Fritsch and Butland 1984, with unequal steps). Three intervals
/// are known: that in which the time is, and its neighbors, which are empty at the ends.
struct Curve {
  std::array<Real, 4> times;
  std::array<Numbers, 4> values;

  Numbers at(Real time) const {
    const Real step = times[2] - times[1];
    const Real s = (time - times[1]) / step;
    const Numbers from = slope(1) * step, to = slope(2) * step;
    const Real s2 = s * s, s3 = s2 * s;
    return (2 * s3 - 3 * s2 + 1) * values[1] + (s3 - 2 * s2 + s) * from + (3 * s2 - 2 * s3) * values[2] +
           (s3 - s2) * to;
  }

 private:
  /// At time i, 1 or 2: none at extremes and at the ends, else a weighted harmonic mean of those on both sides.
  Numbers slope(std::size_t i) const {
    const Real before = times[i] - times[i - 1], after = times[i + 1] - times[i];
    Numbers result = Numbers::Zero();
    if (!(before > 0) || !(after > 0)) return result;
    const Real weight = (before + 2 * after) / (3 * (before + after));
    for (Eigen::Index k = 0; k < result.size(); ++k) {
      const Real left = (values[i][k] - values[i - 1][k]) / before, right = (values[i + 1][k] - values[i][k]) / after;
      if (left * right > 0) result[k] = 1 / (weight / left + (1 - weight) / right);
    }
    return result;
  }
};

/// The curve around a time between the first keyframe and the last.
Numbers interpolate(const std::vector<CameraKeyframe>& keyframes, Real time,
                    const std::function<Numbers(const CameraKeyframe&)>& numbers_of) {
  const auto later = std::ranges::upper_bound(keyframes, time, {}, &CameraKeyframe::time);
  const auto after = std::clamp<std::ptrdiff_t>(later - keyframes.begin(), 1, std::ssize(keyframes) - 1);
  Curve curve;
  for (std::ptrdiff_t i = 0; i < 4; ++i) {
    const std::ptrdiff_t place = std::clamp<std::ptrdiff_t>(after - 2 + i, 0, std::ssize(keyframes) - 1);
    const CameraKeyframe& each = keyframes[static_cast<std::size_t>(place)];
    curve.times[static_cast<std::size_t>(i)] = each.time;
    curve.values[static_cast<std::size_t>(i)] = numbers_of(each);
  }
  return curve.at(std::clamp(time, curve.times[1], curve.times[2]));
}

/// The whole view turned about an axis through a point.
Viewpoint turned(Viewpoint view, const Vec3f& center, const Vec3f& axis, Real degrees) {
  const auto angle = static_cast<float>(std::remainder(degrees, 360.0) * std::numbers::pi / 180);
  const Eigen::Matrix3f turn = Eigen::AngleAxisf(angle, axis).toRotationMatrix();
  view.eye = center + turn * (view.eye - center);
  view.target = center + turn * (view.target - center);
  view.up = turn * view.up;
  return view;
}

}  // namespace

CameraPath::CameraPath(pliant::Camera camera, const Bounds& bounds, float aspect, float inset)
    : camera_(std::move(camera)),
      bounds_(bounds),
      aspect_(aspect),
      inset_(inset),
      start_(place_camera(camera_, bounds, aspect, inset)) {
  if (bounds_.is_empty()) bounds_.add(Vec3f::Zero());
}

Viewpoint CameraPath::at(Real time) const {
  if (camera_.keyframes.empty()) {
    if (camera_.turn_rate == 0) return start_;
    const Vec3f center = (camera_.target || camera_.position) ? start_.target : bounds_.center();
    Viewpoint view = turned(start_, center, camera_.up.cast<float>().normalized(), camera_.turn_rate * time);
    set_depth_range(view, bounds_);
    return view;
  }
  const Vec3 center = bounds_.center().cast<Real>();
  const Vec3 middle = camera_.target.value_or(center);
  const auto numbers_of = [&](const CameraKeyframe& each) {
    Numbers numbers;
    numbers << each.position, each.target.value_or(middle), each.field_of_view.value_or(camera_.field_of_view);
    return numbers;
  };
  const Numbers now = camera_.keyframes.size() == 1 ? numbers_of(camera_.keyframes[0])
                                                    : interpolate(camera_.keyframes, time, numbers_of);
  pliant::Camera camera = camera_;
  camera.position = now.head<3>();
  camera.target = now.segment<3>(3);
  camera.field_of_view = now[6];
  return place_camera(camera, bounds_, aspect_, inset_);
}

}  // namespace pliant_render
