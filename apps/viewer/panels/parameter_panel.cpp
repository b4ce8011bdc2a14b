#include "viewer/panels/parameter_panel.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <imgui.h>

namespace pliant_viewer {
namespace {

constexpr double decades = 1e3;  // that a slider goes up and down from the value that it is first seen with

/// Those of the solver that are always in sight; the others unfold.
bool is_common(const Parameter& parameter) {
  return parameter.section != "settings" || parameter.name == "time_step" || parameter.name == "iterations";
}

/// "time step" for "time_step".
std::string label_of(std::string name) {
  std::ranges::replace(name, '_', ' ');
  return name;
}

/// The ends of a slider: the parameter's own where they are near, else some way up and down from its value.
std::array<double, 2> range_of(const Parameter& parameter) {
  const pliant::Range& range = parameter.range;
  if (range.min > -1e3 && range.max < 1e4) return {range.min, range.max};
  const double value = parameter.value[0];
  return {value / decades, value * decades};
}

std::string help_of(const Parameter& parameter) {
  return parameter.doc + "\nCtrl + click: type a number";
}

}  // namespace

std::optional<std::array<float, 4>> ParameterPanel::place_of(const std::string& key) const {
  const auto found = places_.find(key);
  if (found == places_.end()) return {};
  return found->second;
}

void ParameterPanel::draw(const Snapshot& snapshot, LiveScene& live) {
  std::erase_if(edited_, [&](const auto& entry) { return entry.second.command <= snapshot.commands; });
  const std::span<const Parameter> all = *snapshot.parameters;
  const auto draw_those = [&](const char* title, std::string_view kind) {
    const auto is_meant = [kind](const Parameter& parameter) { return parameter.section.starts_with(kind); };
    const auto begin = std::ranges::find_if(all, is_meant);
    const auto end = std::find_if_not(begin, all.end(), is_meant);
    if (begin == end || !section_header(title)) return;
    draw_sections({begin, end}, live);
  };
  draw_those("Solver", "settings");
  draw_those("Stiffness", "group:");
  draw_those("Forces", "force:");
}

void ParameterPanel::draw_sections(std::span<const Parameter> sections, LiveScene& live) {
  for (auto begin = sections.begin(); begin != sections.end();) {
    const auto end =
        std::find_if(begin, sections.end(), [&](const auto& other) { return other.section != begin->section; });
    draw_section({begin, end}, live);
    begin = end;
  }
}

/// Of a stiffness one row with the name of the group, of forces a row each below their name.
void ParameterPanel::draw_section(std::span<const Parameter> section, LiveScene& live) {
  const Parameter& first = section.front();
  ImGui::PushID(first.section.c_str());
  if (first.section.starts_with("group:")) {
    draw_row(first, first.section.substr(first.section.find(':') + 1), live);
  } else {
    const bool is_solver = first.section == "settings";
    if (!is_solver) ImGui::TextDisabled("%s", first.heading.c_str());
    const auto draw_those = [&](bool common) {
      for (const Parameter& parameter : section) {
        if (is_common(parameter) == common) draw_row(parameter, label_of(parameter.name), live);
      }
    };
    draw_those(true);
    if (is_solver && ImGui::TreeNode("more")) {
      draw_those(false);
      ImGui::TreePop();
    }
  }
  ImGui::PopID();
}

void ParameterPanel::draw_row(const Parameter& parameter, const std::string& label, LiveScene& live) {
  const std::string key = parameter.key();
  const auto found = edited_.find(key);
  pliant::Vec3 value = found == edited_.end() ? parameter.value : found->second.value;
  row_label(label, parameter.section.starts_with("group:") ? parameter.heading + ": " + help_of(parameter)
                                                           : help_of(parameter));
  const std::string id = "##" + parameter.name;
  bool has_changed = false;
  switch (parameter.kind) {
    case ParameterKind::real:
      has_changed = draw_real(parameter, value[0]);
      break;
    case ParameterKind::integer: {
      int number = static_cast<int>(std::min(value[0], 1e9));
      const int most = static_cast<int>(std::min<double>(parameter.range.max, 100));
      has_changed = ImGui::SliderInt(id.c_str(), &number, static_cast<int>(parameter.range.min), most, "%d",
                                     ImGuiSliderFlags_Logarithmic);
      value[0] = number;
      break;
    }
    case ParameterKind::choice: {
      int chosen = static_cast<int>(value[0]);
      std::string items;
      for (const std::string& choice : parameter.choices) items += label_of(choice) + '\0';
      has_changed = ImGui::Combo(id.c_str(), &chosen, items.c_str());
      value[0] = chosen;
      break;
    }
    case ParameterKind::vector:
      has_changed =
          ImGui::DragScalarN(id.c_str(), ImGuiDataType_Double, value.data(), 3, 0.05F, nullptr, nullptr, "%.3g");
      break;
  }
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_[key] = {low.x, low.y, high.x, high.y};
  if (parameter.kind == ParameterKind::vector) explain(parameter.unit);
  if (!has_changed || !value.allFinite()) return;
  const std::uint64_t command =
      live.post([key, value](CommandContext& context) { context.session.set(key, value); }, LiveScene::Kind::changes);
  edited_[key] = {value, command};
}

bool ParameterPanel::draw_real(const Parameter& parameter, double& value) {
  const std::string id = "##" + parameter.name;
  const std::string format = number_format(value, parameter.unit);
  auto found = ranges_.find(parameter.key());
  if (found == ranges_.end()) found = ranges_.emplace(parameter.key(), range_of(parameter)).first;
  auto [low, high] = found->second;
  if (!(low < high)) {  // from zero there are no decades
    const double step = std::max(std::abs(value) * 0.01, 1e-3);
    return ImGui::DragScalar(id.c_str(), ImGuiDataType_Double, &value, static_cast<float>(step),
                             parameter.range.min > -1e300 ? &parameter.range.min : nullptr, nullptr, format.c_str());
  }
  const bool is_wide = low > 0 && high > 100 * low;
  return ImGui::SliderScalar(id.c_str(), ImGuiDataType_Double, &value, &low, &high, format.c_str(),
                             is_wide ? ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat : 0);
}

}  // namespace pliant_viewer
