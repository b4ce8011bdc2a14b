#pragma once
// A slider with its number beside it, and fields for numbers: the one way in which all panels have them.
#include <array>
#include <limits>
#include <string>

namespace pliant_viewer {

/// What a slider goes over, and what its number counts.
struct NumberSlider {
  double low = 0, high = 1;  ///< its ends; a number that is typed may lie beyond; no slider unless low < high
  std::string unit = {};     ///< behind the number; "": none
  bool is_logarithmic = false;
  bool is_whole = false;
  double least = -std::numeric_limits<double>::infinity();  ///< as far as the number goes when it is dragged sideways
  double most = std::numeric_limits<double>::infinity();
};

/// Where its parts stand in the window: left, top, right, bottom. Without a slider both are the number's.
struct NumberPlaces {
  std::array<float, 4> slider = {}, number = {};
};

/// Draws a slider and right of it the number with its unit, which is typed after a click on it and changed by a drag
/// sideways; Ctrl and a click on the slider let one type as well. Takes the width of the next item. Counts as one item
/// for what is asked of the last one. Returns whether the value has changed.
bool number_slider(const char* id, double& value, const NumberSlider& slider, NumberPlaces* places = nullptr);

/// Draws three fields for the numbers of a vector, each changed by a drag sideways, by `speed` for a pixel, or typed
/// after a click on it. Numbers have as many digits as there is room for, and all in the tooltip, with the unit.
bool vector_fields(const char* id, double* values, float speed, const std::string& unit);

/// The same numbers as text, in one line whatever they are; all digits and `help` in the tooltip.
void vector_text(const std::array<double, 3>& values, const std::string& unit, const std::string& help);

/// The label of a row for a vector, with the unit behind it.
std::string label_with_unit(const std::string& label, const std::string& unit);

}  // namespace pliant_viewer
