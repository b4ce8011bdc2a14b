#include "render/loop_subdivision.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <utility>

namespace pliant_render {
namespace {

using IndexList = std::vector<std::uint32_t>;
using Flags = std::vector<std::uint8_t>;

constexpr std::uint32_t no_edge = std::numeric_limits<std::uint32_t>::max();
constexpr double least_corner = 130, greatest_corner = 230;  // what lies between is no corner of a border [degrees]
constexpr std::uint32_t most_neighbors = 256;  // of a smoothed vertex: around one of k, stencils have k² entries

/// Stencils in double precision, which levels multiply.
struct DoubleStencils {
  IndexList offsets{0}, sources;
  std::vector<double> weights;

  void add(std::uint32_t source, double weight) {
    sources.push_back(source);
    weights.push_back(weight);
  }
  void end_row() { offsets.push_back(static_cast<std::uint32_t>(sources.size())); }
  void add_row(std::uint32_t source) {
    add(source, 1);
    end_row();
  }
  void add_midpoint(std::uint32_t a, std::uint32_t b) {
    add(a, 0.5);
    add(b, 0.5);
    end_row();
  }
};

DoubleStencils identity_stencils(std::size_t count) {
  DoubleStencils identity;
  for (std::size_t i = 0; i < count; ++i) identity.add_row(static_cast<std::uint32_t>(i));
  return identity;
}

/// The rows of `finer`, whose sources are rows of `finer_than`, as rows of the latter's sources.
DoubleStencils compose(const DoubleStencils& finer, const DoubleStencils& finer_than, std::size_t source_count) {
  constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();
  DoubleStencils product;
  product.offsets.reserve(finer.offsets.size());
  product.sources.reserve(2 * finer.sources.size());
  product.weights.reserve(2 * finer.sources.size());
  IndexList entries(source_count, none);  // where the row has each source
  for (std::size_t row = 0; row + 1 < finer.offsets.size(); ++row) {
    for (std::uint32_t i = finer.offsets[row]; i < finer.offsets[row + 1]; ++i) {
      const std::uint32_t between = finer.sources[i];
      for (std::uint32_t k = finer_than.offsets[between]; k < finer_than.offsets[between + 1]; ++k) {
        const double weight = finer.weights[i] * finer_than.weights[k];
        std::uint32_t& entry = entries[finer_than.sources[k]];
        if (entry == none) {
          entry = static_cast<std::uint32_t>(product.sources.size());
          product.add(finer_than.sources[k], weight);
        } else {
          product.weights[entry] += weight;
        }
      }
    }
    for (std::size_t k = product.offsets.back(); k < product.sources.size(); ++k) entries[product.sources[k]] = none;
    product.end_row();
  }
  return product;
}

Stencils to_single(DoubleStencils stencils) {
  return {.offsets = std::move(stencils.offsets),
          .sources = std::move(stencils.sources),
          .weights = {stencils.weights.begin(), stencils.weights.end()}};
}

/// A side of a triangle has the number of the corner at which it begins.
constexpr std::size_t side_after(std::size_t side) {
  return side % 3 == 2 ? side - 2 : side + 1;
}

/// The sides of triangles by edges. Triangles that name a vertex twice have none.
struct SurfaceEdges {
  std::vector<std::array<std::uint32_t, 2>> ends;  // in rising order, with the lower vertex first
  IndexList by_lower_end;  // one per vertex and one more: edges from [v] to [v + 1] have v as their lower end
  IndexList side_offsets;  // one per edge and one more: into sides
  IndexList sides;
  IndexList of_sides;  // the edge of each side, or no_edge

