#include "viewer/panels/parameter_panel.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <imgui.h>
#include <imgui_internal.h>

#include "viewer/added_parts.h"
#include "viewer/rounding.h"

namespace pliant_viewer {

using pliant::Parameter;
using pliant::ParameterKind;

namespace {

constexpr double decades = 1e3;  // that a slider goes up and down from the value that it is first seen with

constexpr std::size_t few_colliders = 3;  // that are unfolded at first

bool is_of_settings(const Slider& slider) {
  return std::holds_alternative<std::monostate>(slider.parameter.handle.owner);
}

/// Those of the solver that are always in sight; the others unfold.
bool is_common(const Slider& slider) {
  const std::string& option = slider.parameter.handle.option;
  return !is_of_settings(slider) || option == "time_step" || option == "iterations";
}

/// The ends of a slider: the parameter's own where they are near; from 0 to twice a ratio, such as a stretch; else some
/// way up and down from its value.
std::array<double, 2> range_of(const Parameter& parameter) {
  const pliant::Range& range = parameter.range;
  if (range.min > -1e3 && range.max < 1e4) return {range.min, range.max};
  const double value = parameter.value[0];
  if (parameter.unit.empty() && range.min >= 0) {
    const double most = std::max(2.0, 2 * value);
    return {range.excludes_min ? most / decades : range.min, most};
  }
  return {value / decades, value * decades};
}

using SliderPlace = std::span<const Slider>::iterator;

/// Behind those that have the same owner as the first.
SliderPlace find_end_of_owner(SliderPlace begin, SliderPlace end) {
  const pliant::ParameterOwner& owner = begin->parameter.handle.owner;
  return std::find_if(begin, end, [&](const Slider& other) { return other.parameter.handle.owner != owner; });
}

/// Of a group, without the name of its body, which stands above.
std::string short_name(const std::string& name, const std::string& body) {
  return name.starts_with(body + ".") ? name.substr(body.size() + 1) : name;
}

bool is_allowed(const Parameter& parameter, const pliant::Vec3& value) {
  const pliant::Range& range = parameter.range;
  const int count = parameter.kind == ParameterKind::vector ? 3 : 1;
  return (value.head(count).array() <= range.max).all() &&
         (range.excludes_min ? (value.head(count).array() > range.min).all()
                             : (value.head(count).array() >= range.min).all());
}

std::string help_of(const Parameter& parameter) {
  const bool is_typed = parameter.kind == ParameterKind::real || parameter.kind == ParameterKind::integer;
  return parameter.doc + (is_typed ? "\nclick its number to type one" : "");
}

/// What is lost in rounding is not told.
void draw_feeling(const char* label, const pliant::Vec3& value, const char* unit, const std::string& help) {
  const pliant::Vec3 shown = (value.array().abs() < 1e-6 * value.norm()).select(0, value.array()).matrix();
  row_label(label_with_unit(label, unit), help);
  vector_text({shown.x(), shown.y(), shown.z()}, unit, help);
}

/// Scrolls until all from `top` to here is seen.
void scroll_to_all_from(float top) {
  ImGuiWindow* const panel = ImGui::GetCurrentWindow();
  ImGui::ScrollToRect(panel, {panel->Pos.x, top, panel->Pos.x + panel->Size.x, ImGui::GetCursorScreenPos().y},
                      ImGuiScrollFlags_KeepVisibleEdgeY);
}

}  // namespace

std::optional<std::array<float, 4>> ParameterPanel::place_of(const std::string& key) const {
  const auto found = places_.find(key);
  if (found == places_.end()) return {};
  return found->second;
}

void ParameterPanel::begin(const Snapshot& snapshot) {
  std::erase_if(edited_, [&](const auto& entry) { return entry.second.command <= snapshot.commands; });
  std::erase_if(switched_, [&](const auto& entry) { return entry.second.command <= snapshot.commands; });
}

void ParameterPanel::draw(const Snapshot& snapshot, LiveScene& live, const std::string& selected) {
  const std::span<const Slider> all = *snapshot.sliders;
  const auto those_of = [all](std::size_t kind_of_owner) {
    const auto is_meant = [=](const Slider& slider) { return slider.parameter.handle.owner.index() == kind_of_owner; };
    const auto begin = std::ranges::find_if(all, is_meant);
    return std::span<const Slider>(begin, std::find_if_not(begin, all.end(), is_meant));
  };
  if (section_header("Solver")) draw_options(those_of(0), live);
  shows_forces_ = section_header("Forces");
  if (shows_forces_) draw_forces(those_of(2), snapshot, live);
  if (section_header("Contact")) {
    draw_options(those_of(4), live);
    draw_body_contacts(those_of(5), live);
  }
  const bool is_new = std::exchange(shown_collider_, selected) != selected && !selected.empty();
  scrolls_to_collider_ = is_new ? 2 : std::max(scrolls_to_collider_ - 1, 0);
  if (section_header("Colliders", true, is_new)) draw_colliders(those_of(3), snapshot, live, selected);
}

void ParameterPanel::draw_forces(std::span<const Slider> sliders, const Snapshot& snapshot, LiveScene& live) {
  for (auto begin = sliders.begin(); begin != sliders.end();) {
    const auto end = find_end_of_owner(begin, sliders.end());
    ImGui::PushID(begin->key.c_str());
    if (draw_switch(begin->parameter.name, snapshot, live)) ImGui::SameLine();
    ImGui::TextDisabled("%s", begin->heading.c_str());
    draw_options({begin, end}, live);
    ImGui::PopID();
    begin = end;
  }
  for (const auto& [name, off] : *snapshot.switched_off) {
    if (off.body.empty() && !off.is_collider) draw_switched_off(name, off, snapshot, live);
  }
  draw_adder("forces", snapshot, live);
}

/// A menu of what can be added to a list of the scene.
void ParameterPanel::draw_adder(std::string_view list, const Snapshot& snapshot, LiveScene& live) {
  if (!snapshot.has_text) return;
  const std::string key = "add " + std::string(list);
  const bool is_force = list == "forces";
  ImGui::SetNextItemWidth(-1);
  const bool is_open = ImGui::BeginCombo(("##" + key).c_str(), is_force ? "Add a force ..." : "Add a collider ...",
                                         ImGuiComboFlags_NoArrowButton);
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_[key] = {low.x, low.y, high.x, high.y};
  if (!is_open) return;
  const auto draw_item = [&](const std::string& label, int flags) {
    const bool is_chosen = ImGui::Selectable(label.c_str(), false, flags);
    const ImVec2 top = ImGui::GetItemRectMin(), end = ImGui::GetItemRectMax();
    places_["add " + label] = {top.x, top.y, end.x, end.y};
    return is_chosen;
  };
  const auto offer = [&](std::string_view type, const std::string& body) {
    const std::string label = label_of(std::string(type)) + (body.empty() ? "" : " in " + body);
    if (!draw_item(label, 0)) return;
    live.post([type = std::string(type), body](CommandContext& context) { context.session.add(type, body); },
              LiveScene::Kind::changes);
  };
  for (const AddableType& type : addable_types()) {
    if (type.list != list) continue;
    if (!type.is_of_body) {
      offer(type.name, {});
      continue;
    }
    bool is_offered = false;
    for (std::size_t i = 0; i < snapshot.body_names->size(); ++i) {
      if (snapshot.is_figure.at(i) != 0 || snapshot.is_closed->at(i) == 0) continue;
      offer(type.name, (*snapshot.body_names)[i]);
      is_offered = true;
    }
    if (is_offered) continue;
    draw_item(label_of(std::string(type.name)) + ": no body is closed", ImGuiSelectableFlags_Disabled);
    explain("it needs a body whose surface has no border and encloses a volume");
  }
  ImGui::EndCombo();
}

/// A box to tick, where what has that name can be switched off; returns whether it can.
bool ParameterPanel::draw_switch(const std::string& name, const Snapshot& snapshot, LiveScene& live) {
  const auto found = snapshot.switches->find(name);
  if (found == snapshot.switches->end()) return false;
  const auto switched = switched_.find(name);
  bool is_on = switched == switched_.end() ? found->second : switched->second.on;
  ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {ImGui::GetStyle().FramePadding.y, ImGui::GetStyle().FramePadding.y});
  if (ImGui::Checkbox("##switch", &is_on)) {
    const auto command = [name, is_on](CommandContext& context) { context.session.switch_on(name, is_on); };
    switched_[name] = {is_on, live.post(command, LiveScene::Kind::changes)};
  }
  ImGui::PopStyleVar();
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_["switch:" + name] = {low.x, low.y, high.x, high.y};
  explain("on or off; back on, it is as the scene begins with it");
  return true;
}

