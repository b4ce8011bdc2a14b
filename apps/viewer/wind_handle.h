#pragma once
// The arrow of the wind, turned by the mouse.
#include <optional>
#include <string>

#include "viewer/mouse_interaction.h"

struct ImDrawList;

namespace pliant_viewer {

class WindHandle {
 public:
  /// Takes a press or a turn of the wheel on the arrow, and what follows until the release; false: the event is not
  /// meant for it. A drag turns the wind as if its tip lay on a ball: over the rim of the ball it goes to the other
  /// side. The wheel makes the wind stronger or weaker.
  bool handle(const MouseEvent& event, const MouseInteraction::View& view);
  bool is_busy() const { return is_held_; }
  void cancel() { *this = WindHandle(); }
  /// Whether a press at this place would take hold of it.
  bool is_at(const Vec2f& at, const MouseInteraction::View& view) const;
  /// The middle of the arrow, in units of the mouse.
  static Vec2f place(const MouseInteraction::View& view);
  /// The ball on which the tip moves, while it is held or under the mouse.
  void draw(const MouseInteraction::View& view, bool is_hovered, ImDrawList& list) const;

 private:
  void send(const Vec3f& velocity, bool goes_on, const MouseInteraction::View& view);
  void turn_to(const Vec2f& at, const MouseInteraction::View& view);

  bool is_held_ = false, has_turned_ = false, was_outside_ = false;
  std::string key_;  // of the parameter
  float speed_ = 0;  // [m/s]
  float side_ = 1;   // 1: blows away from the eye, -1: toward it
  Clock::time_point last_notch_{};
  Vec2f grip_ = {0, 0};  // from the mouse to the tip
};

}  // namespace pliant_viewer
