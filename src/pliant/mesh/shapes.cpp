#include "pliant/mesh/shapes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/topology.h"

namespace pliant {

namespace {

constexpr Index no_maximum = std::numeric_limits<Index>::max();

void require_count(std::string_view option, Index value, Index minimum, Index maximum = no_maximum) {
  if (value < minimum) fail_input(fmt::format("{} is {}; it must be at least {}", option, value, minimum));
  if (value > maximum) fail_input(fmt::format("{} is {}; it must be at most {}", option, value, maximum));
}

void require_positive(std::string_view option, Real value) {
  if (!std::isfinite(value) || value <= 0) {
    fail_input(fmt::format("{} is {}; it must be a length in metres, finite and > 0", option, value));
  }
}

/// The count is a floating-point number because the product of three counts may exceed every integer.
void require_vertex_count(std::string_view options, Real count) {
  if (count > Real{max_shape_vertices}) {
    fail_input(fmt::format("{} ask for {:.3g} vertices; stay under {}", options, count, max_shape_vertices));
  }
}

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

std::array<int, 2> axes_of(Plane plane) {
  switch (plane) {
    case Plane::xy:
      return {0, 1};
    case Plane::xz:
      return {0, 2};
    case Plane::yz:
      break;
  }
  return {1, 2};
}

/// Appends the triangles of grid cell (i, j).
void cut_cell(const GridOptions& options, Index i, Index j, std::vector<Triangle>& triangles) {
  const Index a = j * options.columns + i;
  const Index b = a + 1;
  const Index c = a + options.columns;
  const Index d = c + 1;
  if (options.diagonals == Diagonals::crossed) {
    const Index e = options.columns * options.rows + j * (options.columns - 1) + i;
    triangles.insert(triangles.end(), {{a, b, e}, {b, d, e}, {d, c, e}, {c, a, e}});
    return;
  }
  const bool is_even = (i + j) % 2 == 0;
  if (options.diagonals == Diagonals::forward || (options.diagonals == Diagonals::alternating && is_even)) {
    triangles.insert(triangles.end(), {{a, b, d}, {a, d, c}});
  } else {
    triangles.insert(triangles.end(), {{a, b, c}, {b, d, c}});
  }
}

/// Texture coordinates belong to corners of polygons: here the triangles, each vertex with a row of its own.
void keep_triangles_as_faces(Mesh& mesh) {
  for (const Triangle& triangle : mesh.triangles) {
    mesh.faces.offsets.push_back(static_cast<Index>(mesh.faces.vertices.size()));
    mesh.faces.vertices.insert(mesh.faces.vertices.end(), triangle.begin(), triangle.end());
  }
  mesh.faces.offsets.push_back(static_cast<Index>(mesh.faces.vertices.size()));
  mesh.faces.texture_coordinates = mesh.faces.vertices;
}

void place_grid_vertex(Mesh& mesh, const GridOptions& options, Index vertex, Real u, Real v) {
  const auto [first, second] = axes_of(options.plane);
  mesh.vertices(vertex, first) = u * options.size[0];
  mesh.vertices(vertex, second) = v * options.size[1];
  mesh.texture_coordinates.row(vertex) << u, v;
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

/// Corner n of a cell lies at (n & 1, n >> 1 & 1, n >> 2) from its first vertex. Kuhn's six paths from corner 0 to
/// corner 7, one axis at a time; the two middle corners are swapped in odd ones, so that every volume is positive.
constexpr std::array<std::array<unsigned, 4>, 6> six_cut{
    {{0, 1, 3, 7}, {0, 5, 1, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 4, 5, 7}, {0, 6, 4, 7}}};

/// The middle tetrahedron has the corners of even parity; the others cut off one odd corner each.
constexpr std::array<std::array<unsigned, 4>, 5> five_cut{
    {{0, 5, 3, 6}, {1, 3, 0, 5}, {2, 0, 3, 6}, {4, 0, 6, 5}, {7, 3, 5, 6}}};

/// Appends the tetrahedra of one cell, given the mesh's vertex at each of its corners.
void cut_cell(TetrahedronCut cut, bool is_even, const std::array<Index, 8>& corners,
              std::vector<Tetrahedron>& tetrahedra) {
  if (cut == TetrahedronCut::six) {
    for (const auto& [a, b, c, d] : six_cut) tetrahedra.push_back({corners[a], corners[b], corners[c], corners[d]});
    return;
  }
  for (const auto& [a, b, c, d] : five_cut) {
    if (is_even) {
      tetrahedra.push_back({corners[a], corners[b], corners[c], corners[d]});
    } else {  // mirrored in x, which turns the tetrahedra inside out: hence d before c
      tetrahedra.push_back({corners[a ^ 1U], corners[b ^ 1U], corners[d ^ 1U], corners[c ^ 1U]});
    }
  }
}

}  // namespace

Mesh grid(const GridOptions& options) {
  require_count("grid: columns", options.columns, 2);
  require_count("grid: rows", options.rows, 2);
  require_positive("grid: size[0]", options.size[0]);
  require_positive("grid: size[1]", options.size[1]);
  const bool is_crossed = options.diagonals == Diagonals::crossed;
  const Index cell_columns = options.columns - 1;
  const Index cell_rows = options.rows - 1;
  require_vertex_count("grid: columns and rows", Real{1} * options.columns * options.rows +
                                                     (is_crossed ? Real{1} * cell_columns * cell_rows : 0));

  Mesh mesh;
  const Index corner_count = options.columns * options.rows;
  const Index vertex_count = corner_count + (is_crossed ? cell_columns * cell_rows : 0);
  mesh.vertices = Positions::Zero(vertex_count, 3);
  mesh.texture_coordinates.resize(vertex_count, 2);
  for (Index v = 0; v < corner_count; ++v) {
    const Index i = v % options.columns;
    const Index j = v / options.columns;
    place_grid_vertex(mesh, options, v, Real{1} * i / cell_columns, Real{1} * j / cell_rows);
  }
  for (Index v = corner_count; v < vertex_count; ++v) {
    const Index i = (v - corner_count) % cell_columns;
    const Index j = (v - corner_count) / cell_columns;
    place_grid_vertex(mesh, options, v, (i + 0.5) / cell_columns, (j + 0.5) / cell_rows);
  }
  for (Index j = 0; j < cell_rows; ++j) {
    for (Index i = 0; i < cell_columns; ++i) cut_cell(options, i, j, mesh.triangles);
  }
  keep_triangles_as_faces(mesh);
  return mesh;
}

Mesh torus(const TorusOptions& options) {
  const Index nu = options.major_segments;
  const Index nv = options.minor_segments;
  require_count("torus: major_segments", nu, 3);
  require_count("torus: minor_segments", nv, 3);
  require_positive("torus: major_radius", options.major_radius);
  require_positive("torus: minor_radius", options.minor_radius);
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
  require_count("sphere: subdivisions", options.subdivisions, 0, 11);
  require_positive("sphere: radius", options.radius);

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
  const Index n = options.segments;
  require_count("cylinder: segments", n, 3);
  require_count("cylinder: rows", options.rows, 2);
  require_positive("cylinder: radius", options.radius);
  require_positive("cylinder: height", options.height);
  require_vertex_count("cylinder: segments and rows", Real{1} * n * options.rows + 2);

  Mesh mesh;
  const Index bottom = n * options.rows;
  const Index top = bottom + 1;
  mesh.vertices.resize(options.caps == Caps::closed ? top + 1 : bottom, 3);
  for (Index v = 0; v < bottom; ++v) {
    const auto [cos, sin] = on_circle(v % n, n);
    const Index row_index = v / n;
    const Real part = Real{1} * row_index / (options.rows - 1);
    mesh.vertices.row(v) << options.radius * cos, options.radius * sin, options.height * part;
  }
  for (Index first = 0; first + n < bottom; first += n) {
    for (Index i = 0; i < n; ++i) {
      const Index a = first + i;
      const Index b = first + (i + 1) % n;
      mesh.triangles.insert(mesh.triangles.end(), {{a, b, b + n}, {a, b + n, a + n}});
    }
  }
  if (options.caps == Caps::closed) {
    mesh.vertices.row(bottom) << 0, 0, 0;
    mesh.vertices.row(top) << 0, 0, options.height;
    const Index last_row = bottom - n;
    for (Index i = 0; i < n; ++i) {
      const Index next = (i + 1) % n;
      mesh.triangles.insert(mesh.triangles.end(), {{bottom, next, i}, {top, last_row + i, last_row + next}});
    }
  }
  return mesh;
}

Mesh bar(const BarOptions& options) {
  const auto& [nx, ny, nz] = options.cells;
  constexpr std::array axes{'x', 'y', 'z'};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    require_count(fmt::format("bar: cells along {}", axes[axis]), options.cells[axis], 1);
    require_positive(fmt::format("bar: size along {}", axes[axis]), options.size[axis]);
  }
  require_vertex_count("bar: cells", (nx + Real{1}) * (ny + Real{1}) * (nz + Real{1}));

