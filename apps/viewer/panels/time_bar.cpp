#include "viewer/panels/time_bar.h"

#include <fmt/format.h>
#include <imgui.h>

namespace pliant_viewer {

void draw_time_bar(Playback& playback, const Vec2f& picture, const PanelStyle& style) {
  const float margin = 12 * style.unit;
  ImGui::SetNextWindowPos({margin, picture.y() - margin}, ImGuiCond_Always, {0, 1});
  ImGui::SetNextWindowSize({picture.x() - 2 * margin, 0});
  ImGui::Begin("time bar", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav);
  int place = static_cast<int>(playback.place());
  ImGui::SetNextItemWidth(-1);
  const std::string text = fmt::format("{:.2f} s", playback.time(playback.place()));
  if (ImGui::SliderInt("##frame", &place, 0, static_cast<int>(playback.count()) - 1, text.c_str(),
                       ImGuiSliderFlags_AlwaysClamp)) {
    playback.play(false);
    playback.go_to(static_cast<std::size_t>(place));
  }
  ImGui::End();
}

}  // namespace pliant_viewer
