#pragma once
// Where a picture is drawn when there is no window: a framebuffer with several samples a pixel, and a plain one that
// can be read.
#include "render/gl_objects.h"
#include "render/image.h"

namespace pliant_render {

/// What stands in the framebuffer that is bound for reading.
Image read_picture(int width, int height);

class RenderTarget {
 public:
  /// samples: of a pixel, 1 for none; as many as the driver has at most. Throws Error(input) on a size that the driver
  /// does not take.
  RenderTarget(int width, int height, int samples);

  int width() const { return width_; }
  int height() const { return height_; }
  /// Of the last drawing: first all that needs depth and samples.
  void begin() const;
  /// Then, what is drawn flat on top.
  void resolve() const;
  Image read() const;
  /// Of what was resolved, into a window of the same size, which is bound from then on.
  void show() const;

 private:
  int width_;
  int height_;
  Framebuffer sampled_, plain_;
  Renderbuffer sampled_color_, sampled_depth_, plain_color_;
};

}  // namespace pliant_render
