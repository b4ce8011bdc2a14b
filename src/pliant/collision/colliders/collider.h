#pragma once
// What a collider is: a rigid convex shape that bodies meet, with a signed distance in a frame of its own. A collider
// as a user asks for it is a struct of options with an `info` and a `visit` (core/options.h), the members of
// ColliderMotion, and a function
//
//     PlacedShape build(const Options& options);
//
// that throws Error(input) on options out of their range. The built-in ones are listed in colliders/builtin.h.
#include <concepts>
#include <memory>
#include <optional>
#include <string_view>

#include "pliant/core/options.h"

namespace pliant {

struct Mesh;

using Quaternion = Eigen::Quaternion<Real, Eigen::DontAlign>;

/// A frame in space: a point x of it is at position + rotation x.
struct Pose {
  Vec3 position = Vec3::Zero();  ///< [m]
  Quaternion rotation = Quaternion::Identity();

  Vec3 to_space(const Vec3& point) const { return position + rotation * point; }
  Vec3 to_frame(const Vec3& point) const { return rotation.conjugate() * (point - position); }

  friend bool operator==(const Pose& a, const Pose& b) {
    return a.position == b.position && a.rotation.coeffs() == b.rotation.coeffs();
  }
};

/// From `from` (share 0) to `to` (share 1), turned the shorter way.
Pose interpolate(const Pose& from, const Pose& to, Real share);
/// Moved on for a time [s] with a velocity [m/s] and an angular velocity [rad/s] about its position.
Pose moved_on(const Pose& pose, const Vec3& velocity, const Vec3& angular_velocity, Real time);

/// Of a point to a surface.
struct SignedDistance {
  Real distance = 0;            ///< [m], negative inside
  Vec3 normal = Vec3::UnitZ();  ///< its gradient, of length 1
};

/// The shape of a collider, in its own frame. A user's own derives from this class.
class ColliderShape {
 public:
  virtual ~ColliderShape() = default;

  virtual std::string_view type() const = 0;
  /// Of a point of the frame [m]. The shape must be convex: a point whose way meets it is held by the plane through
  /// the place where it would have gone in.
  virtual SignedDistance distance(const Vec3& point) const = 0;
  /// False where the shape has no end, as a plane.
  virtual bool is_bounded() const { return true; }
  /// Triangles of its surface in the frame [m], outward, for pictures and exports; none unless a shape says otherwise.
  /// A shape without end shows what lies within `size` [m] of the origin along its axes.
  virtual Mesh surface(Real size) const;
};

/// A shape, and where it begins.
struct PlacedShape {
  std::shared_ptr<const ColliderShape> shape;
  Pose pose{};
};

/// One type of collider, for people.
struct ColliderInfo {
  std::string_view name;        ///< in scene files
  std::string_view formula;     ///< of the distance
  std::string_view required{};  ///< option that has no default; empty: each has one
};

/// How a collider moves by itself, and how it holds what touches it.
struct ColliderMotion {
  Vec3 velocity = Vec3::Zero();          ///< [m/s]
  Vec3 angular_velocity = Vec3::Zero();  ///< [rad/s], about its position
  Vec3 surface_velocity = Vec3::Zero();  ///< [m/s], in the axes of space when it was made; it turns with the collider
  std::optional<Real> friction{};        ///< μ; none: that of the contact settings
};

/// The members that all options of colliders share.
template <class Self, class Visitor>
void visit_motion(Self& self, Visitor&& field) {
  field(OptionInfo{"velocity", "m/s", "with which it moves on"}, self.velocity);
  field(OptionInfo{"angular_velocity", "rad/s", "with which it turns on, about its position: axis times speed"},
        self.angular_velocity);
  field(OptionInfo{"surface_velocity", "m/s", "of its surface, as of a conveyor belt; it turns with the collider"},
        self.surface_velocity);
  field(OptionInfo{"friction", "", "μ of Coulomb's law; default: that of `contact`", not_negative}, self.friction);
}

template <class Options>
ColliderMotion motion_of(const Options& options) {
  ColliderMotion motion{options.velocity, options.angular_velocity, options.surface_velocity};
  if (!options.friction.empty()) motion.friction = options.friction[0];
  return motion;
}

/// Options of a collider: what the facade and the scene files take in a list of any length.
template <class Options>
concept describes_collider = std::same_as<std::remove_cvref_t<decltype(Options::info)>, ColliderInfo>;

}  // namespace pliant
