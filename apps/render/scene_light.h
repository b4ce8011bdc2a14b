#pragma once
// What light meets on its way: the shadow map, and how much of the sky each point of the picture sees.
#include <functional>

#include "render/camera.h"
#include "render/gl_objects.h"

namespace pliant_render {

/// Draws all that stands in the way of light with the programs of a SceneLight for depths; colliders give way to what
/// touches them by `setback`, in the depths of OpenGL.
using DrawDepths = std::function<void(float setback)>;

/// Part of a picture, from 0 to 1 along its sides.
struct PictureArea {
  Vec2f low = {0, 0}, high = {1, 1};
};

class SceneLight {
 public:
  /// Needs a current OpenGL context, as do all members.
  SceneLight();

  /// Takes all light as unhindered, until the maps below are drawn anew. pixel: drawn for one of the picture, along a
  /// side.
  void begin(const Vec3f& eye, const Vec3f& to_light, float pixel);
  /// Draws the shadow map of what lies in the box. setback: of colliders [m].
  void draw_shadow_map(const Bounds& bounds, float setback, const DrawDepths& draw);
  /// Draws the depths of the picture, and from them which share of the sky and of the key light each point sees: call
  /// it after draw_shadow_map().
  struct ScreenLook {
    Vec2f picture;     ///< size [pixels]
    float share;       ///< of its width and height that the depths are drawn with
    float reach;       ///< how far away what stands in the way of the sky is looked for [m]
    PictureArea area;  ///< where bodies and colliders may be, with what they may keep light from
  };
  /// Only depth_program() and rope_depth_program() may draw here. draw_thin: what is lit, but too thin to keep light
  /// from others in a picture.
  void draw_screen_light(const Viewpoint& viewpoint, const ScreenLook& look, const std::function<void()>& draw,
                         const std::function<void()>& draw_thin);

  /// A square with sides of 2 in the plane z = 0 of this frame, with the program of depths.
  void draw_square(const Mat4f& place) const;
  /// For triangles, with their normals as attribute 1.
  const Program& depth_program() const { return *depth_in_use_; }
  /// For ropes, through shaders::line_geometry.
  const Program& rope_depth_program() const { return depth_in_use_ == &depth_ ? rope_depth_ : rope_screen_depth_; }
  bool has_shadows() const { return has_shadows_; }
  bool has_occlusion() const { return has_occlusion_; }
  /// Sets the uniforms of shaders::lighting in a program that is in use, and binds textures 1 and 2.
  void set(const Program& program) const;
  /// Where floors may see less of the sky.
  const PictureArea& area() const { return area_; }
  /// Sets those of shaders::plane_fragment that tell what it sees of the sky, and binds texture 1. picture: its size
  /// [pixels].
  void set_floor(const Program& program, const Vec2f& picture) const;

 private:
  void find_occlusion(const Mat4f& projection, float reach) const;
  void find_screen_light(const Mat4f& projection, const Mat4f& view) const;
  void set_up_screen(int width, int height);

  Vec3f eye_ = Vec3f::Zero(), to_light_ = Vec3f::UnitZ();
  bool has_shadows_ = false, has_occlusion_ = false;
  Mat4f to_shadow_map_ = Mat4f::Identity();
  float texel_ = 1;             // of the shadow map [m]
  float of_picture_ = 1;        // pixels of the picture for one drawn
  int width_ = 0, height_ = 0;  // of the depths [pixels]; what is seen of the sky is found at half of that
  Vec2f screen_scale_ = {1, 1};
  PictureArea area_;
  Program depth_, rope_depth_, screen_depth_, rope_screen_depth_, occlusion_, occlusion_blur_, screen_light_program_;
  const Program* depth_in_use_ = &depth_;
  Texture shadow_map_, depths_, normals_, raw_, shares_, screen_light_;
  Framebuffer shadow_target_, depth_target_, raw_target_, share_target_, screen_target_;
  VertexArray square_array_, empty_array_;
  Buffer square_;
};

}  // namespace pliant_render
