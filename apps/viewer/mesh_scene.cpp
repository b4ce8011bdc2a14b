#include "viewer/mesh_scene.h"

#include <algorithm>
#include <functional>
#include <numeric>

#include <fmt/format.h>

#include "pliant/constraints/builtin.h"
#include "pliant/core/printable.h"
#include "pliant/forces/gravity.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/topology.h"

namespace pliant_viewer {
namespace {

using pliant::Index;
using pliant::Mesh;
using pliant::Real;

enum class Kind { solid, skin, cloth, ropes };

/// What a kind is made of, for a body of about a meter.
struct Material {
  std::string_view text;
  Real mass;       // [kg]
  Real stiffness;  // of springs and triangles [N/m], of tetrahedra [Pa]
  Real bending;    // [N·m]
  Index iterations;
};

Material material_of(Kind kind) {
  switch (kind) {
    case Kind::solid:
      return {"a soft solid", 5, 2e4, 0, 20};
    case Kind::skin:
      return {"a skin", 1, 2e3, 0.5, 20};
    case Kind::cloth:
      return {"cloth", 0.3, 1e3, 1e-3, 10};
    case Kind::ropes:
      break;
  }
  return {"ropes", 0.3, 1e4, 0, 20};
}

Kind kind_of(const Mesh& mesh) {
  if (!mesh.tetrahedra.empty()) return Kind::solid;
  if (mesh.triangles.empty()) return Kind::ropes;
  return pliant::boundary_edges(mesh).empty() ? Kind::skin : Kind::cloth;
}

/// The highest vertices, or the lowest: those in a band of some share of the height, and at least some share of all.
std::vector<Index> band(const Mesh& mesh, bool at_top, Real share_of_height, Real share_of_vertices) {
  constexpr Index least = 3;
  const Real sign = at_top ? 1 : -1;
  std::vector<Index> vertices(static_cast<std::size_t>(mesh.vertex_count()));
  std::iota(vertices.begin(), vertices.end(), Index{0});
  std::ranges::stable_sort(vertices, std::greater{}, [&](Index i) { return sign * mesh.vertices(i, 2); });
  const pliant::BoundingBox box = pliant::bounding_box(mesh.vertices);
  const Real edge = sign * mesh.vertices(vertices.front(), 2) - share_of_height * (box.max.z() - box.min.z());
  const auto in_band = static_cast<std::size_t>(
      std::ranges::count_if(vertices, [&](Index i) { return sign * mesh.vertices(i, 2) >= edge; }));
  const auto wanted = std::max<std::size_t>(
      least, static_cast<std::size_t>(share_of_vertices * static_cast<Real>(mesh.vertex_count())));
  vertices.resize(std::min(vertices.size(), std::max(in_band, wanted)));
  std::ranges::sort(vertices);
  return vertices;
}

/// The vertices nearest to the four corners of the box, seen from above.
std::vector<Index> corners(const Mesh& mesh) {
  const pliant::BoundingBox box = pliant::bounding_box(mesh.vertices);
  std::vector<Index> vertices;
  for (const Real x : {box.min.x(), box.max.x()}) {
    for (const Real y : {box.min.y(), box.max.y()}) {
      Index nearest = 0;
      (mesh.vertices.leftCols(2).rowwise() - Eigen::RowVector2d(x, y)).rowwise().squaredNorm().minCoeff(&nearest);
      vertices.push_back(nearest);
    }
  }
  std::ranges::sort(vertices);
  vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
  return vertices;
}

std::vector<Index> pins_of(const Mesh& mesh, Kind kind) {
  const pliant::BoundingBox box = pliant::bounding_box(mesh.vertices);
  if (kind == Kind::solid || kind == Kind::skin) return band(mesh, false, 0.03, 0.02);
  if (box.max.z() - box.min.z() < 0.02 * box.diagonal()) return corners(mesh);
  return band(mesh, true, 0.01, 0.005);
}

void add_constraints(pliant::Simulation& simulation, pliant::BodyId body, Kind kind, const Material& material) {
  const Mesh& mesh = simulation.body(body).mesh;
  simulation.add(body, pliant::Position{.on = pins_of(mesh, kind)}, "pins");
  if (kind == Kind::solid) {
    simulation.add(body, pliant::TetrahedronStrain{.stiffness = material.stiffness}, "solid");
    return;
  }
  if (!mesh.triangles.empty()) {
    simulation.add(body, pliant::TriangleStrain{.stiffness = material.stiffness}, "stretch");
    pliant::HingeBending bending{.stiffness = material.bending};
    if (kind == Kind::skin) bending.orientation = pliant::Orientation::signed_;
    simulation.add(body, bending, "bend");
  }
  if (mesh.edges.empty()) return;
  pliant::EdgeSpring ropes{.stiffness = material.stiffness};
  for (const pliant::Edge& edge : mesh.edges) ropes.stencils.add(std::span<const Index>(edge));
  simulation.add(body, ropes, "ropes");
}

Mesh read_of_a_good_size(const std::filesystem::path& file, const pliant::ImportOptions& import, std::string& remark) {
  constexpr Real shortest = 0.2, longest = 5;
  Mesh mesh = pliant::read_mesh(file, import);
  if (mesh.vertex_count() == 0) return mesh;
  const pliant::BoundingBox box = pliant::bounding_box(mesh.vertices);
  const Real length = (box.max - box.min).maxCoeff();
  if (import.scale != 1 || !(length > 0) || (length >= shortest && length <= longest)) return mesh;
  mesh.vertices /= length;
  remark = fmt::format("; it is {:.3g} units long and shown 1 m long, --scale takes other meters for a unit", length);
  return mesh;
}

}  // namespace

pliant::Scene make_mesh_scene(const std::filesystem::path& file, const pliant::ImportOptions& import) {
  pliant::Scene scene;
  scene.name = file.stem().string();
  std::string remark;
  Mesh mesh = read_of_a_good_size(file, import, remark);
  const Kind kind = kind_of(mesh);
  const Material material = material_of(kind);
  // A little for vertices that no element has.
  const auto count = static_cast<Real>(std::max<Index>(mesh.vertex_count(), 1));
  const pliant::Mass mass = pliant::Mass::total(material.mass) + pliant::Mass::per_vertex(1e-3 * material.mass / count);
  scene.description = fmt::format("{}: {} of {} vertices{}", pliant::printable_place(file.string()), material.text,
                                  mesh.vertex_count(), remark);
  scene.simulation.set_settings({.iterations = material.iterations});
  const pliant::BodyId body = scene.simulation.add_body(std::move(mesh), mass, {.name = scene.name});
  add_constraints(scene.simulation, body, kind, material);
  scene.simulation.add_force(std::make_unique<pliant::Gravity>());
  return scene;
}

}  // namespace pliant_viewer
