#include "render/collider_view.h"

#include <algorithm>

#include "pliant/collision/colliders/plane.h"
#include "pliant/collision/colliders/surface.h"

namespace pliant_render {
namespace {

constexpr pliant::Real size_without_end = 10;  // [m], of shapes other than planes
constexpr float most_radii = 5;                // of the bodies, that a collider in the picture may have

std::shared_ptr<const ColliderSurface> make_surface(const std::shared_ptr<const pliant::ColliderShape>& shape) {
  auto made = std::make_shared<ColliderSurface>();
  made->shape = shape;
  made->is_plane = shape->type() == pliant::PlaneCollider::info.name;
  if (made->is_plane) return made;
  const pliant::Mesh mesh = shape->surface(size_without_end);
  const pliant::Positions normals = pliant::corner_normals(*shape, mesh);
  Eigen::Index corner = 0;
  for (const pliant::Triangle& triangle : mesh.triangles) {
    for (const pliant::Index vertex : triangle) {
      made->corners.push_back(
          {mesh.vertices.row(vertex).transpose().cast<float>(), normals.row(corner++).transpose().cast<float>()});
    }
  }
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
    made->points.emplace_back(mesh.vertices.row(i).transpose().cast<float>());
  }
  return made;
}

}  // namespace

ColliderLook collider_look(const pliant::ColliderAppearance& appearance) {
  ColliderLook look;
  look.is_own = appearance.front.has_value();
  if (appearance.front)
    look.tone = pliant::Vec3(appearance.front->red, appearance.front->green, appearance.front->blue).cast<float>();
  if (appearance.finish != pliant::Finish::automatic) look.finish = appearance.finish;
  return look;
}

Mat4f matrix_of(const pliant::Pose& pose) {
  Mat4f matrix = Mat4f::Identity();
  matrix.topLeftCorner<3, 3>() = pose.rotation.toRotationMatrix().cast<float>();
  matrix.topRightCorner<3, 1>() = pose.position.cast<float>();
  return matrix;
}

std::vector<DrawnCollider> ColliderSurfaces::find(const pliant::Simulation& simulation) {
  std::map<const pliant::ColliderShape*, std::shared_ptr<const ColliderSurface>> used;
  std::vector<DrawnCollider> drawn;
  for (const auto& [id, record] : simulation.colliders()) {
    const auto known = surfaces_.find(record.shape.get());
    const std::shared_ptr<const ColliderSurface> surface =
        known == surfaces_.end() ? make_surface(record.shape) : known->second;
    used.emplace(record.shape.get(), surface);
    if (!surface->is_plane && surface->corners.empty()) continue;
    drawn.push_back({static_cast<pliant::Index>(id), record.name, surface, simulation.pose(id)});
  }
  surfaces_ = std::move(used);
  return drawn;
}

std::optional<float> floor_height(const std::vector<DrawnCollider>& colliders) {
  std::optional<float> height;
  for (const DrawnCollider& each : colliders) {
    if (!each.surface->is_plane || !(matrix_of(each.pose)(2, 2) > 0.999F)) continue;
    const auto here = static_cast<float>(each.pose.position.z());
    height = std::max(height.value_or(here), here);
  }
  return height;
}

std::vector<Vec3f> collider_points(const std::vector<DrawnCollider>& colliders, const Bounds& bodies) {
  std::vector<Vec3f> points;
  for (const DrawnCollider& each : colliders) {
    if (!each.surface->shape->is_bounded()) continue;
    const Mat4f place = matrix_of(each.pose);
    const std::size_t first = points.size();
    Bounds box;
    for (const Vec3f& point : each.surface->points) {
      points.emplace_back(place.topLeftCorner<3, 3>() * point + place.topRightCorner<3, 1>());
      box.add(points.back());
    }
    const bool is_large = !bodies.is_empty() && box.radius() > most_radii * bodies.radius();
    if (box.is_empty() || is_large) points.resize(first);
  }
  return points;
}

}  // namespace pliant_render
