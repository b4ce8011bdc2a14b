// The controls of a scene that is simulated: how fast it goes, what takes the time, and its parameters.
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/live_stage.h"

namespace pliant_viewer {
namespace {

/// "1.23 ms", with as many digits as are of use.
std::string milliseconds(double seconds) {
  const double ms = 1e3 * seconds;
  return fmt::format("{:.{}f} ms", ms, ms < 1 ? 3 : ms < 10 ? 2 : ms < 100 ? 1 : 0);
}

void row(const char* label, const std::string& value, const char* help = "") {
  row_label(label, help);
  ImGui::TextUnformatted(value.c_str());
}

std::string pace_text(const Snapshot& snapshot) {
  if (!snapshot.is_playing) return "paused";
  if (!(snapshot.pulse.speed > 0)) return "...";
  const std::string speed = fmt::format("{:.2f} × real time", snapshot.pulse.speed);
  return snapshot.is_behind ? speed + ", cannot keep up" : speed;
}

}  // namespace

void LiveStage::draw_panel(const PanelStyle& style) {
  draw_pace(style);
  ImGui::Separator();
  ImGui::Spacing();
  parameters_.draw(*snapshot_, scene_, style);
}

void LiveStage::draw_pace(const PanelStyle&) {
  const Pulse::Means& pulse = snapshot_->pulse;
  const double time = snapshot_->frame.time;
  row("time", fmt::format("{:.2f} s, step {}", time, snapshot_->step));
  row("pace", pace_text(*snapshot_), "simulated seconds in a second; at most four steps behind the clock");
  row("steps", snapshot_->is_playing && pulse.rate > 0 ? fmt::format("{:.0f} a second", pulse.rate) : "-");
  row("a step", pulse.total > 0 ? milliseconds(pulse.total) : "-", "mean of the last second");
  if (pulse.total > 0) {
    ImGui::PushStyleColor(ImGuiCol_Text, ImGui::GetStyleColorVec4(ImGuiCol_TextDisabled));
    row("  local", milliseconds(pulse.local), "projections of the constraints, and collecting them");
    row("  global", milliseconds(pulse.global), "triangular solves");
    if (pulse.factor > 0) row("  factor", milliseconds(pulse.factor), "after changes of stiffness, pins, time step");
    ImGui::PopStyleColor();
  }
  row_label("speed", "simulated seconds in a second, where the machine can; Ctrl + click: type a number");
  double speed = speed_;
  constexpr double slowest = 0.01, fastest = 10;
  ImGui::BeginDisabled(is_unlimited_);
  bool has_changed = ImGui::SliderScalar("##speed", ImGuiDataType_Double, &speed, &slowest, &fastest, "%.3g ×",
                                         ImGuiSliderFlags_Logarithmic | ImGuiSliderFlags_NoRoundToFormat);
  ImGui::EndDisabled();
  row_label("", "");
  has_changed |= ImGui::Checkbox("as fast as it can", &is_unlimited_);
  if (!has_changed || !(speed > 0)) return;
  speed_ = speed;
  const double wanted = is_unlimited_ ? Pacer::unlimited : speed_;
  scene_.post([wanted](Workshop& workshop) { workshop.pacer.set_speed(wanted); });
}

}  // namespace pliant_viewer
