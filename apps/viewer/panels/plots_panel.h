#pragma once
// Plots over time of what is measured, over the picture.
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "plot/run_plots.h"
#include "viewer/history.h"
#include "viewer/panels/plot_drawing.h"
#include "viewer/picking.h"

namespace pliant_viewer {

class PlotsPanel {
 public:
  /// What a button asks for.
  enum class Wish { none, numbers, drawings };

  /// Draws it over a picture of this size; `now` is marked by a line.
  Wish draw(const pliant_plot::MeasuredRun& run, std::optional<double> now, const Vec2f& picture,
            const PanelStyle& style);
  /// The plots that are chosen, in the range of time that is shown, of few points each.
  std::vector<pliant_report::Plot> plots(const pliant_plot::MeasuredRun& run) const;
  /// What of that which is shown has to be asked for.
  Measuring needs(const pliant_plot::MeasuredRun& run) const;

  /// The times that are shown [s].
  TimeRange shown(const pliant_plot::MeasuredRun& run) const;
  /// Where a plot, by its title, or a button stands in the window, as of the last drawing.
  std::optional<Rect> place_of(const std::string& what) const;

  bool is_open = false;

 private:
  enum class Axes { automatic, linear, logarithmic };
  Wish draw_controls(const pliant_plot::MeasuredRun& run, const PanelStyle& style);
  void draw_choice(const pliant_plot::MeasuredRun& run);
  void draw_times();
  void draw_axes();
  bool draw_button(const char* label, const char* help);
  void draw_plots(const pliant_plot::MeasuredRun& run, std::optional<double> now, const PanelStyle& style);
  void take_mouse(const Rect& area, const TimeRange& known);
  std::vector<pliant_report::Plot> chosen_plots(const pliant_plot::MeasuredRun& run,
                                                const pliant_plot::PlotChoice& choice) const;
  pliant_plot::PlotChoice choice(const TimeRange& range) const;

  std::set<std::string> chosen_ = {"Energy", "Total speed"};  // titles of figures
  Axes axes_ = Axes::automatic;
  TimeView times_;
  std::optional<double> read_at_;  // under the mouse, as of the last drawing [s]
  std::map<std::string, Rect> places_;
  Vec2f picture_ = {0, 0};  // for which it was placed
};

}  // namespace pliant_viewer