  std::size_t size() const { return ends.size(); }
  std::span<const std::uint32_t> sides_of(std::size_t edge) const {
    return std::span(sides).subspan(side_offsets[edge], side_offsets[edge + 1] - side_offsets[edge]);
  }
  std::uint32_t find(std::uint32_t a, std::uint32_t b) const {
    const auto [low, high] = std::minmax(a, b);
    const auto first = ends.begin() + by_lower_end[low], last = ends.begin() + by_lower_end[low + 1];
    const auto found = std::lower_bound(first, last, std::array{low, high});
    return found != last && (*found)[1] == high ? static_cast<std::uint32_t>(found - ends.begin()) : no_edge;
  }
};

SurfaceEdges find_edges(std::uint32_t vertex_count, const IndexList& triangles) {
  struct Side {
    std::uint32_t higher_end, number;
    auto operator<=>(const Side&) const = default;
  };
  const auto lower_end = [&](std::size_t side) { return std::min(triangles[side], triangles[side_after(side)]); };
  const auto has_sides = [&](std::size_t t) {
    return triangles[t] != triangles[t + 1] && triangles[t + 1] != triangles[t + 2] && triangles[t + 2] != triangles[t];
  };
  IndexList offsets(std::size_t{vertex_count} + 1, 0);  // into sides that are sorted by their lower ends
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    for (std::size_t side = t; has_sides(t) && side < t + 3; ++side) ++offsets[lower_end(side) + 1];
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  std::vector<Side> sides(offsets.back());
  IndexList next(offsets.begin(), offsets.end() - 1);
  for (std::size_t t = 0; t < triangles.size(); t += 3) {
    for (std::size_t side = t; has_sides(t) && side < t + 3; ++side) {
      const std::uint32_t higher_end = std::max(triangles[side], triangles[side_after(side)]);
      sides[next[lower_end(side)]++] = {higher_end, static_cast<std::uint32_t>(side)};
    }
  }

  SurfaceEdges edges;
  edges.by_lower_end = {0};
  edges.of_sides.assign(triangles.size(), no_edge);
  for (std::uint32_t vertex = 0; vertex < vertex_count; ++vertex) {
    std::sort(sides.begin() + offsets[vertex], sides.begin() + offsets[vertex + 1]);
    for (std::uint32_t i = offsets[vertex]; i < offsets[vertex + 1]; ++i) {
      if (i == offsets[vertex] || sides[i].higher_end != sides[i - 1].higher_end) {
        edges.ends.push_back({vertex, sides[i].higher_end});
        edges.side_offsets.push_back(i);
      }
      edges.sides.push_back(sides[i].number);
      edges.of_sides[sides[i].number] = static_cast<std::uint32_t>(edges.size() - 1);
    }
    edges.by_lower_end.push_back(static_cast<std::uint32_t>(edges.size()));
  }
  edges.side_offsets.push_back(offsets.back());
  return edges;
}

/// One per vertex: whether the triangles around it do not all hang together by edges there, or there are none.
Flags find_several_fans(std::uint32_t vertex_count, const IndexList& triangles, const SurfaceEdges& edges) {
  // Ends of edges, two each, in sets that are joined by the corners of triangles; each has one end as its root.
  IndexList roots(2 * edges.size());
  std::iota(roots.begin(), roots.end(), 0U);
  const auto root = [&](std::size_t i) {
    while (roots[i] != i) i = roots[i] = roots[roots[i]];
    return i;
  };
  const auto end_of = [&](std::uint32_t edge, std::uint32_t vertex) {
    return 2 * std::size_t{edge} + (edges.ends[edge][0] == vertex ? 0 : 1);
  };
  std::vector<std::int64_t> set_counts(vertex_count, 0);
  for (const auto& [low, high] : edges.ends) {
    ++set_counts[low];
    ++set_counts[high];
  }
  for (std::size_t side = 0; side < triangles.size(); ++side) {
    if (edges.of_sides[side] == no_edge) continue;
    const std::size_t side_before = side_after(side_after(side));
    const std::size_t a = root(end_of(edges.of_sides[side], triangles[side])),
                      b = root(end_of(edges.of_sides[side_before], triangles[side]));
    if (a == b) continue;
    roots[std::max(a, b)] = static_cast<std::uint32_t>(std::min(a, b));
    --set_counts[triangles[side]];
  }
  Flags result(vertex_count);
  std::ranges::transform(set_counts, result.begin(), [](std::int64_t count) { return count == 1 ? 0 : 1; });
  return result;
}

/// One per vertex: the sum of the triangles' angles there at rest [degrees]; not a number where a length is unknown.
std::vector<double> rest_angles(const CoarseSurface& surface, const IndexList& triangles, const SurfaceEdges& edges) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  std::vector<double> lengths(edges.size(), unknown);
  for (std::size_t spring = 0; spring < surface.rest_lengths.size(); ++spring) {
    const std::uint32_t edge = edges.find(surface.springs[2 * spring], surface.springs[2 * spring + 1]);
    if (edge != no_edge) lengths[edge] = static_cast<double>(surface.rest_lengths[spring]);
  }
  std::vector<double> angles(surface.vertex_count, 0);
  for (std::size_t side = 0; side < triangles.size(); ++side) {
    if (edges.of_sides[side] == no_edge) continue;
    const std::size_t opposite = side_after(side), side_before = side_after(opposite);
    const double a = lengths[edges.of_sides[side]], b = lengths[edges.of_sides[side_before]],
                 c = lengths[edges.of_sides[opposite]];
    const double cosine = a > 0 && b > 0 ? (a * a + b * b - c * c) / (2 * a * b) : unknown;
    angles[triangles[side]] += std::acos(std::clamp(cosine, -1.0, 1.0)) * 180 / std::numbers::pi;
  }
  return angles;
}

/// One per vertex: whether it stays where it is for another reason than creases.
Flags find_fixed(const CoarseSurface& surface, const IndexList& triangles, const SurfaceEdges& edges) {
  Flags is_fixed = find_several_fans(surface.vertex_count, triangles, edges);
  IndexList border_counts(surface.vertex_count, 0);
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    if (edges.sides_of(edge).size() != 1) continue;
    for (const std::uint32_t vertex : edges.ends[edge]) ++border_counts[vertex];
  }
  const std::vector<double> angles = rest_angles(surface, triangles, edges);
  for (std::size_t vertex = 0; vertex < is_fixed.size(); ++vertex) {
    if (border_counts[vertex] == 2 && (angles[vertex] < least_corner || angles[vertex] > greatest_corner)) {
      is_fixed[vertex] = 1;
    }
  }
  return is_fixed;
}

