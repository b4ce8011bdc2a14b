#include "viewer/panels/plot_drawing.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <imgui.h>

#include "plot/run_plots.h"

namespace pliant_viewer {
namespace {

using pliant_report::Plot;
using pliant_report::Series;

struct Dot {
  double x = 0, y = 0;  // as shares of the area, from its lower left corner
};

ImU32 series_color(const Plot& plot, std::size_t series) {
  const bool is_dark = ImGui::GetStyleColorVec4(ImGuiCol_WindowBg).x < 0.5F;
  const int color = plot.series[series].color.value_or(static_cast<int>(series));
  const unsigned rgb = palette_color(color, is_dark ? pliant_report::Ground::dark : pliant_report::Ground::light);
  return IM_COL32(rgb >> 16 & 0xFF, rgb >> 8 & 0xFF, rgb & 0xFF, 255);
}

/// "1.234", "−1.2e−05".
std::string value_text(double value) {
  std::string text = fmt::format("{:.4g}", value);
  for (std::size_t at = 0; (at = text.find('-', at)) != text.npos;) text.replace(at, 1, "−");
  return text;
}

/// The point of a line that is next to a time; none where the line has none.
std::optional<std::size_t> nearest_point(const Series& line, double time) {
  if (line.x.empty()) return {};
  const auto after = std::ranges::lower_bound(line.x, time);
  auto place = static_cast<std::size_t>(after - line.x.begin());
  if (place == line.x.size() || (place > 0 && time - line.x[place - 1] < line.x[place] - time)) --place;
  return place;
}

pliant_report::Extent extent_of_values(const Plot& plot) {
  pliant_report::Extent extent;
  for (const Series& line : plot.series) {
    for (const double value : line.y) {
      if (pliant_report::Scale::can_show(plot.y, value)) extent.add(value);
    }
  }
  return extent;
}

float width_of(const std::string& text) {
  return ImGui::CalcTextSize(text.c_str()).x;
}

/// With "..." in place of what does not fit.
std::string cut_to(std::string text, float width) {
  if (width_of(text) <= width) return text;
  while (!text.empty() && width_of(text + "...") > width) {
    while (!text.empty() && (text.back() & 0xC0) == 0x80) text.pop_back();
    if (!text.empty()) text.pop_back();
  }
  return text + "...";
}

void write_at(ImDrawList* list, float x, float y, ImU32 color, const std::string& text) {
  if (list != nullptr) list->AddText({std::round(x), std::round(y)}, color, text.c_str());
}

/// Texts beside each other, on a new line where one would not fit.
class TextFlow {
 public:
  TextFlow(const Rect& place, float space) : place_(place), space_(space), x_(place[0]), y_(place[1]) {}
  /// Makes room for a text.
  void begin(float width) {
    if (x_ > place_[0] && x_ + width > place_[2]) {
      x_ = place_[0];
      y_ += ImGui::GetTextLineHeight();
    }
    next_ = x_ + width + space_;
  }
  void end() { x_ = next_; }
  float x() const { return x_; }
  float y() const { return y_; }
  float below() const { return y_ + ImGui::GetTextLineHeight(); }
  float width() const { return place_[2] - place_[0]; }

