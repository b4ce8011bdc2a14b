#pragma once
// What the mouse does in the picture: moves the camera, pulls at bodies, sets pins and moves them, moves colliders.
#include <functional>
#include <utility>
#include <vector>

#include "viewer/live_scene.h"
#include "viewer/orbit_camera.h"
#include "viewer/window.h"

namespace pliant_viewer {

class MouseInteraction {
 public:
  /// What the mouse acts on.
  struct View {
    Screen screen;
    OrbitCamera& camera;
    LiveScene* live;  ///< null where nothing can be grabbed
    const Snapshot* snapshot;
    float unit = 1;                ///< mouse units per unit of a layout made for the default font size
    std::optional<float> floor{};  ///< height that the camera stays above [m]
    bool shows_colliders = true;   ///< what is hidden cannot be grabbed
    bool shows_wind = true;        ///< by its arrow
    bool shows_forces = false;     ///< others, by theirs
  };
  /// What a press of the left button would grab: a pin, else a point of a body or a collider, else nothing.
  struct PickTarget {
    std::optional<std::uint32_t> pin{};
    std::optional<SurfacePoint> point{};
    std::optional<ColliderPoint> collider{};
  };
  static PickTarget pick(const Vec2f& at, const View& view);
  void handle(const MouseEvent& event, const View& view);
  /// What the left button was clicked on that is no body: a collider, planes too, or nothing.
  struct Click {
    std::optional<Index> collider{};  ///< its number
  };
  /// The last click, once.
  std::optional<Click> take_click() { return std::exchange(click_, std::nullopt); }
  /// Sends the latest target of the pull or pin if the mouse has moved since the last call.
  void flush(const View& view);
  /// Releases everything, as when the scene restarts.
  void cancel() { *this = MouseInteraction(stiffness_); }

  explicit MouseInteraction(Real stiffness) : stiffness_(stiffness) {}
  Real stiffness() const { return stiffness_; }
  void set_stiffness(Real stiffness, LiveScene& live);

  bool is_busy() const { return action_ != Action::none; }
  /// The spring that the mouse is pulling with.
  const std::optional<Pull>& pull() const { return pull_; }
  /// The pin that the mouse is dragging, and the place it is dragged to [m].
  struct GrabbedPin {
    std::uint32_t vertex;
    Vec3f target;
  };
  std::optional<GrabbedPin> grabbed_pin() const {
    return action_ == Action::move_pin ? std::optional(GrabbedPin{vertex_, last_target_}) : std::nullopt;
  }
  /// Where the collider that the mouse is dragging shall go [m].
  std::optional<Vec3f> collider_goal() const {
    return action_ == Action::move_collider ? std::optional(last_target_) : std::nullopt;
  }
  /// A vertex whose pin was set or removed by a command that has not taken effect yet.
  struct Pending {
    std::uint32_t vertex;
    std::uint64_t command;
  };
  std::vector<std::uint32_t> pending(const Snapshot& snapshot);

 private:
  enum class Action { none, orbit, pan, touch_pin, touch_body, touch_collider, pull, move_pin, move_collider };

  void press(const MouseEvent& event, const View& view);
  void press_left(const Vec2f& at, const View& view);
  void move(const Vec2f& to, const View& view);
  void release(const MouseEvent& event, const View& view);
  void begin_pull(const View& view);
  void toggle_pin(std::uint32_t vertex, bool is_pinned, const View& view);
  Vec3f target(const Vec2f& at, const View& view) const;

  Real stiffness_;
  Action action_ = Action::none;
  MouseButton button_ = MouseButton::left;
  Vec2f pressed_ = {0, 0};
  Vec2f last_ = {0, 0};
  float depth_ = 0;  // of what was grabbed, at mouse-down
  // From the point under the mouse at that depth to the pin, or the middle of the collider, so that it does not jump.
  Vec3f grip_ = {0, 0, 0};
  Vec3f last_target_ = {0, 0, 0};
  SurfacePoint point_;
  std::uint32_t vertex_ = 0;
  Index collider_ = 0;
  std::optional<Pull> pull_;
  bool has_moved_ = false;  // since the last flush
  std::optional<Click> click_;
  std::vector<Pending> pending_;
};

/// Posts an action on the scene that is shown. It is dropped after a restart, since the mesh may be another one then.
std::uint64_t post(const MouseInteraction::View& view, LiveScene::Kind kind, std::function<void(Session&)> act);

}  // namespace pliant_viewer
