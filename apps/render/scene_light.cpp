#include "render/scene_light.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "render/shaders.h"

namespace pliant_render {
namespace {

constexpr int shadow_map_size = 1024;  // of shadows [texels]

/// A texture of numbers with this target drawing into it.
void set_up(const Texture& texture, const Framebuffer& target, GLenum format, int width, int height) {
  const bool is_depth = format == GL_DEPTH_COMPONENT32F;
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexImage2D(GL_TEXTURE_2D, 0, static_cast<GLint>(format), width, height, 0, is_depth ? GL_DEPTH_COMPONENT : GL_RGBA,
               GL_FLOAT, nullptr);
  const GLint filter = is_depth ? GL_NEAREST : GL_LINEAR;
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, filter);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
  glBindFramebuffer(GL_FRAMEBUFFER, target.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, is_depth ? GL_DEPTH_ATTACHMENT : GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D,
                         texture.id(), 0);
}

/// Compared with a depth, between texels; what lies outside is in the light.
void compare_depths(const Texture& texture) {
  glBindTexture(GL_TEXTURE_2D, texture.id());
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_MODE, GL_COMPARE_REF_TO_TEXTURE);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_BORDER);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_BORDER);
  const std::array<float, 4> far = {1, 1, 1, 1};
  glTexParameterfv(GL_TEXTURE_2D, GL_TEXTURE_BORDER_COLOR, far.data());
}

void begin_depths(const Framebuffer& target, int width, int height) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.id());
  glViewport(0, 0, width, height);
  glDisable(GL_BLEND);
  glEnable(GL_DEPTH_TEST);
  glClear(GL_DEPTH_BUFFER_BIT);
}

/// From space to where light that comes from `to_light` sees a ball of this radius: -1 to 1 in all directions.
Mat4f seen_by_light(const Vec3f& center, float radius, const Vec3f& to_light) {
  const Vec3f aside = std::abs(to_light.z()) < 0.9F ? Vec3f::UnitZ().eval() : Vec3f::UnitY().eval();
  const Vec3f right = aside.cross(to_light).normalized();
  Mat4f m = Mat4f::Identity();
  m.block<1, 3>(0, 0) = right.transpose() / radius;
  m.block<1, 3>(1, 0) = to_light.cross(right).transpose() / radius;
  m.block<1, 3>(2, 0) = -to_light.transpose() / radius;
  m.topRightCorner<3, 1>() = -m.topLeftCorner<3, 3>() * center;
  return m;
}

