#include "viewer/panels/body_panel.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "render/body_looks.h"

namespace pliant_viewer {
namespace {

using pliant::BodyAppearance;
using pliant::Color;
using pliant::Finish;
using pliant::Mapping;
using pliant::Pattern;

constexpr std::size_t few_bodies = 3;  // that are unfolded at first

Color figure_tone() {
  const auto share = [](int i) { return static_cast<pliant::Real>(pliant_render::solid_tone[i]); };
  return {share(0), share(1), share(2)};
}

/// What a body has where nobody has chosen anything.
pliant::BodyTones usual_tones(std::size_t body, const Snapshot& snapshot, const pliant::ViewSettings& view) {
  const pliant_render::RenderMesh& mesh = *snapshot.render_mesh;
  if (snapshot.appearances->contains((*snapshot.body_names)[body])) return pliant_render::open_tones(body);
  if (snapshot.is_figure.at(body) != 0) return {figure_tone(), figure_tone()};
  const auto vertex = std::ranges::find(mesh.bodies, static_cast<std::uint32_t>(body)) - mesh.bodies.begin();
  const bool is_given = view.front.has_value() || view.back.has_value();
  const bool has_tone = !is_given && static_cast<std::size_t>(vertex) < mesh.tones.size();
  const pliant::BodyTones tones =
      pliant::body_tones.at(has_tone ? mesh.tones[static_cast<std::size_t>(vertex)] % pliant::body_tones.size() : 0);
  return {view.front.value_or(tones.front), view.back.value_or(tones.back)};
}

/// The newest that was measured [J].
std::optional<double> energy_of(const std::string& group, const pliant_plot::MeasuredRun& measured) {
  const std::vector<double>* column = measured.table.find("elastic_" + group);
  if (column == nullptr) return {};
  const auto found = std::find_if(column->rbegin(), column->rend(), [](double energy) { return !std::isnan(energy); });
  if (found == column->rend()) return {};
  return *found;
}

std::string energy_text(double energy) {
  return fmt::format("{:.3g} J", energy);
}

/// Where each group of a body begins in the list of all parameters.
std::vector<std::span<const Slider>> groups_of(const std::string& body, const std::vector<Slider>& sliders) {
  std::vector<std::span<const Slider>> groups;
  for (std::size_t i = 0; i < sliders.size();) {
    const auto& owner = sliders[i].parameter.handle.owner;
    std::size_t end = i + 1;
    while (end < sliders.size() && sliders[end].parameter.handle.owner == owner) ++end;
    if (std::holds_alternative<pliant::GroupId>(owner) && sliders[i].body == body) {
      groups.emplace_back(sliders.data() + i, end - i);
    }
    i = end;
  }
  return groups;
}

void draw_energy(const std::vector<std::span<const Slider>>& groups, const pliant_plot::MeasuredRun& measured) {
  double sum = 0;
  std::string parts;
  for (const std::span<const Slider>& group : groups) {
    const std::string& name = group.front().parameter.name;
    const auto energy = energy_of(name, measured);
    if (!energy) continue;
    sum += *energy;
    parts += fmt::format("\n{}: {}", name, energy_text(*energy));
  }
  if (parts.empty()) return;
  row_label("energy", "elastic, of the constraints of this body, as last measured; Plots show it over time" + parts);
  ImGui::TextUnformatted(energy_text(sum).c_str());
}

bool draw_size(const char* label, const char* unit, pliant::Real& size) {
  constexpr double least = 1e-3, most = 10;
  double shown = size;
  if (!number_slider(label, shown,
                     {.low = least, .high = most, .unit = unit, .is_logarithmic = true, .least = 1e-6, .most = 1e6})) {
    return false;
  }
  size = std::clamp(shown, 1e-6, 1e6);
  return true;
}

bool draw_mapping(Mapping& mapping) {
  constexpr auto names = choice_names(Mapping{});
  bool has_changed = false;
  if (ImGui::BeginCombo("##mapping", names[static_cast<std::size_t>(mapping)].data())) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto choice = static_cast<Mapping>(i);
      if (!ImGui::Selectable(names[i].data(), choice == mapping) || choice == mapping) continue;
      mapping = choice;
      has_changed = true;
    }
    ImGui::EndCombo();
  }
  explain(
      "rest: by places on the body at rest; uv: by the texture coordinates of its mesh; automatic: uv where it has "
      "them");
  return has_changed;
}

