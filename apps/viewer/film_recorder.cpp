#include "viewer/film_recorder.h"

#include <algorithm>
#include <exception>

#include <fmt/format.h>

#include "pliant/core/printable.h"

namespace pliant_viewer {
namespace {

constexpr int many_pictures = 100'000;  // numbers with as many digits as these need

int samples_of(FilmQuality quality, int window_samples) {
  constexpr int smooth = 4, fine = 16;
  if (quality == FilmQuality::fine) return fine;
  return quality == FilmQuality::smooth ? std::max(window_samples, smooth) : window_samples;
}

}  // namespace

const char* ending_of(pliant_render::FilmFormat format) {
  switch (format) {
    case pliant_render::FilmFormat::mp4:
      return ".mp4";
    case pliant_render::FilmFormat::webm:
      return ".webm";
    case pliant_render::FilmFormat::webp:
      return ".webp";
    case pliant_render::FilmFormat::gif:
      return ".gif";
    case pliant_render::FilmFormat::png:
      break;
  }
  return ".png";
}

FilmRecorder::FilmRecorder(const std::filesystem::path& file, const FilmChoices& choices, int samples)
    : is_fine_(choices.quality == FilmQuality::fine),
      target_(choices.size[0], choices.size[1], samples_of(choices.quality, samples)),
      clock_(choices.fps),
      thread_({.out = file,
               .width = choices.size[0],
               .height = choices.size[1],
               .fps = choices.fps,
               .frame_count = many_pictures}) {}

void FilmRecorder::add(pliant_render::Renderer& renderer, const FilmedView& view, int times) {
  const int width = target_.width(), height = target_.height(), factor = target_.factor();
  const auto legend = pliant_render::make_legend(view.appearance, view.options.range, width, height);
  const float inset = legend ? pliant_render::legend_width(height) / static_cast<float>(width) : 0;
  pliant_render::DrawOptions options = view.options;
  options.viewpoint = view.viewpoint(inset);
  options.scale = static_cast<float>(factor * height) / 720;
  options.pixel = static_cast<float>(factor);
  options.markers = view.appearance.markers.value_or(false);
  options.selection = false;
  options.lit_collider.reset();
  options.selected_collider.reset();
  if (is_fine_) options.quality = pliant::Quality::high;
  target_.begin();
  renderer.draw(view.appearance, options, factor * width, factor * height);
  target_.resolve();
  const auto draw_more = [&](const pliant_render::AnnotationCanvas& canvas) {
    view.draw_on_top(options.viewpoint, canvas, static_cast<float>(height) / 720);
  };
  overlay_.draw(view.appearance, options.viewpoint, legend, view.wind, width, height, draw_more);
  thread_.add(target_.read(), times);
}

void FilmRecorder::end() {
  is_ended_ = true;
  thread_.end();
}

std::string FilmRecorder::result() {
  end();
  try {
    const std::string written = thread_.wait();
    if (written.empty()) return "the film has no pictures, since no time went by";
    const std::string text = fmt::format(
        "saved {}, {:.1f} s", pliant::printable_place(std::filesystem::path(written).lexically_normal().string()),
        clock_.length());
    return thread_.hint().empty() ? text : text + "; " + thread_.hint();
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace pliant_viewer
