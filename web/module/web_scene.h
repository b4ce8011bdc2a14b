#pragma once
// A scene as a web page has it: a session of the window, and what is drawn of it. Vertices have the indices of the
// simulation. What a user does wrong throws pliant::Error, with the scene as it was.
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "pliant_io/mesh/mesh_file.h"
#include "render/camera_path.h"
#include "render/capture.h"
#include "viewer/auto_range.h"
#include "viewer/session.h"

namespace pliant_web {

using pliant::Index;
using pliant::Real;
using pliant_render::Vec3f;

/// What is drawn of a scene until its bodies change. Corners: all vertices, and behind them copies at hard edges.
struct Look {
  pliant_render::RenderMesh mesh;
  std::vector<std::array<std::uint8_t, 4>> front;   ///< one per corner: red, green, blue; 255 of a sheet, else 0
  std::vector<std::array<std::uint8_t, 4>> back;    ///< red, green, blue, the number of the pattern
  std::vector<std::array<std::uint8_t, 4>> second;  ///< red, green, blue of the pattern
  std::vector<Vec3f> places;                        ///< in the pattern
  pliant_render::Viewpoint viewpoint;
  float radius = 1;  ///< of the box around everything at the start [m]
};

/// What changes from picture to picture.
struct Frame {
  std::vector<Vec3f> positions, normals;  ///< one per corner
  std::vector<pliant_render::DrawnCollider> colliders;
  std::vector<std::uint32_t> pins;                    ///< ascending
  float ground = 0;                                   ///< height of the floor that is drawn [m]
  std::optional<pliant_render::Viewpoint> viewpoint;  ///< of now, where the scene moves its camera
};

/// What colors show.
struct Values {
  std::vector<float> values;   ///< one per corner
  std::array<float, 2> range;  ///< what the first and the last color of the map stand for
};

class WebScene {
 public:
  /// Of a scene's text; paths in it start at `folder`.
  static WebScene of_text(const std::string& text, const std::string& name, const std::string& folder);
  /// Of the file of a mesh, as make_mesh_scene has it.
  static WebScene of_mesh(const std::string& file, const pliant::ImportOptions& import);

  pliant_viewer::Session& session() { return session_; }
  const pliant_viewer::Session& session() const { return session_; }
  const pliant::ViewSettings& view() const { return view_; }

  /// The camera is placed for a picture of this width over height.
  Look look(float aspect);
  /// Of now; `mesh` is that of the look.
  Frame frame(const pliant_render::RenderMesh& mesh);
  Values values(const pliant_render::RenderMesh& mesh, pliant::ColorBy color);
  void restart(bool keep_changes);

  /// The scene with all changes as a text that of_text() reads.
  std::string text() const;

 private:
  explicit WebScene(pliant_viewer::MakeScene make, std::string folder);

  std::string folder_;
  pliant_viewer::Session session_;
  pliant::ViewSettings view_;
  pliant_render::ColliderSurfaces surfaces_;
  pliant_viewer::AutoRange range_;
  std::optional<float> ground_;  // the lowest so far
  std::optional<pliant_render::CameraPath> camera_path_;
};

}  // namespace pliant_web
