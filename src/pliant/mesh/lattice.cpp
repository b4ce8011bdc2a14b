#include "pliant/mesh/lattice.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/mesh/closed_surface.h"
#include "pliant/mesh/detail/lattice_filling.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/nearest_vertex.h"

namespace pliant {
namespace {

/// Thickness of the layer whose mass the surface's own vertices have, in units of the spacing, and the largest share of
/// the whole that it is.
constexpr Real layer_thickness = 0.125;
constexpr Real largest_layer = 0.25;
/// Of what a vertex of the lattice holds, the share that it keeps at least, and of a cube, what it has at least.
constexpr Real least_kept = 0.1;
constexpr Real least_volume = 1e-4;

Real cubes_across(Real size, Real spacing) {
  return 2 * std::ceil(size / (2 * spacing) + 1e-9) + 2;
}

Real cubes_for(const Vec3& size, Real spacing) {
  return cubes_across(size[0], spacing) * cubes_across(size[1], spacing) * cubes_across(size[2], spacing);
}

void check_spacing(const Vec3& size, Real spacing, std::string_view name) {
  if (spacing > size.maxCoeff()) {
    fail_input(
        fmt::format("{}: the spacing of {:.4g} m is more than the body's largest side, {:.4g} m; give at most "
                    "half of its thickness",
                    name, spacing, size.maxCoeff()));
  }
  if (cubes_for(size, spacing) <= max_lattice_cubes) return;
  Real allowed = spacing;
  while (cubes_for(size, allowed) > max_lattice_cubes) allowed *= 1.02;
  fail_input(
      fmt::format("{}: a spacing of {:.4g} m asks for {:.3g} cubes of the lattice in the box of {:.3g} x {:.3g} "
                  "x {:.3g} m around the surface, and {:.3g} are allowed; give {:.2g} m or more",
                  name, spacing, cubes_for(size, spacing), size[0], size[1], size[2], max_lattice_cubes, allowed));
}

/// The middle of the box is a corner of cubes, so that what is symmetric stays so.
LatticeGrid grid_around(const BoundingBox& box, Real spacing) {
  std::array<Index, 3> counts{};
  Vec3 origin;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const auto i = static_cast<Eigen::Index>(axis);
    counts[axis] = static_cast<Index>(cubes_across(box.max[i] - box.min[i], spacing));
    origin[i] = (box.min[i] + box.max[i]) / 2 - spacing * counts[axis] / 2;
  }
  return {origin, spacing, counts};
}

/// Turns polygons where their triangles have been turned: each polygon is the fan of a row of triangles.
void turn_polygons(const std::vector<Triangle>& before, const std::vector<Triangle>& after, PolygonFaces& faces) {
  std::size_t triangle = 0;
  for (Index f = 0; f < faces.face_count(); ++f) {
    const auto first = faces.offsets[at(f)], last = faces.offsets[at(f) + 1];
    if (triangle < before.size() && before[triangle] != after[triangle]) {
      std::reverse(faces.vertices.begin() + first + 1, faces.vertices.begin() + last);
      if (!faces.texture_coordinates.empty()) {
        std::reverse(faces.texture_coordinates.begin() + first + 1, faces.texture_coordinates.begin() + last);
      }
    }
    triangle += static_cast<std::size_t>(std::max<Index>(last - first - 2, 0));
  }
}

/// Numbers the lattice's vertices that tetrahedra have and makes the mesh.
class SolidMaker {
 public:
  SolidMaker(Mesh& mesh, const LatticeGrid& grid, const LatticeFilling& filling)
      : mesh_(mesh), grid_(grid), filling_(filling), surface_count_(mesh.vertex_count()) {}

  void make() {
    const std::vector<LatticeGrid::Point> points = places_of_surface();
    std::vector<char> is_kept(static_cast<std::size_t>(grid_.tetrahedron_count()), 0);
    for (std::size_t t = 0; t < is_kept.size(); ++t) is_kept[t] = filling_.volumes[t] > 0 ? 1 : 0;
    for (const LatticeGrid::Point& point : points) is_kept[static_cast<std::size_t>(point.tetrahedron)] = 1;
    number_vertices(is_kept);
    std::vector<Index> number_of(is_kept.size(), -1);
    for (std::size_t t = 0; t < is_kept.size(); ++t) {
      if (is_kept[t] == 0) continue;
      number_of[t] = count_of(mesh_.tetrahedra);
      Tetrahedron corners{};
      const auto of_grid = grid_.oriented_corners(static_cast<std::int64_t>(t));
      for (std::size_t i = 0; i < 4; ++i) corners[i] = number_[static_cast<std::size_t>(of_grid[i])];
      mesh_.tetrahedra.push_back(corners);
      const Real share = filling_.volumes[t] / grid_.tetrahedron_volume();
      mesh_.embedding.filled.push_back(std::clamp<Real>(share, least_filled_share, 1));
    }
    for (const LatticeGrid::Point& point : points) carry(point, number_of);
  }

 private:
  std::vector<LatticeGrid::Point> places_of_surface() const {
    std::vector<LatticeGrid::Point> points;
    points.reserve(at(surface_count_));
    for (Index v = 0; v < surface_count_; ++v) {
      const Vec3 place = grid_.inside(row(mesh_.vertices, v));
      const std::array<Index, 3> cube = grid_.cube_at(place);
      points.push_back(grid_.locate(cube, place - Vec3(cube[0] + 0.5, cube[1] + 0.5, cube[2] + 0.5)));
    }
    return points;
  }

