// The panels of the window.
#include <algorithm>

#include <fmt/format.h>
#include <imgui.h>

#include "viewer/panels/appearance_panel.h"
#include "viewer/panels/help_panel.h"
#include "viewer/panels/number_slider.h"
#include "viewer/panels/time_bar.h"
#include "viewer/panels/window_panel.h"
#include "viewer/plot_files.h"
#include "viewer/viewer.h"

namespace pliant_viewer {
namespace {

constexpr ImGuiWindowFlags fixed = ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_NoResize |
                                   ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_AlwaysAutoResize |
                                   ImGuiWindowFlags_NoNav;

}  // namespace

void Viewer::draw_panels() {
  if (panel_width() > 0) draw_main_panel();
  if (auto* playback = dynamic_cast<Playback*>(&source_)) {
    draw_time_bar(*playback, screen_.size, ui_.style());
  }
  draw_plots();
  const bool has_tour = source_.live() != nullptr;
  if (const auto chosen = scene_panel_.draw(screen_.size, ui_.style(), has_tour)) open(*chosen);
  if (scene_panel_.take_wish_for_tour()) tour_.begin();
  draw_tour();
  if (is_help_open_) is_help_open_ = draw_help(source_.live() != nullptr, screen_.size, ui_.style());
  draw_message();
}

/// What there is to try; behind the list of scenes and the help it waits.
void Viewer::draw_tour() {
  const LiveScene* live = source_.live();
  if (live == nullptr) return tour_.end();
  if (scene_panel_.is_open || is_help_open_) return;
  const Snapshot& shown = live->shown();
  tour_.watch({.is_busy = interaction_.is_busy(),
               .is_pulling = interaction_.pull().has_value(),
               .is_handling = handles_.pins.is_holding(),
               .edits = shown.edits,
               .undone_next = shown.undone_next,
               .redone_next = shown.redone_next,
               .camera = camera_});
  tour_.draw(screen_.size, ui_.style());
}

void Viewer::draw_main_panel() {
  const Vec2f size = window_.size();
  ImGui::SetNextWindowPos({screen_.size.x(), 0});
  ImGui::SetNextWindowSize({size.x() - screen_.size.x(), size.y()});
  ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 0);
  ImGui::Begin("panel", nullptr, (fixed & ~ImGuiWindowFlags_AlwaysAutoResize) | ImGuiWindowFlags_NoBackground);
  ImGui::PopStyleVar();
  const float third = (ImGui::GetContentRegionAvail().x - 2 * ImGui::GetStyle().ItemSpacing.x) / 3;
  if (ImGui::Button(source_.is_playing() ? "Pause" : "Play", {third, 0})) source_.play(!source_.is_playing());
  explain("Space");
  ImGui::SameLine();
  if (ImGui::Button("Step", {third, 0})) source_.step(1);
  explain("S");
  ImGui::SameLine();
  if (ImGui::Button("Restart", {third, 0})) source_.restart(true);
  explain(source_.live() != nullptr ? "R: from the start, with what was changed here\n"
                                      "Shift + R: without what was changed"
                                    : "R: to the first frame");
  draw_edit_buttons(third);
  draw_file_buttons(third);
  ImGui::Spacing();
  if (LiveScene* live = source_.live()) {
    row_label("pull", "+ and −: stiffness of the spring by which the mouse pulls");
    double stiffness = interaction_.stiffness();
    const double low = live->suggested_pull() / 1e3, high = live->suggested_pull() * 1e6;
    if (number_slider("##pull", stiffness,
                      {.low = low, .high = high, .unit = "N/m", .is_logarithmic = true, .least = low}) &&
        stiffness > 0) {
      interaction_.set_stiffness(stiffness, *live);
    }
  }
  draw_selection_rows(third);
  draw_brush_rows(third);
  source_.draw_panel(handles_.collider.selected());
  if (const std::string clicked = source_.take_clicked_collider(); !clicked.empty()) {
    handles_.collider.select(clicked == handles_.collider.selected() ? "" : clicked);
    draws_left_ = std::max(draws_left_, 3);
  }
  draw_last_sections(third);
  ImGui::End();
}

