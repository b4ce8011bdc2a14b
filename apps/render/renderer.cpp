#include "render/renderer.h"

#include <algorithm>
#include <utility>

#include "render/scalar_fields.h"
#include "render/shaders.h"

namespace pliant_render {
namespace {

constexpr float rope_width = 3.5F;         // pixels of a picture of 720 rows
constexpr float rope_shadow_width = 1.5F;  // texels of the mask
constexpr float edge_width = 1.0F;
constexpr float marker_radius = 3.4F;
constexpr float least_marker_radius = 2.2F;  // of the picture as it is
constexpr float selected_radius = 6.0F;
constexpr float least_selected_radius = 4.0F;
const Vec3f selected_color(1.0F, 0.70F, 0.12F);
const Vec3f pin_color(0.98F, 0.98F, 0.97F);  // and of vertices under a test force; no body has it
const Vec3f edge_color(0.10F, 0.11F, 0.14F);
constexpr float shadow_darkness = 0.34F;
constexpr float least_slope_of_light = 0.05F;  // over a floor, for a shadow on it
constexpr float occlusion_reach = 0.2F;        // of the radius of the scene
constexpr float lift = 1.5e-3F;  // towards the eye, of the radius of the scene, for lines on what they lie on

Vec3f tone_of(const pliant::Color& color) {
  return {static_cast<float>(color.red), static_cast<float>(color.green), static_cast<float>(color.blue)};
}

/// As it comes out in bytes, so that what fades into it ends in it.
Vec3f background_of(const pliant::ViewSettings& appearance) {
  return (255 * tone_of(appearance.background)).array().round() / 255;
}

Mat4f ground_at(float height) {
  Mat4f ground = Mat4f::Identity();
  ground(2, 3) = height;
  return ground;
}

/// The tones that a scene gives are those of all bodies.
void set_tones(const Program& program, const pliant::ViewSettings& appearance) {
  const bool is_given = appearance.front || appearance.back;
  std::vector<Vec3f> fronts, backs;
  for (const pliant::BodyTones& each : pliant::body_tones) {
    const pliant::BodyTones& tones = is_given ? pliant::body_tones.front() : each;
    fronts.push_back(tone_of(appearance.front.value_or(tones.front)));
    backs.push_back(tone_of(appearance.back.value_or(tones.back)));
  }
  program.set("fronts", std::span<const Vec3f>(fronts));
  program.set("backs", std::span<const Vec3f>(backs));
}

/// Of the picture, in space, as lines take them.
void set_directions(const Program& program, const Viewpoint& viewpoint) {
  const Mat4f view = viewpoint.view();
  program.set("to_right", Vec3f(view.block<1, 3>(0, 0).transpose()));
  program.set("to_top", Vec3f(view.block<1, 3>(1, 0).transpose()));
  program.set("to_eye", Vec3f(view.block<1, 3>(2, 0).transpose()));
}

/// What shifts a point at the middle of the scene that far towards the eye, in the depths of OpenGL.
float depth_shift(const Viewpoint& view, const Bounds& bounds, float shift) {
  const float depth = std::max((bounds.center() - view.eye).dot(view.forward()), view.near);
  return shift * 2 * view.far * view.near / ((view.far - view.near) * depth * depth);
}

Vec3f light_of(const pliant::ViewSettings& appearance) {
  return appearance.light.cast<float>().normalized();
}

/// About the distance at which bodies touch colliders [m]. Between vertices they come nearer, and so far they are drawn
/// in front all the same; what is behind a collider is never that near to its front.
float setback_of(std::vector<float> rest_lengths) {
  constexpr std::size_t one_of = 20;  // is shorter
  constexpr float share = 0.22F;
  if (rest_lengths.empty()) return 0;
  const auto place = rest_lengths.begin() + static_cast<std::ptrdiff_t>(rest_lengths.size() / one_of);
  std::ranges::nth_element(rest_lengths, place);
  return share * *place;
}

GLsizei count_of(const std::vector<std::uint32_t>& list) {
  return static_cast<GLsizei>(list.size());
}

}  // namespace

Renderer::Renderer(RenderMesh render_mesh)
    : mesh_(std::move(render_mesh)),
      setback_(setback_of(mesh_.render_mesh().rest_lengths)),
      line_(shaders::stroke_vertex, shaders::line_geometry, shaders::line_fragment),
      marker_(shaders::stroke_vertex, shaders::marker_geometry, shaders::marker_fragment) {
  mesh_.set_up(markers_array_, markers_, {});
  mesh_.set_up(selected_array_, selected_, {});
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void Renderer::set_frame(const FrameContent& frame, pliant::ColorBy color) {
  bounds_ = bounds_of(frame);
  colliders_.set_frame(frame.colliders);
  has_values_ = frame.values.size() == frame.positions.size() && color != pliant::ColorBy::none;
  mesh_.set_frame(frame, has_values_);
  glBindVertexArray(markers_array_.id());
  upload(markers_, GL_ELEMENT_ARRAY_BUFFER, frame.markers, GL_STREAM_DRAW);
  glBindVertexArray(0);
  marker_count_ = count_of(frame.markers);
  if (!has_values_ || map_of_ == color) return;
  map_of_ = color;
  const auto map = color_map(color);
  set_up_texture(map_, GL_RGB8, static_cast<int>(map.size()), 1, map.data());
}

void Renderer::draw(const pliant::ViewSettings& appearance, const DrawOptions& options, int width, int height) {
  GLint target = 0;
  glGetIntegerv(GL_FRAMEBUFFER_BINDING, &target);
  const Vec2f picture = size_ = Vec2f(static_cast<float>(width), static_cast<float>(height));
  const Mat4f camera = options.viewpoint.projection(picture.x() / picture.y()) * options.viewpoint.view();
  draw_light_maps(appearance, options);
  go_to_picture(static_cast<GLuint>(target));
  const auto end = [&options](std::string_view pass) {
    if (options.clock != nullptr) options.clock->end(pass);
  };
  const Vec3f background = background_of(appearance);
  glClearColor(background.x(), background.y(), background.z(), 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  glEnable(GL_MULTISAMPLE);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  draw_planes(appearance, options, static_cast<GLuint>(target));
  end("background and floor");
  glEnable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  draw_surface(appearance, options, camera);  // first, since they lie in front of what they lie on
  end("bodies");
  colliders_.draw_solids(projection(options), light_, mesh_.render_mesh().looks.colliders,
                         {options.lit_collider, options.selected_collider});
  end("colliders");
  draw_ropes(appearance, options, camera);
  if (appearance.wireframe) draw_wireframe(options, camera);
  draw_markers(options, camera, picture);
  draw_selection(options, camera, picture);
  end("lines and marks");
  glDisable(GL_BLEND);
  glDisable(GL_DEPTH_TEST);
  glBindVertexArray(0);
}

/// Shadows of bodies and colliders on each other, and how much of the sky is seen from where.
void Renderer::draw_light_maps(const pliant::ViewSettings& appearance, const DrawOptions& options) {
  light_.begin(options.viewpoint.eye, light_of(appearance), options.pixel);
  if (options.quality == pliant::Quality::low || bounds_.is_empty()) return;
  if (appearance.shadow) {
    light_.draw_shadow_map(bounds_, setback_, [&](float setback) {
      draw_rope_depths(options, rope_shadow_width);
      draw_depths(setback);
    });
    if (options.clock != nullptr) options.clock->end("shadows on bodies");
  }
  const float reach = occlusion_reach * bounds_.radius();
  const auto draw_solid = [&] {
    draw_floor_depths(appearance, options);
    draw_depths(projection(options).setback);
  };
  light_.draw_screen_light(options.viewpoint, {size_, 1 / options.pixel, reach, area_of(options, reach)}, draw_solid,
                           [&] { draw_rope_depths(options, rope_width * options.scale / options.pixel); });
  if (options.clock != nullptr) options.clock->end("light on what is seen");
}

/// The part of the picture in which all bodies and colliders lie, and what is nearer to them than `reach`.
PictureArea Renderer::area_of(const DrawOptions& options, float reach) const {
  if (colliders_.planes(options.viewpoint.eye).size() > 1) return {};  // they keep the sky from each other
  const Mat4f camera = projection(options).camera;
  const float rows = options.viewpoint.projection(size_.x() / size_.y())(1, 1);
  PictureArea area{Vec2f::Ones(), Vec2f::Zero()};
  bool is_all = false;
  const auto add = [&](const Vec3f& point) {
    const Vec4f seen = camera * point.homogeneous();
    if (!(seen.w() > options.viewpoint.near + reach)) is_all = true;  // the camera is among them
    const Vec2f at = (seen.head<2>() / seen.w()).array() / 2 + 0.5F;
    const float height = rows * reach / (seen.w() - reach) / 2;
    const Vec2f around(height * size_.y() / size_.x(), height);
    area.low = area.low.cwiseMin(at - around);
    area.high = area.high.cwiseMax(at + around);
  };
  for (const Vec3f& point : mesh_.positions()) add(point);
  colliders_.each_point(add);
  if (is_all) return {};
  area.low = area.low.cwiseMax(0).cwiseMin(1);
  area.high = area.high.cwiseMax(area.low).cwiseMin(1);
  return area;
}

void Renderer::draw_depths(float setback) const {
  const Program& depth = light_.depth_program();
  depth.use();
  depth.set("place", Mat4f::Identity().eval());
  depth.set("setback", 0.0F);
  mesh_.draw_triangles();
  depth.set("setback", setback);
  colliders_.draw_triangles(depth, Mat4f::Identity());
}

void Renderer::draw_floor_depths(const pliant::ViewSettings& appearance, const DrawOptions& options) const {
  const Vec3f middle = bounds_.center();
  Mat4f grown = Mat4f::Identity();
  grown.diagonal().head<2>().setConstant(std::max(12 * bounds_.radius(), 1.0F));
  for (const auto& seen : colliders_.planes(options.viewpoint.eye)) {
    Mat4f plane = seen.place;
    const Vec3f normal = plane.block<3, 1>(0, 2);
    plane.topRightCorner<3, 1>() = middle - normal * normal.dot(middle - plane.topRightCorner<3, 1>());
    light_.draw_square(plane * grown);
  }
  if (colliders_.has_planes() || !appearance.ground) return;
  Mat4f ground = Mat4f::Identity();
  ground.topRightCorner<3, 1>() = Vec3f(middle.x(), middle.y(), options.ground_height);
  light_.draw_square(ground * grown);
}

void Renderer::draw_rope_depths(const DrawOptions& options, float width) const {
  if (!mesh_.has_ropes()) return;
  const Program& program = light_.rope_depth_program();
  program.use();
  program.set("place", Mat4f::Identity().eval());
  program.set("setback", 0.0F);
  program.set("width", width);
  program.set("lift", 0.0F);
  set_directions(program, options.viewpoint);
  mesh_.draw_ropes();
}

Projection Renderer::projection(const DrawOptions& options) const {
  return {options.viewpoint.projection(size_.x() / size_.y()) * options.viewpoint.view(),
          depth_shift(options.viewpoint, bounds_, setback_)};
}

void Renderer::go_to_picture(GLuint target) const {
  glBindFramebuffer(GL_FRAMEBUFFER, target);
  glViewport(0, 0, static_cast<GLsizei>(size_.x()), static_cast<GLsizei>(size_.y()));
}

/// Planes that are colliders or, without any, the ground that nothing stands on; each with the shadow on it.
void Renderer::draw_planes(const pliant::ViewSettings& appearance, const DrawOptions& options, GLuint target) {
  const Vec3f light = light_of(appearance);
  const Vec3f middle = bounds_.is_empty() ? Vec3f::Zero().eval() : bounds_.center();
  const float extent = std::max(12 * bounds_.radius(), 1.0F);
  const bool has_planes = colliders_.has_planes();
  Projection projected = projection(options);
  std::vector<ColliderPainter::SeenPlane> planes;
  if (has_planes) {
    planes = colliders_.planes(options.viewpoint.eye, mesh_.render_mesh().looks.colliders);
  } else if (appearance.ground) {
    planes.push_back({ground_at(options.ground_height), {}});
    projected.setback = 0;
  }
  for (const ColliderPainter::SeenPlane& plane : planes) {
    const bool has_shadow =
        appearance.shadow && plane.place.block<3, 1>(0, 2).dot(light) > least_slope_of_light && !bounds_.is_empty();
    ShadowArea area;
    if (has_shadow) {
      if (options.clock != nullptr) options.clock->end("background and floor");
      area = draw_shadow(plane.place.inverse(), light, options.quality);
      if (options.clock != nullptr) options.clock->end("shadow on the floor");
      go_to_picture(target);
    }
    if (has_planes) glEnable(GL_DEPTH_TEST);
    if (planes.size() > 1) glEnable(GL_BLEND);
    floor_shadow_.bind(GL_TEXTURE0);
    const ColliderPainter::PlaneLook look{middle,
                                          extent,
                                          background_of(appearance),
                                          has_shadow ? shadow_darkness : 0,
                                          planes.size() == 1,
                                          size_,
                                          dark_area(plane.place, has_shadow ? &area : nullptr, options)};
    colliders_.draw_plane(plane, look, area, projected, light, light_);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
  }
}

/// The part of the picture in which a floor is not in all light.
PictureArea Renderer::dark_area(const Mat4f& floor, const ShadowArea* shadow, const DrawOptions& options) const {
  PictureArea area{Vec2f::Ones(), Vec2f::Zero()};
  if (light_.has_occlusion()) area = light_.area();
  if (shadow == nullptr) return area;
  const Mat4f camera = projection(options).camera * floor;
  for (const int corner : {0, 1, 2, 3}) {
    const Vec2f side((corner & 1) != 0 ? 1 : -1, (corner & 2) != 0 ? 1 : -1);
    const Vec2f at_corner = shadow->middle + shadow->reach.cwiseProduct(side);
    const Vec4f seen = camera * Vec4f(at_corner.x(), at_corner.y(), 0, 1);
    if (!(seen.w() > options.viewpoint.near)) return {};  // the camera is above it
    const Vec2f at = (seen.head<2>() / seen.w()).array() / 2 + 0.5F;
    area.low = area.low.cwiseMin(at.cwiseMax(0));
    area.high = area.high.cwiseMax(at.cwiseMin(1));
  }
  return area;
}

ShadowArea Renderer::draw_shadow(const Mat4f& to_floor, const Vec3f& light_in_space, pliant::Quality quality) {
  const Vec3f light = to_floor.topLeftCorner<3, 3>() * light_in_space;
  Bounds flat = colliders_.bounds_in(to_floor, light);
  for (const Vec3f& position : mesh_.positions()) {
    flat.add(flatten(to_floor.topLeftCorner<3, 3>() * position + to_floor.topRightCorner<3, 1>(), light));
  }
  const ShadowArea area{flat.center().head<2>(), ((flat.high - flat.low) / 2).head<2>()};
  return floor_shadow_.draw(to_floor, light, area, quality != pliant::Quality::low,
                            {[this] { mesh_.draw_ropes(); }, [this] { mesh_.draw_triangles(); },
                             [&](const Program& program) { colliders_.draw_triangles(program, to_floor); }});
}

float Renderer::nearest_pixel(const DrawOptions& options) const {
  const Vec3f nearest = options.viewpoint.eye.cwiseMax(bounds_.low).cwiseMin(bounds_.high);
  const float rows = options.viewpoint.projection(size_.x() / size_.y())(1, 1) * size_.y();
  return 2 * (nearest - options.viewpoint.eye).norm() / rows;
}

void Renderer::draw_surface(const pliant::ViewSettings& appearance, const DrawOptions& options, const Mat4f& camera) {
  if (!mesh_.has_triangles()) return;
  constexpr int texture_unit = 3;  // beside those of the light
  const Program* in_use = nullptr;
  mesh_.draw_looks(texture_unit, nearest_pixel(options), [&](SurfaceTraits traits) {
    if (has_values_) {  // these tell something, whatever bodies look like
      traits = {.has_cloth = traits.has_cloth};
      traits.is_colored = true;
    }
    traits.is_flat = appearance.shading == pliant::Shading::flat;
    traits.has_shadows = light_.has_shadows();
    traits.has_occlusion = light_.has_occlusion();
    const Program& program = surface_programs_.of(traits);
    if (&program == std::exchange(in_use, &program)) return;
    program.use();
    program.set("camera", camera);
    light_.set(program);
    set_tones(program, appearance);
    program.set("held", solid_tone);
    program.set("picture", texture_unit);
    set_colors(program, options);
  });
}

void Renderer::draw_ropes(const pliant::ViewSettings& appearance, const DrawOptions& options, const Mat4f& camera) {
  if (!mesh_.has_ropes()) return;
  SurfaceTraits traits{.is_rope = true};
  traits.is_colored = has_values_;
  traits.has_looks = !has_values_;
  traits.has_shadows = light_.has_shadows();
  traits.has_occlusion = light_.has_occlusion();
  const Program& program = surface_programs_.of(traits);
  program.use();
  program.set("camera", camera);
  program.set("picture", size_);
  program.set("lift", depth_shift(options.viewpoint, bounds_, lift * bounds_.radius()));
  program.set("width", rope_width * options.scale);
  set_directions(program, options.viewpoint);
  set_tones(program, appearance);
  light_.set(program);
  set_colors(program, options);
  mesh_.draw_ropes();
}

void Renderer::draw_wireframe(const DrawOptions& options, const Mat4f& camera) const {
  line_.use();
  line_.set("camera", camera);
  line_.set("picture", size_);
  line_.set("lift", depth_shift(options.viewpoint, bounds_, lift * bounds_.radius()));
  line_.set("width", edge_width * options.scale);
  line_.set("opacity", 0.55F);
  line_.set("tone", edge_color);
  mesh_.draw_edges();
}

/// What shows values.
void Renderer::set_colors(const Program& program, const DrawOptions& options) const {
  program.set("low", options.range[0]);
  program.set("high", options.range[1]);
  program.set("colors", 0);
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, map_.id());
}

void Renderer::set_selection(const std::vector<std::uint32_t>& vertices) {
  glBindVertexArray(selected_array_.id());
  upload(selected_, GL_ELEMENT_ARRAY_BUFFER, vertices, GL_DYNAMIC_DRAW);
  glBindVertexArray(0);
  selected_count_ = count_of(vertices);
}

void Renderer::set_up_markers(const DrawOptions& options, const Mat4f& camera, const Vec2f& picture) const {
  marker_.use();
  marker_.set("camera", camera);
  marker_.set("picture", picture);
  marker_.set("lift", depth_shift(options.viewpoint, bounds_, 4 * lift * bounds_.radius()));
}

void Renderer::draw_markers(const DrawOptions& options, const Mat4f& camera, const Vec2f& picture) const {
  if (marker_count_ == 0 || !options.markers) return;
  set_up_markers(options, camera, picture);
  const float radius = std::max(marker_radius * options.scale, least_marker_radius * options.pixel);
  marker_.set("radius", radius);
  marker_.set("core_radius", std::min(0.7F * radius, radius - 0.8F));
  marker_.set("tone", pin_color);
  glBindVertexArray(markers_array_.id());
  glDrawElements(GL_POINTS, marker_count_, GL_UNSIGNED_INT, nullptr);
}

/// Behind the marks of pins, which are smaller, as rings around them.
void Renderer::draw_selection(const DrawOptions& options, const Mat4f& camera, const Vec2f& picture) const {
  if (selected_count_ == 0 || !options.selection) return;
  set_up_markers(options, camera, picture);
  const float radius = std::max(selected_radius * options.scale, least_selected_radius * options.pixel);
  marker_.set("radius", radius);
  marker_.set("core_radius", radius - 0.8F * options.scale);
  marker_.set("tone", selected_color);
  glBindVertexArray(selected_array_.id());
  glDrawElements(GL_POINTS, selected_count_, GL_UNSIGNED_INT, nullptr);
}

}  // namespace pliant_render
