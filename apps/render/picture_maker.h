#pragma once
// Frames to pictures without a window: everything that OpenGL needs, in one.
#include <memory>

#include "render/image.h"
#include "render/offscreen_context.h"
#include "render/overlay.h"
#include "render/render_target.h"
#include "render/renderer.h"

namespace pliant_render {

struct PictureOptions {
  pliant::ViewSettings look;
  int samples = 4;                      ///< of a pixel; 1: hard edges, in less time
  Bounds bounds;                        ///< what an automatic camera has in the picture
  float ground_height = 0;              ///< [m]
  std::array<float, 2> range = {0, 1};  ///< of the values, at the ends of the color map
};

class PictureMaker {
 public:
  /// Throws Error(input) where there is no OpenGL, or none that draws pictures of this size.
  PictureMaker(Scenery scenery, PictureOptions options);

  const std::string& driver() const { return context_.renderer(); }
  Image draw(const FrameContent& frame, const std::optional<WindSign>& wind);

 private:
  PictureOptions options_;
  OffscreenContext context_;
  RenderTarget target_;
  Renderer renderer_;
  Overlay overlay_;
};

}  // namespace pliant_render