void draw_screen(const VertexArray& empty_array) {
  glBindVertexArray(empty_array.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

/// Nothing outside of this part of a picture is drawn, until GL_SCISSOR_TEST is disabled.
void limit_to(const PictureArea& area, const Vec2f& picture) {
  const Vec2f low = area.low.cwiseProduct(picture).array().floor(),
              high = area.high.cwiseProduct(picture).array().ceil();
  glEnable(GL_SCISSOR_TEST);
  glScissor(static_cast<GLint>(low.x()), static_cast<GLint>(low.y()), static_cast<GLsizei>(high.x() - low.x()),
            static_cast<GLsizei>(high.y() - low.y()));
}

void go_to(const Framebuffer& target, const Vec2f& size) {
  glBindFramebuffer(GL_FRAMEBUFFER, target.id());
  glViewport(0, 0, static_cast<GLsizei>(size.x()), static_cast<GLsizei>(size.y()));
}

/// For a program that goes over the pixels of this part; the others are in full light, and far away.
void begin_screen(const Framebuffer& target, const Vec2f& size, const PictureArea& area) {
  go_to(target, size);
  glDisable(GL_SCISSOR_TEST);  // which would limit clearing as well
  glClearColor(1, 6e4F, 1, 1);
  glClear(GL_COLOR_BUFFER_BIT);
  limit_to(area, size);
}

void set_lens(const Program& program, const Mat4f& projection) {
  program.set("lens", Vec4f(1 / projection(0, 0), 1 / projection(1, 1), projection(2, 2), projection(2, 3)));
  program.set("inset", projection(0, 2));
}

void bind(GLenum unit, const Texture& texture) {
  glActiveTexture(unit);
  glBindTexture(GL_TEXTURE_2D, texture.id());
}

}  // namespace

SceneLight::SceneLight()
    : depth_(shaders::depth_vertex, "", shaders::depth_fragment),
      rope_depth_(shaders::depth_vertex, shaders::line_geometry, shaders::depth_fragment),
      screen_depth_(shaders::screen_depth_vertex, "", shaders::screen_depth_fragment),
      rope_screen_depth_(shaders::depth_vertex, shaders::line_geometry, shaders::rope_screen_depth_fragment),
      occlusion_(shaders::screen_vertex, "", shaders::reading_depths(shaders::occlusion_fragment)),
      occlusion_blur_(shaders::screen_vertex, "", shaders::occlusion_blur_fragment),
      screen_light_program_(shaders::screen_vertex, "", shaders::reading_depths(shaders::screen_light_fragment)) {
  set_up(shadow_map_, shadow_target_, GL_DEPTH_COMPONENT32F, shadow_map_size, shadow_map_size);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  compare_depths(shadow_map_);
  const std::vector<Vec3f> corners = {{-1, -1, 0}, {1, -1, 0}, {-1, 1, 0}, {1, 1, 0}};
  glBindVertexArray(square_array_.id());
  upload(square_, GL_ARRAY_BUFFER, corners, GL_STATIC_DRAW);
  glEnableVertexAttribArray(0);
  glVertexAttribPointer(0, 3, GL_FLOAT, GL_FALSE, sizeof(Vec3f), nullptr);
  glBindVertexArray(0);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

void SceneLight::begin(const Vec3f& eye, const Vec3f& to_light, float pixel) {
  eye_ = eye;
  of_picture_ = 1 / pixel;
  to_light_ = to_light;
  has_shadows_ = has_occlusion_ = false;
}

void SceneLight::draw_shadow_map(const Bounds& bounds, float setback, const DrawDepths& draw) {
  if (bounds.is_empty()) return;
  const float radius = std::max(1.05F * bounds.radius(), 1e-3F);
  const Mat4f camera = seen_by_light(bounds.center(), radius, to_light_);
  begin_depths(shadow_target_, shadow_map_size, shadow_map_size);
  for (const Program* program : {&rope_depth_, &depth_}) {
    program->use();
    program->set("camera", camera);
    program->set("picture", Vec2f(shadow_map_size, shadow_map_size));
  }
  glEnable(GL_DEPTH_CLAMP);
  glEnable(GL_POLYGON_OFFSET_FILL);
  glPolygonOffset(2, 2);
  draw(setback / radius);
  glDisable(GL_POLYGON_OFFSET_FILL);
  glDisable(GL_DEPTH_CLAMP);
  Mat4f to_texture = Mat4f::Identity();
  to_texture.diagonal().head<3>().setConstant(0.5F);
  to_texture.topRightCorner<3, 1>().setConstant(0.5F);
  to_shadow_map_ = to_texture * camera;
  texel_ = 2 * radius / shadow_map_size;
  has_shadows_ = true;
}

void SceneLight::set_up_screen(int width, int height) {
  if (width == width_ && height == height_) return;
  width_ = width;
  height_ = height;
  const int half_width = (width + 1) / 2, half_height = (height + 1) / 2;
  set_up(depths_, depth_target_, GL_DEPTH_COMPONENT32F, width, height);
  set_up(normals_, depth_target_, GL_RGBA8, width, height);
  set_up(raw_, raw_target_, GL_RG16F, half_width, half_height);
  set_up(shares_, share_target_, GL_RG16F, half_width, half_height);
  set_up(screen_light_, screen_target_, GL_RGBA16F, width, height);
}

void SceneLight::draw_screen_light(const Viewpoint& viewpoint, const ScreenLook& look,
                                   const std::function<void()>& draw, const std::function<void()>& draw_thin) {
  const Vec2f size = (look.share * look.picture).array().floor().max(1);
  set_up_screen(static_cast<int>(size.x()), static_cast<int>(size.y()));
  screen_scale_ = size.cwiseQuotient(look.picture);
  area_ = look.area;
  const Mat4f projection = viewpoint.projection(look.picture.x() / look.picture.y());
  begin_depths(depth_target_, width_, height_);
  for (const Program* program : {&rope_screen_depth_, &screen_depth_}) {
    program->use();
    program->set("camera", Mat4f(projection * viewpoint.view()));
    program->set("picture", size);
  }
  depth_in_use_ = &screen_depth_;
  draw();
  glDisable(GL_DEPTH_TEST);
  find_occlusion(projection, look.reach);
  has_occlusion_ = true;
  go_to(depth_target_, size);
  glEnable(GL_DEPTH_TEST);
  draw_thin();
  glDisable(GL_DEPTH_TEST);
  depth_in_use_ = &depth_;
  find_screen_light(projection, viewpoint.view());
}

void SceneLight::draw_square(const Mat4f& place) const {
  depth_program().use();
  depth_program().set("place", place);
  depth_program().set("setback", 0.0F);
  glVertexAttrib3f(1, 0, 0, 0);
  glBindVertexArray(square_array_.id());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
}

void SceneLight::find_occlusion(const Mat4f& projection, float reach) const {
  const Vec2f size((width_ + 1) / 2, (height_ + 1) / 2);
  begin_screen(raw_target_, size, area_);
  bind(GL_TEXTURE0, depths_);
  occlusion_.use();
  occlusion_.set("depths", 0);
  set_lens(occlusion_, projection);
  occlusion_.set("reach", reach);
  occlusion_.set("pixels", projection(1, 1) * static_cast<float>(height_) / 4);
  draw_screen(empty_array_);
  occlusion_blur_.use();
  occlusion_blur_.set("occlusion", 0);
  const auto blur = [&](const Texture& from, const Framebuffer& to, int side, int corner) {
    begin_screen(to, size, area_);
    bind(GL_TEXTURE0, from);
    occlusion_blur_.set("side", side);
    occlusion_blur_.set("corner", corner);
    draw_screen(empty_array_);
  };
  // The mean over squares has steps where what is seen changes; those of four neighbors are smoother.
  blur(raw_, share_target_, 4, -2);
  blur(shares_, raw_target_, 2, 0);
  glDisable(GL_SCISSOR_TEST);
}

void SceneLight::find_screen_light(const Mat4f& projection, const Mat4f& view) const {
  begin_screen(screen_target_, Vec2f(width_, height_), area_);
  const Program& program = screen_light_program_;
  program.use();
  program.set("depths", 0);
  program.set("shadow_map", 1);
  program.set("occlusion", 2);
  bind(GL_TEXTURE0, depths_);
  bind(GL_TEXTURE1, shadow_map_);
  bind(GL_TEXTURE2, raw_);
  set_lens(program, projection);
  program.set("normals", 3);
  bind(GL_TEXTURE3, normals_);
  program.set("has_shadows", has_shadows_ ? 1 : 0);
  program.set("view", Mat3f(view.topLeftCorner<3, 3>()));
  program.set("to_shadow_map", Mat4f(to_shadow_map_ * view.inverse()));
  program.set("texel", texel_);
  program.set("light", Vec3f(view.topLeftCorner<3, 3>() * to_light_));
  draw_screen(empty_array_);
  glDisable(GL_SCISSOR_TEST);
}

void SceneLight::set_floor(const Program& program, const Vec2f& picture) const {
  program.set("of_picture", of_picture_);
  program.set("screen_light", 1);
  program.set("to_screen", Vec2f(picture.cwiseInverse()));
  bind(GL_TEXTURE1, screen_light_);
  glActiveTexture(GL_TEXTURE0);
}

void SceneLight::set(const Program& program) const {
  program.set("of_picture", of_picture_);
  program.set("eye", eye_);
  program.set("light", to_light_);
  program.set("screen_light", 1);
  program.set("screen_scale", screen_scale_);
  bind(GL_TEXTURE1, screen_light_);
  glActiveTexture(GL_TEXTURE0);
}

}  // namespace pliant_render
