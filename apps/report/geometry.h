#pragma once
// Places in a figure, in its units: x to the right, y downwards.
#include <string>
#include <vector>

namespace pliant_report {

struct Point {
  double x = 0;
  double y = 0;
};

struct Box {
  double left = 0;
  double top = 0;
  double right = 0;
  double bottom = 0;

  double width() const { return right - left; }
  double height() const { return bottom - top; }
  bool has(const Point& p) const { return p.x >= left && p.x <= right && p.y >= top && p.y <= bottom; }
  bool meets(const Box& other) const {
    return left < other.right && other.left < right && top < other.bottom && other.top < bottom;
  }
};

/// Points that are connected one to the next.
using Run = std::vector<Point>;

/// The run with, of those points in a row that share a column one unit wide, only the first, the last and those
/// furthest up, down, left and right: it looks the same.
Run thinned(const Run& run);

/// One point of all those within the same square of one unit, in the order given.
std::vector<Point> without_covered(const std::vector<Point>& points);

/// Those parts of a run that lie within the box.
std::vector<Run> clipped(const Run& run, const Box& box);

/// Whether any part of the segment lies in the box.
bool crosses(const Point& a, const Point& b, const Box& box);

/// A coordinate with one decimal, as short as it can be written.
std::string decimal(double coordinate);

/// "M1 2L3.5 4" for every run.
std::string path_data(const std::vector<Run>& runs);

}  // namespace pliant_report
