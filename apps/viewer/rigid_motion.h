#pragma once
// A turn and a shift, as a hand makes them.
#include <Eigen/Geometry>

#include "render/vectors.h"

namespace pliant_viewer {

using pliant_render::Vec3f;

/// Of points: turned about a center, then moved.
struct RigidMotion {
  Vec3f center = {0, 0, 0};       ///< [m]
  Vec3f rotation = {0, 0, 0};     ///< about this axis, by its length [rad]
  Vec3f translation = {0, 0, 0};  ///< [m]

  bool is_finite() const { return center.allFinite() && rotation.allFinite() && translation.allFinite(); }
  Eigen::Vector3d operator()(const Eigen::Vector3d& point) const {
    const Eigen::Vector3d middle = center.cast<double>(), axis = rotation.cast<double>();
    const double angle = axis.norm();
    const Eigen::Vector3d from_middle = point - middle;
    const Eigen::Vector3d turned =
        angle > 0 ? Eigen::Vector3d(Eigen::AngleAxisd(angle, axis / angle) * from_middle) : from_middle;
    return middle + turned + translation.cast<double>();
  }
};

}  // namespace pliant_viewer