void ParameterPanel::draw_switched_off(const std::string& name, const SwitchedOff& off, const Snapshot& snapshot,
                                       LiveScene& live) {
  ImGui::PushID(name.c_str());
  if (draw_switch(name, snapshot, live)) ImGui::SameLine();
  ImGui::AlignTextToFramePadding();
  ImGui::TextDisabled("%s, off", short_name(name, off.body).c_str());
  explain(off.type);
  ImGui::PopID();
}

/// Of each collider what it feels, and its options, which fold.
void ParameterPanel::draw_colliders(std::span<const Slider> sliders, const Snapshot& snapshot, LiveScene& live,
                                    const std::string& selected) {
  end_lost_drag(live);
  for (const auto& [id, wrench] : snapshot.wrenches) {
    const pliant::ParameterOwner owner = id;
    const auto is_own = [&](const Slider& slider) { return slider.parameter.handle.owner == owner; };
    const auto begin = std::ranges::find_if(sliders, is_own);
    if (begin == sliders.end()) continue;
    const auto movable = snapshot.movable.find(id);
    const bool is_selected = movable != snapshot.movable.end() && movable->second.name == selected;
    const float top = ImGui::GetCursorScreenPos().y;
    ImGui::PushID(begin->key.c_str());
    if (draw_switch(begin->parameter.name, snapshot, live)) ImGui::SameLine();
    if (draw_collider_name(begin->heading, snapshot, movable == snapshot.movable.end() ? "" : movable->second.name,
                           is_selected)) {
      if (is_selected) draw_pose(movable->second, live);
      draw_feeling("force", wrench.force, "N", "what bodies pressed and rubbed it with in the last step");
      draw_feeling("torque", wrench.torque, "N·m", "the same about its position");
      for (auto slider = begin; slider != sliders.end() && is_own(*slider); ++slider) {
        draw_row(*slider, label_of(slider->parameter.handle.option), help_of(slider->parameter), live);
      }
    }
    ImGui::PopID();
    if (is_selected && scrolls_to_collider_ > 0) scroll_to_all_from(top);
  }
  for (const auto& [name, off] : *snapshot.switched_off) {
    if (off.is_collider) draw_switched_off(name, off, snapshot, live);
  }
  draw_adder("colliders", snapshot, live);
}

