#pragma once
// Annotations on pictures that are drawn without a window.
#include "render/annotations.h"

struct ImGuiContext;

namespace pliant_render {

class Overlay {
 public:
  /// Loads the font. Needs a current OpenGL context, as do all members.
  Overlay();
  ~Overlay();
  Overlay(const Overlay&) = delete;
  Overlay& operator=(const Overlay&) = delete;

  /// Draws onto the bound framebuffer of this size [pixels].
  void draw(const pliant::ViewSettings& appearance, const Viewpoint& viewpoint, const std::optional<Legend>& legend,
            const std::optional<WindAnnotation>& wind, int width, int height);

 private:
  ImGuiContext* context_;
  ImFont* font_ = nullptr;
};

}  // namespace pliant_render
