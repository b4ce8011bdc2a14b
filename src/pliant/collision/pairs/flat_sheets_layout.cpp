// Which bodies are flat sheets, and their grids.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "pliant/collision/pairs/flat_sheets.h"

namespace pliant {
namespace {

using Place = std::array<Real, 2>;

/// Of a length or an area: by how much sums may differ that are the same.
constexpr Real same_length = 1e-11;
constexpr Real same_area = 1e-9;
/// Of the square of the longest edge: less than so much area is a sliver, of which derivatives are not right.
constexpr Real least_area = 1e-3;
/// Sides of a cell, in roots of the area that a vertex has.
constexpr Real cell_size = 1.5;
/// Of a cell: where its grid begins, so that few vertices of regular meshes lie between cells.
constexpr Real shift = 0.37;
/// Of a cell: what rounding may move a place by, at most.
constexpr Real rounding_of_places = 1e-4;
/// How many cells a grid may have.
constexpr Real most_cells_of_vertex = 4;
/// And on a side: single precision knows places on longer ones less well than rounding_of_places says.
constexpr Real most_cells_of_side = 1024;

Real cross(const Place& from, const Place& a, const Place& b) {
  return (a[0] - from[0]) * (b[1] - from[1]) - (a[1] - from[1]) * (b[0] - from[0]);
}

Real length(const Place& a, const Place& b) {
  return std::hypot(b[0] - a[0], b[1] - a[1]);
}

struct Outline {
  Real area = 0, length = 0;
};

/// Of the convex hull of some places.
Outline hull_of(std::vector<Place> places) {
  std::ranges::sort(places);
  std::vector<Place> hull;
  for (int side = 0; side < 2; ++side) {
    const std::size_t begin = hull.size();
    for (const Place& each : places) {
      while (hull.size() > begin + 1 && !(cross(hull[hull.size() - 2], hull.back(), each) > 0)) hull.pop_back();
      hull.push_back(each);
    }
    hull.pop_back();
    std::ranges::reverse(places);
  }
  Outline outline;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    const Place& next = hull[(i + 1) % hull.size()];
    outline.area += cross(hull.front(), hull[i], next) / 2;
    outline.length += length(hull[i], next);
  }
  return outline;
}

bool is_connected(const Surface& surface, std::span<const Index> vertices) {
  std::vector<char> is_reached(surface.body.size(), 0);
  std::vector<Index> open{vertices.front()};
  is_reached[at(open.front())] = 1;
  std::size_t reached = 1;
  while (!open.empty()) {
    const Index vertex = open.back();
    open.pop_back();
    for (const Index next : surface.neighbors(vertex)) {
      if (is_reached[at(next)] != 0) continue;
      is_reached[at(next)] = 1;
      ++reached;
      open.push_back(next);
    }
  }
  return reached == vertices.size();
}

/// Two directions across the mean normal of some triangles; none where there is none.
bool find_axes(const Surface& surface, const Positions& rest, std::span<const Index> triangles, Vec3& u, Vec3& v) {
  Vec3 sum = Vec3::Zero();
  for (const Index t : triangles) {
    const auto& [a, b, c] = surface.triangles[at(t)];
    sum += (row(rest, b) - row(rest, a)).cross(row(rest, c) - row(rest, a));
  }
  const Vec3 normal = sum.stableNormalized();
  if (!(normal.squaredNorm() > 0.5)) return false;
  // along the first edge, so that cells lie as a grid does
  const auto& [a, b, c] = surface.triangles[at(triangles.front())];
  const Vec3 edge = row(rest, b) - row(rest, a);
  u = (edge - normal.dot(edge) * normal).stableNormalized();
  v = normal.cross(u);
  return u.squaredNorm() > 0.5;
}

}  // namespace

void FlatSheets::set_surface(const Surface& surface, const Positions& rest) {
  *this = {};
  sheet_of_vertex_.assign(surface.body.size(), -1);
  places_.assign(surface.body.size(), {});
  const std::size_t parts = surface.meets_itself.size();
  std::vector<std::vector<Index>> triangles(parts), vertices(parts);
  const auto part_of = [&](Index vertex) { return at(surface.body[at(vertex)]); };
  for (Index t = 0; t < count_of(surface.triangles); ++t) {
    triangles[part_of(surface.triangles[at(t)][0])].push_back(t);
  }
  for (const Index v : surface.vertices) vertices[part_of(v)].push_back(v);
  for (std::size_t e = at(surface.loose_begin); e < surface.edges.size(); ++e) {
    triangles[part_of(surface.edges[e][0])].clear();
  }
  for (std::size_t p = 0; p < parts; ++p) {
    if (!triangles[p].empty()) add_sheet(surface, rest, static_cast<Index>(p), triangles[p], vertices[p]);
  }
  if (!is_empty()) lay_out_cells();
}

