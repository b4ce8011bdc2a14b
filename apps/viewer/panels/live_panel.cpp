// The controls of a scene that is simulated: how fast it goes, what takes the time, and its parameters.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/live_source.h"
#include "viewer/panels/number_slider.h"

namespace pliant_viewer {
namespace {

/// In milliseconds, "1.23", with as many digits as are of use.
std::string number_of_milliseconds(double seconds) {
  const double ms = 1e3 * seconds;
  return fmt::format("{:.{}f}", ms, ms < 1 ? 3 : ms < 10 ? 2 : ms < 100 ? 1 : 0);
}

std::string milliseconds(double seconds) {
  return number_of_milliseconds(seconds) + " ms";
}

void row(const char* label, const std::string& value, const std::string& help = {}) {
  row_label(label, help);
  wrapped_text(value);
}

/// "1.00 × real time", and whether that is less than was asked for.
std::string pace_text(const Snapshot& snapshot) {
  if (!snapshot.is_playing) return "paused";
  if (!(snapshot.statistics.speed > 0)) return "...";
  const double speed = snapshot.statistics.speed;
  const std::string text = fmt::format("{:.{}f} × real time", speed, speed < 10 ? 2 : 0);
  return snapshot.is_behind ? text + ", all it can" : text;
}

std::string steps_text(const Snapshot& snapshot) {
  const FrameStatistics::Means& statistics = snapshot.statistics;
  if (!(statistics.total > 0)) return "-";
  if (!snapshot.is_playing) return milliseconds(statistics.total) + " each";
  return fmt::format("{:.{}f} a second, {} each", statistics.rate, statistics.rate < 10 ? 1 : 0,
                     milliseconds(statistics.total));
}

}  // namespace

void LiveSource::draw_panel(const std::string& selected_collider) {
  draw_pace();
  parameters_.begin(*snapshot_);
  bodies_.draw(*snapshot_, scene_, parameters_, history_.run());
  parameters_.draw(*snapshot_, scene_, selected_collider);
}

void LiveSource::draw_pace() {
  const FrameStatistics::Means& statistics = snapshot_->statistics;
  row("time", fmt::format("{:.2f} s, step {}", snapshot_->frame.time, snapshot_->step));
  if (snapshot_->is_replaying) {
    const ReplayReport& replayed = snapshot_->replayed;
    row("replay", fmt::format("step {} of {}", replayed.steps, replayed.wanted_steps),
        "a recorded session is done again; whatever you do takes over from it");
  }
  row("pace", pace_text(*snapshot_), "simulated seconds in a second; at most four steps behind the clock");
  row("steps", steps_text(*snapshot_), "means of the last second");
  const double rest = std::max(0.0, statistics.total - statistics.local - statistics.global - statistics.factor);
  const std::string help = fmt::format(
      "milliseconds of a step, by phase\nlocal: projections of the constraints, and collecting them\n"
      "global: triangular solves\nfactor, after changes of stiffness, pins, time step: {:.3g}\nforces, prediction and "
      "others: {:.3g}",
      1e3 * statistics.factor, 1e3 * rest);
  const std::string phases = statistics.total > 0
                                 ? fmt::format("local {}, global {}", number_of_milliseconds(statistics.local),
                                               milliseconds(statistics.global))
                                 : "-";
  row("phases", phases, help);
  row("contact", statistics.contact > 0 ? milliseconds(statistics.contact) + " of it" : "none",
      "what contact takes in these phases; without `surfaces`, below, bodies meet colliders alone, which is faster");
  row_label("speed", "simulated seconds in a second, where the machine can");
  double speed = speed_;
  constexpr double slowest = 0.01, fastest = 10;
  const ImGuiStyle& spaces = ImGui::GetStyle();
  ImGui::SetNextItemWidth(
      -(ImGui::GetFrameHeight() + spaces.ItemInnerSpacing.x + ImGui::CalcTextSize("max").x + spaces.ItemSpacing.x));
  ImGui::BeginDisabled(is_unlimited_);
  bool has_changed = number_slider(
      "##speed", speed, {.low = slowest, .high = fastest, .unit = "×", .is_logarithmic = true, .least = slowest});
  ImGui::EndDisabled();
  ImGui::SameLine();
  has_changed |= ImGui::Checkbox("max", &is_unlimited_);
  explain("as fast as the machine can");
  if (!has_changed || !(speed > 0)) return;
  set_speed(is_unlimited_ ? std::nullopt : std::optional(speed));
}

}  // namespace pliant_viewer
