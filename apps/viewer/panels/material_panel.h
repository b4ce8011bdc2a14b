#pragma once
// A menu of materials for each body.
#include <array>
#include <map>
#include <optional>
#include <string>

#include "viewer/live_scene.h"

namespace pliant_viewer {

class MaterialPanel {
 public:
  /// Before the rows of a picture.
  void begin(const Snapshot& snapshot);
  /// Draws the row of a body that can be made of a material, and posts what is chosen.
  void draw_row(const BodyMaterial& row, LiveScene& live);
  /// Where the menu of a body stands in the window, as of the last drawing: left, top, right, bottom.
  std::optional<std::array<float, 4>> place_of(const std::string& body) const;

 private:
  /// What a menu shows while the simulation has not taken it over yet.
  struct Chosen {
    std::string material;
    std::uint64_t command;
  };

  std::map<std::string, Chosen> chosen_;
  std::map<std::string, std::array<float, 4>> places_;
};

}  // namespace pliant_viewer
