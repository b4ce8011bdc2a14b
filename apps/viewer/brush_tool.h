#pragma once
// Paints the stiffness of a group with the mouse: a drag over its body leaves a soft round mark.
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "viewer/mouse_interaction.h"

struct ImDrawList;

namespace pliant_viewer {

/// Which vertices of a mesh are joined by an edge that is drawn, and which ones are drawn at all.
class DrawnNeighbors {
 public:
  explicit DrawnNeighbors(const pliant_render::RenderMesh& render_mesh);
  std::span<const std::uint32_t> of(std::uint32_t vertex) const {
    return std::span(list_).subspan(begins_[vertex], begins_[vertex + 1] - begins_[vertex]);
  }
  bool is_drawn(std::uint32_t vertex) const { return begins_[vertex + 1] > begins_[vertex]; }

 private:
  std::vector<std::size_t> begins_;
  std::vector<std::uint32_t> list_;
};

/// The vertices of a body around a point that can be reached over its surface without leaving the radius [m], and what
/// a brush leaves there, 1 in the middle, 0 at the rim. Those that are not drawn, inside of solids, all within it.
std::vector<std::pair<std::uint32_t, Real>> brush_mark(const SurfacePoint& point, float radius,
                                                       const DrawnNeighbors& neighbors,
                                                       std::span<const std::uint32_t> bodies,
                                                       std::span<const Vec3f> positions);

class BrushTool {
 public:
  /// What is painted, and its body; no name: the brush is off.
  struct Subject {
    std::string group{};
    std::uint32_t body = 0;
  };
  Subject subject;
  Real factor = 4;   ///< of the stiffness, 0.001 to 1000
  float radius = 0;  ///< [m]
  bool is_on() const { return !subject.group.empty(); }

  /// Takes an event of the left button on the body, and those that follow until it is released; false: it is not meant.
  bool handle(const MouseEvent& event, const MouseInteraction::View& view);
  /// Paints the way to where the mouse is, and sends it unless the scene is still busy with what was sent before.
  void flush(const MouseInteraction::View& view);
  /// Ends the stroke, and sends all of it.
  void finish(const MouseInteraction::View& view);
  bool is_busy() const { return is_painting_; }
  /// Forgets a stroke under way, as when the scene restarts.
  void cancel();

  /// The point of the body under the mouse.
  std::optional<SurfacePoint> point_at(const Vec2f& place, const MouseInteraction::View& view) const;
  /// The rim around a point, as it appears from the eye, and beside it the factor that is there.
  void draw(const SurfacePoint& point, const MouseInteraction::View& view, ImDrawList& list) const;

 private:
  void dab(const Vec2f& at, const MouseInteraction::View& view);
  void paint_way(const MouseInteraction::View& view);
  void send(const MouseInteraction::View& view);

  bool is_painting_ = false, erases_ = false, goes_on_ = false;
  Vec2f last_ = {0, 0}, mouse_ = {0, 0};   // painted up to, and where the mouse has gone
  std::map<std::uint32_t, Real> waiting_;  // by vertex, its share
  std::uint64_t sent_ = 0;                 // the last command
  std::shared_ptr<const pliant_render::RenderMesh> mesh_;
  std::optional<DrawnNeighbors> neighbors_;  // in it
};

}  // namespace pliant_viewer