/// What a run has as well: the picture, films, the window, and buttons of the given width.
void Viewer::draw_last_sections(float width) {
  if (section_header("Picture") &&
      draw_appearance_panel(appearance_, samples_, quality_.choose(appearance_.quality), source_))
    change_color();
  if (section_header("Film", false)) film_panel_.draw(film_under_way());
  if (section_header("Window") && draw_window_panel(settings_, ui_.scale(), button_places_)) {
    write_window_settings(settings_file_, settings_);
  }
  ImGui::Separator();
  ImGui::Spacing();
  if (ImGui::Button("Help", {width, 0})) is_help_open_ = !is_help_open_;
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  button_places_["Help"] = {low.x, low.y, high.x, high.y};
  explain("H: all keys");
  ImGui::SameLine();
  if (ImGui::Button("Plots", {width, 0})) plots_panel_.is_open = !plots_panel_.is_open;
  explain("G: energies, speed, residual, contacts and the time of a step, over time");
  if (source_.live() != nullptr) {
    ImGui::SameLine();
    if (ImGui::Button("Tour", {width, 0})) tour_.begin();
    explain("five things to try in the window");
  }
  ImGui::TextDisabled("%.0f pictures a second", frames_.means(Clock::now()).rate);
  explain("drawn by " + window_.driver());
}

void Viewer::draw_file_buttons(float width) {
  if (film_panel_.draw_button(film_under_way(), width)) toggle_film();
  ImGui::SameLine();
  if (ImGui::Button("Picture##button", {width, 0})) save_picture();
  explain("P: saves the picture as a PNG file in the current folder, without this panel");
  ImGui::SameLine();
  ImGui::BeginDisabled(open_ == nullptr);
  if (ImGui::Button("Open", {width, 0})) scene_panel_.is_open = true;
  ImGui::EndDisabled();
  explain("Ctrl + O: a list of scenes; or drop a scene, a mesh, a session or a run onto the window");
}

void Viewer::draw_plots() {
  const pliant_plot::MeasuredRun* run = source_.measured();
  if (run == nullptr) {
    if (plots_panel_.is_open) say("this run has no measurements.csv, of which plots are made");
    plots_panel_.is_open = false;
    return;
  }
  std::optional<double> now;
  if (source_.live() == nullptr) now = source_.frame().time;
  save_plots(plots_panel_.draw(*run, now, screen_.size, ui_.style()), *run);
  source_.measure(plots_panel_.is_open ? plots_panel_.needs(*run) : Measuring{});
}

void Viewer::save_plots(PlotsPanel::Wish wish, const pliant_plot::MeasuredRun& run) {
  try {
    if (wish == PlotsPanel::Wish::numbers) say("saved " + saved_names({save_measured(run, picture_folder_)}));
    if (wish == PlotsPanel::Wish::drawings) {
      const auto files = pliant_viewer::save_plots(plots_panel_.plots(run), run.name, picture_folder_);
      say(files.empty() ? "there is no plot to save" : "saved " + saved_names(files));
    }
  } catch (const std::exception& error) {
    say(error.what());
  }
}

/// Shows the latest message or error at the upper edge.
void Viewer::draw_message() {
  std::string text = message_;
  if (const LiveScene* live = source_.live(); text.empty() && live != nullptr) {
    const double age = live->step_age().count();
    text = age > 1 ? fmt::format("a step has taken {:.0f} s so far; fewer iterations end it", age) : live->shown().note;
  }
  if (text.empty()) return;
  const float unit = ui_.style().unit;
  ImGui::SetNextWindowPos({screen_.size.x() / 2, 16 * unit}, ImGuiCond_Always, {0.5F, 0});
  ImGui::Begin("message", nullptr, fixed | ImGuiWindowFlags_NoInputs | ImGuiWindowFlags_NoFocusOnAppearing);
  ImGui::PushTextWrapPos(0.8F * screen_.size.x());
  ImGui::TextUnformatted(text.c_str());
  ImGui::PopTextWrapPos();
  ImGui::End();
}

}  // namespace pliant_viewer
