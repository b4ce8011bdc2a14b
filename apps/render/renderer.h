#pragma once
// Draws frames of one scenery with OpenGL 3.3 core, in a window as well as without one.
#include "render/gl_objects.h"
#include "render/scenery.h"

namespace pliant_render {

/// How a frame is drawn, besides the scene's settings.
struct DrawOptions {
  Viewpoint viewpoint;
  std::array<float, 2> range = {0, 1};  ///< of the values, at the ends of the color map
  float ground_height = 0;              ///< [m]
  float scale = 1;                      ///< of widths and marks: pixels of the picture to one at 720 rows
};

class Renderer {
 public:
  /// Needs a current context, as do all members.
  explicit Renderer(Scenery scenery);

  const Scenery& scenery() const { return scenery_; }
  /// Takes over the positions, values and markers of a frame.
  void set_frame(const FrameContent& frame, pliant::ColorBy color);
  /// Clears the framebuffer that is bound, of this size in pixels, and draws the frame.
  void draw(const pliant::ViewSettings& look, const DrawOptions& options, int width, int height);

 private:
  struct Vertex {
    Vec3f position, normal;
    float value;
  };
  /// Where the shadow lies on the ground.
  struct ShadowArea {
    Vec2f middle, reach;
  };

  void set_vertex_layout() const;
  ShadowArea draw_shadow(const Vec3f& light, float height);
  void blur(const Texture& from, const Framebuffer& to, const Vec2f& step) const;
  void draw_ground(const pliant::ViewSettings& look, const DrawOptions& options, const Mat4f& camera) const;
  void lay_shadow(const ShadowArea& area, float height, const Mat4f& camera) const;
  void draw_surface(const pliant::ViewSettings& look, const DrawOptions& options, const Mat4f& camera) const;
  void draw_lines(const pliant::ViewSettings& look, const DrawOptions& options, const Mat4f& camera,
                  const Vec2f& picture) const;
  void draw_markers(const DrawOptions& options, const Mat4f& camera, const Vec2f& picture) const;

  Scenery scenery_;
  Bounds bounds_;
  bool has_values_ = false;
  pliant::ColorBy map_of_ = pliant::ColorBy::none;
  GLsizei marker_count_ = 0;
  std::vector<Vertex> vertices_;
  Program surface_, flat_surface_, line_, marker_, flatten_, flatten_ropes_, blur_, ground_, shadow_;
  VertexArray triangles_array_, ropes_array_, edges_array_, markers_array_, empty_array_;
  Buffer vertex_buffer_, triangles_, ropes_, edges_, markers_;
  Texture map_, mask_, half_blurred_;
  Framebuffer mask_target_, half_blurred_target_;
};

}  // namespace pliant_render
