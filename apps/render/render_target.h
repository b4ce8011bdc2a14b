#pragma once
// Where a picture is drawn without a window: a multisampled framebuffer, and a plain one that can be read back.
#include "render/gl_objects.h"
#include "render/image.h"

namespace pliant_render {

/// Reads the framebuffer that is bound for reading, of this size [pixels].
Image read_picture(int width, int height);

class RenderTarget {
 public:
  /// samples: per pixel, 1 for no antialiasing; limited to the driver's maximum.
  /// @throws pliant::Error (input) for a size that the driver does not support.
  RenderTarget(int width, int height, int samples);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Starts a picture: what needs depth and several samples is drawn next.
  void begin() const;
  /// Resolves the samples: what is drawn flat on top comes next.
  void resolve() const;
  Image read() const;
  /// Copies the resolved picture into a window of the same size and leaves the window's framebuffer bound.
  void show() const;

 private:
  int width_;
  int height_;
  Framebuffer sampled_, plain_;
  Renderbuffer sampled_color_, sampled_depth_, plain_color_;
};

}  // namespace pliant_render
