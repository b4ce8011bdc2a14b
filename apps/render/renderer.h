#pragma once
// Draws frames of one render mesh with OpenGL 3.3 core, with or without a window.
#include <optional>

#include "render/collider_painter.h"
#include "render/floor_shadow.h"
#include "render/gl_objects.h"
#include "render/mesh_buffers.h"
#include "render/pass_clock.h"

namespace pliant_render {

/// How a frame is drawn, in addition to the scene's settings.
struct DrawOptions {
  Viewpoint viewpoint;                  ///< the camera
  std::array<float, 2> range = {0, 1};  ///< values at the ends of the color map
  float ground_height = 0;              ///< [m]
  float scale = 1;                      ///< of line widths and markers: pixels per pixel of a picture of 720 rows
  float pixel = 1;                      ///< pixels drawn for a pixel of the picture, along a side
  bool markers = true;                  ///< on pinned vertices and those under a test force
  bool selection = false;               ///< marks on selected vertices
  std::optional<pliant::Index> lit_collider{};       ///< the number of one that is drawn brighter
  std::optional<pliant::Index> selected_collider{};  ///< of another one
  pliant::Quality quality = pliant::Quality::high;   ///< `automatic` is `high` here
  PassClock* clock = nullptr;                        ///< for who wants to know what takes how long
};

class Renderer {
 public:
  /// Needs a current OpenGL context, as do all members.
  explicit Renderer(RenderMesh render_mesh);

  const RenderMesh& render_mesh() const { return mesh_.render_mesh(); }
  /// What bodies look like from now on. Textures that cannot be read are left out, see texture_error.
  void set_looks(BodyLooks looks) { mesh_.set_looks(std::move(looks)); }
  const std::string& texture_error() const { return mesh_.texture_error(); }
  /// Surfaces are drawn that much smoother from the next frame on, see ViewSettings::subdivision. Returns whether that
  /// is new.
  bool set_subdivision(int levels) { return mesh_.set_subdivision(levels); }
  /// Uploads the positions, values and markers of a frame.
  void set_frame(const FrameContent& frame, pliant::ColorBy color);
  /// Vertices that are marked as selected in all frames from now on.
  void set_selection(const std::vector<std::uint32_t>& vertices);
  /// Clears the bound framebuffer of this size [pixels] and draws the frame.
  void draw(const pliant::ViewSettings& appearance, const DrawOptions& options, int width, int height);

 private:
  /// Both of space: from it to the frame of the floor, and where light comes from.
  ShadowArea draw_shadow(const Mat4f& to_floor, const Vec3f& light, pliant::Quality quality);
  Projection projection(const DrawOptions& options) const;
  void draw_light_maps(const pliant::ViewSettings& appearance, const DrawOptions& options);
  PictureArea dark_area(const Mat4f& floor, const ShadowArea* shadow, const DrawOptions& options) const;
  PictureArea area_of(const DrawOptions& options, float reach) const;
  void draw_depths(float setback) const;
  void draw_floor_depths(const pliant::ViewSettings& appearance, const DrawOptions& options) const;
  /// width: in the picture that is drawn [pixels]
  void draw_rope_depths(const DrawOptions& options, float width) const;
  void go_to_picture(GLuint target) const;
  void draw_planes(const pliant::ViewSettings& appearance, const DrawOptions& options, GLuint target);
  void draw_surface(const pliant::ViewSettings& appearance, const DrawOptions& options, const Mat4f& camera);
  /// What a pixel shows of the nearest body, across [m]; 0: the camera is among them.
  float nearest_pixel(const DrawOptions& options) const;
  void draw_ropes(const pliant::ViewSettings& appearance, const DrawOptions& options, const Mat4f& camera);
  void draw_wireframe(const DrawOptions& options, const Mat4f& camera) const;
  void set_colors(const Program& program, const DrawOptions& options) const;
  void draw_markers(const DrawOptions& options, const Mat4f& camera, const Vec2f& picture) const;
  void draw_selection(const DrawOptions& options, const Mat4f& camera, const Vec2f& picture) const;
  void set_up_markers(const DrawOptions& options, const Mat4f& camera, const Vec2f& picture) const;

  MeshBuffers mesh_;
  ColliderPainter colliders_;
  SceneLight light_;
  Bounds bounds_;
  float setback_ = 0;    // of colliders [m]
  Vec2f size_ = {1, 1};  // of the picture [pixels]
  bool has_values_ = false;
  pliant::ColorBy map_of_ = pliant::ColorBy::none;
  GLsizei marker_count_ = 0, selected_count_ = 0;
  SurfacePrograms surface_programs_;
  Program line_, marker_;
  FloorShadow floor_shadow_;
  VertexArray markers_array_, selected_array_, empty_array_;
  Buffer markers_, selected_;
  Texture map_;
};

}  // namespace pliant_render
