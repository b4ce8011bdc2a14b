#pragma once
// Signs on pictures that are drawn without a window.
#include "render/signs.h"

struct ImGuiContext;

namespace pliant_render {

class Overlay {
 public:
  /// Loads the font. Needs a current context of OpenGL, as do all members.
  Overlay();
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Draws onto the framebuffer that is bound, of this size in pixels.
  void draw(const pliant::ViewSettings& look, const Viewpoint& viewpoint, const std::optional<Legend>& legend,
            const std::optional<WindSign>& wind, int width, int height);

 private:
  ImGuiContext* context_;
  ImFont* font_ = nullptr;
};

}  // namespace pliant_render