/// The line that unfolds the others, by its arrow or a double click; a click on the name selects a collider that has
/// one, as a click in the picture does.
bool ParameterPanel::draw_collider_name(const std::string& heading, const Snapshot& snapshot, const std::string& name,
                                        bool is_selected) {
  if (is_selected && scrolls_to_collider_ > 0) {
    ImGui::SetNextItemOpen(true);
  } else {
    ImGui::SetNextItemOpen(snapshot.wrenches.size() <= few_colliders, ImGuiCond_Once);
  }
  int flags = ImGuiTreeNodeFlags_NoTreePushOnOpen | ImGuiTreeNodeFlags_SpanAvailWidth;
  if (is_selected) flags |= ImGuiTreeNodeFlags_Selected;
  if (!name.empty()) flags |= ImGuiTreeNodeFlags_OpenOnArrow | ImGuiTreeNodeFlags_OpenOnDoubleClick;
  const ImGuiCol color = is_selected ? ImGuiCol_TextSelectedBg : ImGuiCol_Header;
  ImGui::PushStyleColor(ImGuiCol_Header, ImGui::GetStyleColorVec4(color));
  const bool is_open = ImGui::TreeNodeEx("##options", flags, "%s", heading.c_str());
  ImGui::PopStyleColor();
  if (name.empty()) return is_open;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_["collider:" + name] = {low.x, low.y, high.x, high.y};
  if (ImGui::IsItemClicked() && !ImGui::IsItemToggledOpen()) clicked_collider_ = name;
  explain("a click selects it, as in the picture: a handle moves and turns it");
  return is_open;
}

