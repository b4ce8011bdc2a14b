#include "tests/pairs/bounce_scenes.h"

#include <algorithm>
#include <cmath>

#include "tests/pairs/parts.h"

namespace pliant_tests {

using namespace pliant;

namespace {

constexpr Real slowest = 2;         // [m/s]
constexpr Real room_to_fall = 0.1;  // [m]

PairOptions faster(PairOptions options) {
  options.speed += slowest;
  return options;
}

/// Cells a side of a block of so many vertices.
Index cells_of_block(Index vertices) {
  return std::max(Index{2}, static_cast<Index>(std::lround(std::cbrt(vertices))) - 1);
}

/// A pinned sheet below what falls.
PairScene above_sheet(const PairOptions& options, Index vertices) {
  PairScene scene{empty_simulation(options), 1};
  const Index n = side_of(vertices);
  const BodyId sheet = add_cloth(scene.simulation, sheet_mesh(n, 0.6, {-0.3, -0.3, 0}));
  scene.simulation.add(sheet, Position{.on = border_of(n)});
  return scene;
}

}  // namespace

PairScene bounce_block(const PairOptions& options) {
  PairScene scene{empty_simulation(options), 1};
  const Index cells = cells_of_block(options.vertices / 2);
  Mesh low = cube_mesh(cells, 0.2);
  const BodyId body = add_rubber(scene.simulation, low, 1e5);
  std::vector<Index> bottom(at((cells + 1) * (cells + 1)));
  for (Index i = 0; i < count_of(bottom); ++i) bottom[at(i)] = i;
  scene.simulation.add(body, Position{.on = bottom});
  Mesh high = cube_mesh(cells, 0.16);
  high.vertices.rowwise() += Vec3(0.013, 0.007, 0).transpose();
  put_lowest_at(high, 0.1 + room_to_fall);
  add_rubber(scene.simulation, high, 1e5, falling(faster(options)));
  finish(scene, options);
  return scene;
}

PairScene bounce_sheet(const PairOptions& options) {
  PairScene scene = above_sheet(options, 3 * options.vertices / 4);
  add_cloth(scene.simulation, sheet_mesh(side_of(options.vertices, 4), 0.3, {-0.14, -0.16, room_to_fall}),
            falling(faster(options)));
  finish(scene, options);
  return scene;
}

PairScene bounce_ball(const PairOptions& options) {
  PairScene scene = above_sheet(options, options.vertices / 2);
  Mesh ball = ball_mesh(cells_of_block(options.vertices / 2), 0.2);
  put_lowest_at(ball, room_to_fall);
  add_rubber(scene.simulation, ball, 1e5, falling(faster(options)));
  finish(scene, options);
  return scene;
}

}  // namespace pliant_tests