 private:
  Rect place_;
  float space_, x_, y_, next_ = 0;
};

/// The heading, and of each line its color, its name and the value at a time; returns where this ends. Into no list it
/// is laid out alone.
float draw_legend_of(const PreparedPlot& prepared, const Rect& place, double time, float unit, ImDrawList* list) {
  const Plot& plot = prepared.plot;
  const float sample = 16 * unit, gap = 5 * unit, room = width_of("−8.888e−88");
  const ImU32 ink = ImGui::GetColorU32(ImGuiCol_Text), faint = ImGui::GetColorU32(ImGuiCol_TextDisabled);
  TextFlow flow(place, 12 * unit);
  const std::string heading = cut_to(prepared.heading, flow.width() - gap - width_of("at 8888.8 s"));
  const std::string when = fmt::format("at {:.4g} s", time);
  flow.begin(width_of(heading) + gap + width_of("at 8888.8 s"));
  write_at(list, flow.x(), flow.y(), ink, heading);
  write_at(list, flow.x() + width_of(heading) + gap, flow.y(), faint, when);
  flow.end();
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const Series& line = plot.series[i];
    const bool has_name = plot.series.size() > 1;
    const std::string name = has_name ? cut_to(line.name, flow.width() - sample - 2 * gap - room) : "";
    flow.begin(sample + (has_name ? gap + width_of(name) : 0) + gap + room);
    const float middle = std::round(flow.y() + ImGui::GetTextLineHeight() / 2);
    if (list != nullptr) {
      list->AddLine({flow.x(), middle}, {flow.x() + sample, middle}, series_color(plot, i), 2.5F * unit);
    }
    float x = flow.x() + sample + gap;
    if (has_name) {
      write_at(list, x, flow.y(), ink, name);
      x += width_of(name) + gap;
    }
    const auto point = nearest_point(line, time);
    const bool is_known = point && std::isfinite(line.y[*point]);
    write_at(list, x, flow.y(), is_known ? ink : faint, is_known ? value_text(line.y[*point]) : "-");
    flow.end();
  }
  return flow.below() + 9 * unit;  // room for half a number at the upper end of the axis
}

class AreaDrawing {
 public:
  AreaDrawing(const Rect& area, float unit) : area_(area), unit_(unit), list_(*ImGui::GetWindowDrawList()) {}

  ImVec2 place_of(const Dot& dot) const {
    return {area_[0] + static_cast<float>(dot.x) * (area_[2] - area_[0]),
            area_[3] - static_cast<float>(dot.y) * (area_[3] - area_[1])};
  }

  void draw_value_ticks(const PreparedPlot& prepared) const {
    const float half = ImGui::GetTextLineHeight() / 2;
    for (const pliant_report::Tick& tick : prepared.ticks.ticks) {
      const float y = std::round(place_of({0, prepared.values.fraction(tick)}).y);
      if (y < area_[1] - 1 || y > area_[3] + 1) continue;
      list_.AddLine({area_[0], y}, {area_[2], y}, ImGui::GetColorU32(ImGuiCol_Separator));
      if (tick.label.empty()) continue;
      const float x = area_[0] - 5 * unit_ - width_of(tick.label);
      write_at(&list_, x, y - half, ImGui::GetColorU32(ImGuiCol_TextDisabled), tick.label);
    }
  }

  /// Below the area, each with its unit, whole, and apart.
  void draw_time_ticks(const TimeRange& range, float window_right) const {
    pliant_report::Axis axis{.label = "time", .min = range.from, .max = range.to};
    const pliant_report::Scale scale(axis, {}, 0);
    const float widest = width_of("0.00001 s") + 8 * unit_;
    const int most = std::clamp(static_cast<int>((area_[2] - area_[0]) / widest), 3, 9);
    const pliant_report::Ticks ticks = scale.ticks(most);
    const std::string power = ticks.power == 0 ? " s" : " " + pliant_report::power_of_ten(ticks.power) + " s";
    float free_from = area_[0] - 1e4F;
    for (const pliant_report::Tick& tick : ticks.ticks) {
      const float x = std::round(place_of({scale.fraction(tick), 0}).x);
      list_.AddLine({x, area_[1]}, {x, area_[3]}, ImGui::GetColorU32(ImGuiCol_Separator));
      if (tick.label.empty()) continue;
      const std::string label = tick.label + power;
      const float width = width_of(label);
      const float left = std::min(x - width / 2, window_right - width);
      if (left < free_from) continue;
      write_at(&list_, left, area_[3] + 3 * unit_, ImGui::GetColorU32(ImGuiCol_TextDisabled), label);
      free_from = left + width + 8 * unit_;
    }
  }

  void draw_line(const std::vector<Dot>& dots, ImU32 color) const {
    std::vector<ImVec2> points;
    const auto finish = [&] {
      if (points.size() > 1) {
        list_.AddPolyline(points.data(), static_cast<int>(points.size()), color, ImDrawFlags_None, 1.7F * unit_);
      } else if (points.size() == 1) {
        list_.AddCircleFilled(points.front(), 1.7F * unit_, color);
      }
      points.clear();
    };
    const Dot* before = nullptr;
    for (const Dot& dot : dots) {
      if (!std::isfinite(dot.x) || !std::isfinite(dot.y)) {
        finish();
        before = nullptr;
        continue;
      }
      add_segment(before, dot, points);
      before = &dot;
    }
    finish();
  }

