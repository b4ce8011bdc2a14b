#pragma once
// A slider for each parameter of the simulation.
#include <array>
#include <map>
#include <optional>

#include "viewer/live_scene.h"
#include "viewer/panels/panel_style.h"

namespace pliant_viewer {

class ParameterPanel {
 public:
  /// Draws all parameters of a snapshot, and posts what is changed.
  void draw(const Snapshot& snapshot, LiveScene& live);
  /// Where the widget of a parameter stands in the window, as of the last drawing: left, top, right, bottom.
  std::optional<std::array<float, 4>> place_of(const std::string& key) const;

 private:
  /// What a slider shows while the simulation has not taken it over yet.
  struct Edited {
    pliant::Vec3 value;
    std::uint64_t command;
  };
  void draw_owners(std::span<const Slider> sliders, LiveScene& live);
  void draw_group(std::span<const Slider> group, LiveScene& live);
  void draw_options(std::span<const Slider> options, LiveScene& live);
  void draw_colliders(std::span<const Slider> sliders, const Snapshot& snapshot, LiveScene& live);
  void draw_body_contacts(std::span<const Slider> sliders, LiveScene& live);
  void draw_row(const Slider& slider, const std::string& label, const std::string& help, LiveScene& live);
  void post_change(const std::string& key, const pliant::Parameter& parameter, pliant::Vec3 value, bool has_changed,
                   LiveScene& live);
  bool draw_real(const Slider& slider, double& value);

  std::map<std::string, Edited> edited_;
  std::optional<std::pair<std::string, pliant::Vec3>> withheld_;  // what is being typed and may become a value
  std::string held_;  // key of what is being dragged and has changed: one change for undo
  std::map<std::string, std::array<double, 2>> ranges_;  // of sliders, by the values that were seen first
  std::map<std::string, std::array<float, 4>> places_;
};

}  // namespace pliant_viewer
