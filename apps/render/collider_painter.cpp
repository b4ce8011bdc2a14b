#include "render/collider_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "render/shaders.h"

namespace pliant_render {
namespace {

const Vec3f lit_tone(0.76F, 0.81F, 0.88F);  // of a collider that is selected, or under the mouse

constexpr float floor_tone = 0.86F;  // of the background, as of the ground
constexpr int plane_rings = 24;
constexpr int plane_sectors = 48;

/// Of a face with this normal, as shaders::lighting lights it without the light from the eye.
float light_on(const Vec3f& normal, const Vec3f& to_light) {
  return 0.31F + 0.1F * normal.z() + 0.75F * std::max(normal.dot(to_light), 0.0F);
}

Vec3f normal_of(const Mat4f& plane) {
  return plane.block<3, 1>(0, 2);
}

}  // namespace

Vec3f flatten(const Vec3f& point_in_frame, const Vec3f& light_in_frame) {
  return point_in_frame - light_in_frame * (std::max(point_in_frame.z(), 0.0F) / light_in_frame.z());
}

ColliderPainter::ColliderPainter() : plane_(shaders::plane_vertex, "", shaders::plane_fragment) {}

void ColliderPainter::set_frame(const std::vector<DrawnCollider>& colliders) {
  colliders_ = colliders;
  std::map<const ColliderSurface*, std::unique_ptr<Solid>> used;
  for (const DrawnCollider& each : colliders_) {
    const ColliderSurface* surface = each.surface.get();
    if (surface->is_plane || used.contains(surface)) continue;
    if (const auto known = solids_.find(surface); known != solids_.end()) {
      used.emplace(surface, std::move(known->second));
      continue;
    }
    auto solid = std::make_unique<Solid>();
    solid->surface = each.surface;
    glBindVertexArray(solid->array.id());
    upload(solid->corners, GL_ARRAY_BUFFER, surface->corners, GL_STATIC_DRAW);
    const auto attribute = [](GLuint place, std::size_t offset) {
      glEnableVertexAttribArray(place);
      glVertexAttribPointer(place, 3, GL_FLOAT, GL_FALSE, sizeof(ColliderSurface::Corner),
                            reinterpret_cast<const void*>(offset));  // NOLINT: as OpenGL wants it
    };
    attribute(0, offsetof(ColliderSurface::Corner, position));
    attribute(1, offsetof(ColliderSurface::Corner, normal));
    used.emplace(surface, std::move(solid));
  }
  glBindVertexArray(0);
  solids_ = std::move(used);
}

bool ColliderPainter::has_planes() const {
  return std::ranges::any_of(colliders_, [](const DrawnCollider& each) { return each.surface->is_plane; });
}

std::vector<Mat4f> ColliderPainter::planes(const Vec3f& eye) const {
  std::vector<Mat4f> planes;
  for (const DrawnCollider& each : colliders_) {
    if (!each.surface->is_plane) continue;
    const Mat4f plane = matrix_of(each.pose);
    const Vec3f middle = plane.topRightCorner<3, 1>();
    if (normal_of(plane).dot(eye - middle) > 0) planes.push_back(plane);
  }
  std::ranges::stable_sort(planes, std::ranges::greater(), [](const Mat4f& plane) { return normal_of(plane).z(); });
  return planes;
}

void ColliderPainter::each_point(const std::function<void(const Vec3f&)>& take) const {
  for (const DrawnCollider& each : colliders_) {
    const Mat4f place = matrix_of(each.pose);
    for (const Vec3f& point : each.surface->points) {
      take(place.topLeftCorner<3, 3>() * point + place.topRightCorner<3, 1>());
    }
  }
}

Bounds ColliderPainter::bounds_in(const Mat4f& frame, const Vec3f& light) const {
  Bounds bounds;
  for (const DrawnCollider& each : colliders_) {
    if (!each.surface->shape->is_bounded()) continue;
    const Mat4f place = frame * matrix_of(each.pose);
    for (const Vec3f& point : each.surface->points) {
      bounds.add(flatten(place.topLeftCorner<3, 3>() * point + place.topRightCorner<3, 1>(), light));
    }
  }
  return bounds;
}

void ColliderPainter::draw_triangles(const Program& program, const Mat4f& frame) const {
  for (const DrawnCollider& each : colliders_) draw_triangles_of(each, program, frame);
}

void ColliderPainter::draw_triangles_of(const DrawnCollider& each, const Program& program, const Mat4f& frame) const {
  const auto solid = solids_.find(each.surface.get());
  if (solid == solids_.end()) return;
  program.set("place", Mat4f(frame * matrix_of(each.pose)));
  glBindVertexArray(solid->second->array.id());
  glDrawArrays(GL_TRIANGLES, 0, static_cast<GLsizei>(each.surface->corners.size()));
}

void ColliderPainter::draw_solids(const Projection& projection, const SceneLight& light,
                                  const std::array<std::optional<pliant::Index>, 2>& lit) {
  if (solids_.empty()) return;
  SurfaceTraits traits{.is_solid = true};
  traits.has_shadows = light.has_shadows();
  traits.has_occlusion = light.has_occlusion();
  const Program& solid = programs_.of(traits);
  solid.use();
  solid.set("camera", projection.camera);
  solid.set("setback", projection.setback);
  light.set(solid);
  for (const DrawnCollider& each : colliders_) {
    solid.set("held", std::ranges::count(lit, each.number) > 0 ? lit_tone : solid_tone);
    draw_triangles_of(each, solid, Mat4f::Identity());
  }
}

void ColliderPainter::draw_plane(const Mat4f& plane, const PlaneLook& look, const ShadowArea& shadow,
                                 const Projection& projection, const Vec3f& to_light) const {
  const Vec3f normal = normal_of(plane);
  const float share = light_on(normal, to_light) / light_on(Vec3f::UnitZ(), to_light);
  const Vec3f from_plane = look.middle - plane.topRightCorner<3, 1>();
  const Vec3f middle = plane.topLeftCorner<3, 3>().transpose() * (from_plane - normal * normal.dot(from_plane));
  plane_.use();
  plane_.set("camera", projection.camera);
  plane_.set("setback", projection.setback);
  plane_.set("place", plane);
  plane_.set("center", middle);
  plane_.set("extent", look.extent);
  plane_.set("tone", Vec3f((floor_tone * std::pow(share, 0.4545F) * look.background).cwiseMin(1)));
  plane_.set("rings", plane_rings);
  plane_.set("sectors", plane_sectors);
  plane_.set("middle", shadow.middle);
  plane_.set("reach", shadow.reach);
  plane_.set("darkness", look.darkness);
  plane_.set("mask", 0);
  glBindVertexArray(empty_array_.id());
  glEnable(GL_DEPTH_CLAMP);  // as of the ground
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * (plane_sectors + 1), plane_rings);
  glDisable(GL_DEPTH_CLAMP);
}

}  // namespace pliant_render
