#include "report/plot.h"

#include <fmt/format.h>

#include "report/curves.h"
#include "report/guides.h"
#include "report/plot_layout.h"
#include "report/text.h"

namespace pliant_report {
namespace {

constexpr double baseline = 4.5;  ///< of a line of text, below its middle

std::string text_at(double x, double y, std::string_view style, std::string_view text) {
  return fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>\n", style, decimal(x), decimal(y), escaped(text));
}

std::string path(std::string_view style, const std::string& data) {
  return data.empty() ? "" : fmt::format("<path class=\"{}\" d=\"{}\"/>\n", style, data);
}

/// What a reader who sees nothing is told: what is plotted over what, and of what.
std::string spoken(const Plot& plot) {
  std::string text = plot.title.empty() ? std::string() : plot.title + ": ";
  text += fmt::format("{} over {}", plot.y.label.empty() ? "values" : plot.y.label,
                      plot.x.label.empty() ? "values" : plot.x.label);
  std::string_view separator = "; of ";
  for (const Series& series : plot.series) {
    if (series.name.empty()) continue;
    text += fmt::format("{}{}", separator, series.name);
    separator = ", ";
  }
  return text;
}

std::string grid_and_axes(const PlotLayout& layout) {
  const Box& area = layout.area;
  constexpr double long_tick = 5;
  constexpr double short_tick = 3;
  std::string grid, axes, labels;
  for (const PlacedTick& tick : layout.x_ticks) {
    const bool is_told = !tick.label.empty();
    axes += path_data({{{tick.at, area.bottom}, {tick.at, area.bottom + (is_told ? long_tick : short_tick)}}});
    if (!is_told) continue;
    grid += path_data({{{tick.at, area.top}, {tick.at, area.bottom}}});
    labels += text_at(tick.at, (tick.box.top + tick.box.bottom) / 2 + baseline, "plot-number plot-middle", tick.label);
  }
  for (const PlacedTick& tick : layout.y_ticks) {
    const bool is_told = !tick.label.empty();
    axes += path_data({{{area.left - (is_told ? long_tick : short_tick), tick.at}, {area.left, tick.at}}});
    if (!is_told) continue;
    grid += path_data({{{area.left, tick.at}, {area.right, tick.at}}});
    labels += text_at(tick.box.right, tick.at + baseline, "plot-number plot-end", tick.label);
  }
  axes += path_data({{{area.left, area.top}, {area.left, area.bottom}, {area.right, area.bottom}}});
  return path("plot-grid", grid) + path("plot-axis", axes) + labels;
}

std::string titles(const PlotLayout& layout) {
  std::string result;
  double y = layout.legend.empty() ? layout.area.top - line_height / 2 - 6 : layout.legend.front().box.top - 5;
  y -= line_height * (static_cast<double>(layout.title.size()) - 0.5) - baseline;
  for (const std::string& line : layout.title) {
    if (!line.empty())
      result += text_at(layout.legend.empty() ? 6 : layout.legend.front().box.left, y, "plot-title", line);
    y += line_height;
  }
  const Box& area = layout.area;
  y = layout.height - 6 - line_height * (static_cast<double>(layout.x_label.size()) - 0.5) + baseline;
  for (const std::string& line : layout.x_label) {
    if (!line.empty()) result += text_at((area.left + area.right) / 2, y, "plot-middle", line);
    y += line_height;
  }
  double x = 6 + line_height / 2 + baseline;
  for (const std::string& line : layout.y_label) {
    if (line.empty()) continue;
    result += fmt::format("<text class=\"plot-middle\" transform=\"translate({} {}) rotate(-90)\">{}</text>\n",
                          decimal(x), decimal((area.top + area.bottom) / 2), escaped(line));
    x += line_height;
  }
  return result;
}

std::string drawn(const Look& look, const std::vector<Run>& lines, const std::vector<Point>& marks) {
  const std::string content =
      path(look.is_dashed ? "plot-line plot-dashed" : "plot-line", path_data(lines)) +
      path(look.is_hollow ? "plot-marks plot-hollow" : "plot-marks", marks_data(marks, look.shape));
  return content.empty() ? "" : fmt::format("<g class=\"plot-color-{}\">\n{}</g>\n", look.color, content);
}

std::string band(const Look& look, const std::vector<Run>& outlines) {
  std::string data;
  for (const Run& outline : outlines) data += path_data({outline}) + 'z';
  return data.empty() ? "" : fmt::format("<g class=\"plot-color-{}\">\n{}</g>\n", look.color, path("plot-band", data));
}

std::string legend(const Plot& plot, const PlotLayout& layout, const std::vector<Curve>& curves) {
  std::string result;
  for (const LegendEntry& entry : layout.legend) {
    const double y = (entry.box.top + entry.box.bottom) / 2;
    const double right = entry.box.left + legend_sample_width;
    std::vector<Run> lines;
    std::vector<Point> marks;
    if (plot.series[entry.series].mark != Mark::points) lines.push_back({{entry.box.left, y}, {right, y}});
    if (!curves[entry.series].marks.empty()) marks.push_back({(entry.box.left + right) / 2, y});
    result += drawn(look_of(plot, entry.series), lines, marks);
    result += text_at(right + 6, y + baseline, "plot-name", entry.name);
  }
  return result;
}

std::string opening(const Plot& plot, const PlotLayout& layout, bool is_alone) {
  const std::string height = decimal(layout.height);
  const std::string label = escaped(spoken(plot));
  std::string result = fmt::format(
      "<svg{} class=\"plot\" viewBox=\"0 0 {} {}\" width=\"{}\" height=\"{}\" role=\"img\" aria-label=\"{}\">\n"
      "<title>{}</title>\n",
      is_alone ? " xmlns=\"http://www.w3.org/2000/svg\"" : "", plot_width, height, plot_width, height, label,
      plot.title.empty() ? label : escaped(plot.title));
  if (is_alone) {
    result += fmt::format("<style>\n{}</style>\n<rect class=\"plot-ground\" width=\"{}\" height=\"{}\"/>\n",
                          plot_style(), plot_width, height);
  }
  return result;
}

}  // namespace

std::string to_svg(const Plot& plot, bool is_alone) {
  const PlotLayout layout = plot_layout(plot);
  std::vector<Curve> curves;
  for (std::size_t i = 0; i < plot.series.size(); ++i) curves.push_back(curve_of(plot, i, layout));
  const std::vector<PlacedGuide> guides = place_guides(plot, layout, curves);

  std::string svg = opening(plot, layout, is_alone) + grid_and_axes(layout) + titles(layout);
  for (const PlacedGuide& guide : guides) svg += path("plot-guide", path_data({{guide.start, guide.end}}));
  for (std::size_t i = 0; i < curves.size(); ++i) svg += band(look_of(plot, i), curves[i].bands);
  // Lines first: no line hides a point.
  for (std::size_t i = 0; i < curves.size(); ++i) svg += drawn(look_of(plot, i), curves[i].lines, {});
  for (std::size_t i = 0; i < curves.size(); ++i) svg += drawn(look_of(plot, i), {}, curves[i].marks);
  for (const PlacedGuide& guide : guides) {
    if (guide.label.empty()) continue;
    svg += text_at((guide.box.left + guide.box.right) / 2, (guide.box.top + guide.box.bottom) / 2 + baseline,
                   "plot-guide-label plot-middle", guide.label);
  }
  return svg + legend(plot, layout, curves) + "</svg>\n";
}

}  // namespace pliant_report
