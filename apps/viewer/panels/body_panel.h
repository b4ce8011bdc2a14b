#pragma once
// What bodies are made of, look like and are held together by, one after another.
#include <array>
#include <map>
#include <optional>
#include <string>

#include "plot/run_plots.h"
#include "viewer/live_scene.h"
#include "viewer/panels/material_panel.h"
#include "viewer/panels/parameter_panel.h"

namespace pliant_viewer {

class BodyPanel {
 public:
  /// Draws a part for each body that unfolds, with its constraints by the rows of `parameters`, and posts what is
  /// changed. `measured`: energies of the constraints.
  void draw(const Snapshot& snapshot, LiveScene& live, ParameterPanel& parameters,
            const pliant_plot::MeasuredRun& measured);
  const MaterialPanel& materials() const { return materials_; }
  /// Where a widget of a body stands in the window, "cloth.front", "cloth.back", "cloth.pattern",
  /// "cloth.pattern_color", "cloth.pattern_size", "cloth.no_texture", "cloth.mapping", "cloth.texture_size" or
  /// "cloth.finish", as of the last drawing: left, top, right, bottom.
  std::optional<std::array<float, 4>> place_of(const std::string& key) const;

 private:
  /// What is shown while the simulation has not taken it over yet.
  struct Chosen {
    pliant::BodyAppearance appearance;
    std::uint64_t command;
  };
  void draw_appearance(const std::string& body, const pliant::BodyTones& tones, const Snapshot& snapshot,
                       LiveScene& live);
  bool draw_color(const std::string& body, const char* what, pliant::Color& color, const char* help);
  bool draw_pattern(const std::string& body, const char* unit, pliant::BodyAppearance& appearance);
  bool draw_texture(const std::string& body, const char* unit, pliant::BodyAppearance& appearance);
  /// usual: what `automatic` means for this body.
  bool draw_finish(const std::string& body, pliant::Finish usual, pliant::BodyAppearance& appearance);
  void note_widget(const std::string& body, const std::string& what, bool has_changed);

  MaterialPanel materials_;
  std::map<std::string, Chosen> chosen_;
  std::pair<std::string, std::string> held_;  // body and widget that is being dragged and has changed something
  bool goes_on_ = false;                      // what is dragged now was so in the last picture: one change for undo
  bool is_held_ = false;                      // a widget of the body that is being drawn
  std::map<std::string, std::array<float, 4>> places_;
};

}  // namespace pliant_viewer