  void number_vertices(const std::vector<char>& is_kept) {
    number_.assign(static_cast<std::size_t>(grid_.vertex_count()), -1);
    for (std::size_t t = 0; t < is_kept.size(); ++t) {
      if (is_kept[t] == 0) continue;
      for (const std::int64_t v : grid_.oriented_corners(static_cast<std::int64_t>(t))) {
        number_[static_cast<std::size_t>(v)] = 0;
      }
    }
    Index count = surface_count_;
    for (Index& number : number_) {
      if (number == 0) number = count++;
    }
    mesh_.vertices.conservativeResize(count, 3);
    mesh_.embedding.volumes.assign(at(count), 0);
    for (std::size_t v = 0; v < number_.size(); ++v) {
      if (number_[v] < 0) continue;
      mesh_.vertices.row(number_[v]) = grid_.position(static_cast<std::int64_t>(v)).transpose();
      mesh_.embedding.volumes[at(number_[v])] = filling_.vertex_volumes[v];
    }
  }

  void carry(const LatticeGrid::Point& point, const std::vector<Index>& number_of) {
    const Index number = number_of[static_cast<std::size_t>(point.tetrahedron)];
    std::array<Real, 4> weights{};
    for (std::size_t i = 0; i < 4; ++i) {
      const Index corner = number_[static_cast<std::size_t>(point.corners[i])];
      const Tetrahedron& corners = mesh_.tetrahedra[at(number)];
      weights[static_cast<std::size_t>(std::ranges::find(corners, corner) - corners.begin())] = point.weights[i];
    }
    mesh_.embedding.tetrahedra.push_back(number);
    mesh_.embedding.weights.push_back(weights);
  }

  Mesh& mesh_;
  const LatticeGrid& grid_;
  const LatticeFilling& filling_;
  Index surface_count_;
  std::vector<Index> number_;  ///< in the mesh, of each vertex of the grid; −1: none
};

/// Takes the volume of a layer under the surface from the lattice to the surface's vertices, by their weights.
void share_out_layer(const ClosedSurface& surface, Real spacing, Mesh& mesh) {
  Embedding& embedding = mesh.embedding;
  std::vector<Real>& volumes = embedding.volumes;
  const Real thickness = std::min(layer_thickness * spacing, largest_layer * surface.volume / surface.area);
  std::vector<Real> least = volumes;
  const Real cube = spacing * spacing * spacing;
  for (Real& volume : least) volume = std::max(least_kept * volume, least_volume * cube);
  const std::vector<Real> areas = vertex_areas(mesh.vertices, surface.triangles);
  for (Index v = 0; v < embedding.carried_count(); ++v) {
    volumes[at(v)] = thickness * areas[at(v)];
    const Tetrahedron& corners = mesh.tetrahedra[at(embedding.tetrahedra[at(v)])];
    for (std::size_t i = 0; i < 4; ++i) volumes[at(corners[i])] -= embedding.weights[at(v)][i] * volumes[at(v)];
  }
  for (std::size_t v = 0; v < volumes.size(); ++v) {
    if (v >= at(embedding.carried_count())) volumes[v] = std::max(volumes[v], least[v]);
  }
}

void scale_to(Real sum, std::vector<Real>& values) {
  const Real factor = sum / std::accumulate(values.begin(), values.end(), Real{0});
  for (Real& value : values) value *= factor;
}

void extend_maps(Index surface_count, Mesh& mesh) {
  if (mesh.maps.empty()) return;
  const NearestVertex nearest(mesh.vertices.topRows(surface_count));
  for (Index v = surface_count; v < mesh.vertex_count(); ++v) {
    const Index found = nearest(row(mesh.vertices, v));
    for (VertexMap& map : mesh.maps) map.values.push_back(map.values[at(found)]);
  }
}

}  // namespace

Mesh lattice_solid(Mesh mesh, const LatticeOptions& options, std::string_view name) {
  check_options(name, options);
  ClosedSurface surface = closed_surface(mesh, name);
  const BoundingBox box = bounding_box(mesh.vertices);
  check_spacing(box.max - box.min, options.spacing, name);
  const LatticeGrid grid = grid_around(box, options.spacing);
  const LatticeFilling filling = fill_lattice(grid, mesh.vertices, surface, name);
  surface.volume = filling.volume;
  const Index surface_count = mesh.vertex_count();
  turn_polygons(mesh.triangles, surface.triangles, mesh.faces);
  mesh.triangles = surface.triangles;
  mesh.embedding.spacing = options.spacing;
  SolidMaker(mesh, grid, filling).make();
  share_out_layer(surface, options.spacing, mesh);
  scale_to(filling.volume, mesh.embedding.volumes);
  extend_maps(surface_count, mesh);
  return mesh;
}

Real filled_share(const Mesh& mesh) {
  const std::vector<Real>& filled = mesh.embedding.filled;
  if (filled.empty()) return 1;
  return std::accumulate(filled.begin(), filled.end(), Real{0}) / static_cast<Real>(filled.size());
}

}  // namespace pliant