/// None of a body without vertices. Vertices are numbered from body to body.
std::optional<std::size_t> first_vertex(const std::string& body, const Snapshot& snapshot) {
  const std::vector<std::uint32_t>& bodies = snapshot.render_mesh->bodies;
  const auto number = std::ranges::find(*snapshot.body_names, body) - snapshot.body_names->begin();
  const auto found = std::ranges::lower_bound(bodies, static_cast<std::uint32_t>(number));
  if (found == bodies.end() || *found != static_cast<std::uint32_t>(number)) return {};
  return static_cast<std::size_t>(found - bodies.begin());
}

/// Whether what is laid on a body now goes by texture coordinates.
bool goes_by_uv(const std::string& body, const Snapshot& snapshot) {
  const std::vector<pliant_render::VertexLook>& looks = snapshot.render_mesh->looks.vertices;
  const auto vertex = first_vertex(body, snapshot);
  return vertex && *vertex < looks.size() && looks[*vertex].by_uv > 0;
}

/// What the finish of a body is where it is left open.
Finish usual_finish(const std::string& body, const Snapshot& snapshot) {
  const pliant_render::RenderMesh& mesh = *snapshot.render_mesh;
  const auto vertex = first_vertex(body, snapshot);
  const bool is_sheet = vertex && mesh.is_sheet[*vertex] != 0;
  const auto row = std::ranges::find(*snapshot.materials, body, &BodyMaterial::name);
  return pliant_render::finish_of({}, row == snapshot.materials->end() ? "" : row->material, is_sheet);
}

}  // namespace

std::optional<std::array<float, 4>> BodyPanel::place_of(const std::string& key) const {
  const auto found = places_.find(key);
  if (found == places_.end()) return {};
  return found->second;
}

void BodyPanel::draw(const Snapshot& snapshot, LiveScene& live, ParameterPanel& parameters,
                     const pliant_plot::MeasuredRun& measured) {
  std::erase_if(chosen_, [&](const auto& entry) { return entry.second.command <= snapshot.commands; });
  places_.clear();
  materials_.begin(snapshot);
  const std::vector<std::string>& bodies = *snapshot.body_names;
  if (bodies.empty() || !section_header("Bodies")) return;
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    const std::string& body = bodies[i];
    ImGui::PushID(static_cast<int>(i));
    ImGui::SetNextItemOpen(bodies.size() <= few_bodies, ImGuiCond_Once);
    if (ImGui::TreeNodeEx("##body", ImGuiTreeNodeFlags_NoTreePushOnOpen, "%s", body.c_str())) {
      const auto row = std::ranges::find(*snapshot.materials, body, &BodyMaterial::name);
      if (row != snapshot.materials->end()) materials_.draw_row(*row, live);
      draw_appearance(body, usual_tones(i, snapshot, live.appearance()), snapshot, live);
      const auto groups = groups_of(body, *snapshot.sliders);
      draw_energy(groups, measured);
      for (const std::span<const Slider>& group : groups) parameters.draw_group(group, snapshot, live);
      for (const auto& [name, off] : *snapshot.switched_off) {
        if (off.body == body) parameters.draw_switched_off(name, off, snapshot, live);
      }
    }
    ImGui::PopID();
  }
}

/// Two swatches and a menu; a pattern and a texture have rows of their own. A back that was left open for a texture on
/// both sides stays open.
void BodyPanel::draw_appearance(const std::string& body, const pliant::BodyTones& tones, const Snapshot& snapshot,
                                LiveScene& live) {
  BodyAppearance appearance;
  const auto given = snapshot.appearances->find(body);
  const auto chosen = chosen_.find(body);
  if (given != snapshot.appearances->end()) appearance = given->second;
  if (chosen != chosen_.end()) appearance = chosen->second.appearance;
  Color front = appearance.front.value_or(tones.front);
  Color back = appearance.back.value_or(appearance.front ? front : tones.back);
  row_label("color", "of the front and the back, and a pattern on both");
  goes_on_ = is_held_ = false;
  bool has_changed = draw_color(body, "front", front, "the side that normals point from");
  ImGui::SameLine();
  const bool has_new_back = draw_color(body, "back", back, "the other side; a texture is then on the front alone");
  has_changed |= has_new_back;
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  const char* const unit = goes_by_uv(body, snapshot) ? "of uv" : "m";
  has_changed |= draw_pattern(body, unit, appearance);
  if (!appearance.texture.empty()) has_changed |= draw_texture(body, unit, appearance);
  has_changed |= draw_finish(body, usual_finish(body, snapshot), appearance);
  if (!is_held_ && held_.first == body) held_ = {};
  if (!has_changed) return;
  appearance.front = front;
  if (appearance.texture.empty() || appearance.back || has_new_back) appearance.back = back;
  const std::uint64_t command =
      live.post([body, appearance, goes_on = goes_on_](
                    CommandContext& context) { context.session.set_appearance(body, appearance, goes_on); },
                LiveScene::Kind::changes);
  chosen_[body] = {appearance, command};
}

