#include "render/render_target.h"

#include <algorithm>
#include <string>

#include "pliant/core/error.h"
#include "render/shaders.h"

namespace pliant_render {
namespace {

void attach(const Renderbuffer& buffer, GLenum place, GLenum format, int width, int height, int samples) {
  glBindRenderbuffer(GL_RENDERBUFFER, buffer.id());
  glRenderbufferStorageMultisample(GL_RENDERBUFFER, samples > 1 ? samples : 0, format, width, height);
  glFramebufferRenderbuffer(GL_FRAMEBUFFER, place, GL_RENDERBUFFER, buffer.id());
}

void check_complete(int width, int height) {
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) == GL_FRAMEBUFFER_COMPLETE && glGetError() == GL_NO_ERROR) return;
  pliant::fail_input("size: the driver draws no picture of " + std::to_string(width) + " x " + std::to_string(height) +
                     " pixels with so many samples; give a smaller one, or --samples 1");
}

/// The texture that samples are drawn into.
void attach_samples(const Texture& texture, int width, int height, int samples) {
  const GLenum kind = samples > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
  glBindTexture(kind, texture.id());
  if (samples > 1) {
    glTexImage2DMultisample(kind, samples, GL_RGBA8, width, height, GL_TRUE);
  } else {
    glTexImage2D(kind, 0, GL_RGBA8, width, height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glTexParameteri(kind, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(kind, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  }
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, kind, texture.id(), 0);
  glBindTexture(kind, 0);
}

/// Of texelFetch(), which takes a sample in one kind of texture, and a level in the other.
std::string resolve_program(int factor, int samples) {
  std::string text = "#version 330 core\n";
  text += std::string("#define SAMPLER ") + (samples > 1 ? "sampler2DMS\n" : "sampler2D\n");
  text += "const int factor = " + std::to_string(factor) + ", samples = " + std::to_string(samples) + ";\n";
  return text.append(shaders::resolve_fragment);
}

}  // namespace

RenderTarget::RenderTarget(int width, int height, int samples) : width_(width), height_(height) {
  GLint most_samples = 1;
  GLint most_pixels = 0;
  GLint most_texture_samples = 1;
  glGetIntegerv(GL_MAX_SAMPLES, &most_samples);
  glGetIntegerv(GL_MAX_COLOR_TEXTURE_SAMPLES, &most_texture_samples);
  glGetIntegerv(GL_MAX_RENDERBUFFER_SIZE, &most_pixels);
  if (std::max(width, height) > most_pixels) {
    pliant::fail_input("size: " + std::to_string(std::max(width, height)) + " pixels are more than the " +
                       std::to_string(most_pixels) + " that the driver draws; give a smaller picture");
  }
  most_samples = std::max(1, std::min(most_samples, most_texture_samples));
  if (samples > most_samples && 2 * std::max(width, height) <= most_pixels) factor_ = 2;
  samples_ = std::clamp((samples + factor_ * factor_ - 1) / (factor_ * factor_), 1, most_samples);
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.id());
  attach_samples(sampled_color_, factor_ * width, factor_ * height, samples_);
  attach(sampled_depth_, GL_DEPTH_ATTACHMENT, GL_DEPTH_COMPONENT24, factor_ * width, factor_ * height, samples_);
  check_complete(width, height);
  glBindFramebuffer(GL_FRAMEBUFFER, plain_.id());
  attach(plain_color_, GL_COLOR_ATTACHMENT0, GL_RGBA8, width, height, 1);
  check_complete(width, height);
  if (factor_ * samples_ > 1) resolve_.emplace(shaders::screen_vertex, "", resolve_program(factor_, samples_));
}

void RenderTarget::begin() const {
  glBindFramebuffer(GL_FRAMEBUFFER, sampled_.id());
  glViewport(0, 0, factor_ * width_, factor_ * height_);
}

void RenderTarget::resolve() const {
  if (!resolve_) {
    glBindFramebuffer(GL_READ_FRAMEBUFFER, sampled_.id());
    glBindFramebuffer(GL_DRAW_FRAMEBUFFER, plain_.id());
    glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
    glBindFramebuffer(GL_FRAMEBUFFER, plain_.id());
    return;
  }
  glBindFramebuffer(GL_FRAMEBUFFER, plain_.id());
  glViewport(0, 0, width_, height_);
  const GLenum kind = samples_ > 1 ? GL_TEXTURE_2D_MULTISAMPLE : GL_TEXTURE_2D;
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(kind, sampled_color_.id());
  resolve_->use();
  resolve_->set("picture", 0);
  glBindVertexArray(empty_array_.id());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glBindVertexArray(0);
  glBindTexture(kind, 0);
}

void RenderTarget::show() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, plain_.id());
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glBlitFramebuffer(0, 0, width_, height_, 0, 0, width_, height_, GL_COLOR_BUFFER_BIT, GL_NEAREST);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

Image RenderTarget::read() const {
  glBindFramebuffer(GL_READ_FRAMEBUFFER, plain_.id());
  return read_picture(width_, height_);
}

Image read_picture(int width, int height) {
  Image image;
  image.width = width;
  image.height = height;
  const auto row = 3 * static_cast<std::size_t>(width);
  std::vector<std::uint8_t> upside_down(row * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGB, GL_UNSIGNED_BYTE, upside_down.data());
  image.pixels.resize(upside_down.size());
  for (std::size_t y = 0; y < static_cast<std::size_t>(height); ++y) {
    const std::size_t from = (static_cast<std::size_t>(height) - 1 - y) * row;
    std::copy_n(upside_down.data() + from, row, image.pixels.data() + y * row);
  }
  return image;
}

}  // namespace pliant_render
