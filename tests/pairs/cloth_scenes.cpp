#include "tests/pairs/cloth_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pliant/mesh/join.h"
#include "tests/pairs/parts.h"

namespace pliant_tests {

using namespace pliant;

namespace {

/// A sheet of 1 × 1 m whose middle is at `height` above a sphere of 0.3 m that is a little off its middle.
PairScene over_sphere(const PairOptions& options, Real height, const Vec3& off_center, Real duration) {
  PairScene scene{empty_simulation(options), duration};
  add_cloth(scene.simulation, sheet_mesh(side_of(options.vertices), 1, {-0.5, -0.5, 0.3 + height}), falling(options));
  scene.simulation.add(SphereCollider{.center = off_center, .radius = 0.3}, "ball");
  scene.simulation.add(PlaneCollider{.position = {0, 0, -0.4}}, "floor");
  finish(scene, options);
  return scene;
}

/// Both rows of pins of a strip, each with the places where they begin.
struct Ends {
  GroupId pins;
  std::vector<Vec3> begin;
  Real length = 0;
};

void turn_ends(const Ends& ends, Simulation& simulation) {
  const Real time = simulation.state().time + simulation.settings().time_step;
  const std::size_t half = ends.begin.size() / 2;
  for (std::size_t i = 0; i < ends.begin.size(); ++i) {
    const Real side = i < half ? -1 : 1;
    const Real angle = side * std::numbers::pi / 2 * time;
    const Vec3& x = ends.begin[i];
    const Real nearer = std::min(0.15, 0.02 * time) * ends.length;
    simulation.set_target(ends.pins, static_cast<Index>(i),
                          {std::cos(angle) * x.x(), x.y() - side * nearer, std::sin(angle) * x.x()});
  }
}

void turn_about_vertical(Mesh& mesh, const Vec3& center, Real angle) {
  const Eigen::AngleAxis<Real> turn(angle, Vec3::UnitZ());
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    mesh.vertices.row(i) = (center + turn * (row(mesh.vertices, i) - center)).transpose();
  }
}

/// The smaller of the distances that two meshes have by themselves, as it was asked for [m].
Real common_distance(const PairOptions& options, const Mesh& a, const Mesh& b) {
  return options.distance_scale * std::min(usual_distance(a), usual_distance(b));
}

}  // namespace

PairScene drape(const PairOptions& options) {
  return over_sphere(options, 0.05, {0.02, 0.01, 0}, 5);
}

PairScene fall(const PairOptions& options) {
  PairOptions fast = options;
  fast.speed += 5.5;
  return over_sphere(fast, 0.25, {0.02, 0.01, 0}, 1);
}

PairScene rotating_sphere(const PairOptions& options) {
  PairScene scene = over_sphere(options, 0.03, Vec3::Zero(), 4);
  const ColliderId ball = *scene.simulation.find_collider("ball");
  scene.move = [ball](Simulation& simulation) {
    const Real time = simulation.state().time + simulation.settings().time_step;
    const Real angle = 3 * std::max(0.0, time - 1);
    simulation.set_target(ball, {Vec3::Zero(), Eigen::Quaternion<Real>(Eigen::AngleAxis<Real>(angle, Vec3::UnitZ()))});
  };
  return scene;
}

PairScene twist(const PairOptions& options) {
  PairScene scene{empty_simulation(options), 8};
  const Index n = side_of(options.vertices, 2);
  const Mesh strip = sheet_mesh(n, 0.4, {-0.2, 0, 0}, Plane::xy, 2 * n);
  const BodyId body = add_cloth(scene.simulation, strip);
  Ends ends;
  std::vector<Index> pinned;
  for (const Index first : {Index{0}, strip.vertex_count() - n}) {
    for (Index i = 0; i < n; ++i) {
      pinned.push_back(first + i);
      ends.begin.push_back(row(strip.vertices, first + i));
    }
  }
  ends.length = ends.begin.back().y() - ends.begin.front().y();
  ends.pins = scene.simulation.add(body, Position{.on = pinned});
  scene.move = [ends](Simulation& simulation) { turn_ends(ends, simulation); };
  finish(scene, options);
  return scene;
}

