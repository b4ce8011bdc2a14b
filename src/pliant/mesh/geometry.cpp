#include "pliant/mesh/geometry.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/error.h"

namespace pliant {

namespace {

/// Measure under which an element has no extent, relative to that power of its longest edge.
constexpr Real flatness_limit = 1e-12;

template <std::size_t n>
Real longest_edge(const Positions& x, const std::array<Index, n>& element) {
  Real longest = 0;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 1; j < n; ++j) {
      longest = std::max(longest, (row(x, element[j]) - row(x, element[i])).stableNorm());
    }
  }
  return longest;
}

Real volume_of(const Positions& x, const Tetrahedron& tetrahedron) {
  const auto& [a, b, c, d] = tetrahedron;
  return tetrahedron_volume(row(x, a), row(x, b), row(x, c), row(x, d));
}

/// Which element a message is about, as in `triangle 3 (vertices 0, 4, 5)`.
template <std::size_t n>
std::string describe(std::string_view kind, std::size_t i, const std::array<Index, n>& element) {
  return fmt::format("{} {} (vertices {})", kind, i, fmt::join(element, ", "));
}

void check_vertices(const Mesh& mesh, std::string_view name) {
  if (mesh.vertex_count() == 0) fail_input(fmt::format("{}: the mesh has no vertices; give at least one", name));
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 x = row(mesh.vertices, v);
    if (!x.allFinite()) {
      fail_input(fmt::format("{}: vertex {} is not finite: ({}, {}, {}); give three numbers in meters", name, v, x[0],
                             x[1], x[2]));
    }
    if (x.cwiseAbs().maxCoeff() > coordinate_limit) {
      fail_input(
          fmt::format("{}: vertex {} lies too far out to compute with: ({}, {}, {}); keep coordinates under {} m", name,
                      v, x[0], x[1], x[2], coordinate_limit));
    }
  }
}

/// Indices in range and no vertex twice.
template <std::size_t n>
void check_indices(Index vertex_count, const std::vector<std::array<Index, n>>& elements, std::string_view kind,
                   std::string_view name) {
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const auto& element = elements[i];
    for (std::size_t j = 0; j < n; ++j) {
      if (element[j] < 0 || element[j] >= vertex_count) {
        fail_input(fmt::format("{}: {} refers to vertex {}, but the mesh has {} vertices; use indices 0 to {}", name,
                               describe(kind, i, element), element[j], vertex_count, vertex_count - 1));
      }
      if (std::find(element.begin(), element.begin() + static_cast<std::ptrdiff_t>(j), element[j]) !=
          element.begin() + static_cast<std::ptrdiff_t>(j)) {
        fail_input(fmt::format("{}: {} has vertex {} twice; give it {} different vertices or remove it", name,
                               describe(kind, i, element), element[j], n));
      }
    }
  }
}

void check_edges(const Mesh& mesh, std::string_view name) {
  for (std::size_t i = 0; i < mesh.edges.size(); ++i) {
    if (!has_no_extent(mesh.vertices, mesh.edges[i])) continue;
    fail_input(fmt::format("{}: {} has zero length; move its ends apart or remove it", name,
                           describe("edge", i, mesh.edges[i])));
  }
}

void check_triangles(const Mesh& mesh, std::string_view name) {
  for (std::size_t i = 0; i < mesh.triangles.size(); ++i) {
    if (!has_no_extent(mesh.vertices, mesh.triangles[i])) continue;
    fail_input(fmt::format("{}: {} has zero area; move its vertices off one line or remove it", name,
                           describe("triangle", i, mesh.triangles[i])));
  }
}

void check_tetrahedra(const Mesh& mesh, std::string_view name) {
  for (std::size_t i = 0; i < mesh.tetrahedra.size(); ++i) {
    const Tetrahedron& tetrahedron = mesh.tetrahedra[i];
    if (has_no_extent(mesh.vertices, tetrahedron)) {
      fail_input(fmt::format("{}: {} has zero volume; move its vertices off one plane or remove it", name,
                             describe("tetrahedron", i, tetrahedron)));
    }
    if (const Real volume = volume_of(mesh.vertices, tetrahedron); volume < 0) {
      fail_input(fmt::format("{}: {} is inverted, its volume is {:.3g} m^3; swap two of its vertices", name,
                             describe("tetrahedron", i, tetrahedron), volume));
    }
  }
}

