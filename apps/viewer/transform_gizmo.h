#pragma once
// A handle in the picture that moves and turns something: arrows and rings around its middle.
#include <optional>
#include <vector>

#include "viewer/mouse_interaction.h"

struct ImDrawList;

namespace pliant_viewer {

/// What it moves, a derived class says.
class TransformGizmo {
 public:
  /// What the mouse can take hold of. Moving goes along an axis, or in the plane of the picture.
  enum class Part { none, plane, move_x, move_y, move_z, turn_x, turn_y, turn_z };

  TransformGizmo() = default;
  TransformGizmo(const TransformGizmo&) = default;
  TransformGizmo& operator=(const TransformGizmo&) = default;
  virtual ~TransformGizmo() = default;

  bool is_shown() const { return is_shown_; }
  /// Takes a press on one of its parts, and what follows until the release; false: the event is not meant for it.
  bool handle(const MouseEvent& event, const MouseInteraction::View& view);
  /// Moves what it holds if the mouse has moved, and the scene has followed, since the last call.
  void flush(const MouseInteraction::View& view);
  bool is_busy() const { return held_ != Part::none; }
  /// Whether it moves or turns something: the mouse has gone on since it took a part.
  bool is_holding() const { return is_busy() && is_held_; }
  /// What a press at this place would take hold of.
  Part part_at(const Vec2f& at, const MouseInteraction::View& view) const;
  /// Where a part is drawn, for its middle.
  std::optional<Vec2f> place_of(Part part, const MouseInteraction::View& view) const;

  /// How far what it holds has been moved since it was taken.
  const RigidMotion& motion() const { return motion_; }
  void draw(const MouseInteraction::View& view, Part hovered, ImDrawList& list) const;

 protected:
  struct Place {
    Vec3f middle = {0, 0, 0};                            ///< [m]
    Eigen::Matrix3f axes = Eigen::Matrix3f::Identity();  ///< its columns
    std::vector<Part> left_out{};                        ///< parts that it does not have
  };
  /// Shows it there, before any motion.
  void stand_at(const Place& place);
  void hide() { is_shown_ = false; }
  /// Whether the scene has come to the last command, so that what it shows of its place counts.
  bool is_up_to_date(const Snapshot& snapshot) const { return !is_busy() && snapshot.commands >= command_; }
  /// A dot where something will be with the next step, unless it is there.
  static void draw_dot(const MouseInteraction::View& view, const Vec3f& from, const Vec3f& to, ImDrawList& list);

 private:
  /// Calls stand_at() or hide() by the snapshot: what is held may have moved since the press.
  virtual void look_again(const MouseInteraction::View& view) = 0;
  /// What was moved by that begins its next motion there.
  virtual void go_on_from(const RigidMotion& motion) = 0;
  virtual void take(const MouseInteraction::View& view) = 0;
  /// To where motion() says; these return the number of the command.
  virtual std::uint64_t move(const MouseInteraction::View& view) = 0;
  virtual std::uint64_t let_go(const MouseInteraction::View& view) = 0;
  /// While time stands still: where it will be.
  virtual void draw_targets(const MouseInteraction::View& view, ImDrawList& list) const = 0;

  bool has(Part part) const;
  Vec3f direction(int axis) const { return place_.axes.col(axis); }
  Vec3f middle() const { return motion_.center + motion_.translation; }
  float reach(const MouseInteraction::View& view) const;
  std::vector<Vec3f> ring(int axis, const MouseInteraction::View& view) const;
  std::optional<float> angle_at(const Vec2f& at, const MouseInteraction::View& view) const;
  void begin(Part part, const Vec2f& at);
  void aim(const MouseInteraction::View& view);
  void hold(const MouseInteraction::View& view);
  void send(const MouseInteraction::View& view);
  void drag(const Vec2f& to, const MouseInteraction::View& view);
  void draw_arrow(int axis, const MouseInteraction::View& view, bool is_lit, ImDrawList& list) const;
  void draw_ring_of(int axis, const MouseInteraction::View& view, bool is_lit, ImDrawList& list) const;

  bool is_shown_ = false;
  Place place_;
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
  std::uint64_t motion_command_ = 0;  // that moved it last
  std::uint64_t command_ = 0;         // that let go last
};

}  // namespace pliant_viewer
