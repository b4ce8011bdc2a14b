#pragma once
// The window as a whole: handles input and shows a source.
#include <deque>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "render/render_target.h"
#include "render/renderer.h"
#include "viewer/auto_range.h"
#include "viewer/brush_tool.h"
#include "viewer/frame_statistics.h"
#include "viewer/handles.h"
#include "viewer/mouse_interaction.h"
#include "viewer/panels/film_panel.h"
#include "viewer/panels/plots_panel.h"
#include "viewer/panels/tour.h"
#include "viewer/quality_chooser.h"
#include "viewer/select_tool.h"
#include "viewer/ui.h"
#include "viewer/view_source.h"
#include "viewer/viewer_options.h"
#include "viewer/window_settings.h"

namespace pliant_viewer {

class Viewer {
 public:
  Viewer(Window& window, ViewSource& source, ViewerOptions options);

  /// Runs until the window is closed, something else was opened, or `shall_end`, asked several times a second, returns
  /// true.
  void run(const std::function<bool()>& shall_end);
  /// Waits at most `most_wait` [s] until there is something to draw, and draws it. Returns whether it has drawn.
  bool turn(double most_wait);

  /// The picture as last drawn, in units of the mouse.
  const Screen& screen() const { return screen_; }
  const MouseInteraction& interaction() const { return interaction_; }
  const SelectTool& selection() const { return select_; }
  const PinGizmo& gizmo() const { return handles_.pins; }
  const ColliderGizmo& collider_gizmo() const { return handles_.collider; }
  BrushTool& brush() { return brush_; }
  /// As the mouse sees it now.
  MouseInteraction::View mouse_view();
  const pliant::ViewSettings& appearance() const { return appearance_; }
  /// Number of pictures drawn so far.
  std::uint64_t frame_count() const { return frame_count_; }
  bool is_help_open() const { return is_help_open_; }
  const ScenePanel& scene_panel() const { return scene_panel_; }
  const PlotsPanel& plots_panel() const { return plots_panel_; }
  /// Where a button for the selection stands: left, top, right, bottom.
  const std::array<float, 4>& button_place(const std::string& label) const { return button_places_.at(label); }
  const Tour& tour() const { return tour_; }
  const std::string& message() const { return message_; }
  const WindowSettings& settings() const { return settings_; }
  float panel_scale() const { return ui_.scale(); }
  pliant_render::Vec3f panel_color() const { return ui_.panel_color(); }
  /// Takes back the last change of the scene, and does it again, as soon as its thread comes to it.
  void undo();
  void redo();
  /// Saves the scene as it has been changed, and as it is shown, with a checkpoint unless it is at its start: to the
  /// file that was saved last, or the first time, and `as_new`, under the next free name like sheet-1.json.
  void save_scene(bool as_new = false);
  /// Saves the session, all that was done since the scene was opened, under the next free name like sheet-1.session.
  void save_session();
  /// Saves the picture without panels under the next free name like pliant-0001.png, and says so in the window.
  void save_picture() { wants_picture_ = true; }
  /// Begins a film of what is seen, as chosen in the panel, or ends the one under way.
  void toggle_film();
  /// Completes the film under way; returns what has come of it, or nothing where there is none.
  std::string finish_film();
  const FilmRecorder* film_under_way() const { return film_ ? &*film_ : nullptr; }
  FilmPanel& film_panel() { return film_panel_; }

