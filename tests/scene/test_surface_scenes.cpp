// The built-in scenes in which surfaces touch: nothing ever passes through anything, and each shows what it promises.
#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <vector>

#include <doctest/doctest.h>

#include "load_builtin_scene.h"
#include "pliant/collision/crossings.h"
#include "pliant/pliant.h"
#include "pliant/simulation/held.h"
#include "whole_scenes.h"

namespace test_surface_scenes {

using namespace pliant;
using pliant_tests::load_builtin_scene;
using pliant_tests::runs_whole_scenes;

namespace {

/// All triangles of a simulation; and its edges, of which a rope has no others. What is held may cross what is held.
struct Surfaces {
  std::vector<Triangle> triangles;
  std::vector<Edge> edges;
  std::vector<char> held;

  explicit Surfaces(const Simulation& simulation) : held(held_vertices(simulation)) {
    for (const Body& body : simulation.bodies()) {
      const Index first = body.first_vertex;
      for (const auto& [a, b, c] : surface_triangles(body.mesh)) triangles.push_back({first + a, first + b, first + c});
      for (const auto& [a, b] : body.mesh.edges) edges.push_back({first + a, first + b});
    }
  }
  std::int64_t crossings(const Simulation& simulation) const {
    std::int64_t count = 0;
    const auto is_held = [&](Index vertex) { return held[at(vertex)] != 0; };
    visit_crossings({.positions = simulation.state().positions, .triangles = triangles, .edges = edges},
                    [&](const Crossing& crossing) {
                      const bool both_held = std::ranges::all_of(crossing.edge, is_held) &&
                                             std::ranges::all_of(triangles[at(crossing.triangle)], is_held);
                      if (!both_held) ++count;
                    });
    return count;
  }
};

/// Steps to the end of the scene, or only a few; f(simulation, step) after each.
void run_without_crossings(std::string_view name, const std::function<void(const Simulation&, std::int64_t)>& f) {
  Scene scene = load_builtin_scene(name);
  const Surfaces surfaces(scene.simulation);
  const std::int64_t steps = runs_whole_scenes ? scene.steps : 20;
  REQUIRE(surfaces.crossings(scene.simulation) == 0);
  for (std::int64_t i = 1; i <= steps; ++i) {
    CAPTURE(i);
    scene.step();
    REQUIRE(surfaces.crossings(scene.simulation) == 0);
    if (runs_whole_scenes) f(scene.simulation, i == steps ? -1 : i);  // −1: the end
  }
  CHECK(scene.simulation.warnings().empty());
}

Real mean_height(const Simulation& simulation, std::size_t body) {
  const Body& it = simulation.bodies()[body];
  return simulation.state().positions.middleRows(it.first_vertex, it.mesh.vertex_count()).col(2).mean();
}

Real highest(const Simulation& simulation) {
  return simulation.state().positions.col(2).maxCoeff();
}

}  // namespace

TEST_CASE("scene layers: all five sheets lie on the ball, the higher the smaller") {
  run_without_crossings("layers", [](const Simulation& simulation, std::int64_t step) {
    if (step != -1) return;
    for (std::size_t i = 1; i < 5; ++i) CHECK(mean_height(simulation, i) > mean_height(simulation, i - 1));
    CHECK(highest(simulation) > 0.4);
    CHECK(simulation.state().velocities.rowwise().norm().maxCoeff() < 1);
  });
}

TEST_CASE("scene twist: the strip becomes a rope of cloth, and hangs as a strip at the end") {
  Real narrow = 1;
  run_without_crossings("twist", [&](const Simulation& simulation, std::int64_t step) {
    const Positions& x = simulation.state().positions;
    if (step == 400) {
      narrow = 0;
      for (Index j = 0; j < 13; ++j) {  // the column in the middle
        const Vec3 from_middle = (x.row(37 * j + 18) - x.row(37 * 6 + 18)).transpose();
        narrow = std::max(narrow, from_middle.norm());
      }
    }
    if (step == -1) CHECK(x.col(2).minCoeff() < 0);
  });
  if (runs_whole_scenes) CHECK(narrow < 0.075);  // of 0.15 at rest
}

TEST_CASE("scene fold: a strip of 1.2 m lies in a heap of a quarter of its length") {
  run_without_crossings("fold", [](const Simulation& simulation, std::int64_t step) {
    if (step != -1) return;
    const Positions& x = simulation.state().positions;
    CHECK(x.col(1).maxCoeff() - x.col(1).minCoeff() < 0.4);
    CHECK(highest(simulation) > 0.02);
    CHECK(highest(simulation) < 0.15);
  });
}

TEST_CASE("scene pile: a dozen blocks come to rest in the crate, or on its wall") {
  run_without_crossings("pile", [](const Simulation& simulation, std::int64_t step) {
    if (step != -1) return;
    const Positions& x = simulation.state().positions;
    CHECK(x.leftCols(2).cwiseAbs().maxCoeff() < 0.6);  // one may lean over a wall
    CHECK(simulation.state().velocities.rowwise().norm().maxCoeff() < 0.5);
    CHECK(highest(simulation) > 0.2);
  });
}

TEST_CASE("scene dress: the skirt rises as the figure whirls, and hangs from its waist at the end") {
  Real widest = 0;
  run_without_crossings("dress", [&](const Simulation& simulation, std::int64_t step) {
    const Body& dress = simulation.bodies()[1];
    const Positions x = simulation.state().positions.middleRows(dress.first_vertex, dress.mesh.vertex_count());
    const Real width = std::hypot(x.col(0).maxCoeff() - x.col(0).minCoeff(), x.col(1).maxCoeff() - x.col(1).minCoeff());
    if (step > 0) widest = std::max(widest, width);
    if (step != -1) return;
    CHECK(width < 0.95 * widest);
    CHECK(x.col(2).minCoeff() > 0.3);
    CHECK(x.col(2).maxCoeff() > 1.15);
    CHECK(std::abs(x.col(1).mean() + 1.2) < 0.03);  // where it has walked to
  });
}

TEST_CASE("scene funnel: the cloth comes through the spout, whole, and lies below it") {
  run_without_crossings("funnel", [](const Simulation& simulation, std::int64_t step) {
    const Body& cloth = simulation.bodies()[1];
    const Positions x = simulation.state().positions.middleRows(cloth.first_vertex, cloth.mesh.vertex_count());
    if (step == 60) CHECK(x.col(2).minCoeff() > 0.4);  // it lies in the funnel
    if (step != -1) return;
    CHECK(x.col(2).maxCoeff() < 0.44);  // the lower end of the spout is at 0.45
    CHECK(x.leftCols(2).cwiseAbs().maxCoeff() < 0.7);
  });
}

TEST_CASE("scene reef_knot: it is drawn tight, and neither cord comes out of the other's loop") {
  Real wide = 0;
  run_without_crossings("reef_knot", [&](const Simulation& simulation, std::int64_t step) {
    const auto cord = [&](std::size_t i) -> Positions {
      const Body& it = simulation.bodies()[i];
      return simulation.state().positions.middleRows(it.first_vertex, it.mesh.vertex_count());
    };
    const Positions red = cord(0), blue = cord(1);
    const Real overlap = red.col(0).maxCoeff() - blue.col(0).minCoeff();  // with the free ends
    if (step == 1) wide = overlap;
    if (step != -1) return;
    // The hands have gone 0.2 m apart; cords that had slipped would have gone with them, to an overlap below 0.
    CHECK(overlap > 0.08);
    CHECK(overlap < wide);
    CHECK(red.col(0).maxCoeff() > 0.02);
    CHECK(blue.col(0).minCoeff() < -0.02);
    CHECK(std::min(red.col(2).minCoeff(), blue.col(2).minCoeff()) > 0.15);
  });
}

TEST_CASE("scene tablecloth: the cloth is gone from the table, and the crates stand on it") {
  run_without_crossings("tablecloth", [](const Simulation& simulation, std::int64_t step) {
    if (step != -1) return;
    const Positions& x = simulation.state().positions;
    const auto middle = [&](std::size_t i) -> Vec3 {
      const Body& it = simulation.bodies()[i];
      return x.middleRows(it.first_vertex, it.mesh.vertex_count()).colwise().mean().transpose();
    };
    CHECK(middle(0).x() > 0.6);
    for (std::size_t i = 1; i < 4; ++i) {
      const Body& crate = simulation.bodies()[i];
      const Vec3 start = crate.mesh.vertices.colwise().mean().transpose();
      CHECK((middle(i) - start).norm() < 0.12);
    }
    CHECK(std::abs(middle(3).z() - 0.6) < 0.02);  // it has not fallen over
  });
}

TEST_CASE("scene chain_mail: every ring still hangs where its row hangs") {
  run_without_crossings("chain_mail", [](const Simulation& simulation, std::int64_t step) {
    if (step != -1) return;
    const Positions& x = simulation.state().positions;
    CHECK(x.col(2).minCoeff() > 0.45);  // none has come loose and fallen
    CHECK(x.leftCols(2).cwiseAbs().maxCoeff() < 0.4);
  });
}

TEST_CASE("scene block: 72 g of cloth catch 8.8 kg") {
  run_without_crossings("block", [](const Simulation& simulation, std::int64_t step) {
    const auto mass = [&](std::size_t i) {
      const Body& it = simulation.bodies()[i];
      const auto first = simulation.state().masses.begin() + it.first_vertex;
      return std::accumulate(first, first + it.mesh.vertex_count(), Real{0});
    };
    if (step == 1) CHECK(mass(1) / mass(0) > 120);
    if (step != -1) return;
    CHECK(mean_height(simulation, 1) > 0.4);
    CHECK(mean_height(simulation, 1) < 0.75);
    CHECK(simulation.state().velocities.rowwise().norm().maxCoeff() < 1);
  });
}

TEST_CASE("scene turning_ball: the cloth turns with the ball, and stays on it") {
  Real turned = 0;
  Vec3 before = Vec3::Zero();
  run_without_crossings("turning_ball", [&](const Simulation& simulation, std::int64_t step) {
    const Positions& x = simulation.state().positions;
    const Vec3 corner = x.row(0).transpose();
    if (step > 1) turned += std::atan2(before.cross(corner).z(), before.head<2>().dot(corner.head<2>()));
    before = corner;
    if (step == -1) CHECK(highest(simulation) > 0.5);
  });
  if (runs_whole_scenes) CHECK(turned > 6);  // rad, of the ball's 17
}

TEST_CASE("scene rope_coil: the rope lies in coils, several upon each other") {
  run_without_crossings("rope_coil", [](const Simulation& simulation, std::int64_t step) {
    if (step != -1) return;
    const Positions& x = simulation.state().positions;
    CHECK(x.col(0).maxCoeff() - x.col(0).minCoeff() < 0.4);
    CHECK(highest(simulation) > 0.02);
    CHECK(highest(simulation) < 0.2);
  });
}

}  // namespace test_surface_scenes
