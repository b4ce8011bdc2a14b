#include "viewer/panels/appearance_panel.h"

#include <imgui.h>

namespace pliant_viewer {

bool draw_appearance_panel(pliant::ViewSettings& appearance, int& samples, pliant::Quality quality,
                           const ViewSource& source) {
  bool has_changed = false;
  row_label("color", "C: what the colors of the bodies tell");
  constexpr auto names = choice_names(pliant::ColorBy{});
  if (ImGui::BeginCombo("##color", names[static_cast<std::size_t>(appearance.color)].data())) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto color = static_cast<pliant::ColorBy>(i);
      if (!source.knows(color)) continue;
      if (ImGui::Selectable(names[i].data(), color == appearance.color)) {
        has_changed = color != appearance.color;
        appearance.color = color;
      }
    }
    ImGui::EndCombo();
  }
  bool is_flat = appearance.shading == pliant::Shading::flat;
  row_label("draw", "");
  ImGui::Checkbox("edges", &appearance.wireframe);
  explain("W: the edges of the elements");
  ImGui::SameLine();
  if (ImGui::Checkbox("flat", &is_flat)) appearance.shading = is_flat ? pliant::Shading::flat : pliant::Shading::smooth;
  explain("L: each face by itself");
  ImGui::SameLine();
  bool is_smoothed = samples > 1;
  if (ImGui::Checkbox("soft", &is_smoothed)) samples = is_smoothed ? 4 : 1;
  explain("smooth outlines, with four samples a pixel: twice the time, and off at first without a graphics card");
  row_label("", "");
  ImGui::Checkbox("ground", &appearance.ground);
  ImGui::SameLine();
  ImGui::Checkbox("shadow", &appearance.shadow);
  explain("on the ground, and with light of bodies on bodies");
  row_label("smoother", "each triangle is cut into four so many times, to be drawn rounder than it is simulated");
  ImGui::SetNextItemWidth(-1);
  constexpr std::array<const char*, 4> finer = {"as simulated", "4 x the triangles", "16 x the triangles",
                                                "64 x the triangles"};
  ImGui::Combo("##subdivision", &appearance.subdivision, finer.data(), static_cast<int>(finer.size()));
  row_label("", "");
  bool is_lit = quality != pliant::Quality::low;
  if (ImGui::Checkbox("light", &is_lit)) appearance.quality = is_lit ? pliant::Quality::high : pliant::Quality::low;
  explain("shadows of bodies on bodies, darker where little of the sky is seen; off at first where it would be slow");
  if (!source.frame().content.colliders.empty()) {
    ImGui::SameLine();
    ImGui::Checkbox("colliders", &appearance.colliders);
    explain("O: hidden ones act all the same");
  }
  return has_changed;
}

}  // namespace pliant_viewer