/// What has a number at the middle of edges, and which edges are creases.
struct MidpointCorners {
  IndexList of_sides;                                // the fine number of the middle of each side
  std::vector<std::array<std::uint32_t, 2>> firsts;  // one per edge: the coarse numbers at both ends, of the vertex
  std::vector<std::array<std::uint32_t, 2>> others;  // and of each copy
  IndexList copies, normals_from;                    // one per copy, as in FineSurface
  Flags is_crease;                                   // one per edge
};

/// Triangles share a number at the middle of an edge where they share those at both ends, and a normal where they share
/// both normals.
///
/// An edge of two triangles is a crease where their normals differ at either end. split_at_hard_edges joins the corners
/// of two triangles at both ends of an edge over which the surface is smooth, so that different normals at one end tell
/// of a hard edge. At the other they are the same where one comes from one triangle to the other without crossing a
/// hard edge: where a hard edge ends within a smooth surface, at a dart. Between two darts, an edge is shaded as if it
/// was smooth, and is. Middles inherit this: normals differ there just where they differ at an end.
MidpointCorners number_midpoints(const FineSurface& surface, const SurfaceEdges& edges) {
  const auto vertex_count = static_cast<std::uint32_t>(surface.vertex_count + edges.size());
  const auto first_copy = static_cast<std::uint32_t>(vertex_count + surface.copies.size());
  IndexList roots(surface.vertex_count + surface.copies.size());
  std::iota(roots.begin(), roots.end(), 0U);
  for (std::size_t i = 0; i < surface.copies.size(); ++i) {
    roots[surface.vertex_count + i] = roots[surface.normals_from[i]];
  }
  struct Middle {
    std::array<std::uint32_t, 2> normals, numbers;  // at the lower and the higher end
    std::uint32_t side;
    auto operator<=>(const Middle&) const = default;
  };
  MidpointCorners corners;
  corners.of_sides.assign(surface.triangles.size(), 0);
  std::vector<Middle> middles;
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    middles.clear();
    for (const std::uint32_t side : edges.sides_of(edge)) {
      std::array numbers{surface.corners[side], surface.corners[side_after(side)]};
      if (surface.triangles[side] != edges.ends[edge][0]) std::swap(numbers[0], numbers[1]);
      middles.push_back({{roots[numbers[0]], roots[numbers[1]]}, numbers, side});
    }
    std::ranges::sort(middles);
    std::uint32_t number = surface.vertex_count + edge, normal_from = number;
    corners.firsts.push_back(middles.front().numbers);
    for (std::size_t i = 0; i < middles.size(); ++i) {
      if (i > 0 && middles[i].numbers != middles[i - 1].numbers) {
        number = first_copy + static_cast<std::uint32_t>(corners.others.size());
        if (middles[i].normals != middles[i - 1].normals) normal_from = number;
        corners.others.push_back(middles[i].numbers);
        corners.copies.push_back(surface.vertex_count + edge);
        corners.normals_from.push_back(normal_from);
      }
      corners.of_sides[middles[i].side] = number;
    }
    const bool is_smooth = middles.size() == 2 && middles.front().normals == middles.back().normals;
    corners.is_crease.push_back(is_smooth ? 0 : 1);
  }
  return corners;
}

