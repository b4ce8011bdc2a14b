#include "tests/pairs/masonry_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/pairs/parts.h"

namespace pliant_tests {

using namespace pliant;

namespace {

constexpr Real stone = 1e8;  // against strain [Pa]

/// Cells a side of boxes of so many vertices.
Index cells_of_box(Index vertices) {
  return std::max(Index{1}, static_cast<Index>(std::lround(std::cbrt(vertices))) - 1);
}

struct Wedge {
  Real from = 0, to = 0;  ///< angles from the horizontal [rad]
  Real gap = 0;           ///< between it and the next, half of it on either side [m]
};

/// The faces towards the neighbors are parallel to theirs.
Mesh wedge_mesh(const Wedge& wedge, Index cells) {
  constexpr Real inner = 0.9, thickness = 0.2, depth = 0.3;
  Mesh mesh = bar({.cells = {cells, cells, cells}, .size = {1, 1, 1}});
  const auto along = [](Real angle) { return Vec3(std::cos(angle), 0, std::sin(angle)); };
  const auto across = [](Real angle) { return Vec3(-std::sin(angle), 0, std::cos(angle)); };
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 x = row(mesh.vertices, i);
    const Real share = x.z();  // of the way round
    const Vec3 offset = wedge.gap / 2 * ((1 - share) * across(wedge.from) - share * across(wedge.to));
    const Real radius = inner + thickness * x.x();
    const Vec3 place = radius * along(wedge.from + share * (wedge.to - wedge.from)) + offset;
    mesh.vertices.row(i) = (place + Vec3(0, depth * (x.y() - 0.5), 0)).transpose();
  }
  return mesh;
}

}  // namespace

PairScene tower(const PairOptions& options, Index boxes) {
  PairScene scene{empty_simulation(options), 5};
  const Index cells = cells_of_box(options.vertices / boxes);
  Mesh box = bar({.cells = {cells, cells, cells}, .size = {0.2, 0.2, 0.2}});
  PairOptions exact = options;
  exact.contact.distance = options.distance_scale * 0.005;
  exact.distance_scale = 1;
  for (Index i = 0; i < boxes; ++i) {
    put_lowest_at(box, 0.2 * i + exact.contact.distance * (i + 1));
    add_rubber(scene.simulation, box, stone);
  }
  scene.simulation.add(PlaneCollider{}, "floor");
  finish(scene, exact);
  return scene;
}

PairScene tower_of_20(const PairOptions& options) {
  return tower(options, 20);
}

PairScene arch(const PairOptions& options, Index wedges) {
  PairScene scene{empty_simulation(options), 5};
  const Index cells = cells_of_box(options.vertices / wedges);
  PairOptions exact = options;
  exact.contact.distance = options.distance_scale * 0.005;
  exact.distance_scale = 1;
  for (Index i = 0; i < wedges; ++i) {
    const Real angle = std::numbers::pi / wedges;
    add_rubber(scene.simulation,
               wedge_mesh({.from = i * angle, .to = (i + 1) * angle, .gap = exact.contact.distance}, cells), stone);
  }
  scene.simulation.add(PlaneCollider{.position = {0, 0, -exact.contact.distance / 2}}, "floor");
  finish(scene, exact);
  return scene;
}

PairScene arch_of_11(const PairOptions& options) {
  return arch(options, 11);
}

Standing standing(const Simulation& simulation) {
  Standing result{.highest = -1e9};
  for (const Body& body : simulation.bodies()) {
    const Vec3 now =
        simulation.state().positions.middleRows(body.first_vertex, body.mesh.vertex_count()).colwise().mean();
    const Vec3 moved = now - Vec3(body.mesh.vertices.colwise().mean());
    result.highest = std::max(result.highest, now.z());
    result.sag = std::max(result.sag, -moved.z());
    result.sideways = std::max(result.sideways, moved.head<2>().norm());
  }
  result.fastest = simulation.state().velocities.rowwise().norm().maxCoeff();
  return result;
}

}  // namespace pliant_tests
