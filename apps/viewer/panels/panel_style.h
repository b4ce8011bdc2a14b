#pragma once
// Styles and small widgets shared by all panels.
#include <array>
#include <optional>
#include <string>

namespace pliant_viewer {

struct PanelStyle {
  float unit = 1;  ///< pixels per unit of a layout made for the default font size
};

/// Sets colors, roundings and spacings of all panels, on a light background or a dark one.
void set_panel_style(bool is_dark, float unit);

/// A printf format for a number of about this size with its unit, without an exponent where possible.
std::string number_format(double number, const std::string& unit);

/// "time step" for "time_step".
std::string label_of(std::string name);

/// Draws the label on the left of a row; the widget that follows takes the rest, or the next line where the label is
/// too long for that. `help` is the label's tooltip.
void row_label(const std::string& label, const std::string& help);

/// Text that continues on a new line where the panel is too narrow for it.
void wrapped_text(const std::string& text);

/// A heading that folds its section, and unfolds it now where `shall_open`; returns whether it is unfolded.
bool section_header(const char* title, bool is_open_at_first = true, bool shall_open = false);

/// Where the heading of a section stood when it was drawn last: left, top, right, bottom.
std::optional<std::array<float, 4>> section_place(const std::string& title);

/// A tooltip for the widget drawn last; none where `help` is empty.
void explain(const std::string& help);

}  // namespace pliant_viewer
