#pragma once
// Makes pictures of frames without a window: OpenGL context, renderer and annotations in one.
#include <memory>

#include "render/camera_path.h"
#include "render/image.h"
#include "render/offscreen_context.h"
#include "render/overlay.h"
#include "render/render_target.h"
#include "render/renderer.h"

namespace pliant_render {

struct PictureOptions {
  pliant::ViewSettings appearance;      ///< size, camera, colors and light
  int samples = 16;                     ///< per pixel; 1 is faster and leaves hard edges
  Bounds bounds;                        ///< what the automatic camera fits into the picture
  float ground_height = 0;              ///< [m]
  std::array<float, 2> range = {0, 1};  ///< values at the ends of the color map
  PassClock* clock = nullptr;           ///< of the passes of all pictures, alive as long as the maker
};

class PictureMaker {
 public:
  /// @throws pliant::Error (input) if there is no OpenGL, or it cannot draw pictures of this size.
  PictureMaker(RenderMesh render_mesh, PictureOptions options);

  const std::string& driver() const { return context_.renderer(); }
  int samples() const { return target_.samples(); }  ///< fewer than asked for where the driver has no more
  /// Why a texture is left out; empty: none is.
  const std::string& texture_error() const { return renderer_.texture_error(); }
  /// time: at which the camera is there [s]
  Image draw(const FrameContent& frame, const std::optional<WindAnnotation>& wind, pliant::Real time = 0);

 private:
  PictureOptions options_;
  OffscreenContext context_;
  RenderTarget target_;
  std::optional<Legend> legend_;
  CameraPath camera_;
  Renderer renderer_;
  Overlay overlay_;
};

}  // namespace pliant_render
