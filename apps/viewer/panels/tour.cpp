#include "viewer/panels/tour.h"

#include <array>

#include <fmt/format.h>
#include <imgui.h>

namespace pliant_viewer {
namespace {

struct Stop {
  const char* title;
  const char* text;
};

constexpr std::array<Stop, Tour::step_count + 1> stops = {
    Stop{"Pull", "Drag a body with the left button: a spring pulls at it. Let it go again."},
    Stop{"Look around", "Drag beside the body to turn the camera, and turn the wheel to come nearer."},
    Stop{"Pin", "Click a body to pin it where it is. Drag the pin to move it, click it to let it go."},
    Stop{"Move many",
         "Hold Ctrl and drag a box around a part of a body, press N to pin it, then drag an arrow or a ring."},
    Stop{"Change", "Move a slider on the right, a stiffness say; then take it back with Ctrl + Z."},
    Stop{"That is all",
         "Space pauses, R starts over, Ctrl + S saves what you have built, Ctrl + O opens something else, and "
         "H shows all keys."}};

/// Whether that is what a change of pins is called.
bool is_of_pins(const std::string& edit) {
  return edit.starts_with("pin") || edit.starts_with("unpin") || edit.starts_with("move ");
}

}  // namespace

void Tour::begin() {
  *this = Tour();
  step_ = 0;
}

void Tour::skip() {
  if (!step_) return;
  step_ = *step_ + 1;
  at_first_.reset();
  has_pulled_ = has_handled_ = has_changed_ = false;
  if (*step_ > step_count) end();
}

bool Tour::is_done(const TourSight& now) const {
  switch (*step_) {
    case 0:
      return has_pulled_ && !now.is_pulling;
    case 1:
      return !now.is_busy && !now.camera.is_like(at_first_->camera);
    case 2:
      return now.edits > at_first_->edits && is_of_pins(now.undone_next);
    case 3:
      return has_handled_ && !now.is_handling;
    case 4:
      return has_changed_ && !now.redone_next.empty();
    default:
      return false;
  }
}

void Tour::watch(const TourSight& now) {
  if (!step_) return;
  if (!at_first_) at_first_ = now;
  has_pulled_ = has_pulled_ || now.is_pulling;
  has_handled_ = has_handled_ || now.is_handling;
  const bool is_value = !now.undone_next.empty() && !is_of_pins(now.undone_next);
  has_changed_ = has_changed_ || (now.edits > at_first_->edits && is_value);
  if (is_done(now)) skip();
}

void Tour::draw(const Vec2f& picture, const PanelStyle& style) {
  if (!step_) return;
  const Stop& stop = stops.at(static_cast<std::size_t>(*step_));
  const bool is_last = *step_ == step_count;
  const float width = std::min(picture.x() - 16 * style.unit, 520 * style.unit);
  ImGui::SetNextWindowPos({picture.x() / 2, picture.y() - 20 * style.unit}, ImGuiCond_Always, {0.5F, 1});
  ImGui::SetNextWindowSize({width, 0});
  ImGui::SetNextWindowBgAlpha(0.96F);
  ImGui::Begin("Tour", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::TextUnformatted(stop.title);
  if (!is_last) {
    ImGui::SameLine();
    ImGui::TextDisabled("%d of %d", *step_ + 1, step_count);
  }
  ImGui::PushTextWrapPos(0);
  ImGui::TextUnformatted(stop.text);
  ImGui::PopTextWrapPos();
  ImGui::Spacing();
  if (!is_last && ImGui::Button("Skip")) skip();
  if (!is_last) ImGui::SameLine();
  if (ImGui::Button(is_last ? "Close" : "End the tour")) end();
  ImGui::End();
}

}  // namespace pliant_viewer
