#include "pliant_io/export/detail/gltf_surface.h"

#include <map>
#include <numeric>
#include <utility>

#include "pliant/mesh/topology.h"

namespace pliant {
namespace {

std::vector<Triangle> surface_triangles(const Mesh& mesh) {
  return mesh.triangles.empty() ? boundary_triangles(mesh.tetrahedra) : mesh.triangles;
}

/// Numbers pairs of a vertex and a row of texture coordinates in the order of their first use.
class Corners {
 public:
  explicit Corners(const Mesh& mesh, GltfSurface& surface) : mesh_(mesh), surface_(surface) {}

  Index index(Index vertex, Index row) {
    const auto [entry, is_new] = indices_.try_emplace({vertex, row}, static_cast<Index>(surface_.vertices.size()));
    if (is_new) {
      surface_.vertices.push_back(vertex);
      surface_.texture.push_back(coordinates(row));
    }
    return entry->second;
  }

  /// One that is there already, if there is one.
  Index any_index(Index vertex) {
    const auto entry = indices_.lower_bound({vertex, -1});
    return entry != indices_.end() && entry->first.first == vertex ? entry->second : index(vertex, -1);
  }

 private:
  std::array<float, 2> coordinates(Index row) const {
    if (row < 0) return {0, 0};
    const auto pair = mesh_.texture_coordinates.row(row).cast<float>().eval();
    return {pair[0], 1 - pair[1]};
  }

  const Mesh& mesh_;
  GltfSurface& surface_;
  std::map<std::pair<Index, Index>, Index> indices_;
};

}  // namespace

GltfSurface::GltfSurface(const Mesh& mesh) {
  if (mesh.faces.texture_coordinates.empty()) {
    vertices.resize(static_cast<std::size_t>(mesh.vertex_count()));
    std::iota(vertices.begin(), vertices.end(), 0);
    for (const Triangle& triangle : surface_triangles(mesh)) {
      triangles.insert(triangles.end(), triangle.begin(), triangle.end());
    }
    for (const Edge& edge : mesh.edges) lines.insert(lines.end(), edge.begin(), edge.end());
    return;
  }
  Corners corners(mesh, *this);
  const PolygonFaces& faces = mesh.faces;
  for (std::size_t face = 1; face < faces.offsets.size(); ++face) {
    const auto first = static_cast<std::size_t>(faces.offsets[face - 1]);
    const auto last = static_cast<std::size_t>(faces.offsets[face]);
    const auto add = [&](std::size_t corner) {
      triangles.push_back(corners.index(faces.vertices[corner], faces.texture_coordinates[corner]));
    };
    for (std::size_t corner = first + 2; corner < last; ++corner) {
      add(first);
      add(corner - 1);
      add(corner);
    }
  }
  for (const Edge& edge : mesh.edges) {
    for (const Index vertex : edge) lines.push_back(corners.any_index(vertex));
  }
}

Positions vertex_normals(const Mesh& mesh, const Positions& positions) {
  Positions normals = Positions::Zero(positions.rows(), 3);
  for (const Triangle& triangle : surface_triangles(mesh)) {
    const Vec3 corner = row(positions, triangle[0]);
    const Vec3 normal = (row(positions, triangle[1]) - corner).cross(row(positions, triangle[2]) - corner);
    for (const Index vertex : triangle) normals.row(vertex) += normal.transpose();
  }
  for (Index v = 0; v < normals.rows(); ++v) {
    const Vec3 unit = row(normals, v).stableNormalized();
    const bool is_unit = std::abs(unit.norm() - 1) < 1e-6;  // not where it is zero or too large
    normals.row(v) = is_unit ? unit.transpose() : Eigen::RowVector3d(0, 0, 1);
  }
  return normals;
}

SplitCorners::SplitCorners(const Mesh& surface, const Positions& corner_normals) {
  constexpr Real fineness = 200;  // normals that differ by less than its inverse are one
  std::map<std::array<Index, 4>, Index> numbers;
  std::vector<std::pair<Index, Eigen::Index>> kept;  // vertex and corner
  Eigen::Index corner = 0;
  for (const Triangle& triangle : surface.triangles) {
    for (const Index vertex : triangle) {
      const auto part = [&](int axis) {
        return static_cast<Index>(std::lround(fineness * corner_normals(corner, axis)));
      };
      const auto [found, is_new] = numbers.try_emplace({vertex, part(0), part(1), part(2)}, count_of(kept));
      if (is_new) kept.emplace_back(vertex, corner);
      triangles.push_back(found->second);
      ++corner;
    }
  }
  positions.resize(static_cast<Eigen::Index>(kept.size()), 3);
  normals.resize(static_cast<Eigen::Index>(kept.size()), 3);
  for (std::size_t i = 0; i < kept.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    positions.row(row) = surface.vertices.row(kept[i].first);
    normals.row(row) = corner_normals.row(kept[i].second);
  }
}

}  // namespace pliant
