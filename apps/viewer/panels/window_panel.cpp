#include "viewer/panels/window_panel.h"

#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/panels/panel_style.h"

namespace pliant_viewer {
namespace {

std::string percent(float scale) {
  return fmt::format("{} %", std::lround(100 * scale));
}

}  // namespace

bool draw_window_panel(WindowSettings& settings, float scale, std::map<std::string, std::array<float, 4>>& places) {
  const WindowSettings before = settings;
  const auto note_place = [&places](const std::string& name) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    places[name] = {low.x, low.y, high.x, high.y};
  };
  constexpr auto themes = choice_names(Theme{});
  row_label("theme", "Ctrl + T: light or dark panels; automatic: as the background of the picture is");
  const bool is_theme_open = ImGui::BeginCombo("##theme", themes[static_cast<std::size_t>(settings.theme)].data());
  if (!is_theme_open) note_place("theme");
  for (std::size_t i = 0; is_theme_open && i < themes.size(); ++i) {
    const auto theme = static_cast<Theme>(i);
    if (ImGui::Selectable(themes[i].data(), theme == settings.theme)) settings.theme = theme;
    note_place("theme " + std::string(themes[i]));
  }
  if (is_theme_open) ImGui::EndCombo();
  row_label("size", "Ctrl + and Ctrl −: of the panels and their letters; Ctrl 0: automatic");
  const std::string automatic = "automatic (" + percent(scale) + ")";
  const bool is_size_open = ImGui::BeginCombo("##size", (settings.scale > 0 ? percent(scale) : automatic).c_str());
  if (!is_size_open) note_place("panel size");
  if (is_size_open) {
    if (ImGui::Selectable("automatic", !(settings.scale > 0))) settings.scale = 0;
    for (const float each : panel_scales) {
      if (ImGui::Selectable(percent(each).c_str(), each == settings.scale)) settings.scale = each;
    }
    ImGui::EndCombo();
  }
  return !(settings == before);
}

}  // namespace pliant_viewer
