#include "render/outline.h"

#include <cmath>
#include <limits>
#include <numbers>

namespace pliant_render {
namespace {

/// Evenly all around, on a spiral from pole to pole.
std::vector<Vec3f> spread_directions(int count) {
  std::vector<Vec3f> spread;
  for (int i = 0; i < count; ++i) {
    const double z = 1 - (2 * i + 1) / static_cast<double>(count);
    const double radius = std::sqrt(1 - z * z);
    const double angle = i * std::numbers::pi * (3 - std::sqrt(5.0));
    spread.emplace_back(Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), z).cast<float>());
  }
  return spread;
}

/// Upper bound of what points in the box reach in a direction.
float reach_of(const Bounds& box, const Vec3f& direction) {
  return box.center().dot(direction) + (box.high - box.low).dot(direction.cwiseAbs()) / 2;
}

}  // namespace

Outline::Outline()
    : directions_(spread_directions(100)),
      reach_(directions_.size(), -std::numeric_limits<float>::infinity()),
      furthest_(directions_.size(), Vec3f::Zero()) {}

void Outline::add(std::span<const Vec3f> points, const Bounds& box) {
  if (box.is_empty()) return;
  box_.add(box.low);
  box_.add(box.high);
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    if (!(reach_of(box, directions_[d]) > reach_[d])) continue;
    for (const Vec3f& point : points) {
      const float reach = point.dot(directions_[d]);
      if (!(reach > reach_[d]) || !point.allFinite()) continue;
      reach_[d] = reach;
      furthest_[d] = point;
    }
  }
}

void Outline::add(const FrameContent& frame, const pliant::ViewSettings& appearance) {
  const Bounds bodies = bounds_of(std::span<const Vec3f>(frame.positions));
  add(frame.positions, bodies);
  if (!appearance.colliders) return;
  const std::vector<Vec3f> points = collider_points(frame.colliders, bodies);
  add(points, bounds_of(std::span<const Vec3f>(points)));
}

Bounds Outline::bounds() const {
  Bounds bounds = box_;
  if (!bounds.is_empty()) bounds.outline = furthest_;
  return bounds;
}

}  // namespace pliant_render
