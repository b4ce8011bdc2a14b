#include "report/guides.h"

#include <limits>

#include "report/text.h"

namespace pliant_report {
namespace {

constexpr double label_margin = 5;  ///< between a label and its line, or the area's edges

/// Where the label of a guide could stand, the best places first.
std::vector<Box> possible_boxes(const PlacedGuide& guide, bool is_vertical, const Box& area) {
  const double width = text_width(guide.label);
  std::vector<Box> boxes;
  const auto add = [&](double left, double top) {
    const Box box{left, top, left + width, top + line_height};
    if (box.left >= area.left && box.right <= area.right && box.top >= area.top && box.bottom <= area.bottom) {
      boxes.push_back(box);
    }
  };
  if (is_vertical) {
    const auto rows = static_cast<int>((area.height() - 2 * label_margin) / line_height);
    for (int row = 0; row < rows; ++row) {
      const double top = area.top + label_margin + row * line_height;
      add(guide.start.x + label_margin, top);
      add(guide.start.x - label_margin - width, top);
    }
  } else {
    const double above = guide.start.y - line_height - 1;
    const double below = guide.start.y + 1;
    const double free = area.width() - width - 2 * label_margin;
    for (const double share : {1.0, 0.0, 0.75, 0.5, 0.25}) {
      add(area.left + label_margin + share * free, above);
      add(area.left + label_margin + share * free, below);
    }
  }
  return boxes;
}

double cost(const Box& box, const std::vector<PlacedGuide>& guides, std::size_t own, const std::vector<Curve>& curves) {
  constexpr double of_label = 1e6;
  constexpr double of_line = 30;
  double sum = 0;
  for (std::size_t i = 0; i < guides.size(); ++i) {
    if (i < own && guides[i].box.meets(box)) sum += of_label;
    if (i != own && crosses(guides[i].start, guides[i].end, box)) sum += of_line;
  }
  for (const Curve& curve : curves) {
    for (const Run& run : curve.lines) {
      for (std::size_t i = 1; i < run.size(); ++i) sum += crosses(run[i - 1], run[i], box) ? 1 : 0;
    }
    for (const Point& p : curve.marks) sum += box.has(p) ? 1 : 0;
  }
  return sum;
}

}  // namespace

std::vector<PlacedGuide> place_guides(const Plot& plot, const PlotLayout& layout, const std::vector<Curve>& curves) {
  std::vector<PlacedGuide> guides;
  std::vector<bool> is_vertical;
  const Box& area = layout.area;
  for (const Guide& guide : plot.guides) {
    const double share = guide.is_vertical ? layout.x.fraction(guide.value) : layout.y.fraction(guide.value);
    if (!(share >= 0 && share <= 1)) continue;
    const double x = area.left + share * area.width();
    const double y = area.bottom - share * area.height();
    const std::string label = shortened(guide.label, area.width() / 2 - 2 * label_margin);
    guides.push_back(guide.is_vertical ? PlacedGuide{{x, area.top}, {x, area.bottom}, label, {}}
                                       : PlacedGuide{{area.left, y}, {area.right, y}, label, {}});
    is_vertical.push_back(guide.is_vertical);
  }
  for (std::size_t i = 0; i < guides.size(); ++i) {
    if (guides[i].label.empty()) continue;
    double least = std::numeric_limits<double>::infinity();
    double order = 0;
    for (const Box& box : possible_boxes(guides[i], is_vertical[i], area)) {
      // Places further down the list have to be better by what they are less usual.
      const double sum = cost(box, guides, i, curves) + order;
      order += 0.5;
      if (sum >= least) continue;
      least = sum;
      guides[i].box = box;
    }
  }
  return guides;
}

}  // namespace pliant_report
