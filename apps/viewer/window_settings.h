#pragma once
// What a user has chosen for the window itself, kept for the next start in `window.json` beside the list of recent
// files. A convenience: what cannot be read or written is passed over.
#include <array>
#include <filesystem>
#include <string_view>

namespace pliant_viewer {

/// Of the panels. `automatic`: as light or dark as the background of the picture.
enum class Theme { automatic, light, dark };
constexpr std::array<std::string_view, 3> choice_names(Theme) {
  return {"automatic", "light", "dark"};
}

/// Sizes of panels and letters that can be chosen, ascending.
constexpr std::array<float, 8> panel_scales = {0.75F, 1, 1.25F, 1.5F, 1.75F, 2, 2.5F, 3};

struct WindowSettings {
  Theme theme = Theme::automatic;
  float scale =
      0;  ///< of panels and letters, one of panel_scales; 0: as the desktop and the size of the window ask for

  friend bool operator==(const WindowSettings&, const WindowSettings&) = default;
};

/// The scale where none is chosen: that of the desktop, or more in a window of many pixels, whose picture has larger
/// labels as well.
float automatic_scale(float of_desktop, const std::array<int, 2>& pixels);
/// The next of panel_scales above or below one, or the last.
float next_scale(float scale, bool is_larger);

/// Where they are kept; empty where the environment names no folder.
std::filesystem::path window_settings_path();
/// Those of a file; the usual ones where it says nothing, and where there is none.
WindowSettings read_window_settings(const std::filesystem::path& file);
/// Nothing is written where the path is empty.
void write_window_settings(const std::filesystem::path& file, const WindowSettings& settings);

}  // namespace pliant_viewer
