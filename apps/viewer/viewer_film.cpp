// Filming what the window shows.
#include <cmath>

#include "pliant/core/error.h"
#include "viewer/free_name.h"
#include "viewer/gizmos.h"
#include "viewer/recent_pictures.h"
#include "viewer/viewer.h"

namespace pliant_viewer {

/// Begins a film, or ends the one under way.
void Viewer::toggle_film() {
  if (film_) {
    film_->end();
    draws_left_ = 2;
    return;
  }
  FilmChoices choices = film_panel_.choices;
  if (choices.size[0] == 0) {
    const std::array<int, 2> window = window_.framebuffer_size();
    const float share = screen_.size.x() / window_.size().x();
    choices.size = {static_cast<int>(std::lround(static_cast<float>(window[0]) * share)), window[1]};
  }
  // Films have an even size.
  for (int& length : choices.size) length -= length % 2;
  const auto file = free_name(picture_folder_, source_.name(), {ending_of(choices.format), first_picture_ending});
  source_.hold_at(source_.frame().time);  // until the first picture
  try {
    film_.emplace(file, choices, samples_);
  } catch (const std::exception& error) {
    film_.reset();
    source_.hold_at({});
    return say(error.what());
  }
  is_frame_new_ = true;
}

/// Draws the scene as it looks, small and without what the hand is about.
void Viewer::tell_look() {
  if (!looked_ || !renderer_ || frame_count_ == 0) return;
  constexpr int width = 2 * recent_picture_width, height = 2 * recent_picture_height;
  try {
    pliant_render::DrawOptions options = draw_options(height);
    options.viewpoint = camera_.viewpoint(bounds_, 0);
    options.markers = appearance_.markers.value_or(false);
    options.selection = false;
    options.lit_collider.reset();
    options.selected_collider.reset();
    const pliant_render::RenderTarget target(width, height, 1);
    target.begin();
    renderer_->draw(appearance_, options, width, height);
    target.resolve();
    looked_(halved(target.read()));
  } catch (const std::exception&) {
    return;  // a convenience, not worth a word at the end
  }
}

/// Whether the newest frame is between two pictures of the film, which is not shown then.
bool Viewer::waits_for_film() const {
  return film_ && film_->is_recording() && source_.is_playing() &&
         !film_->clock().is_due(source_.frame().time, source_.cuts());
}

/// Before the picture in the window: where a picture of the film is due, it is drawn with the same frame.
void Viewer::film() {
  if (film_ && film_->is_over()) {
    say(film_->result());
    film_.reset();
    source_.hold_at({});
  }
  if (!film_) return;
  if (!film_->is_recording()) {
    source_.hold_at({});
    draws_left_ = std::max(draws_left_, 1);
    return;
  }
  const int due = film_->clock().take_due(source_.frame().time, source_.speed(), source_.cuts());
  source_.hold_at(film_->clock().next_time());  // so that time goes no further while the picture is drawn
  if (due > 0) {
    const auto draw_pull = [this](const pliant_render::Viewpoint& viewpoint,
                                  const pliant_render::AnnotationCanvas& canvas, float unit) {
      if (!interaction_.pull()) return;
      const Screen screen{viewpoint, {canvas.width, canvas.height}};
      const std::vector<Vec3f>& positions = source_.frame().content.positions;
      draw_spring(screen, interaction_.pull()->point.position(positions), interaction_.pull()->target, unit,
                  canvas.list);
    };
    const FilmedView view{appearance_, draw_options(1), appearance_.wind_arrow ? source_.frame().wind : std::nullopt,
                          [this](float inset) { return camera_.viewpoint(bounds_, inset); }, draw_pull};
    film_->add(*renderer_, view, due);
    glBindFramebuffer(GL_FRAMEBUFFER, 0);
  }
}

std::string Viewer::finish_film() {
  if (!film_) return "";
  source_.hold_at({});
  std::string result = film_->result();
  film_.reset();
  return result;
}

}  // namespace pliant_viewer
