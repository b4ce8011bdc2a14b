#pragma once
// Selects vertices with the mouse while Ctrl is held: by a click, a box, a lasso, a border.
#include <string>
#include <vector>

#include "viewer/mouse_interaction.h"
#include "viewer/pacer.h"
#include "viewer/vertex_region.h"

namespace pliant_viewer {

class SelectTool {
 public:
  bool draws_lasso = false;   ///< a drag draws a lasso, not a box
  bool sees_through = false;  ///< a box or a lasso also selects what is hidden

  /// Takes an event that is meant for it, and those that follow until the button is released; false: it is not.
  bool handle(const MouseEvent& event, const MouseInteraction::View& view);
  bool is_busy() const { return is_pressed_; }
  /// What is being drawn with the mouse; empty: nothing.
  Outline outline() const;

  /// Ascending.
  const std::vector<std::uint32_t>& selected() const { return selected_; }
  /// How often that has changed.
  std::uint64_t version() const { return version_; }
  void select(std::vector<std::uint32_t> vertices);
  void clear() { select({}); }
  /// All that is drawn.
  void select_all(const pliant_render::RenderMesh& render_mesh);
  /// The vertices beside those that are selected, too.
  void grow(const pliant_render::RenderMesh& render_mesh);
  /// Forgets what is under way, and vertices beyond so many.
  void restart(std::size_t vertex_count);

  /// What to tell the user, once; empty: nothing.
  std::string take_message() { return std::exchange(message_, {}); }

 private:
  void release(const Vec2f& at, const MouseInteraction::View& view);
  void click(const Vec2f& at, const MouseInteraction::View& view);
  void add(const std::vector<std::uint32_t>& vertices);
  void take_away(const std::vector<std::uint32_t>& vertices);

  std::vector<std::uint32_t> selected_;
  std::uint64_t version_ = 0;
  bool is_pressed_ = false, takes_away_ = false, is_drag_ = false;
  std::vector<Vec2f> path_;
  Vec2f last_click_ = {0, 0};
  Clock::time_point last_click_time_{};
  std::vector<std::uint32_t> before_click_;  // selected before the click that may become a double one
  std::string message_;
};

}  // namespace pliant_viewer
