#include "pliant/mesh/shapes/surfaces.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes/limits.h"
#include "pliant/mesh/topology.h"

namespace pliant {

namespace {

/// cos and sin of the i-th of n equal parts of a turn. Exact at quarter turns, so that shapes have clean coordinates.
std::array<Real, 2> on_circle(Index i, Index n) {
  const auto quarters = std::int64_t{4} * i;
  if (quarters % n == 0) {
    constexpr std::array<std::array<Real, 2>, 4> quarter_turns{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
    return quarter_turns[static_cast<std::size_t>(quarters / n % 4)];
  }
  const Real angle = 2 * std::numbers::pi * i / n;
  return {std::cos(angle), std::sin(angle)};
}

/// Cuts every triangle into four at the middles of its edges, which are moved out to the unit sphere.
void subdivide_sphere(Mesh& mesh) {
  const std::vector<Edge> edges = unique_edges(mesh);
  const Index first_middle = mesh.vertex_count();
  mesh.vertices.conservativeResize(first_middle + static_cast<Index>(edges.size()), 3);
  for (std::size_t e = 0; e < edges.size(); ++e) {
    const Vec3 middle = row(mesh.vertices, edges[e][0]) + row(mesh.vertices, edges[e][1]);
    mesh.vertices.row(first_middle + static_cast<Index>(e)) = middle.normalized().transpose();
  }
  const auto middle_of = [&](Index i, Index j) {
    const auto found = std::ranges::lower_bound(edges, Edge{std::min(i, j), std::max(i, j)});
    return first_middle + static_cast<Index>(found - edges.begin());
  };
  std::vector<Triangle> finer;
  finer.reserve(4 * mesh.triangles.size());
  for (const auto& [a, b, c] : mesh.triangles) {
    const Index ab = middle_of(a, b);
    const Index bc = middle_of(b, c);
    const Index ca = middle_of(c, a);
    finer.insert(finer.end(), {{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  mesh.triangles = std::move(finer);
}

/// Triangles between rows of n vertices, `end` in all.
void join_rows(Mesh& mesh, Index n, Index end) {
  for (Index first = 0; first + n < end; first += n) {
    for (Index i = 0; i < n; ++i) {
      const Index a = first + i;
      const Index b = first + (i + 1) % n;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + n}, {a, b + n, a + n}});
    }
  }
}

/// Fans from the first row to vertex `end`, and from the last one to the next.
void close_rows(Mesh& mesh, Index n, Index end) {
  const Index last_row = end - n;
  for (Index i = 0; i < n; ++i) {
    const Index next = (i + 1) % n;
    mesh.triangles.insert(mesh.triangles.end(), {{end, next, i}, {end + 1, last_row + i, last_row + next}});
  }
}

}  // namespace

Mesh torus(const TorusOptions& options) {
  check_options(options.shape, options);
  const Index nu = options.major_segments;
  const Index nv = options.minor_segments;
  if (options.minor_radius >= options.major_radius) {
    fail_input(fmt::format("torus: minor_radius is {}; it must be less than major_radius, {}", options.minor_radius,
                           options.major_radius));
  }
  require_vertex_count("torus: major_segments and minor_segments", Real{1} * nu * nv);

  Mesh mesh;
  mesh.vertices.resize(nu * nv, 3);
  mesh.triangles.reserve(static_cast<std::size_t>(nu) * static_cast<std::size_t>(nv) * 2);
  const auto vertex = [&](Index a, Index b) { return a % nu * nv + b % nv; };
  for (Index a = 0; a < nu; ++a) {
    const auto [cos_major, sin_major] = on_circle(a, nu);
    for (Index b = 0; b < nv; ++b) {
      const auto [cos_minor, sin_minor] = on_circle(b, nv);
      const Real distance = options.major_radius + options.minor_radius * cos_minor;
      mesh.vertices.row(vertex(a, b)) << distance * cos_major, distance * sin_major, options.minor_radius * sin_minor;
      mesh.triangles.push_back({vertex(a, b), vertex(a + 1, b), vertex(a + 1, b + 1)});
      mesh.triangles.push_back({vertex(a, b), vertex(a + 1, b + 1), vertex(a, b + 1)});
    }
  }
  return mesh;
}

Mesh sphere(const SphereOptions& options) {
  check_options(options.shape, options);

  Mesh mesh;
  constexpr Real g = std::numbers::phi;
  mesh.vertices.resize(12, 3);
  mesh.vertices << -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0,  //
      0, -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g,               //
      g, 0, -1, g, 0, 1, -g, 0, -1, -g, 0, 1;
  mesh.vertices.rowwise().normalize();
  mesh.triangles = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
                    {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
                    {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
  for (Index level = 0; level < options.subdivisions; ++level) subdivide_sphere(mesh);
  mesh.vertices *= options.radius;
  return mesh;
}

Mesh cylinder(const CylinderOptions& options) {
  check_options(options.shape, options);
  const Index n = options.segments;
  const Real widening = options.top_radius > 0 ? options.top_radius - options.radius : 0;
  require_vertex_count("cylinder: segments and rows", Real{1} * n * options.rows + 2);

  Mesh mesh;
  const Index bottom = n * options.rows;
  const Index top = bottom + 1;
  mesh.vertices.resize(options.caps == Caps::closed ? top + 1 : bottom, 3);
  for (Index v = 0; v < bottom; ++v) {
    const auto [cos, sin] = on_circle(v % n, n);
    const Index row_index = v / n;
    const Real part = Real{1} * row_index / (options.rows - 1);
    const Real radius = options.radius + part * widening;
    mesh.vertices.row(v) << radius * cos, radius * sin, options.height * part;
  }
  join_rows(mesh, n, bottom);
  if (options.caps == Caps::closed) {
    mesh.vertices.row(bottom) << 0, 0, 0;
    mesh.vertices.row(top) << 0, 0, options.height;
    close_rows(mesh, n, bottom);
  }
  return mesh;
}

Mesh capsule(const CapsuleOptions& options) {
  check_options(options.shape, options);
  const Real top_radius = options.top_radius > 0 ? options.top_radius : options.radius;
  const Real slope = (options.radius - top_radius) / options.height;
  if (!(std::abs(slope) < 1)) {
    fail_input(fmt::format("capsule: one ball, of {} m, holds the other, of {} m, {} m away; give a larger height",
                           std::max(options.radius, top_radius), std::min(options.radius, top_radius), options.height));
  }
  const Real touch = std::asin(slope);  // the latitude at which the cone between the balls touches both
  constexpr Real quarter = std::numbers::pi / 2;
  const Index n = options.segments;
  const Real turn = 2 * std::numbers::pi / n;
  const Real edge = turn * std::max(options.radius, top_radius);
  const auto parts_of = [](Real count) { return std::max(Real{1}, std::round(count)); };
  const Real below = parts_of((quarter + touch) / turn), above = parts_of((quarter - touch) / turn);
  const Real between = parts_of(options.height * std::cos(touch) / edge);
  const Real rows = below + between + above - 1;  // a pole is no row
  require_vertex_count("capsule: segments", rows * n + 2);

  Mesh mesh;
  const auto row_count = static_cast<Index>(rows);
  const Index bottom = n * row_count;
  mesh.vertices.resize(bottom + 2, 3);
  for (Index i = 0; i < row_count; ++i) {
    const Real place = Real{1} + i;
    const bool is_below = place <= below;
    const Real latitude = is_below ? -quarter + (quarter + touch) * place / below
                                   : quarter - (quarter - touch) * std::min(Real{1}, (rows + 1 - place) / above);
    const Real share = std::clamp((place - below) / between, Real{0}, Real{1});
    const Real radius = options.radius + share * (top_radius - options.radius);
    for (Index a = 0; a < n; ++a) {
      const auto [cos, sin] = on_circle(a, n);
      const Real distance = radius * std::cos(latitude);
      mesh.vertices.row(i * n + a) << distance * cos, distance * sin,
          share * options.height + radius * std::sin(latitude);
    }
  }
  mesh.vertices.row(bottom) << 0, 0, -options.radius;
  mesh.vertices.row(bottom + 1) << 0, 0, options.height + top_radius;
  join_rows(mesh, n, bottom);
  close_rows(mesh, n, bottom);
  return mesh;
}

}  // namespace pliant
