#pragma once
// Arrows of forces at the left of the picture, turned by the mouse: of the wind, of gravity, of test forces.
#include <optional>
#include <string>
#include <vector>

#include "viewer/mouse_interaction.h"

namespace pliant_viewer {

class ForceArrows {
 public:
  /// Of the first wind that blows, and, while the panel is open at its forces, of others that act, for the first few.
  struct Arrow {
    std::string key;          ///< of the parameter
    Vec3f vector{0, 0, 0};    ///< in its unit
    std::string text;         ///< "gravity 9.81 m/s²"
    Vec2f middle{0, 0};       ///< in units of the mouse, as is
    float radius = 0;         ///< of the ball on which the tip moves
    bool is_of_wind = false;  ///< which is part of the picture, and drawn with it
  };
  static std::vector<Arrow> list(const MouseInteraction::View& view);

  /// Takes a press or a turn of the wheel on an arrow, and what follows until the release; false: the event is not
  /// meant for it. A drag turns the force as if its tip lay on a ball: over the rim of the ball it goes to the other
  /// side. The wheel makes the force stronger or weaker.
  bool handle(const MouseEvent& event, const MouseInteraction::View& view);
  bool is_busy() const { return held_.has_value(); }
  void cancel() { *this = ForceArrows(); }
  /// The arrow that a press at this place would take hold of. Where none is shown, what is seen comes first.
  static std::optional<Arrow> at(const Vec2f& place, const MouseInteraction::View& view);
  /// The arrows but for that of the wind, and the ball of one that is held or under the mouse.
  void draw(const MouseInteraction::View& view, const std::optional<Arrow>& hovered,
            const pliant_render::AnnotationCanvas& canvas) const;

 private:
  void take(const Arrow& arrow, const Vec2f& at, const MouseInteraction::View& view);
  void turn_to(const Vec2f& at, const MouseInteraction::View& view);

  std::optional<Arrow> held_;  // as it was when it was taken
  bool has_turned_ = false, was_outside_ = false;
  float side_ = 1;  // 1: points away from the eye, -1: toward it
  std::string last_key_;
  Clock::time_point last_notch_{};
  Vec2f grip_ = {0, 0};  // from the mouse to the tip
};

}  // namespace pliant_viewer