  Mesh mesh;
  mesh.vertices.resize((nx + 1) * (ny + 1) * (nz + 1), 3);
  const auto vertex = [nx = nx, ny = ny](Index i, Index j, Index k) { return (k * (ny + 1) + j) * (nx + 1) + i; };
  for (Index k = 0; k <= nz; ++k) {
    for (Index j = 0; j <= ny; ++j) {
      for (Index i = 0; i <= nx; ++i) {
        mesh.vertices.row(vertex(i, j, k)) << options.size[0] * i / nx, options.size[1] * j / ny,
            options.size[2] * k / nz;
        if (i == nx || j == ny || k == nz) continue;
        std::array<Index, 8> corners{};
        for (Index n = 0; n < 8; ++n) {
          corners[static_cast<std::size_t>(n)] = vertex(i + n % 2, j + n / 2 % 2, k + n / 4);
        }
        cut_cell(options.cut, (i + j + k) % 2 == 0, corners, mesh.tetrahedra);
      }
    }
  }
  return mesh;
}

Mesh chain(const ChainOptions& options) {
  require_count("chain: links", options.links, 1);
  require_positive("chain: length", options.length);
  require_vertex_count("chain: links", options.links + Real{1});
  const Vec3& direction = options.direction;
  if (!direction.allFinite() || direction.isZero(0)) {
    fail_input(fmt::format("chain: direction is ({}, {}, {}); it must be finite and not zero", direction[0],
                           direction[1], direction[2]));
  }

  Mesh mesh;
  mesh.vertices.resize(options.links + 1, 3);
  const Vec3 span = options.length * direction.stableNormalized();
  for (Index v = 0; v <= options.links; ++v) {
    mesh.vertices.row(v) = (Real{1} * v / options.links * span).transpose();
    if (v > 0) mesh.edges.push_back({v - 1, v});
  }
  return mesh;
}

}  // namespace pliant
