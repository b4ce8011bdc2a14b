#include "viewer/picking.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace pliant_viewer {
namespace {

using Ray = Screen::Ray;

/// The share of the way from a to b where the segment is seen nearest to the place, and how near that is.
struct Nearest {
  float share;
  float distance;
};
Nearest nearest_on(const Vec2f& a, const Vec2f& b, const Vec2f& place) {
  const Vec2f along = b - a;
  const float length = along.squaredNorm();
  const float share = length > 0 ? std::clamp((place - a).dot(along) / length, 0.0F, 1.0F) : 0;
  return {share, (a + share * along - place).norm()};
}

/// The share between two points of different depths that is seen at `share` between their places.
float undo_perspective(float share, float depth_a, float depth_b) {
  const float weight_b = share / depth_b;
  const float weight_a = (1 - share) / depth_a;
  return weight_b / (weight_a + weight_b);
}

/// How far along the ray [m] a shape begins that it goes into from outside: no step is longer than the distance to the
/// shape (Hart 1996).
std::optional<double> reach(const pliant::ColliderShape& shape, const pliant::Vec3& origin,
                            const pliant::Vec3& direction, double farthest) {
  constexpr int most_steps = 256;
  constexpr double nearly = 1e-6;  // of the way so far
  double way = 0;
  for (int i = 0; i < most_steps && way < farthest; ++i) {
    const double distance = shape.distance(origin + way * direction).distance;
    if (distance < 0 && i == 0) return {};
    if (distance <= nearly * way) return way;
    way += distance;
  }
  return {};
}

}  // namespace

/// After Möller and Trumbore (1997), in double precision, so that it falls through no seam.
std::optional<TriangleHit> meet(const Ray& ray, const Vec3f& a, const Vec3f& b, const Vec3f& c) {
  constexpr double slack = 1e-9;
  using Vec3d = Eigen::Vector3d;
  const Vec3d along = ray.direction.cast<double>();
  const Vec3d ab = (b - a).cast<double>(), ac = (c - a).cast<double>();
  const Vec3d normal = along.cross(ac);
  const double determinant = ab.dot(normal);
  if (!(std::abs(determinant) > 0)) return {};
  const Vec3d from_a = (ray.origin - a).cast<double>();
  const double v = from_a.dot(normal) / determinant;
  if (!(v >= -slack && v <= 1 + slack)) return {};
  const Vec3d other = from_a.cross(ab);
  const double w = along.dot(other) / determinant;
  if (!(w >= -slack && v + w <= 1 + slack)) return {};
  const double distance = ac.dot(other) / determinant;
  if (!(distance > 0)) return {};
  return TriangleHit{distance, v, w};
}

float distance_to_segment(const Vec2f& a, const Vec2f& b, const Vec2f& place) {
  return nearest_on(a, b, place).distance;
}

Screen::Ray Screen::ray(const Vec2f& place) const {
  const float half = std::tan(viewpoint.field_of_view / 2);
  const float x = 2 * place.x() / size.x() - 1 + viewpoint.inset;
  const float y = 1 - 2 * place.y() / size.y();
  return {viewpoint.eye, viewpoint.forward() + half * (aspect() * x * viewpoint.right() + y * viewpoint.up)};
}

std::optional<Vec2f> Screen::place_of(const Vec3f& point) const {
  const float depth = depth_of(point);
  if (!(depth > 0)) return {};
  const float half = std::tan(viewpoint.field_of_view / 2);
  const Vec3f from_eye = point - viewpoint.eye;
  const float x = from_eye.dot(viewpoint.right()) / (depth * half * aspect()) - viewpoint.inset;
  const float y = from_eye.dot(viewpoint.up) / (depth * half);
  return Vec2f((x + 1) / 2 * size.x(), (1 - y) / 2 * size.y());
}

float Screen::depth_of(const Vec3f& point) const {
  return (point - viewpoint.eye).dot(viewpoint.forward());
}

Vec3f Screen::point_at(const Vec2f& place, float depth) const {
  const Ray through = ray(place);
  return through.origin + depth * through.direction;
}

Vec3f SurfacePoint::position(std::span<const Vec3f> positions) const {
  Vec3f sum = Vec3f::Zero();
  for (int i = 0; i < 3; ++i) sum += weights[i] * positions[vertices[static_cast<std::size_t>(i)]];
  return sum;
}

