// What a brush leaves around a point of a body.
#include <map>

#include <doctest/doctest.h>

#include "pliant/pliant.h"
#include "viewer/brush_tool.h"

namespace test_brush {

using namespace pliant;
using namespace pliant_viewer;

namespace {

struct Painted {
  pliant_render::RenderMesh mesh;
  std::vector<Vec3f> positions;

  explicit Painted(const Simulation& simulation)
      : mesh(pliant_render::make_render_mesh(simulation.bodies())),
        positions(pliant_render::to_floats(simulation.state().positions)) {}
  /// Around a vertex; by vertex.
  std::map<std::uint32_t, Real> mark(std::uint32_t vertex, float radius) const {
    const auto list = brush_mark({{vertex, vertex, vertex}}, radius, DrawnNeighbors(mesh), mesh.bodies, positions);
    std::map<std::uint32_t, Real> shares(list.begin(), list.end());
    CHECK(shares.size() == list.size());  // each once
    return shares;
  }
};

}  // namespace

TEST_CASE("a brush leaves a round mark, full in the middle, nothing beyond its rim") {
  Simulation simulation;
  simulation.add_body(grid({.columns = 11, .rows = 11, .plane = Plane::xy}), Mass::total(1));
  const Painted sheet(simulation);
  const auto shares = sheet.mark(60, 0.25F);
  CHECK(shares.at(60) == 1);
  const Real beside = 1 - 0.1 * 0.1 / (0.25 * 0.25);
  CHECK(shares.at(61) == doctest::Approx(beside * beside));
  CHECK(shares.at(71) == doctest::Approx(beside * beside));
  CHECK(shares.size() == 21);  // of a grid, the points within two and a half cells
  for (const auto& [vertex, share] : shares) CHECK((sheet.positions[vertex] - sheet.positions[60]).norm() < 0.25F);
  CHECK(sheet.mark(60, 0.01F).size() == 1);  // finer than the mesh
}

TEST_CASE("it does not go through to the layer behind a fold, nor to another body") {
  Simulation simulation;
  // A strip that is folded in the middle, its ends a centimeter apart, and a sheet between them.
  Mesh strip = grid({.columns = 21, .rows = 2, .size = {1, 0.05}, .plane = Plane::xy});
  for (Index v = 0; v < strip.vertex_count(); ++v) {
    const Real along = strip.vertices(v, 0);
    if (along <= 0.5) continue;
    strip.vertices(v, 0) = 1 - along;
    strip.vertices(v, 2) = 0.01;
  }
  simulation.add_body(std::move(strip), Mass::total(1));
  Mesh between = grid({.columns = 5, .rows = 2, .size = {0.2, 0.05}, .plane = Plane::xy});
  between.vertices.col(2).array() += 0.005;
  simulation.add_body(std::move(between), Mass::total(1));
  const Painted folded(simulation);
  const auto at_end = folded.mark(0, 0.12F);
  CHECK(at_end.contains(2));
  CHECK_FALSE(at_end.contains(20));  // over it, at the other end of the strip
  CHECK_FALSE(at_end.contains(42));  // of the sheet
  const auto at_fold = folded.mark(10, 0.12F);
  CHECK(at_fold.contains(9));
  CHECK(at_fold.contains(11));  // around the fold
}

TEST_CASE("of a solid it takes what is inside as well") {
  Simulation simulation;
  simulation.add_body(bar({.cells = {4, 4, 4}, .size = {1, 1, 1}}), Mass::total(1));
  const Painted block(simulation);
  const DrawnNeighbors neighbors(block.mesh);
  std::size_t inside = 0;
  const auto shares = block.mark(0, 0.7F);
  for (const auto& [vertex, share] : shares) inside += neighbors.is_drawn(vertex) ? 0U : 1U;
  CHECK(inside >= 4);
  for (const auto& [vertex, share] : shares) CHECK((block.positions[vertex] - block.positions[0]).norm() < 0.7F);
}

TEST_CASE("ropes are painted along") {
  Simulation simulation;
  simulation.add_body(chain({.links = 10}), Mass::total(1));
  CHECK(Painted(simulation).mark(5, 0.25F).size() == 5);
}

}  // namespace test_brush
