#pragma once
// The window as a whole: takes what people do, shows a stage.
#include <filesystem>
#include <optional>

#include "render/render_target.h"
#include "render/renderer.h"
#include "viewer/auto_range.h"
#include "viewer/hand.h"
#include "viewer/pulse.h"
#include "viewer/stage.h"
#include "viewer/ui.h"

namespace pliant_viewer {

struct ViewerOptions {
  pliant::ViewSettings look;     ///< to begin with; its size is that of the window
  std::optional<int> samples{};  ///< of a pixel; default: 4 on a graphics card, 1 where the processor draws
  std::filesystem::path picture_folder = ".";  ///< of saved pictures
};

class Viewer {
 public:
  Viewer(Window& window, Stage& stage, ViewerOptions options);

  /// Until the window is closed, or `shall_end` says so, which is asked several times a second.
  void run(const std::function<bool()>& shall_end);
  /// Waits, at most that long [s], until there is something to be drawn, and draws it. Returns whether it has drawn.
  bool turn(double most_wait);

  /// The picture as it was drawn last, for the mouse.
  const Screen& screen() const { return screen_; }
  const Hand& hand() const { return hand_; }
  const pliant::ViewSettings& look() const { return look_; }
  /// Pictures that were drawn.
  std::uint64_t frame_count() const { return frame_count_; }
  bool is_help_open() const { return is_help_open_; }
  /// Writes what is seen, without the panels, to the next free pliant-0001.png, and says so in the window.
  void save_picture() { wants_picture_ = true; }

 private:
  // viewer_input.cpp
  void take_input();
  void take_key(const KeyEvent& event);
  Hand::Place place_of_mouse();
  void toggle_color();
  void change_color();
  void frame_everything();
  void view_as_at_first();

  void draw();
  void update_scenery();
  void update_bounds();
  void place_screen();
  float panel_width() const;
  Vec2f picture_size() const;
  void fill_panel(int left, int width, int height) const;
  std::array<float, 2> color_range();
  void draw_picture(const pliant_render::DrawOptions& options, int width, int height);
  void draw_signs();
  void draw_marks(const pliant_render::SignSheet& sheet);
  void draw_panels();
  void draw_main_panel();
  void draw_message();
  void write_picture(int width, int height);
  void say(std::string message);

  Window& window_;
  Stage& stage_;
  pliant::ViewSettings look_;
  int samples_;
  std::filesystem::path picture_folder_;
  Ui ui_;
  bool is_panel_open_ = true;
  OrbitCamera camera_;
  OrbitCamera first_camera_;
  Hand hand_;
  AutoRange auto_range_;
  std::optional<pliant_render::Renderer> renderer_;
  std::optional<pliant_render::RenderTarget> target_;
  int target_samples_ = 1;
  std::shared_ptr<const pliant_render::Scenery> scenery_;
  std::uint64_t restarts_ = 0;

  pliant_render::Bounds bounds_;  // of the frame that is shown
  std::array<float, 2> range_ = {0, 1};
  float ground_height_ = 0;
  bool has_ground_ = false;  // at a height that suits what is shown
  Screen screen_;
  bool is_frame_new_ = true;
  int draws_left_ = 0;  // after something was touched: the panels need one or two more to settle
  double frame_interval_;
  Clock::time_point last_draw_{};
  Clock::time_point last_message_{};
  std::string message_;
  Pulse frames_;
  std::uint64_t frame_count_ = 0;
  bool is_help_open_ = false;
  bool wants_picture_ = false;
};

}  // namespace pliant_viewer
