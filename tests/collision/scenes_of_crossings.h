#pragma once
// Surfaces for tests of crossings, and what is counted there.
#include <algorithm>
#include <vector>

#include "pliant/collision/crossings.h"
#include "pliant/mesh/mesh.h"
#include "tests/core/random.h"
#include "tests/mesh/meshes.h"

namespace pliant_tests {

inline pliant::Crossings crossings_of(const pliant::Mesh& mesh, std::size_t most = 1000000) {
  const std::vector<pliant::Triangle> triangles = pliant::surface_triangles(mesh);
  return pliant::find_crossings({mesh.vertices, triangles, mesh.edges}, most);
}

inline std::int64_t crossing_count(const pliant::Mesh& mesh) {
  return crossings_of(mesh, 0).count;
}

inline pliant::Mesh moved(pliant::Mesh mesh, const pliant::Vec3& way) {
  mesh.vertices.rowwise() += way.transpose();
  return mesh;
}

inline pliant::Mesh turned(pliant::Mesh mesh, const pliant::Mat3& rotation) {
  mesh.vertices = (mesh.vertices * rotation.transpose()).eval();
  return mesh;
}

/// columns × rows unit cells in the plane of two of the axes, with whole coordinates from the origin on.
inline pliant::Mesh whole_grid(int columns, int rows, int first_axis, int second_axis) {
  pliant::Mesh mesh;
  mesh.vertices = pliant::Positions::Zero((columns + 1) * (rows + 1), 3);
  const auto vertex = [&](int i, int j) { return pliant::Index{j * (columns + 1) + i}; };
  for (int j = 0; j <= rows; ++j) {
    for (int i = 0; i <= columns; ++i) {
      mesh.vertices(vertex(i, j), first_axis) = i;
      mesh.vertices(vertex(i, j), second_axis) = j;
      if (i == columns || j == rows) continue;
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1)});
      mesh.triangles.push_back({vertex(i, j), vertex(i + 1, j + 1), vertex(i, j + 1)});
    }
  }
  return mesh;
}

/// The surface of a tetrahedron.
inline pliant::Mesh tetrahedron_surface(const std::array<pliant::Vec3, 4>& corners) {
  pliant::Mesh mesh = mesh_of({}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}});
  mesh.vertices.resize(4, 3);
  for (pliant::Index v = 0; v < 4; ++v) mesh.vertices.row(v) = corners[static_cast<std::size_t>(v)].transpose();
  return mesh;
}

/// Triangles of their own, `size` across, within the unit cube.
inline pliant::Mesh soup(Random& random, pliant::Index count, pliant::Real size) {
  pliant::Mesh mesh;
  mesh.vertices.resize(3 * count, 3);
  for (pliant::Index t = 0; t < count; ++t) {
    const pliant::Vec3 middle = random.vector(1);
    for (pliant::Index i = 0; i < 3; ++i) mesh.vertices.row(3 * t + i) = (middle + random.vector(size)).transpose();
    mesh.triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  return mesh;
}

/// The same surface with vertices and triangles in another order, and some triangles turned.
inline pliant::Mesh shuffled(const pliant::Mesh& mesh, Random& random) {
  std::vector<pliant::Index> place(pliant::at(mesh.vertex_count()));
  for (std::size_t v = 0; v < place.size(); ++v) place[v] = static_cast<pliant::Index>(v);
  const auto shuffle = [&](auto& list) {
    for (std::size_t i = list.size(); i > 1; --i) {
      std::swap(list[i - 1], list[pliant::at(random.index(static_cast<pliant::Index>(i)))]);
    }
  };
  shuffle(place);
  pliant::Mesh result;
  result.vertices.resize(mesh.vertices.rows(), 3);
  for (pliant::Index v = 0; v < mesh.vertex_count(); ++v)
    result.vertices.row(place[pliant::at(v)]) = mesh.vertices.row(v);
  for (const auto& [a, b, c] : mesh.triangles) {
    result.triangles.push_back({place[pliant::at(a)], place[pliant::at(b)], place[pliant::at(c)]});
    if (random.index(2) == 0) std::swap(result.triangles.back()[0], result.triangles.back()[1]);
  }
  shuffle(result.triangles);
  return result;
}

}  // namespace pliant_tests
