#include <array>
#include <charconv>
#include <string_view>

#include <fmt/format.h>

#include "report/curves.h"
#include "report/plot.h"

namespace pliant_report {
namespace {

/// Colors are written out for every scheme instead of as variables, which programs that edit or convert SVG do not
/// know.
struct Scheme {
  std::string_view ground;
  std::string_view text;
  std::string_view number;
  std::string_view axis;
  std::string_view grid;
  /// Found by a search: at least 3:1 to the ground, and as far apart as may be in the eyes of readers with and without
  /// each of the three kinds of color blindness.
  std::array<std::string_view, color_count> series;
};

constexpr Scheme light = {
    "#ffffff", "#1f2429", "#4d555e",
    "#767f89", "#e7e9ec", {"#1142c7", "#ae4900", "#198171", "#d556b5", "#aa8d1c", "#0c91f5", "#5d437b", "#91003b"}};
constexpr Scheme dark = {
    "#15181c", "#e2e6ea", "#aab2bb",
    "#7d8690", "#2b3037", {"#257dfe", "#ff8a29", "#42c392", "#c064ae", "#f8d43e", "#a8e3e0", "#b3a9f8", "#ee333a"}};

constexpr std::string_view shape_rules =
    R"(.plot { font: 13px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, sans-serif; }
.plot text { stroke: none; }
.plot-title { font-weight: 600; }
.plot-number { font-variant-numeric: tabular-nums; }
.plot-middle { text-anchor: middle; }
.plot-end { text-anchor: end; }
.plot-grid, .plot-axis, .plot-guide { fill: none; stroke-width: 1; }
.plot-guide { stroke-dasharray: 4 3; }
.plot .plot-guide-label { paint-order: stroke; stroke-width: 4; stroke-linejoin: round; }
.plot-line { fill: none; stroke: currentColor; stroke-width: 1.7; stroke-linejoin: round; stroke-linecap: round; }
.plot-band { fill: currentColor; fill-opacity: .2; stroke: none; }
.plot-dashed { stroke-dasharray: 6 4.5; }
.plot-marks { fill: currentColor; stroke-width: 1.4; paint-order: stroke; }
.plot .plot-hollow { stroke: currentColor; stroke-width: 1.5; paint-order: normal; }
)";

std::string colors(const Scheme& scheme) {
  std::string style = fmt::format(
      ".plot text {{ fill: {text}; }}\n"
      ".plot .plot-number, .plot .plot-guide-label {{ fill: {number}; }}\n"
      ".plot-ground, .plot .plot-hollow {{ fill: {ground}; }}\n"
      ".plot-marks, .plot .plot-guide-label {{ stroke: {ground}; }}\n"
      ".plot-axis, .plot-guide {{ stroke: {axis}; }}\n"
      ".plot-grid {{ stroke: {grid}; }}\n",
      fmt::arg("text", scheme.text), fmt::arg("number", scheme.number), fmt::arg("ground", scheme.ground),
      fmt::arg("axis", scheme.axis), fmt::arg("grid", scheme.grid));
  for (std::size_t i = 0; i < scheme.series.size(); ++i) {
    style += fmt::format(".plot-color-{} {{ color: {}; }}\n", i, scheme.series[i]);
  }
  return style;
}

}  // namespace

unsigned int palette_color(int color, Ground ground) {
  const std::string_view hex =
      (ground == Ground::dark ? dark : light).series[static_cast<std::size_t>(color % color_count)].substr(1);
  unsigned int number = 0;
  std::from_chars(hex.data(), hex.data() + hex.size(), number, 16);
  return number;
}

std::string plot_style() {
  return fmt::format(
      "{}{}@media screen and (prefers-color-scheme: dark) {{\n{}}}\n"
      "@media print {{\n.plot {{ break-inside: avoid; print-color-adjust: exact; }}\n}}\n",
      shape_rules, colors(light), colors(dark));
}

}  // namespace pliant_report
