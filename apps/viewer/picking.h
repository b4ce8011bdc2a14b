#pragma once
// From the mouse to points of the bodies, and back.
#include <optional>
#include <span>

#include "render/render_mesh.h"

namespace pliant_viewer {

using pliant::Index;
using pliant_render::Vec2f;
using pliant_render::Vec3f;

/// A picture as the mouse sees it. Places are measured from the upper left corner in units of the mouse, whatever the
/// number of pixels per unit.
struct Screen {
  pliant_render::Viewpoint viewpoint;
  Vec2f size = {1, 1};

  float aspect() const { return size.x() / size.y(); }
  /// A ray from the eye through a place.
  struct Ray {
    Vec3f origin;
    Vec3f direction;  ///< scaled so that its component along the direction of view is 1
  };
  Ray ray(const Vec2f& place) const;
  /// Where a point appears; none if it is behind the eye.
  std::optional<Vec2f> place_of(const Vec3f& point) const;
  /// Distance of a point from the eye along the direction of view [m].
  float depth_of(const Vec3f& point) const;
  /// The point at a place and a depth [m].
  Vec3f point_at(const Vec2f& place, float depth) const;
};

/// How deep [m] a ray meets a triangle, and the weights of its second and third vertex there.
struct TriangleHit {
  double depth;
  double v, w;
};
std::optional<TriangleHit> meet(const Screen::Ray& ray, const Vec3f& a, const Vec3f& b, const Vec3f& c);

/// A point on a triangle, or on an edge, whose third weight is 0.
struct SurfacePoint {
  std::array<std::uint32_t, 3> vertices{};
  Vec3f weights = {1, 0, 0};  ///< barycentric

  Vec3f position(std::span<const Vec3f> positions) const;
  /// The nearest of its vertices.
  std::uint32_t nearest_vertex(std::span<const Vec3f> positions) const;
};

/// How near a place comes to a line between two others.
float distance_to_segment(const Vec2f& a, const Vec2f& b, const Vec2f& place);

/// The frontmost point of a triangle or a rope at a place; ropes are hit within `reach` of it.
std::optional<SurfacePoint> pick_surface(const pliant_render::RenderMesh& render_mesh, std::span<const Vec3f> positions,
                                         const Screen& screen, const Vec2f& place, float reach);

/// The vertex that appears nearest to a place, within `reach`.
std::optional<std::uint32_t> pick_vertex(std::span<const std::uint32_t> vertices, std::span<const Vec3f> positions,
                                         const Screen& screen, const Vec2f& place, float reach);

/// A point on a collider.
struct ColliderPoint {
  Index number = 0;  ///< of its ColliderId
  Vec3f position = {0, 0, 0};
};

enum class Planes { left_out, too };
/// The frontmost point of a collider at a place, of those that have an end, and of planes where they are wanted.
std::optional<ColliderPoint> pick_collider(std::span<const pliant_render::DrawnCollider> colliders,
                                           const Screen& screen, const Vec2f& place, Planes planes = Planes::left_out);

/// Whether a collider, planes too, stands between the eye and a point.
bool is_behind_collider(std::span<const pliant_render::DrawnCollider> colliders, const Screen& screen,
                        const Vec3f& point);

}  // namespace pliant_viewer
