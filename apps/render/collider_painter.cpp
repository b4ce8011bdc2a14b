#include "render/collider_painter.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "render/shaders.h"

namespace pliant_render {
namespace {

/// Of a collider that is selected, or under the mouse.
Vec3f lit_tone(const Vec3f& tone) {
  return tone.array() + 0.45F * (1 - tone.array());
}

constexpr float floor_tone = 0.86F;  // of the background
constexpr int plane_rings = 24;
constexpr int plane_sectors = 48;

/// Of a face with this normal, as shaders::lighting lights it without the light from the eye.
float light_on(const Vec3f& normal, const Vec3f& to_light) {
  return 0.31F + 0.1F * normal.z() + 0.75F * std::max(normal.dot(to_light), 0.0F);
}

ColliderLook look_of(const DrawnCollider& collider, const ColliderLooks& looks) {
  const auto found = looks.find(collider.name);
  return found == looks.end() ? ColliderLook{} : found->second;
}

std::string plane_program(const SurfaceTraits& traits) {
  return head_of(traits).append(shaders::dithering).append(shaders::plane_fragment);
}

/// A rectangle of pixels: x, y, width, height.
using Pixels = std::array<GLint, 4>;

/// The part of a picture, then the four around it.
std::array<Pixels, 5> parts_of(const PictureArea& area, const Vec2f& picture) {
  const Eigen::Array2i size = picture.array().round().cast<int>();
  const Eigen::Array2i low = area.low.cwiseProduct(picture).array().floor().cast<int>().min(size);
  const Eigen::Array2i high = area.high.cwiseProduct(picture).array().ceil().cast<int>().max(low).min(size);
  const int width = high.x() - low.x(), height = high.y() - low.y();
  return {{{low.x(), low.y(), width, height},
           {0, 0, size.x(), low.y()},
           {0, high.y(), size.x(), size.y() - high.y()},
           {0, low.y(), low.x(), height},
           {high.x(), low.y(), size.x() - high.x(), height}}};
}

Vec3f normal_of(const Mat4f& plane) {
  return plane.block<3, 1>(0, 2);
}

}  // namespace

Vec3f flatten(const Vec3f& point_in_frame, const Vec3f& light_in_frame) {
  return point_in_frame - light_in_frame * (std::max(point_in_frame.z(), 0.0F) / light_in_frame.z());
}

ColliderPainter::ColliderPainter()
    : bright_plane_(shaders::plane_vertex, "", plane_program({})),
      plane_(shaders::plane_vertex, "", plane_program({.has_shadows = true})),
      dark_plane_(shaders::plane_vertex, "", plane_program({.has_shadows = true, .has_occlusion = true})) {}

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

std::vector<ColliderPainter::SeenPlane> ColliderPainter::planes(const Vec3f& eye, const ColliderLooks& looks) const {
  std::vector<SeenPlane> planes;
  for (const DrawnCollider& each : colliders_) {
    if (!each.surface->is_plane) continue;
    const Mat4f plane = matrix_of(each.pose);
    const Vec3f middle = plane.topRightCorner<3, 1>();
    if (!(normal_of(plane).dot(eye - middle) > 0)) continue;
    const ColliderLook look = look_of(each, looks);
    planes.push_back({plane, look.is_own ? std::optional(look.tone) : std::nullopt});
  }
  std::ranges::stable_sort(planes, std::ranges::greater(),
                           [](const SeenPlane& plane) { return normal_of(plane.place).z(); });
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

void ColliderPainter::draw_solids(const Projection& projection, const SceneLight& light, const ColliderLooks& looks,
                                  const std::array<std::optional<pliant::Index>, 2>& lit) {
  if (solids_.empty()) return;
  const Program* in_use = nullptr;
  for (const DrawnCollider& each : colliders_) {
    const ColliderLook look = look_of(each, looks);
    SurfaceTraits traits{.is_solid = true};
    traits.has_cloth = look.finish == pliant::Finish::cloth;
    traits.has_gloss = look.finish == pliant::Finish::glossy || look.finish == pliant::Finish::metal;
    traits.has_shadows = light.has_shadows();
    traits.has_occlusion = light.has_occlusion();
    const Program& solid = programs_.of(traits);
    if (&solid != std::exchange(in_use, &solid)) {
      solid.use();
      solid.set("camera", projection.camera);
      solid.set("setback", projection.setback);
      light.set(solid);
    }
    solid.set("held_finish", static_cast<int>(look.finish));
    solid.set("held", std::ranges::count(lit, each.number) > 0 ? lit_tone(look.tone) : look.tone);
    draw_triangles_of(each, solid, Mat4f::Identity());
  }
}

void ColliderPainter::draw_plane(const SeenPlane& seen, const PlaneLook& look, const ShadowArea& shadow,
                                 const Projection& projection, const Vec3f& to_light, const SceneLight& light) const {
  const Mat4f& plane = seen.place;
  const Vec3f tone = seen.tone.value_or(floor_tone * look.background);
  const Vec3f normal = normal_of(plane);
  const float share = light_on(normal, to_light) / light_on(Vec3f::UnitZ(), to_light);
  const Vec3f from_plane = look.middle - plane.topRightCorner<3, 1>();
  const Vec3f middle = plane.topLeftCorner<3, 3>().transpose() * (from_plane - normal * normal.dot(from_plane));
  const auto draw = [&](const Program& program, const Pixels& pixels) {
    if (pixels[2] == 0 || pixels[3] == 0) return;
    glScissor(pixels[0], pixels[1], pixels[2], pixels[3]);
    program.use();
    program.set("camera", projection.camera);
    program.set("setback", projection.setback);
    program.set("place", plane);
    program.set("center", middle);
    program.set("extent", look.extent);
    program.set("tone", Vec3f((std::pow(share, 0.4545F) * tone).cwiseMin(1)));
    program.set("rings", plane_rings);
    program.set("sectors", plane_sectors);
    program.set("middle", shadow.middle);
    program.set("reach", shadow.reach);
    program.set("darkness", look.darkness);
    program.set("mask", 0);
    program.set("background", look.background);
    program.set("is_last", look.is_last ? 1 : 0);
    light.set_floor(program, look.picture);
    glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 2 * (plane_sectors + 1), plane_rings);
  };
  const std::array<Pixels, 5> parts = parts_of(look.dark, look.picture);
  glBindVertexArray(empty_array_.id());
  glEnable(GL_DEPTH_CLAMP);  // it goes on in front of what the camera is made for
  glEnable(GL_SCISSOR_TEST);
  draw(light.has_occlusion() ? dark_plane_ : plane_, parts[0]);
  for (std::size_t i = 1; i < parts.size(); ++i) draw(bright_plane_, parts[i]);
  glDisable(GL_SCISSOR_TEST);
  glDisable(GL_DEPTH_CLAMP);
}

}  // namespace pliant_render
