#include "viewer/window_settings.h"

#include <algorithm>
#include <cstdint>
#include <exception>
#include <string>

#include <nlohmann/json.hpp>

#include "pliant_io/files/atomic_file.h"
#include "pliant_io/files/read_file.h"
#include "viewer/recent_files.h"

namespace pliant_viewer {

float automatic_scale(float of_desktop, const std::array<int, 2>& pixels) {
  constexpr float share = 0.75F, most = 2;  // a larger window has more room as well, not larger letters alone
  const float growth = std::min(static_cast<float>(pixels[0]) / 1280, static_cast<float>(pixels[1]) / 720) * share;
  float scale = of_desktop;
  for (const float each : panel_scales) {
    if (each <= std::min(growth, most)) scale = std::max(scale, each);
  }
  return scale;
}

float next_scale(float scale, bool is_larger) {
  constexpr float nearly = 1e-3F;
  if (is_larger) {
    const auto found = std::ranges::find_if(panel_scales, [=](float each) { return each > scale + nearly; });
    return found == panel_scales.end() ? panel_scales.back() : *found;
  }
  float below = panel_scales.front();
  for (const float each : panel_scales) {
    if (each < scale - nearly) below = each;
  }
  return below;
}

std::filesystem::path window_settings_path() {
  const std::filesystem::path folder = state_folder();
  return folder.empty() ? folder : folder / "window.json";
}

WindowSettings read_window_settings(const std::filesystem::path& file) {
  constexpr std::uintmax_t most_of_settings = 1 << 16;
  WindowSettings settings;
  std::error_code ignored;
  if (const auto size = std::filesystem::file_size(file, ignored); ignored || size > most_of_settings) return settings;
  try {
    const nlohmann::json json = nlohmann::json::parse(pliant::read_file(file));
    constexpr auto themes = choice_names(Theme{});
    const auto theme = std::ranges::find(themes, json.value("theme", std::string()));
    if (theme != themes.end()) settings.theme = static_cast<Theme>(theme - themes.begin());
    const float scale = json.value("scale", 0.0F);
    if (std::ranges::count(panel_scales, scale) > 0) settings.scale = scale;
  } catch (const std::exception&) {
    return settings;
  }
  return settings;
}

void write_window_settings(const std::filesystem::path& file, const WindowSettings& settings) {
  if (file.empty()) return;
  try {
    nlohmann::json json = {{"theme", choice_names(Theme{})[static_cast<std::size_t>(settings.theme)]}};
    if (settings.scale > 0) json["scale"] = settings.scale;
    std::filesystem::create_directories(file.parent_path());
    pliant::write_file_atomically(file, json.dump(1) + "\n");
  } catch (const std::exception&) {
    return;
  }
}

}  // namespace pliant_viewer
