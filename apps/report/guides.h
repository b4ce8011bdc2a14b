#pragma once
// Lines across a plot, and where their labels stand.
#include <vector>

#include "report/curves.h"

namespace pliant_report {

struct PlacedGuide {
  Point start{};
  Point end{};
  std::string label{};
  Box box{};  ///< of the label, within the plotting area
};

/// The guides that the axes show. A label stands beside its line near an edge, where it covers least of the curves and
/// no other label.
std::vector<PlacedGuide> place_guides(const Plot& plot, const PlotLayout& layout, const std::vector<Curve>& curves);

}  // namespace pliant_report
