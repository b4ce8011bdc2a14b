#include "tests/pairs/body_scenes.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "tests/core/random.h"
#include "tests/pairs/parts.h"

namespace pliant_tests {

using namespace pliant;

namespace {

void place(Mesh& mesh, const Mat3& rotation, const Vec3& center) {
  mesh.vertices = (mesh.vertices * rotation.transpose()).eval();
  mesh.vertices.rowwise() += center.transpose();
}

/// A rope about the vertical: a spiral of so many turns, between the heights `from` and `to`.
struct Spiral {
  Index vertices = 2;
  Real radius = 0.1, from = 0, to = 1, turns = 3;
};

Mesh rope_mesh(const Spiral& spiral) {
  Mesh mesh = chain({.links = spiral.vertices - 1});
  for (Index i = 0; i < spiral.vertices; ++i) {
    const Real share = static_cast<Real>(i) / (spiral.vertices - 1);
    const Real angle = 2 * std::numbers::pi * spiral.turns * share;
    mesh.vertices.row(i) << spiral.radius * std::cos(angle), spiral.radius * std::sin(angle),
        spiral.from + (spiral.to - spiral.from) * share;
  }
  return mesh;
}

}  // namespace

PairScene block(const PairOptions& options) {
  PairScene scene{empty_simulation(options), 5};
  Simulation& simulation = scene.simulation;
  const Index n = side_of(options.vertices, 1 / 0.7);
  const Index cells = std::max(Index{2}, static_cast<Index>(std::lround(std::cbrt(0.3 * options.vertices))) - 1);
  Mesh cloth = sheet_mesh(n, 0.6, {-0.3, -0.3, 0});
  Mesh rubber = cube_mesh(cells, 0.2);
  const Real r = std::max(Real{1}, options.distance_scale) * std::max(usual_distance(cloth), usual_distance(rubber));
  const Real height = std::max(0.01, 1.5 * r);
  put_lowest_at(cloth, height);
  put_lowest_at(rubber, height + std::max(0.04, 2.5 * r));
  simulation.add(add_cloth(simulation, cloth), Position{.on = border_of(n)});
  add_rubber(simulation, rubber, 1e5, falling(options));
  simulation.add(PlaneCollider{}, "floor");
  finish(scene, options);
  return scene;
}

PairScene rope(const PairOptions& options) {
  PairScene scene{empty_simulation(options), 3};
  Simulation& simulation = scene.simulation;
  const Index n = side_of(options.vertices, 1 / 0.6);
  const Mesh cloth = sheet_mesh(n, 0.6, {-0.3, -0.3, 0});
  simulation.add(add_cloth(simulation, cloth), Position{.on = border_of(n)});
  const Index links = std::max(Index{20}, options.vertices - n * n);
  add_rope(simulation, rope_mesh({.vertices = links, .radius = 0.12, .from = 0.06, .to = 0.2, .turns = 3}),
           falling(options));
  finish(scene, options);
  return scene;
}

PairScene coil(const PairOptions& options) {
  PairScene scene{empty_simulation(options), 3};
  add_rope(scene.simulation,
           rope_mesh({.vertices = options.vertices, .radius = 0.02, .from = 0.03, .to = 2, .turns = 8}),
           falling(options));
  scene.simulation.add(PlaneCollider{}, "floor");
  finish(scene, options);
  return scene;
}

PairScene pile(const PairOptions& options) {
  const Index cells = options.vertices < 800 ? 2 : options.vertices < 5000 ? 3 : 4;
  const Index of_body = (cells + 1) * (cells + 1) * (cells + 1);
  return pile(options, std::max(Index{3}, options.vertices / of_body), cells);
}

PairScene pile(const PairOptions& options, Index bodies, Index cells) {
  PairScene scene{empty_simulation(options), 5};
  Random random(options.seed);
  const auto side = std::max(Index{2}, static_cast<Index>(std::lround(std::cbrt(bodies))));
  const Real spacing = 0.38;  // more than the diagonal of the largest box
  for (Index i = 0; i < bodies; ++i) {
    const Real size = random.uniform(0.12, 0.2);
    Mesh mesh = random.index(2) == 0 ? cube_mesh(cells, size) : ball_mesh(cells, size);
    const Vec3 place_in_layer((i % side) - (side - 1) / 2.0, (i / side % side) - (side - 1) / 2.0, 0);
    const Vec3 center = spacing * (place_in_layer + Vec3(0, 0, 0.6 + i / (side * side)));
    place(mesh, random.rotation(), center);
    const Vec3 velocity = falling(options) - 1.5 * place_in_layer + random.vector(0.5);
    add_rubber(scene.simulation, mesh, random.uniform(2e4, 1e5), velocity);
  }
  scene.simulation.add(PlaneCollider{}, "floor");
  finish(scene, options);
  return scene;
}

PairScene collision_of_two(const PairOptions& options) {
  PairScene scene{empty_simulation(options, Vec3::Zero()), 1};
  Random random(options.seed);
  const Index cells = std::max(Index{2}, static_cast<Index>(std::lround(std::cbrt(options.vertices / 2.0))) - 1);
  for (const Real side : {-1.0, 1.0}) {
    Mesh mesh = cube_mesh(cells, 0.2);
    place(mesh, random.rotation(), {0.2 * side, 0.03 * side, 0.02 * side});
    add_rubber(scene.simulation, mesh, 1e5, {-side * (1 + options.speed), 0, 0});
  }
  finish(scene, options);
  return scene;
}

}  // namespace pliant_tests
