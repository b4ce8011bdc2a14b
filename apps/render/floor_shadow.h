#pragma once
// The shadow on a floor: what throws it, flattened along the light and blurred; the farther above the floor it is, the
// wider and the lighter.
#include <array>
#include <functional>

#include "render/gl_objects.h"

namespace pliant_render {

/// Where a shadow lies on a floor, in its frame [m].
struct ShadowArea {
  Vec2f middle = Vec2f::Zero();
  Vec2f reach = Vec2f::Ones();
};

/// Draw all that throws a shadow; `colliders` sets the uniform `place` of the program for each.
struct ShadowCasters {
  std::function<void()> ropes, bodies;
  std::function<void(const Program&)> colliders;
};

class FloorShadow {
 public:
  /// Needs a current OpenGL context, as do all members.
  FloorShadow();

  /// Draws the mask of a shadow. to_floor: from space to the frame of the floor, which is z = 0 there; light: where it
  /// comes from, in that frame, of length 1; flat: where the shadow lies were it not blurred [m]. is_soft: the blur
  /// grows with the height; else it is the same everywhere, and coarser, which takes less time.
  ShadowArea draw(const Mat4f& to_floor, const Vec3f& light, const ShadowArea& flat, bool is_soft,
                  const ShadowCasters& casters);
  /// Binds the mask to a unit: 1 in the shadow, and 0 beyond its edges.
  void bind(GLenum unit) const;

 private:
  static constexpr int layer_count = 4;
  /// A texture of a mask, and what draws into it.
  struct Layer {
    Texture texture;
    Framebuffer target;
  };

  void set_up(bool is_soft);
  void flatten(const Mat4f& to_floor, const Vec3f& light, const ShadowArea& area, const ShadowCasters& casters) const;
  void blur(const Texture& from, int level, const Vec4f& channel, const Layer& to, int size, const Vec2f& step) const;
  void combine() const;
  int size_of(int layer) const { return size_ >> layer; }

  Program flatten_, flatten_ropes_, blur_, combine_;
  VertexArray empty_array_;
  Layer flat_, mask_;  // of what is flattened, with a channel for each layer of heights; of the shadow
  std::array<Layer, layer_count> half_blurred_, blurred_;
  int size_ = 0;  // of the masks, along a side [texels]
  bool is_soft_ = false;
};

}  // namespace pliant_render
