#pragma once
// Where a picture is drawn without a window: a multisampled framebuffer, and a plain one that can be read back.
#include <optional>

#include "render/gl_objects.h"
#include "render/image.h"

namespace pliant_render {

/// Reads the framebuffer that is bound for reading, of this size [pixels].
Image read_picture(int width, int height);

class RenderTarget {
 public:
  /// samples: per pixel, 1 for no antialiasing. More than the driver has are had by drawing at twice the size.
  /// @throws pliant::Error (input) for a size that the driver does not support.
  RenderTarget(int width, int height, int samples);

  int width() const { return width_; }
  int height() const { return height_; }
  /// What is drawn is so many times as wide and high: 1 or 2.
  int factor() const { return factor_; }
  /// Of a pixel of the picture, fewer than asked for where the driver has no more.
  int samples() const { return samples_ * factor_ * factor_; }
  /// Starts a picture: what needs depth and several samples is drawn next.
  void begin() const;
  /// Resolves the samples, with blending and the test of depths off: what is drawn flat on top comes next.
  void resolve() const;
  Image read() const;
  /// Copies the resolved picture into a window of the same size and leaves the window's framebuffer bound.
  void show() const;

 private:
  int width_;
  int height_;
  int factor_ = 1;
  int samples_ = 1;  // of a pixel as drawn
  Framebuffer sampled_, plain_;
  Texture sampled_color_;
  Renderbuffer sampled_depth_, plain_color_;
  VertexArray empty_array_;
  std::optional<Program> resolve_;
};

}  // namespace pliant_render
