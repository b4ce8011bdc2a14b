#include "viewer/panels/plots_panel.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <imgui.h>

#include "pliant_io/recorder/measurements.h"

namespace pliant_viewer {
namespace {

using pliant_plot::Figure;
using pliant_plot::MeasuredRun;
using pliant_report::Plot;

/// Times of the first row and of the last one.
TimeRange known_times(const MeasuredRun& run) {
  const std::vector<double>* times = run.table.find("time");
  if (times == nullptr || times->empty()) return {};
  return {times->front(), times->back()};
}

Rect last_item() {
  const ImVec2 low = ImGui::GetItemRectMin(), high = ImGui::GetItemRectMax();
  return {low.x, low.y, high.x, high.y};
}

/// Whatever is `width` wide follows on the same line where it fits.
void follow_on(float width) {
  ImGui::SameLine();
  if (ImGui::GetContentRegionAvail().x < width) ImGui::NewLine();
}

float button_width(const char* label) {
  return ImGui::CalcTextSize(label).x + 2 * ImGui::GetStyle().FramePadding.x;
}

float combo_width(const char* longest) {
  return button_width(longest) + ImGui::GetFrameHeight();
}

}  // namespace

TimeRange PlotsPanel::shown(const MeasuredRun& run) const {
  return times_.range(known_times(run));
}

std::optional<Rect> PlotsPanel::place_of(const std::string& what) const {
  const auto found = places_.find(what);
  if (found == places_.end()) return {};
  return found->second;
}

Measuring PlotsPanel::needs(const MeasuredRun& run) const {
  Measuring needs;
  for (const Figure& figure : pliant_plot::usual_figures(run.table.names)) {
    if (!chosen_.contains(figure.title)) continue;
    for (const std::string& column : figure.columns) {
      needs.energies |= pliant::takes_local_step(column);
      needs.past_limits |= column == "past_limits";
    }
  }
  return needs;
}

pliant_plot::PlotChoice PlotsPanel::choice(const TimeRange& range) const {
  pliant_plot::PlotChoice choice{.from = range.from, .to = range.to};
  if (axes_ != Axes::automatic) choice.is_logarithmic = axes_ == Axes::logarithmic;
  return choice;
}

std::vector<Plot> PlotsPanel::chosen_plots(const MeasuredRun& run, const pliant_plot::PlotChoice& choice) const {
  std::vector<Plot> plots;
  for (const Figure& figure : pliant_plot::usual_figures(run.table.names)) {
    if (!chosen_.contains(figure.title)) continue;
    for (Plot& plot : figure_plots(run, figure, choice)) plots.push_back(std::move(plot));
  }
  return plots;
}

std::vector<Plot> PlotsPanel::plots(const MeasuredRun& run) const {
  return chosen_plots(run, choice(shown(run)));
}

PlotsPanel::Wish PlotsPanel::draw(const MeasuredRun& run, std::optional<double> now, const Vec2f& picture,
                                  const PanelStyle& style) {
  places_.clear();
  if (!is_open) return Wish::none;
  const float margin = 12 * style.unit, bar = now ? 56 * style.unit : 0;
  const ImGuiCond when = picture == picture_ ? ImGuiCond_Appearing : ImGuiCond_Always;
  picture_ = picture;
  const float height = std::clamp(0.45F * picture.y(), 220 * style.unit, 480 * style.unit);
  ImGui::SetNextWindowPos({margin, picture.y() - margin - bar}, when, {0, 1});
  ImGui::SetNextWindowSize({picture.x() - 2 * margin, std::min(height, picture.y() - 2 * margin - bar)}, when);
  ImGui::SetNextWindowBgAlpha(0.97F);
  ImGui::SetNextWindowSizeConstraints({240 * style.unit, 160 * style.unit}, {1e5F, 1e5F});
  ImGui::Begin("plots", nullptr,
               ImGuiWindowFlags_NoTitleBar | ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_NoSavedSettings |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoScrollbar | ImGuiWindowFlags_NoScrollWithMouse);
  const Wish wish = draw_controls(run, style);
  ImGui::Spacing();
  ImGui::BeginChild("all plots", {0, 0}, false, ImGuiWindowFlags_NoScrollWithMouse | ImGuiWindowFlags_NoNav);
  draw_plots(run, now, style);
  ImGui::EndChild();
  ImGui::End();
  return wish;
}

PlotsPanel::Wish PlotsPanel::draw_controls(const MeasuredRun& run, const PanelStyle&) {
  Wish wish = Wish::none;
  draw_choice(run);
  draw_times();
  draw_axes();
  if (draw_button("Save CSV", "all that was measured since the start, as a table like measurements.csv")) {
    wish = Wish::numbers;
  }
  if (draw_button("Save SVG", "what is shown here, a drawing for each plot")) wish = Wish::drawings;
  if (draw_button("Close", "G")) is_open = false;
  return wish;
}

bool PlotsPanel::draw_button(const char* label, const char* help) {
  follow_on(button_width(label));
  const bool is_pressed = ImGui::Button(label);
  places_[label] = last_item();
  explain(help);
  return is_pressed;
}

void PlotsPanel::draw_choice(const MeasuredRun& run) {
  if (ImGui::Button("Curves")) ImGui::OpenPopup("curves");
  places_["Curves"] = last_item();
  explain("which plots are shown");
  if (!ImGui::BeginPopup("curves")) return;
  for (const Figure& figure : pliant_plot::usual_figures(run.table.names)) {
    bool is_chosen = chosen_.contains(figure.title);
    if (ImGui::Checkbox(figure.title.c_str(), &is_chosen)) {
      if (is_chosen) {
        chosen_.insert(figure.title);
      } else {
        chosen_.erase(figure.title);
      }
    }
    places_["choose " + figure.title] = last_item();
  }
  ImGui::EndPopup();
}

void PlotsPanel::draw_times() {
  constexpr std::array<double, 4> lengths = {1, 5, 20, 60};
  const auto last_text = [](double length) { return fmt::format("last {:.3g} s", length); };
  const std::string shown = !times_.length()   ? "all of the time"
                            : times_.follows() ? last_text(*times_.length())
                                               : fmt::format("{:.3g} s of it", *times_.length());
  const float width = combo_width("all of the time");
  follow_on(width);
  ImGui::SetNextItemWidth(width);
  const bool is_unfolded = ImGui::BeginCombo("##times", shown.c_str());
  if (!is_unfolded) {
    places_["times"] = last_item();
    explain("wheel over a plot: more or less of the time\ndrag a plot: earlier or later\ndouble click: all of it");
    return;
  }
  if (ImGui::Selectable("all of the time", !times_.length())) times_.show_all();
  places_["all of the time"] = last_item();
  for (const double length : lengths) {
    if (ImGui::Selectable(last_text(length).c_str(), times_.follows() && times_.length() == length)) {
      times_.show_last(length);
    }
  }
  ImGui::EndCombo();
}

void PlotsPanel::draw_axes() {
  constexpr std::array<const char*, 3> names = {"automatic axes", "linear axes", "logarithmic axes"};
  const float width = combo_width(names[2]);
  follow_on(width);
  ImGui::SetNextItemWidth(width);
  const bool is_unfolded = ImGui::BeginCombo("##axes", names[static_cast<std::size_t>(axes_)]);
  if (!is_unfolded) {
    places_["axes"] = last_item();
    explain("automatic: residuals and gaps are logarithmic where they span decades");
    return;
  }
  for (std::size_t i = 0; i < names.size(); ++i) {
    const auto axes = static_cast<Axes>(i);
    if (ImGui::Selectable(names[i], axes == axes_)) axes_ = axes;
  }
  ImGui::EndCombo();
}

void PlotsPanel::draw_plots(const MeasuredRun& run, std::optional<double> now, const PanelStyle& style) {
  const TimeRange known = known_times(run), range = times_.range(known);
  pliant_plot::PlotChoice all_rows = choice(range);
  all_rows.is_thinned = false;
  if (const std::vector<double>* times = run.table.find("time"); times != nullptr && !times->empty()) {
    // Lines go on to the sides.
    const auto first = std::ranges::lower_bound(*times, range.from);
    const auto last = std::ranges::upper_bound(*times, range.to);
    if (first != times->begin()) all_rows.from = *std::prev(first);
    if (last != times->end()) all_rows.to = *last;
  }
  std::vector<Plot> plots = chosen_plots(run, all_rows);
  if (plots.empty()) {
    wrapped_text(chosen_.empty() ? "No curves are chosen." : "Nothing was measured yet: take a step.");
    return;
  }
  const float unit = style.unit, space = 16 * unit;
  const ImVec2 from = ImGui::GetCursorScreenPos(), room = ImGui::GetContentRegionAvail();
  const auto count = static_cast<float>(plots.size());
  const float columns = std::clamp(std::floor((room.x + space) / (400 * unit)), 1.0F, count);
  const float rows = std::ceil(count / columns);
  const float width = (room.x - (columns - 1) * space) / columns;
  float height = room.y / rows;
  std::vector<PreparedPlot> prepared;
  float left = 0;
  prepared.reserve(plots.size());
  for (Plot& plot : plots) {
    prepared.emplace_back(std::move(plot), room.y / rows - 60 * unit, style);
    left = std::max(left, prepared.back().label_width);
    height = std::max(height, least_height(prepared.back(), width, style));
  }
  const PlotMarks marks{read_at_, now};
  read_at_.reset();
  for (std::size_t i = 0; i < prepared.size(); ++i) {
    const std::string& title = prepared[i].plot.title;
    const auto place = static_cast<float>(i);
    const float row = std::floor(place / columns), column = place - row * columns;
    const float x = from.x + column * (width + space), y = from.y + row * height;
    const Rect area = draw_plot(prepared[i], {x, y, x + width, y + height - 4 * unit}, left, range, marks, style);
    places_[title] = area;
    ImGui::SetCursorScreenPos({area[0], area[1]});
    ImGui::InvisibleButton(title.c_str(), {area[2] - area[0], area[3] - area[1]});
    take_mouse(area, known);
  }
  ImGui::SetCursorScreenPos({from.x, from.y + rows * height});
}

/// Of the area drawn last.
void PlotsPanel::take_mouse(const Rect& area, const TimeRange& known) {
  constexpr double a_notch = 0.8;
  const ImGuiIO& io = ImGui::GetIO();
  const double width = std::max(area[2] - area[0], 1.0F);
  const double share = std::clamp((static_cast<double>(io.MousePos.x) - area[0]) / width, 0.0, 1.0);
  if (ImGui::IsItemActive() && io.MouseDelta.x != 0) times_.pan(-io.MouseDelta.x / width, known);
  if (!ImGui::IsItemHovered()) return;
  if (ImGui::IsMouseDoubleClicked(ImGuiMouseButton_Left)) times_.show_all();
  if (io.MouseWheel != 0) times_.zoom(share, std::pow(a_notch, io.MouseWheel), known);
  read_at_ = times_.range(known).at(share);
}

}  // namespace pliant_viewer