/// The weight of each of so many neighbors, by Loop (1987).
double neighbor_weight(std::uint32_t count) {
  const double part = 0.375 + 0.25 * std::cos(2 * std::numbers::pi / count);
  return (0.625 - part * part) / count;
}

/// Where the vertices of the finer surface lie: the coarser one's, and then those on its edges.
///
/// Creases are cubic B-splines. On one that ends in a dart, too, the new vertex is at the middle, as DeRose, Kass and
/// Truong ("Subdivision surfaces in character animation", 1998) have it.
DoubleStencils place_vertices(const FineSurface& surface, const SurfaceEdges& edges, const Flags& is_crease,
                              const Flags& is_fixed) {
  IndexList offsets(std::size_t{surface.vertex_count} + 1, 0), crease_counts(surface.vertex_count, 0);
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    for (const std::uint32_t vertex : edges.ends[edge]) {
      ++offsets[vertex + 1];
      crease_counts[vertex] += is_crease[edge];
    }
  }
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  IndexList edges_around(offsets.back()), next(offsets.begin(), offsets.end() - 1);
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    for (const std::uint32_t vertex : edges.ends[edge]) edges_around[next[vertex]++] = edge;
  }

  DoubleStencils points;
  for (std::uint32_t vertex = 0; vertex < surface.vertex_count; ++vertex) {
    const std::uint32_t count = offsets[vertex + 1] - offsets[vertex];
    const bool is_on_crease = crease_counts[vertex] == 2;
    if (is_fixed[vertex] != 0 || crease_counts[vertex] > 2 || (!is_on_crease && count > most_neighbors)) {
      points.add_row(vertex);
      continue;
    }
    const double weight = is_on_crease ? 0.125 : neighbor_weight(count);
    points.add(vertex, 1 - weight * (is_on_crease ? 2 : count));
    for (std::uint32_t i = offsets[vertex]; i < offsets[vertex + 1]; ++i) {
      const auto& [low, high] = edges.ends[edges_around[i]];
      if (!is_on_crease || is_crease[edges_around[i]] != 0) points.add(low == vertex ? high : low, weight);
    }
    points.end_row();
  }
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    const auto& [low, high] = edges.ends[edge];
    if (is_crease[edge] != 0) {
      points.add_midpoint(low, high);
      continue;
    }
    points.add(low, 0.375);
    points.add(high, 0.375);
    for (const std::uint32_t side : edges.sides_of(edge)) {
      points.add(surface.triangles[side_after(side_after(side))], 0.125);
    }
    points.end_row();
  }
  return points;
}

/// What is linear on each triangle: the coarser vertices, the edges' middles, the coarser copies, those of the middles.
DoubleStencils place_corners(const FineSurface& surface, const MidpointCorners& midpoints) {
  DoubleStencils places;
  for (std::uint32_t vertex = 0; vertex < surface.vertex_count; ++vertex) places.add_row(vertex);
  for (const auto& [a, b] : midpoints.firsts) places.add_midpoint(a, b);
  for (std::uint32_t i = 0; i < surface.copies.size(); ++i) places.add_row(surface.vertex_count + i);
  for (const auto& [a, b] : midpoints.others) places.add_midpoint(a, b);
  return places;
}

/// The numbers of three corners and of three middles, the first between the first two, as those of four triangles.
void append_four(IndexList& list, const std::array<std::uint32_t, 3>& at, const std::array<std::uint32_t, 3>& middle) {
  const auto [a, b, c] = at;
  const auto [ab, bc, ca] = middle;
  list.insert(list.end(), {a, ab, ca, ab, b, bc, ca, bc, c, ab, bc, ca});
}