 private:
  // viewer_input.cpp
  void take_input();
  void take_keys();
  void take_key(const KeyEvent& event);
  void take_plain_key(int key, bool has_shift);
  void take_control_key(char letter, bool has_shift, bool is_repeated);
  bool takes_window_key(int key, char letter);
  void toggle_color();
  void change_color();
  void frame_everything();
  void view_as_at_first();
  // viewer_selection.cpp
  void toggle_pins();
  void pin_selected(bool shall_pin);
  void change_select_shape();
  void update_selection();
  void draw_selection_rows(float width);
  void draw_hand(const pliant_render::AnnotationCanvas& canvas);
  // viewer_brush.cpp
  void choose_brush(const BrushTool::Subject& subject);
  void draw_brush_rows(float width);
  void fill_with_brush(Real factor);
  void film();
  bool waits_for_film() const;
  void draw();
  void update_render_mesh();
  void update_bounds();
  void place_screen();
  float panel_width() const;
  Vec2f picture_size() const;
  void fill_panel(int left, int width, int height) const;
  std::array<float, 2> color_range();
  pliant_render::DrawOptions draw_options(int height) const;
  void draw_picture(const pliant_render::DrawOptions& options, int width, int height);
  void draw_measured_picture(int width, int height);
  void draw_annotations();
  void draw_panels();
  void draw_main_panel();
  void draw_last_sections(float width);
  void draw_message();
  void draw_plots();
  void draw_tour();
  void save_plots(PlotsPanel::Wish wish, const pliant_plot::MeasuredRun& run);
  void tell_look();
  void write_picture(int width, int height);
  void draw_edit_buttons(float width);
  void draw_file_buttons(float width);
  pliant::ViewSettings placed_appearance() const;
  void take_dropped_files();
  void open(const std::string& what);
  void open_what_waits();
  void say(std::string message);

  Window& window_;
  ViewSource& source_;
  pliant::ViewSettings appearance_;
  int samples_;
  std::filesystem::path picture_folder_;
  std::shared_ptr<std::filesystem::path> saved_scene_;  // last, for the thread of the scene; empty: none
  std::string refused_;         // to be opened, though changes would be lost; once more, and it is
  std::uint64_t messages_ = 0;  // of the scene that were shown
  std::filesystem::path settings_file_;
  WindowSettings settings_;
  Ui ui_;
  bool is_panel_open_ = true;
  OrbitCamera camera_;
  OrbitCamera first_camera_;
  MouseInteraction interaction_;
  SelectTool select_;
  Handles handles_;
  BrushTool brush_;
  std::optional<std::uint64_t> drawn_selection_;  // its version
  std::optional<Index> lit_collider_;             // that the mouse would take
  std::deque<KeyEvent> keys_;                     // that the panels and the shortcuts have not taken yet
  AutoRange auto_range_;
  QualityChooser quality_;
  std::array<int, 2> measured_size_ = {0, 0};  // that quality_ knows about [pixels]
  std::optional<pliant_render::Renderer> renderer_;
  std::optional<pliant_render::RenderTarget> target_;
  FilmPanel film_panel_;
  std::optional<FilmRecorder> film_;
  int target_samples_ = 1;
  std::shared_ptr<const pliant_render::RenderMesh> render_mesh_;
  std::uint64_t restarts_ = 0, rebuilds_ = 0;

  pliant_render::Bounds bounds_;  // of the current frame
  std::array<float, 2> range_ = {0, 1};
  float ground_height_ = 0;
  bool has_ground_ = false;  // whether ground_height_ suits the current scene
  Screen screen_;
  bool is_frame_new_ = true;
  bool shown_colliders_ = true;  // in the frame that the renderer has
  int draws_left_ = 0;           // after input: the panels need one or two more frames to settle
  double frame_interval_;
  Clock::time_point last_draw_{};
  Clock::time_point last_message_{};
  std::string message_;
  FrameStatistics frames_;
  std::uint64_t frame_count_ = 0;
  bool is_help_open_ = false, wants_picture_ = false;
  bool sees_nothing_;  // the camera was placed before there was a body
  std::map<std::string, std::array<float, 4>> button_places_;
  std::function<std::string(const std::string&)> open_;
  std::function<void(const std::filesystem::path&)> saved_;
  std::function<void(const pliant_render::Image&)> looked_;
  ScenePanel scene_panel_;
  Tour tour_;
  PlotsPanel plots_panel_;
  std::string waits_;     // to be opened once the picture has said so; empty: nothing
  int waits_turns_ = 0;   // pictures until then
  bool is_over_ = false;  // something else was opened
};

}  // namespace pliant_viewer
