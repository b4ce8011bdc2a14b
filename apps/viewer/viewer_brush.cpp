// The brush in the window: which stiffness it paints, how much, how wide.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/panels/number_slider.h"
#include "viewer/viewer.h"

namespace pliant_viewer {
namespace {

/// "cloth: bend" for "cloth.bend".
std::string label_of(const PaintableGroup& each) {
  const bool has_body = each.group.starts_with(each.body + ".");
  return has_body ? each.body + ": " + each.group.substr(each.body.size() + 1) : each.group;
}

std::uint32_t body_number(const PaintableGroup& each, const Snapshot& snapshot) {
  return static_cast<std::uint32_t>(std::ranges::find(*snapshot.body_names, each.body) - snapshot.body_names->begin());
}

/// Its extent at rest or wherever it is now [m].
float size_of_body(std::uint32_t body, const Snapshot& snapshot) {
  pliant_render::Bounds bounds;
  const std::vector<Vec3f>& positions = snapshot.frame.content.positions;
  for (std::size_t v = 0; v < positions.size(); ++v) {
    if (snapshot.render_mesh->bodies[v] == body) bounds.add(positions[v]);
  }
  return bounds.is_empty() ? 1 : 2 * bounds.radius();
}

}  // namespace

/// A name that is empty puts the brush away.
void Viewer::choose_brush(const BrushTool::Subject& subject) {
  LiveScene* live = source_.live();
  brush_.finish(mouse_view());
  const bool is_other_body = !brush_.is_on() || brush_.subject.body != subject.body;
  brush_.subject = subject;
  live->post([group = subject.group](CommandContext& context) { context.painted = group; });
  if (!brush_.is_on()) return;
  if (is_other_body) brush_.radius = 0.08F * size_of_body(subject.body, live->shown());
  if (appearance_.color == pliant::ColorBy::none) return;
  appearance_.color = pliant::ColorBy::none;  // which would hide what is painted
  change_color();
}

void Viewer::draw_brush_rows(float width) {
  const LiveScene* live = source_.live();
  if (live == nullptr || render_mesh_ == nullptr) return;
  const std::vector<PaintableGroup>& groups = *live->shown().paintable;
  const auto chosen = std::ranges::find(groups, brush_.subject.group, &PaintableGroup::group);
  if (brush_.is_on() && chosen == groups.end()) choose_brush({});  // it has gone
  if (groups.empty()) return;
  const auto note_place = [this](const char* name) {
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    button_places_[name] = {low.x, low.y, high.x, high.y};
  };
  row_label("paint",
            "with a brush, where a stiffness is larger or smaller: blue is softer, orange stiffer\n"
            "a drag paints, with Shift it takes the paint off; Esc puts the brush away");
  if (ImGui::BeginCombo("##paint", brush_.is_on() && chosen != groups.end() ? label_of(*chosen).c_str() : "nothing")) {
    if (ImGui::Selectable("nothing", !brush_.is_on())) choose_brush({});
    note_place("paint nothing");
    for (const PaintableGroup& each : groups) {
      if (ImGui::Selectable((label_of(each) + "##" + each.group).c_str(), each.group == brush_.subject.group)) {
        choose_brush({each.group, body_number(each, live->shown())});
      }
      note_place(("paint " + each.group).c_str());
    }
    ImGui::EndCombo();
  } else {
    note_place("paint");
  }
  if (!brush_.is_on()) return;
  row_label("factor", "by which the stiffness is multiplied where the brush has gone");
  constexpr double softest = 0.01, stiffest = 100;
  double factor = brush_.factor;
  NumberPlaces places;
  if (number_slider("##factor", factor,
                    {.low = softest, .high = stiffest, .unit = "×", .is_logarithmic = true, .least = 1e-3}, &places)) {
    brush_.factor = std::clamp(factor, 1e-3, 1e3);
  }
  button_places_["factor"] = places.slider;
  row_label("size", "of the brush: its radius");
  const double size = size_of_body(brush_.subject.body, live->shown());
  const double least = size / 200, most = size / 2;
  double radius = brush_.radius;
  if (number_slider("##size", radius,
                    {.low = least, .high = most, .unit = "m", .is_logarithmic = true, .least = 1e-3 * size}, &places)) {
    brush_.radius = static_cast<float>(std::clamp(radius, 1e-3 * size, 10 * size));
  }
  button_places_["size"] = places.slider;
  if (ImGui::Button("Fill", {width, 0})) fill_with_brush(brush_.factor);
  note_place("Fill");
  explain("all of the body");
  ImGui::SameLine();
  if (ImGui::Button("Clean", {width, 0})) fill_with_brush(1);
  note_place("Clean");
  explain("take all paint off");
  ImGui::SameLine();
  if (ImGui::Button("Done", {width, 0})) choose_brush({});
  explain("Esc: put the brush away");
}

void Viewer::fill_with_brush(Real factor) {
  PaintDab all;
  all.factor = factor;
  for (std::size_t v = 0; v < render_mesh_->bodies.size(); ++v) {
    if (render_mesh_->bodies[v] == brush_.subject.body) all.vertices.push_back(static_cast<Index>(v));
  }
  all.shares.assign(all.vertices.size(), 1);
  post(mouse_view(), LiveScene::Kind::changes,
       [group = brush_.subject.group, all = std::move(all)](Session& session) { session.paint(group, all); });
}

}  // namespace pliant_viewer
