#include "tests/pairs/crossed_scenes.h"

#include <algorithm>
#include <cmath>

#include "tests/core/random.h"
#include "tests/pairs/parts.h"

namespace pliant_tests {

using namespace pliant;

namespace {

constexpr Index sheet_side = 9;

Mesh flat_sheet() {
  return sheet_mesh(sheet_side, 1, Vec3(-0.5, -0.5, 0));
}

Mesh upright_sheet(Real lowest) {
  return sheet_mesh(sheet_side, 0.6, Vec3(-0.3, 0.013, lowest), Plane::xz);
}

/// Pinned vertices that are moved together from where they are at rest.
struct MovedPins {
  GroupId group{};
  Mesh mesh;
  std::vector<Index> vertices;

  MovedPins(Simulation& simulation, BodyId body, const Mesh& of_body, std::vector<Index> which)
      : group(simulation.add(body, Position{.on = which})), mesh(of_body), vertices(std::move(which)) {}
  void move(Simulation& simulation, const Vec3& way) const {
    for (std::size_t i = 0; i < vertices.size(); ++i) {
      simulation.set_target(group, static_cast<Index>(i), row(mesh.vertices, vertices[i]) + way);
    }
  }
};

std::vector<Index> vertices_from(Index begin, Index end) {
  std::vector<Index> vertices;
  for (Index v = begin; v < end; ++v) vertices.push_back(v);
  return vertices;
}

Real next_time(const Simulation& simulation) {
  return simulation.state().time + simulation.settings().time_step;
}

}  // namespace

PairScene crossed_sheets(const PairOptions& options, Real speed) {
  PairScene scene{empty_simulation(options, Vec3::Zero())};
  add_cloth(scene.simulation, flat_sheet());
  add_cloth(scene.simulation, upright_sheet(-0.317), Vec3(0, 0, speed));
  finish(scene, options);
  return scene;
}

PairScene pulled_apart(const PairOptions& options, Real speed) {
  PairScene scene{empty_simulation(options)};
  scene.simulation.add(add_cloth(scene.simulation, flat_sheet()), Position{});
  const Mesh mesh = upright_sheet(-0.317);
  const BodyId upright = add_cloth(scene.simulation, mesh);
  const Index count = mesh.vertex_count();
  const MovedPins pins(scene.simulation, upright, mesh, vertices_from(count - sheet_side, count));
  scene.move = [pins, speed](Simulation& simulation) {
    pins.move(simulation, Vec3(0, 0, speed * next_time(simulation)));
  };
  finish(scene, options);
  return scene;
}

PairScene rope_through_sheet(const PairOptions& options) {
  PairScene scene{empty_simulation(options)};
  scene.simulation.add(add_cloth(scene.simulation, flat_sheet()), Position{});
  Mesh rope = chain({.links = 20, .length = 0.6, .direction = {0.1, 0.05, 1}});
  rope.vertices.rowwise() += Vec3(0.02, 0.03, -0.3).transpose();
  add_rope(scene.simulation, rope);
  finish(scene, options);
  return scene;
}

PairScene crossed_loop(const PairOptions& options) {
  PairScene scene{empty_simulation(options)};
  Mesh mesh = sheet_mesh(7, 0.4, Vec3::Zero(), Plane::xy, 25);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 flat = row(mesh.vertices, v);
    const Real t = 1.3 * (2 * flat.y() / mesh.vertices.col(1).maxCoeff() - 1);
    mesh.vertices.row(v) = Vec3(flat.x(), 0.4 * (t * t * t - t), 0.05 + 0.3 * t * t + 0.02 * flat.x()).transpose();
  }
  add_cloth(scene.simulation, mesh);
  scene.simulation.add(PlaneCollider{});
  finish(scene, options);
  return scene;
}

