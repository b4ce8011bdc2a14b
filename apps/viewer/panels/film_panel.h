#pragma once
// The choices for a film of what the window shows, and how far it is.
#include <map>
#include <string>

#include "viewer/film_recorder.h"
#include "viewer/panels/panel_style.h"

namespace pliant_viewer {

class FilmPanel {
 public:
  /// A button of this width that begins a film, or ends it; returns whether it is pressed. `film`: the one under way,
  /// or null.
  bool draw_button(const FilmRecorder* film, float width);
  /// The rows of the choices, and how far the film is.
  void draw(const FilmRecorder* film);
  /// Where a menu stands in the window, "format", "size", "rate" or "quality", or the "button", as of the last drawing:
  /// left, top, right, bottom.
  std::optional<std::array<float, 4>> place_of(const std::string& what) const;

  FilmChoices choices;

 private:
  void note_place(const std::string& what);
  void draw_choices();

  std::map<std::string, std::array<float, 4>> places_;
};

/// A red dot with the length of the film so far, at the upper left of the picture.
void draw_film_mark(const FilmRecorder& film, const pliant_render::AnnotationCanvas& canvas, float unit);

}  // namespace pliant_viewer
