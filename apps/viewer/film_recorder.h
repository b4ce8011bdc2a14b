#pragma once
// Films what a window shows.
#include <array>
#include <memory>
#include <optional>
#include <string>

#include "render/overlay.h"
#include "render/render_target.h"
#include "render/renderer.h"
#include "viewer/film_clock.h"
#include "viewer/film_thread.h"

namespace pliant_viewer {

/// window: with its light and samples; smooth: with at least 4 samples a pixel; fine: with all light and 16 samples.
enum class FilmQuality { window, smooth, fine };

/// What the film is to be, chosen in the panel.
struct FilmChoices {
  pliant_render::FilmFormat format = pliant_render::FilmFormat::mp4;  ///< png: numbered pictures
  std::array<int, 2> size = {0, 0};                                   ///< [pixels]; 0: as the window's picture
  int fps = 30;
  FilmQuality quality = FilmQuality::smooth;
};

/// What a picture of the film shows, beside the renderer's frame.
struct FilmedView {
  const pliant::ViewSettings& appearance;
  pliant_render::DrawOptions options;  ///< as the window's
  std::optional<pliant_render::WindAnnotation> wind;
  std::function<pliant_render::Viewpoint(float)> viewpoint;  ///< with this share of the width for a legend
  /// Draws what else is seen, with one unit for a picture 720 pixels high.
  std::function<void(const pliant_render::Viewpoint&, const pliant_render::AnnotationCanvas&, float)> draw_on_top;
};

class FilmRecorder {
 public:
  /// Begins a film. `samples`: of a pixel in the window.
  /// @throws pliant::Error (input, output) where no film of that size can be drawn, or written there.
  FilmRecorder(const std::filesystem::path& file, const FilmChoices& choices, int samples);

  FilmClock& clock() { return clock_; }
  const FilmClock& clock() const { return clock_; }
  /// Draws a picture with the renderer's frame, and adds it to the film so many times.
  void add(pliant_render::Renderer& renderer, const FilmedView& view, int times);

  /// No more pictures come; the film is completed beside the window.
  void end();
  bool is_recording() const { return !is_ended_ && !thread_.is_over(); }
  bool is_over() const { return thread_.is_over(); }
  /// Waits for its end, and says what has come of it: "saved film.mp4, 3.2 s", or what went wrong.
  std::string result();

 private:
  bool is_fine_;
  pliant_render::RenderTarget target_;
  pliant_render::Overlay overlay_;
  FilmClock clock_;
  FilmThread thread_;
  bool is_ended_ = false;
};

/// Behind the name of a film of numbered pictures.
inline constexpr const char* first_picture_ending = "-00000.png";
/// The ending of a file's name: ".mp4".
const char* ending_of(pliant_render::FilmFormat format);

}  // namespace pliant_viewer
