#pragma once
// Five things to try in the window, one after another; each goes on to the next when it has been done.
#include <cstdint>
#include <optional>
#include <string>

#include "viewer/orbit_camera.h"
#include "viewer/panels/panel_style.h"

namespace pliant_viewer {

/// What the tour sees of what the user does.
struct TourSight {
  bool is_busy = false;       ///< the mouse does something in the picture
  bool is_pulling = false;    ///< a body
  bool is_handling = false;   ///< moves or turns pins by their handle
  std::uint64_t edits = 0;    ///< changes of the scene so far
  std::string undone_next{};  ///< as Session has it
  std::string redone_next{};
  OrbitCamera camera;
};

class Tour {
 public:
  static constexpr int step_count = 5;

  void begin();
  void end() { step_.reset(); }
  bool is_on() const { return step_.has_value(); }
  /// From 0 on; step_count: all is done.
  std::optional<int> step() const { return step_; }
  /// Goes on when what the step asks for has been done.
  void watch(const TourSight& now);
  void skip();

  /// Draws it at the lower edge of the picture.
  void draw(const Vec2f& picture, const PanelStyle& style);

 private:
  bool is_done(const TourSight& now) const;

  std::optional<int> step_;
  std::optional<TourSight> at_first_;  // when the step began
  bool has_pulled_ = false, has_handled_ = false, has_changed_ = false;
};

}  // namespace pliant_viewer