PairScene crossed_pile(const PairOptions& options) {
  PairScene scene{empty_simulation(options)};
  Random random(options.seed);
  const auto put = [&](Mesh mesh, Real height) {
    const Mat3 turn = random.rotation();
    const Vec3 place = Vec3(0, 0, height) + random.vector(0.15);
    const Vec3 center = mesh.vertices.colwise().mean().transpose();
    for (Index v = 0; v < mesh.vertex_count(); ++v) {
      mesh.vertices.row(v) = (place + turn * (row(mesh.vertices, v) - center)).transpose();
    }
    return mesh;
  };
  for (int i = 0; i < 4; ++i) {
    add_rubber(scene.simulation, put(bar({.cells = {3, 3, 3}, .size = {0.2, 0.2, 0.2}}), 0.5), 2e4);
  }
  for (int i = 0; i < 2; ++i) {
    add_cloth(scene.simulation, put(sheet_mesh(sheet_side, 0.5, Vec3::Zero()), 0.5));
    add_rope(scene.simulation, put(chain({.links = 20, .length = 0.6, .direction = {1, 0, 0}}), 0.5));
  }
  scene.simulation.add(PlaneCollider{});
  finish(scene, options);
  return scene;
}

PairScene near_sheets(const PairOptions& options, Real share, bool is_pinned) {
  PairScene scene{empty_simulation(options, is_pinned ? Vec3(0, 0, -9.81) : Vec3::Zero())};
  const Mesh lower = flat_sheet();
  const BodyId body = add_cloth(scene.simulation, lower);
  if (is_pinned) scene.simulation.add(body, Position{});
  const Real width = 0.8;
  const Mesh at_zero = sheet_mesh(sheet_side, width, Vec3(-0.37, -0.36, 0));
  const Real distance = (usual_distance(lower) + usual_distance(at_zero)) / 2;
  add_cloth(scene.simulation, sheet_mesh(sheet_side, width, Vec3(-0.37, -0.36, share * distance)));
  finish(scene, options);
  return scene;
}

PairScene closing_sheets(const PairOptions& options, Real speed) {
  PairScene scene{empty_simulation(options)};
  constexpr Real height = 0.15;
  const auto add_pinned = [&](const Vec3& corner) {
    const Mesh mesh = sheet_mesh(sheet_side, 1, corner);
    const BodyId body = add_cloth(scene.simulation, mesh);
    return MovedPins(scene.simulation, body, mesh, vertices_from(0, mesh.vertex_count()));
  };
  const MovedPins lower = add_pinned(Vec3(-0.5, -0.5, -height));
  const MovedPins upper = add_pinned(Vec3(-0.51, -0.49, height));
  add_cloth(scene.simulation, sheet_mesh(sheet_side, 0.5, Vec3(-0.24, -0.26, 0)));
  scene.move = [lower, upper, speed](Simulation& simulation) {
    const Real way = std::min(2 * height, speed * next_time(simulation));
    lower.move(simulation, Vec3(0, 0, way));
    upper.move(simulation, Vec3(0, 0, -way));
  };
  finish(scene, options);
  return scene;
}

PairScene driven_through(const PairOptions& options) {
  PairScene scene{empty_simulation(options)};
  const Mesh flat = flat_sheet();
  std::vector<Index> middle;
  for (Index v = 0; v < flat.vertex_count(); ++v) {
    if (std::abs(flat.vertices(v, 0)) < 0.3 && std::abs(flat.vertices(v, 1)) < 0.2) middle.push_back(v);
  }
  scene.simulation.add(add_cloth(scene.simulation, flat), Position{.on = middle});
  const Mesh mesh = upright_sheet(0.05);
  const BodyId upright = add_cloth(scene.simulation, mesh);
  const MovedPins pins(scene.simulation, upright, mesh, vertices_from(0, sheet_side * 4));
  scene.move = [pins](Simulation& simulation) {
    const Real time = next_time(simulation);
    pins.move(simulation, Vec3(0, 0, time < 0.5 ? -time : time - 1));
  };
  finish(scene, options);
  return scene;
}

}  // namespace pliant_tests