void check_faces(const Mesh& mesh, std::string_view name) {
  const PolygonFaces& faces = mesh.faces;
  const auto corner_count = static_cast<Index>(faces.vertices.size());
  const bool is_partition =
      faces.offsets.empty()
          ? corner_count == 0
          : faces.offsets.front() == 0 && faces.offsets.back() == corner_count && std::ranges::is_sorted(faces.offsets);
  const bool has_all_textures =
      faces.texture_coordinates.empty() || faces.texture_coordinates.size() == faces.vertices.size();
  if (!is_partition || !has_all_textures) {
    fail_input(fmt::format("{}: the polygons' offsets, vertices and texture coordinates do not match; see PolygonFaces",
                           name));
  }
  const auto check_corners = [&](const std::vector<Index>& corners, Index lowest, Eigen::Index end,
                                 std::string_view what) {
    for (std::size_t c = 0; c < corners.size(); ++c) {
      if (corners[c] >= lowest && corners[c] < end) continue;
      fail_input(fmt::format("{}: polygon corner {} refers to {} {}, but the mesh has {}; use indices 0 to {}", name, c,
                             what, corners[c], end, end - 1));
    }
  };
  check_corners(faces.vertices, 0, mesh.vertex_count(), "vertex");
  check_corners(faces.texture_coordinates, -1, mesh.texture_coordinates.rows(), "texture coordinate");
}

}  // namespace

Real triangle_area(const Vec3& x0, const Vec3& x1, const Vec3& x2) {
  return (x1 - x0).cross(x2 - x0).stableNorm() / 2;
}

Real tetrahedron_volume(const Vec3& x0, const Vec3& x1, const Vec3& x2, const Vec3& x3) {
  return (x1 - x0).cross(x2 - x0).dot(x3 - x0) / 6;
}

std::vector<Real> edge_lengths(const Positions& x, std::span<const Edge> edges) {
  std::vector<Real> lengths;
  lengths.reserve(edges.size());
  for (const auto& [a, b] : edges) lengths.push_back((row(x, b) - row(x, a)).norm());
  return lengths;
}

std::vector<Real> triangle_areas(const Positions& x, std::span<const Triangle> triangles) {
  std::vector<Real> areas;
  areas.reserve(triangles.size());
  for (const auto& [a, b, c] : triangles) areas.push_back(triangle_area(row(x, a), row(x, b), row(x, c)));
  return areas;
}

std::vector<Real> tetrahedron_volumes(const Positions& x, std::span<const Tetrahedron> tetrahedra) {
  std::vector<Real> volumes;
  volumes.reserve(tetrahedra.size());
  for (const auto& [a, b, c, d] : tetrahedra) {
    volumes.push_back(tetrahedron_volume(row(x, a), row(x, b), row(x, c), row(x, d)));
  }
  return volumes;
}

Positions triangle_normals(const Positions& x, std::span<const Triangle> triangles) {
  Positions normals(static_cast<Eigen::Index>(triangles.size()), 3);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    const auto& [a, b, c] = triangles[t];
    const Vec3 normal = (row(x, b) - row(x, a)).cross(row(x, c) - row(x, a));
    normals.row(static_cast<Eigen::Index>(t)) = normal.stableNormalized().transpose();
  }
  return normals;
}

std::vector<Real> vertex_areas(const Positions& x, std::span<const Triangle> triangles) {
  std::vector<Real> areas(static_cast<std::size_t>(x.rows()), 0);
  for (const Triangle& triangle : triangles) {
    const Real third = triangle_area(row(x, triangle[0]), row(x, triangle[1]), row(x, triangle[2])) / 3;
    for (Index vertex : triangle) areas[static_cast<std::size_t>(vertex)] += third;
  }
  return areas;
}

BoundingBox bounding_box(const Positions& x) {
  if (x.rows() == 0) return {};
  return {x.colwise().minCoeff().transpose(), x.colwise().maxCoeff().transpose()};
}

bool has_no_extent(const Positions& x, const Edge& edge) {
  const Vec3 a = row(x, edge[0]);
  const Vec3 b = row(x, edge[1]);
  return (b - a).stableNorm() <= 4 * std::numeric_limits<Real>::epsilon() * std::max(a.stableNorm(), b.stableNorm());
}

bool has_no_extent(const Positions& x, const Triangle& triangle) {
  const auto& [a, b, c] = triangle;
  const Real length = longest_edge(x, triangle);
  return triangle_area(row(x, a), row(x, b), row(x, c)) <= flatness_limit * length * length;
}

bool has_no_extent(const Positions& x, const Tetrahedron& tetrahedron) {
  const Real length = longest_edge(x, tetrahedron);
  return std::abs(volume_of(x, tetrahedron)) <= flatness_limit * length * length * length;
}

void check_mesh(const Mesh& mesh, std::string_view name) {
  check_vertices(mesh, name);
  check_indices(mesh.vertex_count(), mesh.edges, "edge", name);
  check_indices(mesh.vertex_count(), mesh.triangles, "triangle", name);
  check_indices(mesh.vertex_count(), mesh.tetrahedra, "tetrahedron", name);
  check_faces(mesh, name);
  check_edges(mesh, name);
  check_triangles(mesh, name);
  check_tetrahedra(mesh, name);
}

}  // namespace pliant
