#pragma once
// A slider for each parameter of the simulation.
#include <array>
#include <map>
#include <optional>
#include <utility>

#include "viewer/live_scene.h"
#include "viewer/panels/number_slider.h"
#include "viewer/panels/panel_style.h"

namespace pliant_viewer {

class ParameterPanel {
 public:
  /// Before the rows of a picture.
  void begin(const Snapshot& snapshot);
  /// Draws the rows of a group of constraints, and posts what is changed: its switch, its name and its stiffness, or
  /// else its first option; the others unfold.
  void draw_group(std::span<const Slider> group, const Snapshot& snapshot, LiveScene& live);
  /// The row of a group or a force that is switched off.
  void draw_switched_off(const std::string& name, const SwitchedOff& off, const Snapshot& snapshot, LiveScene& live);
  /// Draws all parameters of a snapshot but those of groups, and posts what is changed. `selected`: the name of a
  /// collider that has rows for where it is as well.
  void draw(const Snapshot& snapshot, LiveScene& live, const std::string& selected = {});
  /// The collider whose name was clicked since the last call; "": none.
  std::string take_clicked_collider() { return std::exchange(clicked_collider_, {}); }
  bool shows_forces() const { return shows_forces_; }  ///< as of the last drawing
  /// Where the widget of a parameter, the "number:KEY" beside its slider, "switch:NAME", "collider:NAME", or "add
  /// forces" and "add colliders", stands in the window, as of the last drawing: left, top, right, bottom.
  std::optional<std::array<float, 4>> place_of(const std::string& key) const;

 private:
  /// What a slider shows while the simulation has not taken it over yet.
  struct Edited {
    pliant::Vec3 value;
    std::uint64_t command;
  };
  void draw_forces(std::span<const Slider> sliders, const Snapshot& snapshot, LiveScene& live);
  void draw_options(std::span<const Slider> options, LiveScene& live);
  void draw_adder(std::string_view list, const Snapshot& snapshot, LiveScene& live);
  bool draw_switch(const std::string& name, const Snapshot& snapshot, LiveScene& live);
  void draw_colliders(std::span<const Slider> sliders, const Snapshot& snapshot, LiveScene& live,
                      const std::string& selected);
  bool draw_collider_name(const std::string& heading, const Snapshot& snapshot, const std::string& name,
                          bool is_selected);
  void draw_pose(const MovableCollider& collider, LiveScene& live);
  /// Where the row of a collider has gone from under the hand, which then has let go.
  void end_lost_drag(LiveScene& live);
  void draw_body_contacts(std::span<const Slider> sliders, LiveScene& live);
  void draw_row(const Slider& slider, const std::string& label, const std::string& help, LiveScene& live);
  void post_change(const std::string& key, const pliant::Parameter& parameter, pliant::Vec3 value, bool has_changed,
                   LiveScene& live);
  NumberSlider slider_of(const Slider& slider);

  /// The same of a switch.
  struct Switched {
    bool on;
    std::uint64_t command;
  };

  std::map<std::string, Edited> edited_;
  std::map<std::string, Switched> switched_;
  std::optional<std::pair<std::string, pliant::Vec3>> withheld_;  // what is being typed and may become a value
  struct MovedRow {
    std::string collider, id;  ///< by name; "##place" or "##turned"
    pliant::Vec3 value;
  };
  std::optional<MovedRow> moved_;  // that is dragged
  bool shows_forces_ = false;
  std::string shown_collider_, clicked_collider_;
  int scrolls_to_collider_ = 0;  // pictures in which that goes on: it was selected just now, and its rows are new
  std::string held_;             // key of what is being dragged and has changed: one change for undo
  std::map<std::string, std::array<double, 2>> ranges_;  // of sliders, by the values that were seen first
  std::map<std::string, std::array<float, 4>> places_;
};

}  // namespace pliant_viewer