/// A domain without holes and overlaps whose border is as short as that of its convex hull is the hull.
void FlatSheets::add_sheet(const Surface& surface, const Positions& rest, Index part, std::span<const Index> triangles,
                           std::span<const Index> vertices) {
  Vec3 u, v;
  if (surface.meets_itself[at(part)] == 0 || !is_connected(surface, vertices)) return;
  if (!find_axes(surface, rest, triangles, u, v)) return;
  std::vector<Place> places;
  for (const Index vertex : vertices) {
    places.push_back({u.dot(row(rest, vertex)), v.dot(row(rest, vertex))});
    places_[at(vertex)] = places.back();
  }
  const std::size_t first = triangles_.size();
  std::vector<int> uses(surface.edges.size(), 0);
  Outline own;
  bool is_flat = true;
  for (const Index t : triangles) {
    const auto& corners = surface.triangles[at(t)];
    const auto& [a, b, c] = std::array{places_[at(corners[0])], places_[at(corners[1])], places_[at(corners[2])]};
    const Real area = cross(a, b, c);
    const Real longest = std::max({length(a, b), length(b, c), length(c, a)});
    is_flat = is_flat && area > least_area * longest * longest;
    own.area += area / 2;
    for (const Index e : surface.triangle_edges[at(t)]) ++uses[at(e)];
    const auto number = [&](Real x) { return static_cast<float>(x / area); };
    triangles_.push_back(
        {corners, {number(c[1] - a[1]), number(a[0] - c[0]), number(a[1] - b[1]), number(b[0] - a[0])}});
  }
  for (const Index t : triangles) {
    for (const Index e : surface.triangle_edges[at(t)]) {
      if (uses[at(e)] != 1) continue;
      own.length += length(places_[at(surface.edges[at(e)][0])], places_[at(surface.edges[at(e)][1])]);
    }
  }
  const Outline hull = hull_of(places);
  is_flat = is_flat && std::abs(own.area - hull.area) <= same_area * hull.area &&
            own.length <= hull.length + same_length * hull.length;
  if (!is_flat) return triangles_.resize(first);
  for (const Index vertex : vertices) sheet_of_vertex_[at(vertex)] = count_of(sheets_);
  Sheet& sheet = sheets_.emplace_back();
  lay_out_grids(places, cell_size * std::sqrt(own.area / static_cast<Real>(vertices.size())), sheet);
}

/// The coarsest grid is one block. A long strip that lies askew has larger cells, lest there be many without triangles.
void FlatSheets::lay_out_grids(std::span<const Place> places, Real size, Sheet& sheet) {
  Place low = places.front(), high = low;
  for (const Place& place : places) {
    for (std::size_t i = 0; i < 2; ++i) low[i] = std::min(low[i], place[i]), high[i] = std::max(high[i], place[i]);
  }
  const auto cells = [&](std::size_t i) { return std::floor((high[i] - low[i]) / size + shift) + 1; };
  const Real most_cells = most_cells_of_vertex * static_cast<Real>(places.size()) + block * block;
  while (cells(0) * cells(1) > most_cells || std::max(cells(0), cells(1)) > most_cells_of_side) size *= 2;
  for (std::size_t i = 0; i < 2; ++i) sheet.origin[i] = low[i] - shift * size;
  sheet.cells_per_length = static_cast<float>(1 / size);
  sheet.columns[0] = static_cast<Index>(cells(0));
  sheet.rows[0] = static_cast<Index>(cells(1));
  sheet.level_count = 1;
  for (std::size_t l = 0; l + 1 < most_levels && std::max(sheet.columns[l], sheet.rows[l]) > block; ++l) {
    sheet.columns[l + 1] = (sheet.columns[l] + 1) / 2;
    sheet.rows[l + 1] = (sheet.rows[l] + 1) / 2;
    ++sheet.level_count;
  }
}

