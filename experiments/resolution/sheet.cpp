#include "resolution/sheet.h"

#include <numbers>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/forces/test_force.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/topology.h"

namespace pliant_experiments {
namespace {

using namespace pliant;

constexpr double resting_speed = 1e-9;  // [m/s]; a step of 8 s then moves no vertex by more than 8e-9 m
constexpr int most_steps = 200;

void bring_to_rest(const ExperimentContext& context, Scene& scene) {
  for (int i = 0; i < most_steps; ++i) {
    context.step(scene);
    if (scene.simulation.state().velocities.rowwise().norm().maxCoeff() < resting_speed) return;
  }
  throw Error(ErrorKind::diverged, fmt::format("{}: not at rest after {} steps", scene.place(), most_steps));
}

Scene sheet(const ExperimentContext& context, const Material& material, const Tessellation& tessellation, Sets sets) {
  sets.push_back(fmt::format("bodies[sheet].mesh.columns={}", tessellation.vertices_a_side));
  sets.push_back(fmt::format("bodies[sheet].mesh.rows={}", tessellation.vertices_a_side));
  sets.push_back(fmt::format("bodies[sheet].mesh.diagonals={}", tessellation.diagonals));
  return context.scene("resolution/" + material.scene, sets);
}

/// In the plane of the sheet, xz.
Vec3 direction(double degrees) {
  const double angle = degrees * std::numbers::pi / 180;
  return {std::cos(angle), 0, std::sin(angle)};
}

const Mesh& rest_of(const Scene& scene) {
  return scene.simulation.bodies().front().mesh;
}

/// Each border edge is pulled outwards by its share of the tension, half at each end.
std::vector<Vec3> border_forces(const Mesh& mesh, const Vec3& along, double tension) {
  std::vector<Vec3> forces(static_cast<std::size_t>(mesh.vertex_count()), Vec3::Zero());
  const Vec3 middle = mesh.vertices.colwise().mean().transpose();
  for (const Edge& edge : boundary_edges(mesh)) {
    const Vec3 from = row(mesh.vertices, edge[0]);
    const Vec3 to = row(mesh.vertices, edge[1]);
    Vec3 outwards = (to - from).cross(Vec3::UnitY());  // as long as the edge
    if (outwards.dot((from + to) / 2 - middle) < 0) outwards = -outwards;
    const Vec3 force = tension * along.dot(outwards) * along;
    for (const Index end : edge) forces[static_cast<std::size_t>(end)] += force / 2;
  }
  return forces;
}

}  // namespace

Scene hung(const ExperimentContext& context, const Material& material, const Tessellation& tessellation) {
  Scene scene = sheet(context, material, tessellation, {});
  bring_to_rest(context, scene);
  return scene;
}

Drop drop(const Scene& scene) {
  const Positions& rest = rest_of(scene).vertices;
  const Positions moved = scene.simulation.state().positions - rest;
  const double lowest = rest.col(2).minCoeff();
  Drop sum;
  int count = 0;
  for (Index i = 0; i < rest.rows(); ++i) {
    if (rest(i, 2) > lowest) continue;
    sum.aside += moved(i, 0);
    sum.down -= moved(i, 2);
    ++count;
  }
  return {sum.aside / count, sum.down / count};
}

Scene pulled(const ExperimentContext& context, const Material& material, const Tessellation& tessellation,
             double degrees, double tension) {
  Scene scene = sheet(context, material, tessellation, {"gravity=null"});
  Simulation& simulation = scene.simulation;
  simulation.remove(simulation.find_group("rail").value());
  const Mesh& mesh = rest_of(scene);
  simulation.add(TestForce{.force = border_forces(mesh, direction(degrees), tension)});
  bring_to_rest(context, scene);
  return scene;
}

double elongation(const Scene& scene, double degrees) {
  const Mesh& mesh = rest_of(scene);
  const Positions& x = scene.simulation.state().positions;
  const std::vector<Real> areas = triangle_areas(mesh.vertices, mesh.triangles);
  const Vec3 along = direction(degrees);
  Vec3 image = Vec3::Zero();  // of `along`, times the area
  for (std::size_t i = 0; i < areas.size(); ++i) {
    const auto& [a, b, c] = mesh.triangles[i];
    const Vec3 first = row(mesh.vertices, b) - row(mesh.vertices, a);
    const Vec3 second = row(mesh.vertices, c) - row(mesh.vertices, a);
    // along = u first + v second, both in the plane of the sheet
    const Vec3 normal = first.cross(second);
    const double u = along.cross(second).dot(normal) / normal.squaredNorm();
    const double v = first.cross(along).dot(normal) / normal.squaredNorm();
    image += areas[i] * (u * (row(x, b) - row(x, a)) + v * (row(x, c) - row(x, a)));
  }
  double area = 0;
  for (const Real each : areas) area += each;
  return image.norm() / area - 1;
}

}  // namespace pliant_experiments
