#pragma once
// A handle to move and turn pins together: arrows and rings around their middle.
#include <array>
#include <optional>
#include <vector>

#include "viewer/mouse_interaction.h"

struct ImDrawList;

namespace pliant_viewer {

class PinGizmo {
 public:
  /// What the mouse can take hold of. Moving goes along an axis of space, or in the plane of the picture.
  enum class Part { none, plane, move_x, move_y, move_z, turn_x, turn_y, turn_z };

  /// Stands in the middle of the selected pins, unless it is dragged.
  void follow(const std::vector<std::uint32_t>& selected, const Snapshot& snapshot);
  bool is_shown() const { return !pins_.empty(); }

  /// Takes a press on one of its parts, and what follows until the release; false: the event is not meant for it.
  bool handle(const MouseEvent& event, const MouseInteraction::View& view);
  /// Moves the pins if the mouse has moved, and the scene has followed, since the last call.
  void flush(const MouseInteraction::View& view);
  bool is_busy() const { return held_ != Part::none; }
  /// Whether it moves or turns pins: the mouse has gone on since it took a part.
  bool is_holding() const { return is_busy() && is_held_; }
  void cancel() { *this = PinGizmo(); }
  /// What a press at this place would take hold of.
  Part part_at(const Vec2f& at, const MouseInteraction::View& view) const;
  /// Where a part is drawn, for its middle.
  std::optional<Vec2f> place_of(Part part, const MouseInteraction::View& view) const;

  /// How far the pins have been moved since they were taken.
  const RigidMotion& motion() const { return motion_; }
  void draw(const MouseInteraction::View& view, Part hovered, ImDrawList& list) const;

 private:
  /// A single pin is dragged, and let go, as it is.
  bool has_dot() const { return pins_.size() > 1; }
  Vec3f middle() const { return motion_.center + motion_.translation; }
  float reach(const MouseInteraction::View& view) const;
  std::vector<Vec3f> ring(int axis, const MouseInteraction::View& view) const;
  std::optional<float> angle_at(const Vec2f& at, const MouseInteraction::View& view) const;
  void begin(Part part, const Vec2f& at);
  void aim(const MouseInteraction::View& view);
  void hold(const MouseInteraction::View& view);
  void send(const MouseInteraction::View& view);
  void drag(const Vec2f& to, const MouseInteraction::View& view);
  void draw_targets(const MouseInteraction::View& view, ImDrawList& list) const;
  void draw_arrow(int axis, const MouseInteraction::View& view, bool is_lit, ImDrawList& list) const;
  void draw_ring_of(int axis, const MouseInteraction::View& view, bool is_lit, ImDrawList& list) const;

  std::vector<Index> pins_;     // vertices
  std::vector<Vec3f> targets_;  // of these, before motion_ [m]
  RigidMotion motion_;
  Part held_ = Part::none;
  bool is_held_ = false;  // the mouse has moved beyond a click since it took the part
  Vec2f pressed_ = {0, 0}, last_ = {0, 0};
  float turned_ = 0;  // [rad]
  std::optional<float> last_angle_;
  Vec2f tangent_ = {0, 0};  // by which a ring that is seen from its edge turns [rad per unit of the mouse]
  float along_ = 0;         // where on an axis it was taken [m]
  Vec3f grip_ = {0, 0, 0};  // from the place under the mouse to the middle
  bool has_moved_ = false;
  std::uint64_t motion_command_ = 0;  // that moved them last
  std::uint64_t command_ = 0;         // that let go last
};

}  // namespace pliant_viewer
