#include "viewer/panels/scene_panel.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <imgui.h>

namespace pliant_viewer {

std::optional<std::array<float, 4>> ScenePanel::place_of(const std::string& scene) const {
  const auto found = std::ranges::find(scenes_, scene, &OpenableScene::name);
  const auto number = static_cast<std::size_t>(found - scenes_.begin());
  if (number >= places_.size()) return {};
  return places_[number];
}

/// A picture on the left, and what is said of the scene below its name. Returns whether it was clicked.
bool ScenePanel::draw_row_with_picture(const OpenableScene& scene, const PanelStyle& style) {
  const ImVec2 picture = {112 * style.unit, 70 * style.unit};
  const ImVec2 start = ImGui::GetCursorPos();
  const float left = start.x + picture.x + 12 * style.unit, wrap = ImGui::GetContentRegionMax().x;
  const float line = ImGui::GetTextLineHeightWithSpacing();
  const float text_height = line + ImGui::CalcTextSize(scene.description.c_str(), nullptr, false, wrap - left).y;
  const float height = std::max(picture.y, text_height);
  const bool is_clicked = ImGui::Selectable("##open", false, 0, {0, height});
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_.push_back({low.x, low.y, high.x, high.y});
  const ImVec2 end = ImGui::GetCursorPos();
  if (ImGui::IsItemVisible()) {
    const ImVec2 corner = {low.x + ImGui::GetStyle().ItemSpacing.x / 2, (low.y + high.y - picture.y) / 2};
    if (const pliant_render::Texture* texture = thumbnails_.find(scene.name, scene.picture)) {
      // NOLINTNEXTLINE(performance-no-int-to-ptr): as ImGui wants the number of a texture
      ImGui::GetWindowDrawList()->AddImageRounded(reinterpret_cast<ImTextureID>(std::uintptr_t{texture->id()}), corner,
                                                  {corner.x + picture.x, corner.y + picture.y}, {0, 0}, {1, 1},
                                                  IM_COL32_WHITE, 4 * style.unit);
    } else {
      ImGui::GetWindowDrawList()->AddRectFilled(corner, {corner.x + picture.x, corner.y + picture.y},
                                                ImGui::GetColorU32(ImGuiCol_FrameBg), 4 * style.unit);
    }
  }
  ImGui::SetCursorPos({left, start.y + std::max(0.0F, (height - text_height) / 2)});
  ImGui::TextUnformatted(scene.name.c_str());
  ImGui::SetCursorPosX(left);
  ImGui::PushTextWrapPos(wrap);
  ImGui::TextDisabled("%s", scene.description.c_str());
  ImGui::PopTextWrapPos();
  ImGui::SetCursorPos({end.x, end.y + 4 * style.unit});
  return is_clicked;
}

/// Returns whether the row was clicked.
bool ScenePanel::draw_row(const OpenableScene& scene, const PanelStyle& style) {
  if (!scene.heading.empty()) {
    if (!places_.empty()) ImGui::Spacing();
    ImGui::TextUnformatted(scene.heading.c_str());
    ImGui::Spacing();
  }
  ImGui::PushID(static_cast<int>(places_.size()));
  if (!scene.picture.empty() || (scene.opens.empty() && !thumbnail_file(scene.name).empty())) {
    const bool is_clicked = draw_row_with_picture(scene, style);
    ImGui::PopID();
    return is_clicked;
  }
  const float column = 150 * style.unit;
  const float top = ImGui::GetCursorPosY();
  const float name_left = ImGui::GetCursorPosX();
  const float wrap = ImGui::GetContentRegionMax().x;
  // a long name pushes what is said of it aside
  const float name_width = ImGui::CalcTextSize((scene.name + "  ").c_str()).x;
  const float left = name_left + std::clamp(name_width, column, std::max(column, 0.7F * (wrap - name_left)));
  const float text_height = ImGui::CalcTextSize(scene.description.c_str(), nullptr, false, wrap - left).y;
  const bool is_clicked = ImGui::Selectable("##open", false, 0, {0, std::max(text_height, ImGui::GetTextLineHeight())});
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_.push_back({low.x, low.y, high.x, high.y});
  const float below = ImGui::GetCursorPosY();
  ImGui::SetCursorPosY(top);
  ImGui::TextUnformatted(scene.name.c_str());
  ImGui::SetCursorPos({left, top});
  ImGui::PushTextWrapPos(wrap);
  ImGui::TextDisabled("%s", scene.description.c_str());
  ImGui::PopTextWrapPos();
  ImGui::SetCursorPosY(below);
  ImGui::PopID();
  return is_clicked;
}

std::optional<std::string> ScenePanel::draw(const Vec2f& picture, const PanelStyle& style, bool has_tour) {
  std::optional<std::string> chosen;
  places_.clear();
  if (!is_open) return chosen;
  const float width = std::min(picture.x() - 16 * style.unit, 760 * style.unit);
  const float height = std::min(picture.y() - 16 * style.unit, 560 * style.unit);
  ImGui::SetNextWindowPos({picture.x() / 2, picture.y() / 2}, ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::SetNextWindowSize({width, height});
  ImGui::SetNextWindowBgAlpha(0.98F);
  ImGui::Begin("Scenes", nullptr,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoNav);
  ImGui::TextUnformatted("Open a scene, a mesh or a run");
  ImGui::TextDisabled("Drop a file onto the window, type its name, or choose a scene.");
  ImGui::Spacing();
  const ImGuiStyle& spaces = ImGui::GetStyle();
  const float button = ImGui::CalcTextSize("Close").x + 2 * spaces.FramePadding.x + 12 * style.unit;
  ImGui::SetNextItemWidth(-3 * (button + spaces.ItemSpacing.x));
  const bool is_typed =
      ImGui::InputTextWithHint("##file", "name of a file or a folder", typed_.data(), typed_.size(),
                               ImGuiInputTextFlags_EnterReturnsTrue | ImGuiInputTextFlags_AutoSelectAll);
  ImGui::SameLine();
  const bool is_pressed = ImGui::Button("Open", {button, 0});
  ImGui::SameLine();
  ImGui::BeginDisabled(!has_tour);
  if (ImGui::Button("Tour", {button, 0})) {
    wishes_tour_ = true;
    is_open = false;
  }
  ImGui::EndDisabled();
  explain("five things to try in the window, with the scene behind this list");
  ImGui::SameLine();
  if (ImGui::Button("Close", {button, 0})) is_open = false;
  if ((is_typed || is_pressed) && typed_[0] != '\0') chosen = typed_.data();
  ImGui::Separator();
  ImGui::BeginChild("list");
  for (const OpenableScene& scene : scenes_) {
    if (draw_row(scene, style)) chosen = scene.opens.empty() ? scene.name : scene.opens;
  }
  ImGui::EndChild();
  ImGui::End();
  return chosen;
}

}  // namespace pliant_viewer
