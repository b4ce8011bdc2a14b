#pragma once
// ImGui in a window: its context, its font, its frames.
#include "render/signs.h"
#include "viewer/panels/panel_style.h"
#include "viewer/window.h"

struct ImGuiContext;

namespace pliant_viewer {

class Ui {
 public:
  /// For panels on a background like this one.
  Ui(Window& window, const pliant::Color& background);
  ~Ui();
  Ui(const Ui&) = delete;
  Ui& operator=(const Ui&) = delete;

  /// Between these two, panels and signs are put together; end() draws them onto the framebuffer that is bound.
  void begin();
  void end();
  /// Whether a panel, and not the picture, is at a place; as of the last frame.
  bool has_panel_at(const Vec2f& place) const;
  /// Whether a panel holds the mouse, or takes what is typed.
  bool holds_mouse() const;
  bool takes_text() const;

  /// Where the mouse is, beyond the window's edges too.
  Vec2f mouse() const;
  /// Turns the arrow of the mouse into a hand, for this frame.
  static void show_hand();

  const PanelStyle& style() const { return style_; }
  /// What signs are drawn onto, behind the panels: a picture of this size at the left of the window.
  pliant_render::SignSheet sheet(const Vec2f& picture) const;
  pliant_render::Vec3f panel_color() const;

 private:
  ImGuiContext* context_;
  ImFont* font_ = nullptr;
  PanelStyle style_;
  std::uint32_t ink_;
};

}  // namespace pliant_viewer
