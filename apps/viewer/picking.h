#pragma once
// From the mouse to the bodies, and back.
#include <optional>
#include <span>

#include "render/scenery.h"

namespace pliant_viewer {

using pliant::Index;
using pliant_render::Vec2f;
using pliant_render::Vec3f;

/// A picture as the mouse sees it: places in it are counted from the upper left corner, in the units of the mouse,
/// whichever number of pixels one of them has.
struct Screen {
  pliant_render::Viewpoint viewpoint;
  Vec2f size = {1, 1};

  float aspect() const { return size.x() / size.y(); }
  /// From the eye through a place.
  struct Ray {
    Vec3f origin;
    Vec3f direction;  ///< as long as its share along the direction of view is 1
  };
  Ray ray(const Vec2f& place) const;
  /// Where a point is seen; none where it is behind the eye.
  std::optional<Vec2f> place_of(const Vec3f& point) const;
  /// How far ahead of the eye a point is, along the direction of view [m].
  float depth_of(const Vec3f& point) const;
  /// The point seen at a place, at a depth [m].
  Vec3f point_at(const Vec2f& place, float depth) const;
};

/// A point of an element: vertices of a triangle, or of an edge with the third weight 0.
struct SurfacePoint {
  std::array<std::uint32_t, 3> vertices{};
  Vec3f weights = {1, 0, 0};  ///< barycentric

  Vec3f position(std::span<const Vec3f> positions) const;
  /// The vertex that is nearest to it.
  std::uint32_t nearest_vertex(std::span<const Vec3f> positions) const;
};

/// The foremost point of a triangle or a rope under a place; ropes are hit within `reach` of it.
std::optional<SurfacePoint> pick_surface(const pliant_render::Scenery& scenery, std::span<const Vec3f> positions,
                                         const Screen& screen, const Vec2f& place, float reach);

/// Of the vertices the one that is seen nearest to a place, within `reach`.
std::optional<std::uint32_t> pick_vertex(std::span<const std::uint32_t> vertices, std::span<const Vec3f> positions,
                                         const Screen& screen, const Vec2f& place, float reach);

}  // namespace pliant_viewer
