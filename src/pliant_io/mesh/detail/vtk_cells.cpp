#include "pliant_io/mesh/detail/vtk_cells.h"

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "pliant/mesh/topology.h"
#include "pliant_io/mesh/detail/tetrahedra.h"

namespace pliant {

namespace {

struct OtherVtkCell {
  std::int64_t type;
  std::string_view name;
};

/// What messages call the commonest of the cells that are not read.
constexpr std::array<OtherVtkCell, 16> other_vtk_cells{{{11, "a voxel"},
                                                        {12, "a hexahedron"},
                                                        {13, "a wedge"},
                                                        {14, "a pyramid"},
                                                        {15, "a pentagonal prism"},
                                                        {16, "a hexagonal prism"},
                                                        {21, "a quadratic edge"},
                                                        {22, "a quadratic triangle"},
                                                        {23, "a quadratic quadrilateral"},
                                                        {24, "a quadratic tetrahedron"},
                                                        {25, "a quadratic hexahedron"},
                                                        {42, "a polyhedron"},
                                                        {68, "a Lagrange curve"},
                                                        {69, "a Lagrange triangle"},
                                                        {71, "a Lagrange tetrahedron"},
                                                        {78, "a Bezier tetrahedron"}}};

std::string refuse_vtk_cell(std::int64_t type) {
  const auto* found = std::ranges::find(other_vtk_cells, type, &OtherVtkCell::type);
  const std::string name = found == other_vtk_cells.end() ? std::string("a cell") : std::string(found->name);
  return fmt::format("{} (type {}); save lines, triangles, quadrilaterals, polygons and tetrahedra of first order",
                     name, type);
}

/// How many corners a cell of that type has; none where any number will do.
std::optional<std::size_t> vtk_corner_count(std::int64_t type) {
  if (type == vtk_cell::line) return 2;
  if (type == vtk_cell::triangle) return 3;
  if (type == vtk_cell::pixel || type == vtk_cell::quad || type == vtk_cell::tetrahedron) return 4;
  return {};
}

}  // namespace

std::string VtkCellBuilder::add(std::int64_t type, std::span<const Index> corners) {
  if (type >= 0 && type <= vtk_cell::vertices) return {};  // nothing, or vertices that are there already
  if (type < 0 || type > vtk_cell::tetrahedron) return refuse_vtk_cell(type);
  if (const auto count = vtk_corner_count(type); count && *count != corners.size()) {
    return fmt::format("{} corners for a cell of type {}, which has {}; correct it", corners.size(), type, *count);
  }
  if (type == vtk_cell::line || type == vtk_cell::polyline) return add_lines(corners);
  if (type == vtk_cell::strip) return add_strip(corners);
  if (type == vtk_cell::pixel) return add_face(std::array{corners[0], corners[1], corners[3], corners[2]});
  if (type != vtk_cell::tetrahedron) return add_face(corners);
  return add_tetrahedron(mesh_, {corners[0], corners[1], corners[2], corners[3]}, 0);
}

std::string VtkCellBuilder::add_lines(std::span<const Index> corners) {
  if (corners.size() < 2) return fmt::format("a line of {} vertices; give it at least 2", corners.size());
  for (std::size_t i = 1; i < corners.size(); ++i) {
    if (corners[i - 1] == corners[i]) return fmt::format("a line from vertex {} to itself; remove it", corners[i]);
    mesh_.edges.push_back({corners[i - 1], corners[i]});
  }
  return {};
}

/// Every vertex makes a triangle with the two before it, turned the other way each time. A triangle with a vertex twice
/// only serves to turn the strip around.
std::string VtkCellBuilder::add_strip(std::span<const Index> corners) {
  if (corners.size() < 3) return fmt::format("a strip of {} vertices; give it at least 3", corners.size());
  for (std::size_t i = 2; i < corners.size(); ++i) {
    std::array triangle = {corners[i - 2], corners[i - 1], corners[i]};
    if (triangle[0] == triangle[1] || triangle[1] == triangle[2] || triangle[0] == triangle[2]) continue;
    if (i % 2 == 1) std::swap(triangle[0], triangle[1]);
    if (std::string message = add_face(triangle); !message.empty()) return message;
  }
  return {};
}

std::string VtkCellBuilder::add_face(std::span<const Index> corners) {
  for (const Index corner : corners) polygons_.add_corner(corner);
  return polygons_.finish_face();
}

void VtkCellBuilder::finish() {
  polygons_.finish();
  if (!mesh_.tetrahedra.empty()) {
    mesh_.triangles = {};
    mesh_.faces = {};
  }
  if (mesh_.edges.empty() || (mesh_.triangles.empty() && mesh_.tetrahedra.empty())) return;
  std::vector<Edge> lines = std::exchange(mesh_.edges, {});
  const std::vector<Edge> borders = unique_edges(mesh_);
  std::erase_if(lines, [&](const Edge& line) {
    return std::ranges::binary_search(borders, Edge{std::min(line[0], line[1]), std::max(line[0], line[1])});
  });
  mesh_.edges = std::move(lines);
}

}  // namespace pliant
