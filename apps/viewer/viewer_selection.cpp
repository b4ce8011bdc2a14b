// What the window does with selected vertices, and what it draws of the hand: what it holds and would take hold of.
#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/gizmos.h"
#include "viewer/measure_selection.h"
#include "viewer/viewer.h"

namespace pliant_viewer {
namespace {

constexpr std::array shape_names = {"box", "lasso"};

std::vector<Index> indices(const std::vector<std::uint32_t>& vertices) {
  return {vertices.begin(), vertices.end()};
}

std::vector<std::uint32_t> without_figures(std::vector<std::uint32_t> vertices, const Snapshot& snapshot) {
  const std::vector<std::uint32_t>& bodies = snapshot.render_mesh->bodies;
  std::erase_if(vertices, [&](std::uint32_t vertex) { return snapshot.is_figure.at(bodies.at(vertex)) != 0; });
  return vertices;
}

std::size_t count_pinned(const std::vector<std::uint32_t>& selected, const Snapshot& snapshot) {
  return static_cast<std::size_t>(std::ranges::count_if(
      snapshot.pinned, [&](const PinnedVertex& pin) { return std::ranges::binary_search(selected, pin.vertex); }));
}

/// "24 vertices, 3 pinned", "65 of cloth"
std::string text_of(const std::vector<std::uint32_t>& selected, std::size_t pinned, const Snapshot& snapshot) {
  std::string count = fmt::format("{} vertices", selected.size());
  if (selected.size() == 1) {
    const VertexName name = name_of(selected[0], *snapshot.render_mesh);
    count = fmt::format("{} of {}", name.number, snapshot.body_names->at(name.body));
  }
  if (pinned == 0) return count;
  return pinned == selected.size() ? count + ", pinned" : fmt::format("{}, {} pinned", count, pinned);
}

/// Of the picture as it is shown.
void draw_measures(const std::vector<std::uint32_t>& selected, const Snapshot& snapshot) {
  const SelectionMeasures measures =
      measure_selection(selected, *snapshot.render_mesh, snapshot.frame.content.positions);
  if (measures.position) {
    row_label("place", "where it is");
    wrapped_text(fmt::format("{:.3f}, {:.3f}, {:.3f} m", measures.position->x(), measures.position->y(),
                             measures.position->z()));
  }
  if (measures.between) {
    row_label("distance", "from one to the other, straight, and along x, y and z");
    wrapped_text(fmt::format("{:.4f} m ({:.3f}, {:.3f}, {:.3f})", measures.between->norm(), measures.between->x(),
                             measures.between->y(), measures.between->z()));
  }
  if (measures.stretch) {
    row_label("stretch", selected.size() == 1 ? "of the edges at it: their lengths, by those at rest"
                                              : "of the edges between them: their lengths, by those at rest");
    const std::string least = fmt::format("{:.3f}", (*measures.stretch)[0]);
    const std::string most = fmt::format("{:.3f}", (*measures.stretch)[1]);
    wrapped_text(least == most ? least : least + " to " + most);
  }
}

}  // namespace

/// Pins what is selected; where all of it is pinned already, lets it go. Figures stay as they are.
void Viewer::toggle_pins() {
  const LiveScene* live = source_.live();
  if (live == nullptr) return;
  if (select_.selected().empty()) return say("nothing is selected: Ctrl + drag a box around vertices");
  const std::vector<std::uint32_t> selected = without_figures(select_.selected(), live->shown());
  if (selected.empty()) return say("what is selected is held by the scene itself");
  pin_selected(count_pinned(selected, live->shown()) < selected.size());
}

void Viewer::pin_selected(bool shall_pin) {
  const LiveScene* live = source_.live();
  if (live == nullptr) return;
  const std::vector<std::uint32_t> selected = without_figures(select_.selected(), live->shown());
  post(mouse_view(), LiveScene::Kind::changes, [shall_pin, vertices = indices(selected)](Session& session) {
    if (shall_pin) {
      session.pin(vertices);
    } else {
      session.unpin(vertices);
    }
  });
}

void Viewer::change_select_shape() {
  select_.draws_lasso = !select_.draws_lasso;
  say(select_.draws_lasso ? "Ctrl + drag draws a lasso" : "Ctrl + drag draws a box");
}

/// Before a picture: vertices may be gone, pins may have moved.
void Viewer::update_selection() {
  if (const std::string message = select_.take_message(); !message.empty()) say(message);
  if (drawn_selection_ != select_.version()) {
    renderer_->set_selection(select_.selected());
    drawn_selection_ = select_.version();
  }
  const LiveScene* live = source_.live();
  if (live == nullptr) return;
  handles_.pins.follow(select_.selected(), live->shown());
  handles_.collider.follow(live->shown(), appearance_.colliders);
}

void Viewer::draw_selection_rows(float width) {
  const LiveScene* live = source_.live();
  if (live == nullptr || render_mesh_ == nullptr) return;
  row_label("select",
            "Ctrl + drag: what is inside a box or a lasso (B)\n"
            "Ctrl + click: a vertex; twice: its border, or the rope\n"
            "with Shift they are taken out again");
  const float tick_width = ImGui::GetFrameHeight() + ImGui::GetStyle().ItemInnerSpacing.x +
                           ImGui::CalcTextSize("hidden too").x + ImGui::GetStyle().ItemSpacing.x;
  ImGui::SetNextItemWidth(-tick_width);
  int shape = select_.draws_lasso ? 1 : 0;
  if (ImGui::Combo("##select", &shape, shape_names.data(), static_cast<int>(shape_names.size()))) {
    select_.draws_lasso = shape == 1;
  }
  ImGui::SameLine();
  ImGui::Checkbox("hidden too", &select_.sees_through);
  explain("boxes and lassos also select what is behind a surface or a collider");
  const std::vector<std::uint32_t>& selected = select_.selected();
  if (selected.empty()) return;
  const std::size_t pinned = count_pinned(selected, live->shown());
  row_label("selected", "arrows and rings move and turn what is pinned of it");
  wrapped_text(text_of(selected, pinned, live->shown()));
  draw_measures(selected, live->shown());
  const auto button = [&](const char* label, bool is_enabled, const char* help) {
    ImGui::BeginDisabled(!is_enabled);
    const bool is_pressed = ImGui::Button(label, {width, 0});
    ImGui::EndDisabled();
    const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
    button_places_[label] = {low.x, low.y, high.x, high.y};
    explain(help);
    return is_pressed;
  };
  if (button("Pin", pinned < without_figures(selected, live->shown()).size(),
             "N: hold these vertices where they are, to be moved together")) {
    pin_selected(true);
  }
  ImGui::SameLine();
  if (button("Unpin", pinned > 0, "N: let go of what is pinned of them")) pin_selected(false);
  ImGui::SameLine();
  if (button("Grow", true, "select the vertices beside them, too")) select_.grow(*render_mesh_);
  if (button("Copy", true, "their numbers, as a scene file has them behind \"on\"; of several bodies a line each")) {
    ImGui::SetClipboardText(scene_text_of(selected, *live->shown().render_mesh, *live->shown().body_names).c_str());
    say(selected.size() == 1 ? "copied its number" : fmt::format("copied {} numbers", selected.size()));
  }
  ImGui::SameLine();
  if (button("Push", live->shown().has_text,
             "a test force on them, which holds up the weight of their body; below, under Forces, it is changed")) {
    post(mouse_view(), LiveScene::Kind::changes,
         [vertices = indices(selected)](Session& session) { session.push(vertices); });
  }
  ImGui::SameLine();
  if (button("Clear", true, "Esc: select nothing")) select_.clear();
}

/// What the mouse holds or would grab, and pins that are about to change; saved pictures are without.
void Viewer::draw_hand(const pliant_render::AnnotationCanvas& canvas) {
  lit_collider_.reset();
  LiveScene* live = source_.live();
  if (live == nullptr) return;
  const std::vector<Vec3f>& positions = source_.frame().content.positions;
  const float unit = ui_.style().unit;
  if (const auto held = interaction_.grabbed_pin()) draw_ring(screen_, held->target, unit, canvas.list);
  if (const auto goal = interaction_.collider_goal()) draw_ring(screen_, *goal, unit, canvas.list);
  for (const std::uint32_t vertex : interaction_.pending(live->shown())) {
    draw_ring(screen_, positions[vertex], unit, canvas.list);
  }
  draw_outline(select_.outline(), unit, canvas.list);
  const MouseInteraction::View view = mouse_view();
  const Vec2f mouse = ui_.mouse();
  const bool is_in_picture = (mouse.array() >= 0).all() && mouse.x() <= screen_.size.x() && !ui_.has_panel_at(mouse);
  const bool is_busy = interaction_.is_busy() || handles_.is_busy() || select_.is_busy() || brush_.is_busy();
  if (const auto point = is_in_picture ? brush_.point_at(mouse, view) : std::nullopt; point && !handles_.is_busy()) {
    brush_.draw(*point, view, canvas.list);
  }
  const bool is_free = is_in_picture && !is_busy;
  const bool is_at_handle = handles_.draw(view, is_free ? std::optional(mouse) : std::nullopt, canvas);
  if (is_at_handle) return Ui::show_hand();
  if (!is_free || brush_.point_at(mouse, view)) return;
  const MouseInteraction::PickTarget under = MouseInteraction::pick(mouse, view);
  if (under.pin) {
    draw_ring(screen_, positions[*under.pin], unit, canvas.list);
  } else if (under.point) {
    draw_grip(screen_, positions[under.point->nearest_vertex(positions)], unit, canvas.list);
  } else if (under.collider) {
    lit_collider_ = under.collider->number;
  }
  if (under.pin || under.point || under.collider) Ui::show_hand();
}

}  // namespace pliant_viewer
