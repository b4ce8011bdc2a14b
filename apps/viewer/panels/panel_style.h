#pragma once
// What the panels have in common.
#include <string>

namespace pliant_viewer {

struct PanelStyle {
  float unit = 1;  ///< pixels of a length that is given for letters of common size
};

/// Sets colors, roundings and distances of all panels, on a light background or a dark one.
void set_panel_style(bool is_dark, float unit);

/// printf's format of a number of about this size with its unit, without an exponent where that can be.
std::string number_format(double number, const std::string& unit);

/// A name at the left of a row; the widget that follows takes the rest of it. The text under the mouse explains it.
void row_label(const std::string& label, const std::string& help);

/// A line that folds and unfolds what follows; returns whether that is to be drawn.
bool section_header(const char* title, bool is_open_at_first = true);

/// The text under the mouse, for the widget before.
void explain(const std::string& help);

}  // namespace pliant_viewer
