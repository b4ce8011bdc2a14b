#pragma once
// How the window itself looks: light or dark, and how large its letters are.
#include <array>
#include <map>
#include <string>

#include "viewer/window_settings.h"

namespace pliant_viewer {

/// Draws the rows; returns whether something was chosen. `scale`: in use. `places`: of "theme" and "panel size", and of
/// the choices of an open menu, "theme dark", in the window: left, top, right, bottom.
bool draw_window_panel(WindowSettings& settings, float scale, std::map<std::string, std::array<float, 4>>& places);

}  // namespace pliant_viewer