PairScene fold(const PairOptions& options) {
  PairScene scene{empty_simulation(options), 5};
  const Index n = side_of(options.vertices, 2);
  Mesh strip = sheet_mesh(n, 0.5, {0, 0, 0.05}, Plane::xz, 2 * n);
  for (Index i = 0; i < strip.vertex_count(); ++i) {
    const Vec3 x = row(strip.vertices, i);
    strip.vertices(i, 1) += 0.01 * std::sin(9 * x.z()) + 0.002 * std::sin(7 * x.x() + 1);
  }
  add_cloth(scene.simulation, strip, falling(options));
  scene.simulation.add(PlaneCollider{}, "floor");
  finish(scene, options);
  return scene;
}

PairScene stack(const PairOptions& options) {
  constexpr Index layers = 5;
  PairScene scene{empty_simulation(options), 4};
  const Index n = side_of(options.vertices, layers);
  const Real r = std::max(Real{1}, options.distance_scale) * usual_distance(sheet_mesh(n, 0.6, Vec3::Zero()));
  for (Index i = 0; i < layers; ++i) {
    const Vec3 corner(-0.3 + 0.003 * i, -0.3 - 0.002 * i, 0.22 + 1.2 * r * (2 * i + 1));
    add_cloth(scene.simulation, sheet_mesh(n, 0.6, corner), falling(options));
  }
  scene.simulation.add(SphereCollider{.center = {0.02, 0.01, 0}, .radius = 0.2}, "ball");
  scene.simulation.add(PlaneCollider{.position = {0, 0, -0.3}}, "floor");
  finish(scene, options);
  return scene;
}

PairScene two_sheets(const PairOptions& options) {
  PairScene scene{empty_simulation(options), 3};
  const Index n = side_of(options.vertices, 2);
  const BodyId low = add_cloth(scene.simulation, sheet_mesh(n, 1, {-0.5, -0.5, 0}));
  scene.simulation.add(low, Position{});
  Mesh top = sheet_mesh(n, 0.4, {-0.2, -0.2, 0.1});
  turn_about_vertical(top, Vec3::Zero(), 0.4);
  add_cloth(scene.simulation, top, falling(options));
  finish(scene, options);
  return scene;
}

PairScene layers_free(const PairOptions& options, const Layers& layers) {
  PairScene scene{empty_simulation(options), 2};
  const Index n = side_of(options.vertices, layers.count);
  const Real edge = 0.5 / (n - 1);
  PairOptions exact = options;
  exact.contact.distance = options.distance_scale * usual_distance(sheet_mesh(n, 0.5, Vec3::Zero()));
  exact.distance_scale = 1;
  for (Index i = 0; i < layers.count; ++i) {
    const Real way = layers.shift * edge * i;
    const Vec3 corner(way, 0.6 * way, 1.0005 * exact.contact.distance * (i + 1));
    const Real speed = i == layers.count - 1 ? layers.speed_of_top : 0;
    add_cloth(scene.simulation, sheet_mesh(n, 0.5, corner), {speed, 0, 0});
  }
  scene.simulation.add(PlaneCollider{}, "floor");
  finish(scene, exact);
  return scene;
}

PairScene two_layers_free(const PairOptions& options) {
  return layers_free(options, {.count = 2, .shift = 0.37, .speed_of_top = 1});
}

namespace {

/// Without bodies, gravity tilted.
SlopeScene empty_slope(const PairOptions& options, Real degrees) {
  const Real angle = degrees * std::numbers::pi / 180;
  const Vec3 gravity(9.81 * std::sin(angle), 0, -9.81 * std::cos(angle));
  return {{empty_simulation(options, gravity), 1}, angle, options.contact.friction};
}

/// With a contact distance [m] that is scaled as it was asked for.
PairOptions with_distance(PairOptions options, Real distance) {
  options.contact.distance = options.distance_scale * distance;
  options.distance_scale = 1;
  return options;
}

/// Edges alone.
Mesh net_of(const std::vector<Vec3>& points, std::vector<Edge> edges) {
  Mesh mesh;
  mesh.vertices.resize(count_of(points), 3);
  for (std::size_t i = 0; i < points.size(); ++i) mesh.vertices.row(static_cast<Index>(i)) = points[i].transpose();
  mesh.edges = std::move(edges);
  return mesh;
}

}  // namespace