/// The finest grids come first, and have lists of the triangles whose boxes meet each cell.
void FlatSheets::lay_out_cells() {
  Index next = 0;
  for (Index level = 0; level < most_levels; ++level) {
    for (Sheet& sheet : sheets_) {
      if (level >= sheet.level_count) continue;
      sheet.begin[at(level)] = next;
      next += sheet.columns[at(level)] * sheet.rows[at(level)];
    }
    if (level == 0) first_cells_ = next;
  }
  hulls_.resize(at(next));
  side_by_side_.resize(at(next));
  nearest_.assign(at(next), 0);
  are_spread_.assign(at(next), 0);
  derivatives_.resize(triangles_.size());
  cell_begin_.assign(at(first_cells_) + 1, 0);
  const auto for_each_entry = [&](auto&& visit) {
    for (Index t = 0; t < count_of(triangles_); ++t) {
      const auto& corners = triangles_[at(t)].vertices;
      const Sheet& sheet = sheets_[at(sheet_of_vertex_[at(corners[0])])];
      Place low = places_[at(corners[0])], high = low;
      for (const Index v : corners) {
        const Place& place = places_[at(v)];
        for (std::size_t i = 0; i < 2; ++i) low[i] = std::min(low[i], place[i]), high[i] = std::max(high[i], place[i]);
      }
      const auto [first_column, first_row] = cell_at(sheet, low, -rounding_of_places);
      const auto [last_column, last_row] = cell_at(sheet, high, rounding_of_places);
      for (Index y = first_row; y <= last_row; ++y) {
        for (Index x = first_column; x <= last_column; ++x) visit(sheet.cell(0, x, y), t);
      }
    }
  };
  for_each_entry([&](Index cell, Index) { ++cell_begin_[at(cell) + 1]; });
  std::partial_sum(cell_begin_.begin(), cell_begin_.end(), cell_begin_.begin());
  cell_triangles_.resize(at(cell_begin_.back()));
  std::vector<Index> places(cell_begin_.begin(), cell_begin_.end() - 1);
  for_each_entry([&](Index cell, Index t) { cell_triangles_[at(places[at(cell)]++)] = t; });
}

std::array<Index, 2> FlatSheets::cell_at(const Sheet& sheet, const Place& place, Real further) {
  const auto number = [&](std::size_t i, Index count) {
    const Real cells = (place[i] - sheet.origin[i]) * Real{sheet.cells_per_length} + further;
    return std::clamp(static_cast<Index>(std::floor(cells)), Index{0}, count - 1);
  };
  return {number(0, sheet.columns[0]), number(1, sheet.rows[0])};
}

Positions FlatSheets::flattened(const Positions& rest, Real apart) const {
  Positions flat = rest;
  for (std::size_t v = 0; v < places_.size(); ++v) {
    if (sheet_of_vertex_[v] < 0) continue;
    flat.row(static_cast<Index>(v)) << places_[v][0], places_[v][1], apart * static_cast<Real>(sheet_of_vertex_[v]);
  }
  return flat;
}

void FlatSheets::set_nearest(std::span<const Real> nearest) {
  std::vector<float> of_cells(hulls_.size(), std::numeric_limits<float>::infinity());
  for (std::size_t v = 0; v < places_.size(); ++v) {
    if (sheet_of_vertex_[v] < 0) continue;
    const Sheet& sheet = sheets_[at(sheet_of_vertex_[v])];
    const auto [column, row] = cell_at(sheet, places_[v], 0);
    for (Index y = std::max<Index>(0, row - 1); y <= std::min(row + 1, sheet.rows[0] - 1); ++y) {
      for (Index x = std::max<Index>(0, column - 1); x <= std::min(column + 1, sheet.columns[0] - 1); ++x) {
        float& least = of_cells[at(sheet.cell(0, x, y))];
        least = std::min(least, static_cast<float>(nearest[v]));
      }
    }
  }
  for (const Sheet& sheet : sheets_) {
    for (Index level = 0; level < sheet.level_count; ++level) {
      for_each_cell(sheet, level, [&](Index column, Index row) {
        float& own = of_cells[at(sheet.cell(level, column, row))];
        if (level > 0) own = least_of(of_cells, sheet, level - 1, 2 * column, 2 * row, 2);
      });
      for_each_cell(sheet, level, [&](Index column, Index row) {
        nearest_[at(sheet.cell(level, column, row))] = least_of(of_cells, sheet, level, column, row, block);
      });
    }
  }
}

/// Of so many columns and rows from there on.
float FlatSheets::least_of(std::span<const float> of_cells, const Sheet& sheet, Index level, Index column, Index row,
                           Index count) {
  float least = std::numeric_limits<float>::infinity();
  for_each_of(sheet, level, column, row, count, count,
              [&](Index cell) { least = std::min(least, of_cells[at(cell)]); });
  return least;
}

}  // namespace pliant
