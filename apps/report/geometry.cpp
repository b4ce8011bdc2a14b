#include "report/geometry.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace pliant_report {
namespace {

/// Which part of the segment from a to b lies in the box, as fractions of its length (Liang and Barsky 1984).
std::optional<std::array<double, 2>> part_inside(const Point& a, const Point& b, const Box& box) {
  double start = 0;
  double end = 1;
  const auto cut = [&](double from, double step, double low, double high) {
    if (step == 0) return from >= low && from <= high;
    const double t0 = (low - from) / step;
    const double t1 = (high - from) / step;
    start = std::max(start, std::min(t0, t1));
    end = std::min(end, std::max(t0, t1));
    return start <= end;
  };
  if (!cut(a.x, b.x - a.x, box.left, box.right) || !cut(a.y, b.y - a.y, box.top, box.bottom)) return std::nullopt;
  return std::array{start, end};
}

Point between(const Point& a, const Point& b, double t, const Box& box) {
  if (t == 0) return a;
  if (t == 1) return b;
  return {std::clamp(a.x + t * (b.x - a.x), box.left, box.right),
          std::clamp(a.y + t * (b.y - a.y), box.top, box.bottom)};
}

void append_column(Run& result, const Run& run, std::size_t first, std::size_t end) {
  const auto begin = run.begin() + static_cast<std::ptrdiff_t>(first);
  const auto stop = run.begin() + static_cast<std::ptrdiff_t>(end);
  const auto y = std::minmax_element(begin, stop, [](const Point& a, const Point& b) { return a.y < b.y; });
  const auto x = std::minmax_element(begin, stop, [](const Point& a, const Point& b) { return a.x < b.x; });
  std::array kept = {begin, y.first, y.second, x.first, x.second, stop - 1};
  std::sort(kept.begin(), kept.end());
  const auto last = std::unique(kept.begin(), kept.end());
  for (auto i = kept.begin(); i != last; ++i) result.push_back(**i);
}

}  // namespace

Run thinned(const Run& run) {
  Run result;
  for (std::size_t first = 0; first < run.size();) {
    std::size_t end = first + 1;
    while (end < run.size() && std::floor(run[end].x) == std::floor(run[first].x)) ++end;
    append_column(result, run, first, end);
    first = end;
  }
  return result;
}

std::vector<Point> without_covered(const std::vector<Point>& points) {
  std::set<std::pair<double, double>> squares;
  std::vector<Point> result;
  for (const Point& p : points) {
    if (squares.emplace(std::floor(p.x), std::floor(p.y)).second) result.push_back(p);
  }
  return result;
}

std::vector<Run> clipped(const Run& run, const Box& box) {
  std::vector<Run> result;
  if (run.size() == 1 && box.has(run.front())) result.push_back(run);
  bool continues = false;
  for (std::size_t i = 0; i + 1 < run.size(); ++i) {
    const auto part = part_inside(run[i], run[i + 1], box);
    if (part) {
      if (!continues || (*part)[0] > 0) result.push_back({between(run[i], run[i + 1], (*part)[0], box)});
      result.back().push_back(between(run[i], run[i + 1], (*part)[1], box));
    }
    continues = part && (*part)[1] == 1;
  }
  return result;
}

bool crosses(const Point& a, const Point& b, const Box& box) {
  return part_inside(a, b, box).has_value();
}

std::string decimal(double coordinate) {
  std::string text = fmt::format("{:.1f}", coordinate);
  if (text.ends_with(".0")) text.resize(text.size() - 2);
  return text == "-0" ? "0" : text;
}

std::string path_data(const std::vector<Run>& runs) {
  std::string data;
  for (const Run& run : runs) {
    char command = 'M';
    std::string before;
    for (const Point& p : run) {
      std::string place = fmt::format("{} {}", decimal(p.x), decimal(p.y));
      if (place == before) continue;
      data += command + place;
      before = std::move(place);
      command = 'L';
    }
  }
  return data;
}

}  // namespace pliant_report
