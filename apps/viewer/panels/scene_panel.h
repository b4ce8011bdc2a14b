#pragma once
// The list of scenes that can be opened, and a field for the name of a file.
#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viewer/panels/panel_style.h"
#include "viewer/panels/thumbnails.h"
#include "viewer/picking.h"

namespace pliant_viewer {

/// What the window can open beside what it shows.
struct OpenableScene {
  std::string name;
  std::string description;
  std::string opens = {};    ///< what is asked for; empty: the name
  std::string heading = {};  ///< of the part of the list that begins here; empty: none
  std::filesystem::path picture =
      {};  ///< a PNG file to be shown beside it, there or not; empty: a built-in scene's own
};

class ScenePanel {
 public:
  ScenePanel(std::vector<OpenableScene> scenes, bool is_open_at_first)
      : is_open(is_open_at_first), scenes_(std::move(scenes)) {}

  /// Draws it over the picture; returns what was chosen. `has_tour`: offers a tour of the window.
  std::optional<std::string> draw(const Vec2f& picture, const PanelStyle& style, bool has_tour);
  /// Where a scene stands in the window, as of the last drawing: left, top, right, bottom.
  std::optional<std::array<float, 4>> place_of(const std::string& scene) const;

  /// Whether a tour of the window was asked for since the last call.
  bool take_wish_for_tour() { return std::exchange(wishes_tour_, false); }

  bool is_open = false;

 private:
  bool draw_row(const OpenableScene& scene, const PanelStyle& style);
  bool draw_row_with_picture(const OpenableScene& scene, const PanelStyle& style);

  std::vector<OpenableScene> scenes_;
  std::vector<std::array<float, 4>> places_;
  ThumbnailTextures thumbnails_;
  bool wishes_tour_ = false;
  std::array<char, 1024> typed_{};
};

}  // namespace pliant_viewer
