#include "render/floor_shadow.h"

#include <algorithm>

#include "render/shaders.h"

namespace pliant_render {
namespace {

constexpr int plain_size = 192, soft_size = 320;               // along a side [texels]
constexpr float plain_step = 0.75F, soft_step = 0.9F;          // from tap to tap of the blur [texels]
constexpr float plain_margin = 0.06F, soft_margin = 0.2F;      // around what is flattened, of its half
constexpr float plain_rope_width = 1.5F, soft_rope_width = 3;  // [texels]
constexpr float taps_of_spread = 2.5F;     // the blur has a bell's shape, with so many taps as its standard deviation
constexpr float spread_of_height = 0.07F;  // standard deviation of the blur, for 1 m on the way of the light [m]

void set_up_mask(const Texture& texture, const Framebuffer& target, GLenum format, int size) {
  set_up_texture(texture, format, size, size, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, target.id());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture.id(), 0);
}

void bind_texture(GLenum unit, const Texture& texture) {
  glActiveTexture(unit);
  glBindTexture(GL_TEXTURE_2D, texture.id());
}

}  // namespace

FloorShadow::FloorShadow()
    : flatten_(shaders::flatten_vertex, "", shaders::flatten_fragment),
      flatten_ropes_(shaders::flatten_vertex, shaders::line_geometry, shaders::flatten_fragment),
      blur_(shaders::screen_vertex, "", shaders::blur_fragment),
      combine_(shaders::screen_vertex, "", shaders::combine_fragment) {}

void FloorShadow::set_up(bool is_soft) {
  const int size = is_soft ? soft_size : plain_size;
  if (size == size_ && is_soft == is_soft_) return;
  size_ = size;
  is_soft_ = is_soft;
  set_up_mask(flat_.texture, flat_.target, GL_RGBA8, size);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_NEAREST);
  glGenerateMipmap(GL_TEXTURE_2D);
  set_up_mask(mask_.texture, mask_.target, GL_R8, size);
  const int layers = is_soft ? layer_count : 1;
  for (int i = 0; i < layers; ++i) {
    const auto place = static_cast<std::size_t>(i);
    set_up_mask(half_blurred_[place].texture, half_blurred_[place].target, GL_R8, size_of(i));
    set_up_mask(blurred_[place].texture, blurred_[place].target, GL_R8, size_of(i));
  }
}

ShadowArea FloorShadow::draw(const Mat4f& to_floor, const Vec3f& light, const ShadowArea& flat, bool is_soft,
                             const ShadowCasters& casters) {
  set_up(is_soft);
  const float half = std::max(flat.reach.maxCoeff(), 1e-3F);
  ShadowArea area{flat.middle, flat.reach.array() + (is_soft ? soft_margin : plain_margin) * half};
  if (is_soft) area.reach.setConstant(area.reach.maxCoeff());  // the blur of layers goes by texels
  flatten(to_floor, light, area, casters);
  // As wide in both directions on the ground, not in the mask.
  const float texel = (is_soft ? soft_step : plain_step) * area.reach.maxCoeff() / static_cast<float>(size_);
  const Vec2f step = texel * area.reach.cwiseInverse();
  const int layers = is_soft ? layer_count : 1;
  for (int i = 0; i < layers; ++i) {
    const auto place = static_cast<std::size_t>(i);
    const Vec2f wide = step * static_cast<float>(1 << i);
    const Layer& to = is_soft ? blurred_[place] : mask_;
    blur(flat_.texture, i, Vec4f::Unit(i), half_blurred_[place], size_of(i), {wide.x(), 0});
    blur(half_blurred_[place].texture, 0, Vec4f::Unit(0), to, size_of(i), {0, wide.y()});
  }
  if (is_soft) combine();
  return area;
}

void FloorShadow::flatten(const Mat4f& to_floor, const Vec3f& light, const ShadowArea& area,
                          const ShadowCasters& casters) const {
  glBindFramebuffer(GL_FRAMEBUFFER, flat_.target.id());
  glViewport(0, 0, size_, size_);
  glClearColor(0, 0, 0, 0);
  glClear(GL_COLOR_BUFFER_BIT);
  glEnable(GL_BLEND);  // each height by itself
  glBlendFunc(GL_ONE, GL_ONE);
  glBlendEquation(GL_MAX);
  const float least_spread = taps_of_spread * soft_step * 2 * area.reach.maxCoeff() / static_cast<float>(size_);
  const auto use = [&](const Program& program) {
    program.use();
    program.set("place", to_floor);
    program.set("light", light);
    program.set("middle", area.middle);
    program.set("reach", area.reach);
    program.set("spreads", is_soft_ ? spread_of_height / (std::max(light.z(), 0.05F) * least_spread) : 0.0F);
    program.set("picture", Vec2f(static_cast<float>(size_), static_cast<float>(size_)));
    program.set("width", is_soft_ ? soft_rope_width : plain_rope_width);
    program.set("lift", 0.0F);
  };
  use(flatten_ropes_);
  casters.ropes();
  use(flatten_);
  casters.bodies();
  casters.colliders(flatten_);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glDisable(GL_BLEND);
  bind_texture(GL_TEXTURE0, flat_.texture);
  if (is_soft_) glGenerateMipmap(GL_TEXTURE_2D);
}

void FloorShadow::blur(const Texture& from, int level, const Vec4f& channel, const Layer& to, int size,
                       const Vec2f& step) const {
  glBindFramebuffer(GL_FRAMEBUFFER, to.target.id());
  glViewport(0, 0, size, size);
  blur_.use();
  blur_.set("mask", 0);
  blur_.set("level", static_cast<float>(level));
  blur_.set("channel", channel);
  blur_.set("step_size", step);
  bind_texture(GL_TEXTURE0, from);
  glBindVertexArray(empty_array_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void FloorShadow::combine() const {
  constexpr std::array<const char*, layer_count> names = {"first", "second", "third", "fourth"};
  glBindFramebuffer(GL_FRAMEBUFFER, mask_.target.id());
  glViewport(0, 0, size_, size_);
  combine_.use();
  for (int i = 0; i < layer_count; ++i) {
    const auto place = static_cast<std::size_t>(i);
    combine_.set(names[place], i);
    bind_texture(GL_TEXTURE0 + static_cast<GLenum>(i), blurred_[place].texture);
  }
  glBindVertexArray(empty_array_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glActiveTexture(GL_TEXTURE0);
}

void FloorShadow::bind(GLenum unit) const {
  bind_texture(unit, mask_.texture);
}

}  // namespace pliant_render