bool BodyPanel::draw_color(const std::string& body, const char* what, Color& color, const char* help) {
  std::array<float, 3> shares = {static_cast<float>(color.red), static_cast<float>(color.green),
                                 static_cast<float>(color.blue)};
  ImGui::PushID(what);
  const bool has_changed = ImGui::ColorEdit3("##color", shares.data(), ImGuiColorEditFlags_NoInputs);
  note_widget(body, what, has_changed);
  explain(help);
  ImGui::PopID();
  const auto share = [&](std::size_t i) { return std::clamp(static_cast<pliant::Real>(shares[i]), 0.0, 1.0); };
  if (has_changed) color = {share(0), share(1), share(2)};
  return has_changed;
}

/// unit: of its size.
bool BodyPanel::draw_pattern(const std::string& body, const char* unit, BodyAppearance& appearance) {
  constexpr auto names = choice_names(Pattern{});
  bool has_changed = false;
  const auto shown = [&](std::size_t i) { return i == 0 ? "plain" : names[i].data(); };
  if (ImGui::BeginCombo("##pattern", shown(static_cast<std::size_t>(appearance.pattern)))) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto pattern = static_cast<Pattern>(i);
      if (!ImGui::Selectable(shown(i), pattern == appearance.pattern) || pattern == appearance.pattern) continue;
      appearance.pattern = pattern;
      has_changed = true;
    }
    ImGui::EndCombo();
  }
  note_widget(body, "pattern", has_changed);
  explain("to lay a picture on it, drop a PNG or JPEG file onto the body");
  if (appearance.pattern == Pattern::none || !appearance.texture.empty()) return has_changed;
  row_label("pattern", "the color of every second field or stripe, and the width of one");
  has_changed |= draw_color(body, "pattern_color", appearance.pattern_color, "of every second field or stripe");
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  const bool has_resized = draw_size("##size", unit, appearance.pattern_size);
  note_widget(body, "pattern_size", has_resized);
  return has_changed || has_resized;
}

/// A button that takes it off, how it lies, and its width.
bool BodyPanel::draw_texture(const std::string& body, const char* unit, BodyAppearance& appearance) {
  row_label("texture", appearance.texture);
  const bool is_taken_off = ImGui::Button("take off");
  note_widget(body, "no_texture", is_taken_off);
  ImGui::SameLine();
  ImGui::SetNextItemWidth(-1);
  const bool lies_otherwise = draw_mapping(appearance.mapping);
  note_widget(body, "mapping", lies_otherwise);
  row_label("", "");
  ImGui::SetNextItemWidth(-1);
  const bool has_resized = draw_size("##texture_size", unit, appearance.texture_size);
  explain(
      "its width: in meters on the body at rest, or by the texture coordinates of its mesh, as a share of the unit "
      "square");
  note_widget(body, "texture_size", has_resized);
  if (is_taken_off) appearance.texture.clear();
  return is_taken_off || lies_otherwise || has_resized;
}

bool BodyPanel::draw_finish(const std::string& body, Finish usual, BodyAppearance& appearance) {
  constexpr auto names = choice_names(Finish{});
  const auto shown = [&](std::size_t i) {
    return i == 0 ? fmt::format("usual ({})", names[static_cast<std::size_t>(usual)]) : std::string(names[i]);
  };
  bool has_changed = false;
  row_label("finish", "how its surface throws light back; usual: follows its material");
  ImGui::SetNextItemWidth(-1);
  if (ImGui::BeginCombo("##finish", shown(static_cast<std::size_t>(appearance.finish)).c_str())) {
    for (std::size_t i = 0; i < names.size(); ++i) {
      const auto finish = static_cast<Finish>(i);
      if (!ImGui::Selectable(shown(i).c_str(), finish == appearance.finish) || finish == appearance.finish) continue;
      appearance.finish = finish;
      has_changed = true;
    }
    ImGui::EndCombo();
  }
  note_widget(body, "finish", has_changed);
  return has_changed;
}

/// Of the widget drawn last: where it is, and whether its change goes on with the one before.
void BodyPanel::note_widget(const std::string& body, const std::string& what, bool has_changed) {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  places_[body + "." + what] = {low.x, low.y, high.x, high.y};
  if (!ImGui::IsItemActive()) return;
  is_held_ = true;
  if (has_changed) goes_on_ = std::exchange(held_, {body, what}) == std::pair(body, what);
}

}  // namespace pliant_viewer
