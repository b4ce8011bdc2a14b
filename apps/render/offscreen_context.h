#pragma once
// OpenGL without a display: EGL's surfaceless platform. Pictures go into framebuffers of our own.
#include <string>

namespace pliant_render {

class OffscreenContext {
 public:
  /// Makes a context of OpenGL 3.3 core and makes it current on this thread. Throws Error(input) where the machine has
  /// no such OpenGL.
  OffscreenContext();
  ~OffscreenContext();
  OffscreenContext(const OffscreenContext&) = delete;
  OffscreenContext& operator=(const OffscreenContext&) = delete;

  /// What the driver calls the renderer.
  const std::string& renderer() const { return renderer_; }

 private:
  void* display_ = nullptr;
  void* context_ = nullptr;
  std::string renderer_;
};

}  // namespace pliant_render