/// Of each body how it touches, which folds.
void ParameterPanel::draw_body_contacts(std::span<const Slider> sliders, LiveScene& live) {
  for (auto begin = sliders.begin(); begin != sliders.end();) {
    const auto end = find_end_of_owner(begin, sliders.end());
    ImGui::PushID(begin->key.c_str());
    if (ImGui::TreeNodeEx("##options", ImGuiTreeNodeFlags_NoTreePushOnOpen, "%s", begin->parameter.name.c_str())) {
      for (const Slider& slider : std::span(begin, end)) {
        draw_row(slider, label_of(slider.parameter.handle.option), help_of(slider.parameter), live);
      }
    }
    ImGui::PopID();
    begin = end;
  }
}

void ParameterPanel::draw_group(std::span<const Slider> group, const Snapshot& snapshot, LiveScene& live) {
  ImGui::PushID(group.front().key.c_str());
  const auto is_stiffness = [](const Slider& slider) { return slider.parameter.handle.option == "stiffness"; };
  const auto stiffness = std::ranges::find_if(group, is_stiffness);
  const Slider& first = stiffness == group.end() ? group.front() : *stiffness;
  const std::string help = first.heading + ": " + label_of(first.parameter.handle.option) + ", ";
  bool is_open = false;
  if (group.size() > 1) {
    // The mouse counts as on the arrow so far beside it, where the box of the switch is.
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0, ImGui::GetStyle().ItemSpacing.y});
    is_open = ImGui::TreeNodeEx("##more", ImGuiTreeNodeFlags_FramePadding);
    ImGui::PopStyleVar();
    explain("all options of " + first.heading);
    if (is_open) ImGui::TreePop();  // the row itself is not moved in
    ImGui::SameLine(0, ImGui::GetStyle().FramePadding.x);
  }
  if (draw_switch(first.parameter.name, snapshot, live)) ImGui::SameLine(0, ImGui::GetStyle().ItemInnerSpacing.x);
  draw_row(first, short_name(first.parameter.name, first.body), help + help_of(first.parameter), live);
  if (!is_open) return ImGui::PopID();
  ImGui::Indent();
  for (const Slider& slider : group) {
    if (&slider == &first) continue;
    draw_row(slider, label_of(slider.parameter.handle.option), help_of(slider.parameter), live);
  }
  ImGui::Unindent();
  ImGui::PopID();
}

/// A row for each option; of the solver the common ones, and the others unfold.
void ParameterPanel::draw_options(std::span<const Slider> options, LiveScene& live) {
  const bool is_solver = !options.empty() && is_of_settings(options.front());
  const auto draw_those = [&](bool common) {
    for (const Slider& slider : options) {
      if (is_common(slider) != common) continue;
      draw_row(slider, label_of(slider.parameter.handle.option), help_of(slider.parameter), live);
    }
  };
  draw_those(true);
  if (is_solver && ImGui::TreeNode("more")) {
    draw_those(false);
    ImGui::TreePop();
  }
}