  void draw_time(double share, ImU32 color) const {
    if (!(share >= 0 && share <= 1)) return;
    const float x = std::round(place_of({share, 0}).x);
    list_.AddLine({x, area_[1]}, {x, area_[3]}, color, std::max(1.0F, std::round(unit_)));
  }

  void draw_dot(const Dot& dot, ImU32 color) const {
    if (dot.x >= 0 && dot.x <= 1 && std::isfinite(dot.y)) list_.AddCircleFilled(place_of(dot), 3.2F * unit_, color);
  }

 private:
  /// What of the way from one point to the next lies between the area's sides.
  void add_segment(const Dot* before, const Dot& dot, std::vector<ImVec2>& points) const {
    const auto at_side = [&](double x) {
      const double part = dot.x > before->x ? (x - before->x) / (dot.x - before->x) : 0;
      return Dot{x, before->y + part * (dot.y - before->y)};
    };
    if (before != nullptr && before->x < 0 && dot.x >= 0) points.push_back(place_of(at_side(0)));
    if (dot.x >= 0 && dot.x <= 1) points.push_back(place_of(dot));
    if (before != nullptr && before->x <= 1 && dot.x > 1) points.push_back(place_of(at_side(1)));
  }

  Rect area_;
  float unit_;
  ImDrawList& list_;
};

void draw_curves(const PreparedPlot& prepared, const Rect& area, const TimeRange& range, const PlotMarks& marks,
                 float unit) {
  const AreaDrawing drawing(area, unit);
  const auto share = [&](double time) { return (time - range.from) / std::max(range.length(), 1e-300); };
  if (marks.now) drawing.draw_time(share(*marks.now), ImGui::GetColorU32(ImGuiCol_CheckMark));
  if (marks.read_at) drawing.draw_time(share(*marks.read_at), ImGui::GetColorU32(ImGuiCol_TextDisabled));
  ImGui::PushClipRect({area[0] - unit, area[1] - 4 * unit}, {area[2] + unit, area[3] + 4 * unit}, true);
  for (std::size_t i = 0; i < prepared.plot.series.size(); ++i) {
    const Series& whole = prepared.plot.series[i];
    Series line = whole;
    pliant_plot::thin(line);
    std::vector<Dot> dots(line.x.size());
    for (std::size_t k = 0; k < dots.size(); ++k) dots[k] = {share(line.x[k]), prepared.values.fraction(line.y[k])};
    drawing.draw_line(dots, series_color(prepared.plot, i));
    if (!marks.read_at) continue;
    if (const auto point = nearest_point(whole, *marks.read_at)) {
      drawing.draw_dot({share(whole.x[*point]), prepared.values.fraction(whole.y[*point])},
                       series_color(prepared.plot, i));
    }
  }
  ImGui::PopClipRect();
}

}  // namespace

PreparedPlot::PreparedPlot(Plot given, float height, const PanelStyle& style)
    : plot(std::move(given)), values(plot.y, extent_of_values(plot), 0.05) {
  const int most = std::clamp(static_cast<int>(height / (34 * style.unit)), 3, 7);
  ticks = values.ticks(most);
  heading = pliant_report::with_power(plot.y.label, ticks.power);
  for (const pliant_report::Tick& tick : ticks.ticks) label_width = std::max(label_width, width_of(tick.label));
}

float least_height(const PreparedPlot& prepared, float width, const PanelStyle& style) {
  return draw_legend_of(prepared, {0, 0, width, 0}, 0, style.unit, nullptr) + ImGui::GetTextLineHeight() +
         85 * style.unit;
}

Rect draw_plot(const PreparedPlot& prepared, const Rect& place, float left, const TimeRange& range,
               const PlotMarks& marks, const PanelStyle& style) {
  const float unit = style.unit;
  const float below = ImGui::GetTextLineHeight() + 5 * unit;
  const float top = draw_legend_of(prepared, place, marks.read_at.value_or(range.to), unit, ImGui::GetWindowDrawList());
  const Rect area = {place[0] + left + 6 * unit, top, place[2] - 8 * unit, std::max(place[3] - below, top)};
  const AreaDrawing drawing(area, unit);
  drawing.draw_time_ticks(range, place[2]);
  drawing.draw_value_ticks(prepared);
  draw_curves(prepared, area, range, marks, unit);
  return area;
}

}  // namespace pliant_viewer
