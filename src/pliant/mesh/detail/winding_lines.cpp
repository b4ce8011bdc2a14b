#include "pliant/mesh/detail/winding_lines.h"

#include <algorithm>
#include <cmath>

namespace pliant {
namespace {

/// A place across the lines, on a grid of whole numbers: even ones for vertices, odd ones for lines.
using GridPlace = std::array<std::int64_t, 2>;

/// Grid places along the longer side of all lines.
constexpr Real grid_size = 1 << 24;

/// Twice the area of a, b and the line p, positive when they run counter-clockwise. Of a line on the edge, that of the
/// line moved by a little in y and by much less in z.
std::int64_t side_of(const GridPlace& a, const GridPlace& b, const GridPlace& p) {
  const std::int64_t area = (b[0] - a[0]) * (p[1] - a[1]) - (b[1] - a[1]) * (p[0] - a[0]);
  if (area != 0) return area;
  return b[1] != a[1] ? -(b[1] - a[1]) : b[0] - a[0];
}

}  // namespace

template <class Visit>
void WindingLines::visit_crossings(const Positions& x, std::span<const Triangle> triangles, const Visit& visit) const {
  const Real fineness = grid_size / (step_ * std::max(rows_, columns_));
  const auto vertex_place = [&](Index vertex) {
    return GridPlace{2 * std::llround((x(vertex, 1) - origin_[1]) * fineness),
                     2 * std::llround((x(vertex, 2) - origin_[2]) * fineness)};
  };
  const auto line_place = [&](Index i) { return 2 * std::llround((i + 0.5) * step_ * fineness) + 1; };
  const auto first_line = [&](std::int64_t least, Index count) {
    const Real place = std::floor(static_cast<Real>(least) / (2 * fineness * step_) - 1.5);
    return static_cast<Index>(std::clamp<Real>(place, 0, count));
  };
  const auto end_line = [&](std::int64_t most, Index count) {
    const Real place = std::ceil(static_cast<Real>(most) / (2 * fineness * step_) + 1.5);
    return static_cast<Index>(std::clamp<Real>(place, 0, count));
  };
  for (const Triangle& triangle : triangles) {
    const GridPlace a = vertex_place(triangle[0]), b = vertex_place(triangle[1]), c = vertex_place(triangle[2]);
    const std::int64_t area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
    if (area == 0) continue;
    const Index row_end = end_line(std::max({a[0], b[0], c[0]}), rows_);
    const Index column_end = end_line(std::max({a[1], b[1], c[1]}), columns_);
    for (Index column = first_line(std::min({a[1], b[1], c[1]}), columns_); column < column_end; ++column) {
      for (Index row = first_line(std::min({a[0], b[0], c[0]}), rows_); row < row_end; ++row) {
        const GridPlace p = {line_place(row), line_place(column)};
        const std::int64_t at_a = side_of(b, c, p), at_b = side_of(c, a, p), at_c = side_of(a, b, p);
        if ((at_a > 0) != (area > 0) || (at_b > 0) != (area > 0) || (at_c > 0) != (area > 0)) continue;
        // On an edge a share is what the moved line has; the place along x is that of the edge to the grid's rounding.
        const Real wa = static_cast<Real>(at_a), wb = static_cast<Real>(at_b), wc = static_cast<Real>(at_c);
        const Real along = (wa * x(triangle[0], 0) + wb * x(triangle[1], 0) + wc * x(triangle[2], 0)) / (wa + wb + wc);
        visit(static_cast<std::size_t>(column) * static_cast<std::size_t>(rows_) + static_cast<std::size_t>(row),
              WindingCrossing{along, area > 0 ? -1 : 1});
      }
    }
  }
}

WindingLines::WindingLines(const Positions& x, std::span<const Triangle> triangles, const Vec3& origin, Real step,
                           Index rows, Index columns)
    : origin_(origin), step_(step), rows_(rows), columns_(columns) {
  begins_.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns) + 1, 0);
  visit_crossings(x, triangles, [&](std::size_t line, const WindingCrossing&) { ++begins_[line + 1]; });
  for (std::size_t line = 1; line < begins_.size(); ++line) begins_[line] += begins_[line - 1];
  crossings_.resize(begins_.back());
  std::vector<std::size_t> next(begins_.begin(), begins_.end() - 1);
  visit_crossings(x, triangles,
                  [&](std::size_t line, const WindingCrossing& crossing) { crossings_[next[line]++] = crossing; });
  for (std::size_t line = 0; line + 1 < begins_.size(); ++line) {
    const auto begin = crossings_.begin() + static_cast<std::ptrdiff_t>(begins_[line]);
    std::sort(begin, crossings_.begin() + static_cast<std::ptrdiff_t>(begins_[line + 1]),
              [](const WindingCrossing& a, const WindingCrossing& b) {
                return a.x != b.x ? a.x < b.x : a.change > b.change;
              });
  }
}

}  // namespace pliant
