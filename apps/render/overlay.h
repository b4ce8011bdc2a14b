#pragma once
// Annotations on pictures that are drawn without a window.
#include <functional>

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

  /// Draws onto the bound framebuffer of this size [pixels], and below that whatever `draw_more` does.
  void draw(const pliant::ViewSettings& appearance, const Viewpoint& viewpoint, const std::optional<Legend>& legend,
            const std::optional<WindAnnotation>& wind, int width, int height,
            const std::function<void(const AnnotationCanvas&)>& draw_more = {});

 private:
  ImGuiContext* context_;
  ImFont* font_ = nullptr;
};

}  // namespace pliant_render
