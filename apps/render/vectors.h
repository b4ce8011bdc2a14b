#pragma once
// Vectors and matrices as graphics hardware takes them.
#include <Eigen/Core>

namespace pliant_render {

using Vec2f = Eigen::Vector2f;
using Vec3f = Eigen::Vector3f;
using Vec4f = Eigen::Vector4f;
using Mat3f = Eigen::Matrix3f;
using Mat4f = Eigen::Matrix4f;

}  // namespace pliant_render
