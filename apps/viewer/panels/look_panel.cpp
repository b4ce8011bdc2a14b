#include "viewer/panels/look_panel.h"

#include <imgui.h>

namespace pliant_viewer {

bool draw_look_panel(pliant::ViewSettings& look, int& samples, const Stage& stage) {
  bool has_changed = false;
  row_label("color", "C: what the colors of the bodies tell");
  constexpr auto names = choice_names(pliant::ColorBy{});
  if (ImGui::BeginCombo("##color", names[static_cast<std::size_t>(look.color)].data())) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto color = static_cast<pliant::ColorBy>(i);
      if (!stage.knows(color)) continue;
      if (ImGui::Selectable(names[i].data(), color == look.color)) {
        has_changed = color != look.color;
        look.color = color;
      }
    }
    ImGui::EndCombo();
  }
  bool is_flat = look.shading == pliant::Shading::flat;
  row_label("draw", "");
  ImGui::Checkbox("edges", &look.wireframe);
  explain("W: the edges of the elements");
  ImGui::SameLine();
  if (ImGui::Checkbox("flat", &is_flat)) look.shading = is_flat ? pliant::Shading::flat : pliant::Shading::smooth;
  explain("L: each face by itself");
  ImGui::SameLine();
  bool is_smoothed = samples > 1;
  if (ImGui::Checkbox("soft", &is_smoothed)) samples = is_smoothed ? 4 : 1;
  explain("smooth outlines, with four samples a pixel: twice the time, and off at first without a graphics card");
  row_label("", "");
  ImGui::Checkbox("ground", &look.ground);
  ImGui::SameLine();
  ImGui::BeginDisabled(!look.ground);
  ImGui::Checkbox("shadow", &look.shadow);
  ImGui::EndDisabled();
  return has_changed;
}

}  // namespace pliant_viewer
