#include "tests/pairs/parts.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace pliant_tests {

using namespace pliant;

namespace {

BodyId add_moving(Simulation& simulation, const Mesh& mesh, const Mass& mass, const Vec3& velocity) {
  return simulation.add_body(mesh, mass, {.velocities = velocity.transpose().replicate(mesh.vertex_count(), 1)});
}

}  // namespace

Index side_of(Index count, Real share) {
  return std::max(Index{4}, static_cast<Index>(std::lround(std::sqrt(count / share))));
}

Mesh sheet_mesh(Index n, Real width, const Vec3& corner, Plane plane, Index rows) {
  if (rows == 0) rows = n;
  Mesh mesh = grid({.columns = n,
                    .rows = rows,
                    .size = {width, width * (rows - 1) / (n - 1)},
                    .plane = plane,
                    .diagonals = Diagonals::alternating});
  mesh.vertices.rowwise() += corner.transpose();
  return mesh;
}

std::vector<Index> border_of(Index n) {
  std::vector<Index> border;
  for (Index j = 0; j < n; ++j) {
    for (Index i = 0; i < n; ++i) {
      if (i == 0 || j == 0 || i == n - 1 || j == n - 1) border.push_back(j * n + i);
    }
  }
  return border;
}

Mesh cube_mesh(Index cells, Real size) {
  Mesh mesh = bar({.cells = {cells, cells, cells}, .size = {size, size, size}});
  mesh.vertices.array() -= size / 2;
  return mesh;
}

Mesh ball_mesh(Index cells, Real size) {
  Mesh mesh = cube_mesh(cells, size);
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 x = row(mesh.vertices, i) * (2 / size);
    const Vec3 s = x.cwiseAbs2();
    Vec3 round;
    for (int a = 0; a < 3; ++a) {
      const Real b = s[(a + 1) % 3], c = s[(a + 2) % 3];
      round[a] = x[a] * std::sqrt(1 - b / 2 - c / 2 + b * c / 3);
    }
    mesh.vertices.row(i) = (0.2 * x + 0.8 * round).transpose() * (size / 2);
  }
  return mesh;
}

Real usual_distance(const Mesh& mesh) {
  Simulation probe;
  return probe.contact_distance(probe.add_body(mesh, Mass::per_vertex(1)));
}

void put_lowest_at(Mesh& mesh, Real z) {
  mesh.vertices.col(2).array() += z - mesh.vertices.col(2).minCoeff();
}

BodyId add_cloth(Simulation& simulation, const Mesh& mesh, const Vec3& velocity) {
  const BodyId body = add_moving(simulation, mesh, Mass::area_density(0.2), velocity);
  simulation.add(body, TriangleStrain{.stiffness = 1e3});
  simulation.add(body, Bending{.stiffness = 1e-5});
  return body;
}

BodyId add_rubber(Simulation& simulation, const Mesh& mesh, Real stiffness, const Vec3& velocity) {
  const BodyId body = add_moving(simulation, mesh, Mass::density(1100), velocity);
  simulation.add(body, TetrahedronStrain{.stiffness = stiffness});
  return body;
}

BodyId add_rope(Simulation& simulation, const Mesh& mesh, const Vec3& velocity) {
  const BodyId body = add_moving(simulation, mesh, Mass::line_density(0.06), velocity);
  simulation.add(body, EdgeSpring{.stiffness = 1e4});
  return body;
}

Vec3 falling(const PairOptions& options) {
  return {0, 0, -options.speed};
}

Simulation empty_simulation(const PairOptions& options, const Vec3& gravity) {
  Simulation simulation(options.settings);
  if (!gravity.isZero()) simulation.add(Gravity{.acceleration = gravity});
  return simulation;
}

void add_drag(PairScene& scene, std::size_t body, Real stiffness) {
  const Body& dragged = scene.simulation.bodies()[body];
  const Index vertex = dragged.mesh.vertex_count() / 2;
  const Vec3 begin = row(scene.simulation.state().positions, dragged.first_vertex + vertex);
  const GroupId drag =
      scene.simulation.add(static_cast<BodyId>(body), Drag{.stencils = {{vertex}}, .stiffness = stiffness});
  scene.move = [drag, begin, before = scene.move](Simulation& simulation) {
    if (before) before(simulation);
    const Real angle = 2 * std::numbers::pi * (simulation.state().time + simulation.settings().time_step);
    simulation.set_target(drag, 0, begin + 0.3 * Vec3(std::sin(angle), 0, 1 - std::cos(angle)));
  };
}

void finish(PairScene& scene, const PairOptions& options) {
  Simulation& simulation = scene.simulation;
  ContactSettings contact = options.contact;
  if (options.distance_scale != 1) {
    Real least = std::numeric_limits<Real>::infinity();
    for (const Body& body : simulation.bodies()) least = std::min(least, usual_distance(body.mesh));
    contact.distance = options.distance_scale * least;
  }
  simulation.set_contact(contact);
  if (options.drag > 0) add_drag(scene, simulation.bodies().size() - 1, options.drag);
}

}  // namespace pliant_tests
