#include "viewer/panels/material_panel.h"

#include <imgui.h>

#include "viewer/panels/panel_style.h"

namespace pliant_viewer {

std::optional<std::array<float, 4>> MaterialPanel::place_of(const std::string& body) const {
  const auto found = places_.find(body);
  if (found == places_.end()) return {};
  return found->second;
}

void MaterialPanel::begin(const Snapshot& snapshot) {
  std::erase_if(chosen_, [&](const auto& entry) { return entry.second.command <= snapshot.commands; });
  places_.clear();
}

void MaterialPanel::draw_row(const BodyMaterial& row, LiveScene& live) {
  const auto found = chosen_.find(row.name);
  const std::string& present = found == chosen_.end() ? row.material : found->second.material;
  row_label("material",
            "what this body is made of: its weight, stretch, bending and friction change where it is;\n"
            "pins and pulls stay");
  ImGui::PushID(row.name.c_str());
  const std::string shown = present.empty() ? "its own constraints" : label_of(present);
  const bool is_open = ImGui::BeginCombo("##material", shown.c_str(), ImGuiComboFlags_HeightLarge);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_[row.name] = {low.x, low.y, high.x, high.y};
  if (is_open) {
    for (const MaterialChoice& choice : row.choices) {
      const bool is_present = choice.name == present;
      if (ImGui::Selectable(label_of(choice.name).c_str(), is_present) && !is_present) {
        const auto command = [body = row.name, material = choice.name](CommandContext& context) {
          context.session.set_material(body, material);
        };
        chosen_[row.name] = {choice.name, live.post(command, LiveScene::Kind::changes)};
      }
      // Beside the list, which it would cover.
      if (ImGui::IsItemHovered()) ImGui::SetNextWindowPos({low.x, ImGui::GetItemRectMin().y}, ImGuiCond_Always, {1, 0});
      explain(choice.description);
      if (is_present) ImGui::SetItemDefaultFocus();
    }
    ImGui::EndCombo();
  }
  ImGui::PopID();
}

}  // namespace pliant_viewer
