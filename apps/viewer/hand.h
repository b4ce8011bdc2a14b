#pragma once
// What the mouse does in the picture: leads the camera, pulls at bodies, sets pins, moves them.
#include <vector>

#include "viewer/live_scene.h"
#include "viewer/orbit_camera.h"
#include "viewer/window.h"

namespace pliant_viewer {

class Hand {
 public:
  /// Where the mouse is, over what.
  struct Place {
    Screen screen;
    OrbitCamera& camera;
    LiveScene* live;  ///< null: nothing can be taken hold of
    const Snapshot* snapshot;
    float unit = 1;                ///< of the mouse, to one at the common size of letters
    std::optional<float> floor{};  ///< that the camera stays above [m]
  };
  /// What a press of the left button would take hold of: a pin, else a point of a body, else nothing.
  struct Aim {
    std::optional<std::uint32_t> pin{};
    std::optional<SurfacePoint> point{};
  };
  static Aim aim(const Vec2f& at, const Place& place);
  void handle(const MouseEvent& event, const Place& place);
  /// Sends what has moved since the last call.
  void flush(const Place& place);
  /// Lets everything go, as when the scene begins anew.
  void cancel() { *this = Hand(stiffness_); }

  explicit Hand(Real stiffness) : stiffness_(stiffness) {}
  Real stiffness() const { return stiffness_; }
  void set_stiffness(Real stiffness, LiveScene& live);

  bool is_busy() const { return action_ != Action::none; }
  /// The spring that the mouse holds now.
  const std::optional<Pull>& pull() const { return pull_; }
  /// The pin that the mouse holds now, and where it is to be.
  struct HeldPin {
    std::uint32_t vertex;
    Vec3f target;
  };
  std::optional<HeldPin> held_pin() const {
    return action_ == Action::move_pin ? std::optional(HeldPin{vertex_, last_target_}) : std::nullopt;
  }
  /// Vertices whose pins were set or taken away by commands that have not acted yet.
  struct Pending {
    std::uint32_t vertex;
    std::uint64_t command;
  };
  std::vector<std::uint32_t> pending(const Snapshot& snapshot);

 private:
  enum class Action { none, orbit, pan, touch_pin, touch_body, pull, move_pin };

  void press(const MouseEvent& event, const Place& place);
  void press_left(const Vec2f& at, const Place& place);
  void move(const Vec2f& to, const Place& place);
  void release(const MouseEvent& event, const Place& place);
  void begin_pull(const Place& place);
  void toggle_pin(std::uint32_t vertex, bool is_pinned, const Place& place);
  Vec3f target(const Vec2f& at, const Place& place) const;

  Real stiffness_;
  Action action_ = Action::none;
  MouseButton button_ = MouseButton::left;
  Vec2f pressed_ = {0, 0};
  Vec2f last_ = {0, 0};
  float depth_ = 0;         // of what was taken hold of, at mouse-down
  Vec3f grip_ = {0, 0, 0};  // from where the mouse points at that depth to the pin, so that it does not jump
  Vec3f last_target_ = {0, 0, 0};
  SurfacePoint point_;
  std::uint32_t vertex_ = 0;
  std::optional<Pull> pull_;
  bool has_moved_ = false;  // since the last flush
  std::vector<Pending> pending_;
};

}  // namespace pliant_viewer