void ParameterPanel::draw_row(const Slider& slider, const std::string& label, const std::string& help,
                              LiveScene& live) {
  const Parameter& parameter = slider.parameter;
  const std::string& key = slider.key;
  const auto found = edited_.find(key);
  pliant::Vec3 value = found == edited_.end() ? parameter.value : found->second.value;
  row_label(parameter.kind == ParameterKind::vector ? label_with_unit(label, parameter.unit) : label, help);
  const std::string id = "##" + parameter.handle.option;
  bool has_changed = false;
  NumberPlaces places;
  switch (parameter.kind) {
    case ParameterKind::real:
    case ParameterKind::integer:
      has_changed = number_slider(id.c_str(), value[0], slider_of(slider), &places);
      break;
    case ParameterKind::choice: {
      int chosen = static_cast<int>(value[0]);
      std::string items;
      for (const std::string& choice : parameter.choices) items += label_of(choice) + '\0';
      has_changed = ImGui::Combo(id.c_str(), &chosen, items.c_str());
      value[0] = chosen;
      break;
    }
    case ParameterKind::flag: {
      bool flag = value[0] != 0;
      has_changed = ImGui::Checkbox(id.c_str(), &flag);
      value[0] = flag ? 1 : 0;
      break;
    }
    case ParameterKind::vector:
      has_changed = vector_fields(id.c_str(), value.data(), 0.05F, parameter.unit);
      break;
  }
  const bool is_number = parameter.kind == ParameterKind::real || parameter.kind == ParameterKind::integer;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_[key] = is_number ? places.slider : std::array{low.x, low.y, high.x, high.y};
  if (is_number) places_["number:" + key] = places.number;
  post_change(key, parameter, value, has_changed, live);
}

/// What is on the way to a number, as the 0 of 0.02, is not sent, unless it is left like that.
void ParameterPanel::post_change(const std::string& key, const Parameter& parameter, pliant::Vec3 value,
                                 bool has_changed, LiveScene& live) {
  const bool is_active = ImGui::IsItemActive();
  if (ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape))) withheld_.reset();
  const bool goes_on = held_ == key;
  if (goes_on && !is_active) held_.clear();
  if (has_changed && is_active && !is_allowed(parameter, value)) {
    withheld_ = {key, value};
    return;
  }
  if (has_changed) {
    withheld_.reset();
  } else if (ImGui::IsItemDeactivated() && withheld_ && withheld_->first == key) {
    value = std::exchange(withheld_, {})->second;
  } else {
    return;
  }
  if (!value.allFinite()) return;
  // A drag sets what can be read and a digit more; what is typed is meant as it is.
  const bool has_digits = parameter.kind == ParameterKind::real || parameter.kind == ParameterKind::vector;
  if (has_digits && ImGui::IsMouseDown(ImGuiMouseButton_Left)) {
    if (const pliant::Vec3 shown = with_digits(value, 5); is_allowed(parameter, shown)) value = shown;
  }
  const std::uint64_t command =
      live.post([key, value, goes_on](CommandContext& context) { context.session.set(key, value, goes_on); },
                LiveScene::Kind::changes);
  if (is_active) held_ = key;
  edited_[key] = {value, command};
}

/// How far it goes is decided when it is first seen.
NumberSlider ParameterPanel::slider_of(const Slider& slider) {
  const Parameter& parameter = slider.parameter;
  NumberSlider shown{.unit = parameter.unit, .most = parameter.range.max};
  shown.least = parameter.range.min + (parameter.range.excludes_min ? 1e-9 : 0);
  if (parameter.kind == ParameterKind::integer) {
    shown.low = parameter.range.min;
    shown.high = std::min<double>(parameter.range.max, 100);
    shown.is_logarithmic = shown.is_whole = true;
    return shown;
  }
  const auto found = ranges_.try_emplace(slider.key, range_of(parameter)).first;
  shown.low = found->second[0];
  shown.high = found->second[1];
  shown.is_logarithmic = shown.low > 0 && shown.high > 100 * shown.low;
  return shown;
}

}  // namespace pliant_viewer
