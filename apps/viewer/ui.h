#pragma once
// ImGui in a window: context, font, frames.
#include "render/annotations.h"
#include "viewer/panels/panel_style.h"
#include "viewer/window.h"
#include "viewer/window_settings.h"

struct ImGuiContext;

namespace pliant_viewer {

class Ui {
 public:
  /// `background`: of the picture, which panels suit unless the settings say otherwise.
  Ui(Window& window, const pliant::Color& background, const WindowSettings& settings);
  ~Ui();
  Ui(const Ui&) = delete;
  Ui& operator=(const Ui&) = delete;

  /// Takes over settings and the size of the window, where they have changed; to be called before begin().
  void set_up(const WindowSettings& settings);
  float scale() const { return scale_; }  ///< of panels and letters
  bool is_dark() const { return is_dark_; }
  /// Panels and annotations are built between these two; end() draws them onto the framebuffer that is bound.
  void begin();
  void end();
  /// Passes a key event on to the panels. They see the keyboard in one state per frame: returns false, and takes
  /// nothing, if the event has to wait for the next frame because the panels would miss it or one before it.
  bool take(const KeyEvent& event);
  /// Whether a panel covered a place in the last frame.
  bool has_panel_at(const Vec2f& place) const;
  /// Whether a panel is using the mouse, or the keyboard for text, or a menu is open, which a press beside it closes.
  bool holds_mouse() const;
  bool takes_text() const;
  /// Closes menus that are open; returns whether there were any.
  bool close_menus();

  /// Where the mouse is, also outside the window.
  Vec2f mouse() const;
  /// Shows the mouse cursor as a hand, for this frame.
  static void show_hand();

  const PanelStyle& style() const { return style_; }
  /// The canvas for annotations, behind the panels: a picture of this size on the left of the window.
  pliant_render::AnnotationCanvas canvas(const Vec2f& picture) const;
  pliant_render::Vec3f panel_color() const;

 private:
  void load_letters(float height);

  ImGuiContext* former_context_;  // of the program, if it has one
  ImGuiContext* context_;
  ImFont* font_ = nullptr;
  PanelStyle style_;
  bool is_background_dark_;
  bool is_dark_ = false;
  float scale_ = 0;
  float letters_ = 0;  // height that the font has [pixels]
  std::uint32_t ink_;
  Window& window_;
  std::vector<int> keys_down_;        // as the panels have been told
  std::vector<int> keys_changed_;     // since the last frame
  bool has_command_waiting_ = false;  // one of these edits or ends a field, as Backspace or Enter
};

}  // namespace pliant_viewer