FineSurface cut_triangles(const FineSurface& surface, const SurfaceEdges& edges, const MidpointCorners& midpoints) {
  FineSurface fine;
  fine.vertex_count = static_cast<std::uint32_t>(surface.vertex_count + edges.size());
  const auto fine_number = [&](std::uint32_t number) {  // copies have moved up, behind the new vertices
    return number < surface.vertex_count ? number : number + static_cast<std::uint32_t>(edges.size());
  };
  fine.triangles.reserve(4 * surface.triangles.size());
  fine.corners.reserve(4 * surface.triangles.size());
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
    const bool is_cut = edges.of_sides[t] != no_edge;
    std::array<std::uint32_t, 3> vertices{}, numbers{}, middles{}, middle_numbers{};
    for (std::size_t k = 0; k < 3; ++k) {
      vertices[k] = surface.triangles[t + k];
      numbers[k] = fine_number(surface.corners[t + k]);
      middles[k] = surface.vertex_count + edges.of_sides[t + k];
      middle_numbers[k] = midpoints.of_sides[t + k];
    }
    if (is_cut) {
      append_four(fine.triangles, vertices, middles);
      append_four(fine.corners, numbers, middle_numbers);
      continue;
    }
    for (int copy = 0; copy < 4; ++copy) {
      fine.triangles.insert(fine.triangles.end(), vertices.begin(), vertices.end());
      fine.corners.insert(fine.corners.end(), numbers.begin(), numbers.end());
    }
  }
  fine.copies = surface.copies;
  fine.copies.insert(fine.copies.end(), midpoints.copies.begin(), midpoints.copies.end());
  for (const std::uint32_t number : surface.normals_from) fine.normals_from.push_back(fine_number(number));
  fine.normals_from.insert(fine.normals_from.end(), midpoints.normals_from.begin(), midpoints.normals_from.end());
  for (std::size_t i = 0; i + 1 < surface.edges.size(); i += 2) {
    const std::uint32_t a = surface.edges[i], b = surface.edges[i + 1], edge = edges.find(a, b);
    const std::uint32_t middle = surface.vertex_count + edge;
    if (edge == no_edge) {
      fine.edges.insert(fine.edges.end(), {a, b});
    } else {
      fine.edges.insert(fine.edges.end(), {a, middle, middle, b});
    }
  }
  return fine;
}

template <class Value>
void sum_rows(const Stencils& stencils, std::span<const Value> coarse, std::vector<Value>& fine) {
  fine.resize(stencils.offsets.size() - 1);
  for (std::size_t row = 0; row < fine.size(); ++row) {
    std::uint32_t k = stencils.offsets[row];
    Value sum = stencils.weights[k] * coarse[stencils.sources[k]];
    while (++k < stencils.offsets[row + 1]) sum += stencils.weights[k] * coarse[stencils.sources[k]];
    fine[row] = sum;
  }
}

}  // namespace

FineSurface subdivide(const CoarseSurface& surface, int levels) {
  const std::size_t corner_count = surface.vertex_count + surface.copies.size();
  FineSurface fine;
  fine.vertex_count = surface.vertex_count;
  fine.triangles.assign(surface.triangles.begin(), surface.triangles.end());
  fine.corners.assign(surface.corners.begin(), surface.corners.end());
  fine.copies.assign(surface.copies.begin(), surface.copies.end());
  fine.normals_from.assign(surface.normals_from.begin(), surface.normals_from.end());
  fine.edges.assign(surface.edges.begin(), surface.edges.end());
  DoubleStencils points = identity_stencils(surface.vertex_count), places = identity_stencils(corner_count);
  Flags is_fixed;
  for (int level = 0; level < levels; ++level) {
    const SurfaceEdges edges = find_edges(fine.vertex_count, fine.triangles);
    // Later vertices lie within an edge, where nothing is fixed.
    if (level == 0) is_fixed = find_fixed(surface, fine.triangles, edges);
    is_fixed.resize(fine.vertex_count, 0);
    const MidpointCorners midpoints = number_midpoints(fine, edges);
    points = compose(place_vertices(fine, edges, midpoints.is_crease, is_fixed), points, surface.vertex_count);
    places = compose(place_corners(fine, midpoints), places, corner_count);
    fine = cut_triangles(fine, edges, midpoints);
  }
  fine.points = to_single(std::move(points));
  fine.places = to_single(std::move(places));
  return fine;
}

void apply_stencils(const Stencils& stencils, std::span<const float> coarse, std::vector<float>& fine) {
  sum_rows(stencils, coarse, fine);
}

void apply_stencils(const Stencils& stencils, std::span<const Vec2f> coarse, std::vector<Vec2f>& fine) {
  sum_rows(stencils, coarse, fine);
}

void apply_stencils(const Stencils& stencils, std::span<const Vec3f> coarse, std::vector<Vec3f>& fine) {
  sum_rows(stencils, coarse, fine);
}

}  // namespace pliant_render