std::uint32_t SurfacePoint::nearest_vertex(std::span<const Vec3f> positions) const {
  const Vec3f here = position(positions);
  std::uint32_t nearest = vertices[0];
  for (const std::uint32_t vertex : vertices) {
    if ((positions[vertex] - here).norm() < (positions[nearest] - here).norm()) nearest = vertex;
  }
  return nearest;
}

std::optional<SurfacePoint> pick_surface(const pliant_render::RenderMesh& render_mesh, std::span<const Vec3f> positions,
                                         const Screen& screen, const Vec2f& place, float reach) {
  std::optional<SurfacePoint> picked;
  double foremost = std::numeric_limits<double>::infinity();
  const Ray ray = screen.ray(place);
  for (std::size_t t = 0; t + 2 < render_mesh.triangles.size(); t += 3) {
    const std::uint32_t a = render_mesh.triangles[t], b = render_mesh.triangles[t + 1],
                        c = render_mesh.triangles[t + 2];
    const auto hit = meet(ray, positions[a], positions[b], positions[c]);
    if (!hit || hit->depth >= foremost) continue;
    foremost = hit->depth;
    const double v = std::clamp(hit->v, 0.0, 1.0);
    const double w = std::clamp(hit->w, 0.0, 1.0 - v);
    picked = SurfacePoint{{a, b, c}, Eigen::Vector3d(1 - v - w, v, w).cast<float>()};
  }
  for (std::size_t r = 0; r + 1 < render_mesh.ropes.size(); r += 2) {
    const std::uint32_t a = render_mesh.ropes[r], b = render_mesh.ropes[r + 1];
    const auto place_a = screen.place_of(positions[a]), place_b = screen.place_of(positions[b]);
    if (!place_a || !place_b) continue;
    const Nearest nearest = nearest_on(*place_a, *place_b, place);
    if (nearest.distance > reach) continue;
    const float depth_a = screen.depth_of(positions[a]), depth_b = screen.depth_of(positions[b]);
    const float share = undo_perspective(nearest.share, depth_a, depth_b);
    const float depth = (1 - share) * depth_a + share * depth_b;
    if (depth >= foremost) continue;
    foremost = depth;
    picked = SurfacePoint{{a, b, b}, {1 - share, share, 0}};
  }
  return picked;
}

std::optional<ColliderPoint> pick_collider(std::span<const pliant_render::DrawnCollider> colliders,
                                           const Screen& screen, const Vec2f& place, Planes planes) {
  std::optional<ColliderPoint> picked;
  const Ray ray = screen.ray(place);
  const pliant::Vec3 eye = ray.origin.cast<double>(), along = ray.direction.cast<double>().normalized();
  double foremost = screen.viewpoint.far;
  for (const pliant_render::DrawnCollider& each : colliders) {
    const bool is_wanted_plane = planes == Planes::too && each.surface->is_plane;
    if (!each.surface->shape->is_bounded() && !is_wanted_plane) continue;
    const auto way =
        reach(*each.surface->shape, each.pose.to_frame(eye), each.pose.rotation.conjugate() * along, foremost);
    if (!way) continue;
    foremost = *way;
    picked = ColliderPoint{each.number, (eye + *way * along).cast<float>()};
  }
  return picked;
}

bool is_behind_collider(std::span<const pliant_render::DrawnCollider> colliders, const Screen& screen,
                        const Vec3f& point) {
  constexpr double slack = 2e-3;  // of the way: what touches a collider is seen
  const pliant::Vec3 eye = screen.viewpoint.eye.cast<double>(), along = point.cast<double>() - eye;
  const double way = (1 - slack) * along.norm();
  return std::ranges::any_of(colliders, [&](const pliant_render::DrawnCollider& each) {
    return reach(*each.surface->shape, each.pose.to_frame(eye), each.pose.rotation.conjugate() * along.normalized(),
                 way)
        .has_value();
  });
}

std::optional<std::uint32_t> pick_vertex(std::span<const std::uint32_t> vertices, std::span<const Vec3f> positions,
                                         const Screen& screen, const Vec2f& place, float reach) {
  std::optional<std::uint32_t> picked;
  float nearest = reach;
  for (const std::uint32_t vertex : vertices) {
    const auto seen = screen.place_of(positions[vertex]);
    if (!seen || (*seen - place).norm() > nearest) continue;
    nearest = (*seen - place).norm();
    picked = vertex;
  }
  return picked;
}

}  // namespace pliant_viewer
