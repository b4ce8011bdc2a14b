#pragma once
// The bodies on the graphics card: vertices, what they look like, and lists of triangles, ropes and edges. They may be
// drawn smoother than they are simulated.
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>

#include "render/gl_objects.h"
#include "render/loop_subdivision.h"
#include "render/render_mesh.h"
#include "render/surface_programs.h"

namespace pliant_render {

class MeshBuffers {
 public:
  /// Needs a current OpenGL context, as do all members.
  explicit MeshBuffers(RenderMesh render_mesh);

  /// As it is simulated.
  const RenderMesh& render_mesh() const { return render_mesh_; }
  /// What bodies look like from now on. Textures that cannot be read are left out, see texture_error.
  void set_looks(BodyLooks looks);
  /// Why a texture is left out that the last call of set_looks() has tried to read; empty: none is.
  const std::string& texture_error() const { return texture_error_; }
  /// From the next frame on each triangle is cut into four so many times, and the surface is rounder; 0: as it is.
  /// Fewer times where that would be more than four million triangles. Returns whether it is new.
  bool set_subdivision(int levels);
  /// values: one per vertex, or none. Without them vertices have the number of their tones, -1 those that are held.
  void set_frame(const FrameContent& frame, bool has_values);
  /// Where vertices are in this frame, those of the finer surface and copies as well [m].
  std::span<const Vec3f> positions() const { return positions_; }

  void draw_triangles() const;
  /// Body by body, each with its texture at this unit; `use` prepares the program for what a body has. `pixel`: what a
  /// pixel shows of the nearest one, across [m].
  void draw_looks(int unit, float pixel, const std::function<void(const SurfaceTraits&)>& use) const;
  void draw_ropes() const;
  void draw_edges() const;
  bool has_triangles() const { return !render_mesh_.triangles.empty(); }
  bool has_ropes() const { return !render_mesh_.ropes.empty(); }
  /// Prepares an array of points or lines with elements of its own.
  void set_up(const VertexArray& array, const Buffer& elements, const std::vector<std::uint32_t>& list) const;

 private:
  struct Vertex {
    Vec3f position, normal;
    float value;
  };

  /// Read again when its file is another.
  struct KnownTexture {
    std::filesystem::file_time_type time{};
    bool is_read = false;
    std::unique_ptr<Texture> texture{};  // null: it cannot be read
  };

  /// What is known of a body's look before it is drawn.
  struct BodyTraits {
    SurfaceTraits traits;
    float threads = 0;  ///< of the weave, a meter at rest, where they are the widest [1/m]; 0: none
  };

  void set_layout() const;
  void upload_lists();
  void upload_looks();
  void find_traits(const std::vector<VertexLook>& looks);
  std::vector<VertexLook> fine_looks(const std::vector<VertexLook>& coarse) const;
  void read_textures();
  GLuint texture_of(std::size_t body) const;
  const RenderMesh& drawn() const { return levels_ > 0 ? fine_mesh_ : render_mesh_; }

  RenderMesh render_mesh_, fine_mesh_;  // the fine one has lists to draw alone
  FineSurface fine_;
  int levels_ = 0;
  std::vector<Vec3f> positions_;
  std::vector<float> values_, coarse_values_;
  std::vector<Vertex> vertices_;
  VertexArray triangles_array_, ropes_array_, edges_array_;
  Buffer vertex_buffer_, looks_, triangles_, ropes_, edges_;
  std::map<std::string, KnownTexture> textures_;  // by path
  std::string texture_error_;
  std::vector<BodyTraits> traits_;  // of each body
  Texture no_texture_;              // through which the color is seen
};

}  // namespace pliant_render