SlopeScene rails(const PairOptions& options, Real degrees) {
  SlopeScene slope = empty_slope(options, degrees);
  Simulation& simulation = slope.scene.simulation;
  const PairOptions exact = with_distance(options, 0.01);
  const Index links = std::max(Index{1}, options.vertices / 2);
  std::vector<Vec3> points;
  std::vector<Edge> edges;
  for (const Real y : {-0.1, 0.1}) {
    for (Index i = 0; i <= links; ++i) {
      points.emplace_back(-0.5 + 3.0 * i / links, y, 0);
      if (i > 0) edges.push_back({count_of(points) - 2, count_of(points) - 1});
    }
  }
  simulation.add(add_rope(simulation, net_of(points, edges)), Position{});
  const Real z = 1.0005 * exact.contact.distance;
  const Mesh frame = net_of({{-0.11, -0.2, z}, {0.09, -0.2, z}, {-0.09, 0.2, z}, {0.11, 0.2, z}, {0, 0, z + 0.1}},
                            {{0, 1}, {0, 2}, {1, 3}, {2, 3}, {0, 3}, {0, 4}, {1, 4}, {2, 4}, {3, 4}});
  const BodyId body = simulation.add_body(frame, Mass::per_vertex(0.02), {.name = "frame"});
  simulation.add(body, EdgeSpring{.stiffness = 1e4});
  finish(slope.scene, exact);
  return slope;
}

SlopeScene ridges(const PairOptions& options, Real degrees) {
  SlopeScene slope = empty_slope(options, degrees);
  Simulation& simulation = slope.scene.simulation;
  const PairOptions exact = with_distance(options, 0.01);
  const Index links = std::max(Index{1}, options.vertices / 6);
  std::vector<MeshPart> roofs;
  for (const Real y : {-0.1, 0.1}) {
    Mesh roof = grid({.columns = links + 1, .rows = 3, .size = {3, 0.1}, .plane = Plane::xy});
    for (Index i = 0; i < roof.vertex_count(); ++i) {
      const Real across = roof.vertices(i, 1) - 0.05;
      roof.vertices.row(i) << roof.vertices(i, 0) - 0.5, y + across, -std::abs(across);
    }
    roofs.push_back({"", roof});
  }
  simulation.add(add_cloth(simulation, join(roofs)), Position{});
  const Real z = 1.0005 * exact.contact.distance;
  Mesh sled = bar({.cells = {2, 1, 1}, .size = {0.2, 0.4, 0.1}});
  for (Index i = 0; i < sled.vertex_count(); ++i) {
    const Vec3 x = row(sled.vertices, i);
    const Real lift = std::abs(x.x() - 0.1) < 0.05 ? 0.05 : 0;
    sled.vertices.row(i) << x.x() - 0.1 + 0.025 * (x.y() - 0.2), x.y() - 0.2, z + x.z() + lift;
  }
  add_rubber(simulation, sled, 1e6);
  finish(slope.scene, exact);
  return slope;
}

SlopeScene slope2(const PairOptions& options, Real degrees) {
  SlopeScene slope = empty_slope(options, degrees);
  Simulation& simulation = slope.scene.simulation;
  const Index n = side_of(options.vertices, 7);
  const Mesh low = sheet_mesh(4 * n, 2.2, {-0.2, -0.2, 0}, Plane::xy, 3 * n / 2);
  Mesh top = sheet_mesh(n, 0.4, Vec3::Zero());
  PairOptions exact = options;
  exact.contact.distance = common_distance(options, low, top);
  exact.distance_scale = 1;
  put_lowest_at(top, 1.0005 * exact.contact.distance);
  turn_about_vertical(top, {0.2, 0.2, 0}, 0.3);
  simulation.add(add_cloth(simulation, low), Position{});
  add_cloth(simulation, top);
  finish(slope.scene, exact);
  return slope;
}

Real SlopeScene::way() const {
  const Body& top = scene.simulation.bodies()[1];
  const Positions& x = scene.simulation.state().positions;
  const Index count = top.mesh.vertex_count();
  return (x.middleRows(top.first_vertex, count).col(0) - top.mesh.vertices.col(0)).mean();
}

Real SlopeScene::exact_way(Index steps) const {
  const SolverSettings& settings = scene.simulation.settings();
  const Real h = settings.time_step / settings.substeps;
  const Real n = static_cast<Real>(steps) * settings.substeps;
  const Real acceleration = 9.81 * (std::sin(angle) - friction * std::cos(angle));
  return h * h * n * (n + 1) / 2 * std::max(Real{0}, acceleration);
}

PairScene slope2_steep(const PairOptions& options) {
  return slope2(options, 30).scene;
}

PairScene slope2_near_limit(const PairOptions& options) {
  return slope2(options, 17).scene;
}

PairScene slope2_gentle(const PairOptions& options) {
  return slope2(options, 16).scene;
}

}  // namespace pliant_tests
