// What the builders make of meshes and options.
#include <cmath>
#include <numeric>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "elastic.h"
#include "pliant/constraints/builtin.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"

namespace test_builders {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// The energy of a body stretched to `factor` times its size.
template <class Constraint>
Real stretched_energy(const Mesh& mesh, const Constraint& options, Real factor) {
  return Elastic(mesh, options).energy(factor * mesh.vertices);
}

}  // namespace

TEST_CASE("energies of a uniform stretch, in closed form") {
  const Mesh sheet = grid({.columns = 5, .rows = 4, .size = {2, 3}});
  const Mesh block = bar({.cells = {3, 2, 2}, .size = {1, 2, 3}});
  Real squared_lengths = 0;
  for (const Edge& edge : unique_edges(sheet)) {
    squared_lengths += (sheet.vertices.row(edge[1]) - sheet.vertices.row(edge[0])).squaredNorm();
  }
  const auto approx = [](Real x) { return doctest::Approx(x).epsilon(1e-12); };
  // ½ k (0.1 L)² an edge; ½ EA L 0.1² an edge of a chain; ½ k A · 2 · 0.1² of a sheet; ½ k V · 3 · 0.1² of a block.
  CHECK(stretched_energy(sheet, EdgeSpring{.stiffness = 7}, 1.1) == approx(3.5 * 0.01 * squared_lengths));
  CHECK(stretched_energy(chain({.links = 5, .length = 3}), EdgeStrain{.stiffness = 7}, 1.1) == approx(3.5 * 3 * 0.01));
  CHECK(stretched_energy(sheet, TriangleStrain{.stiffness = 7}, 1.1) == approx(3.5 * 6 * 2 * 0.01));
  CHECK(stretched_energy(block, TetrahedronStrain{.stiffness = 7}, 1.1) == approx(3.5 * 6 * 3 * 0.01));
  // Every triangle gives a third of its area to each of its edges.
  CHECK(stretched_energy(sheet, EdgeStrain{.measure = FibreMeasure::cloth, .stiffness = 7}, 1.1) ==
        approx(3.5 * 6 * 0.01));
  // What the limits leave free costs nothing; beyond, the excess alone.
  CHECK(stretched_energy(sheet, TriangleStrain{.stiffness = 7, .max_stretch = 1.1}, 1.09) == approx(0));
  CHECK(stretched_energy(sheet, TriangleStrain{.stiffness = 7, .max_stretch = 1.1}, 1.3) == approx(3.5 * 6 * 2 * 0.04));
  CHECK(stretched_energy(block, TetrahedronStrain{.stiffness = 7, .min_stretch = 0.9}, 0.8) ==
        approx(3.5 * 6 * 3 * 0.01));
}

TEST_CASE("a rope without pressure resists stretching alone") {
  const Mesh rope = chain({.links = 4});
  const EdgeStrain options{.stiffness = 100, .min_stretch = 0};
  CHECK(stretched_energy(rope, options, 0.5) == 0);
  CHECK(stretched_energy(rope, options, 0) == 0);
  CHECK(stretched_energy(rope, options, 1.1) == doctest::Approx(0.5));
}

TEST_CASE("a selection takes the constraints whose whole stencil it holds") {
  const Mesh sheet = grid({.columns = 4, .rows = 4});
  const Selection corner = {0, 1, 4, 5};
  CHECK(Elastic(sheet, EdgeSpring{.on = corner}).set().count == 5);
  CHECK(Elastic(sheet, TriangleStrain{.on = corner}).set().count == 2);
  CHECK(Elastic(sheet, HingeBending{.on = corner}).set().count == 1);
  CHECK(Elastic(sheet, Bending{.on = corner}).set().count == 0);
  CHECK(Elastic(sheet, Position{.on = corner, .hold = Hold::soft}).set().count == 4);
  CHECK(Elastic(sheet, EdgeSpring{.on = std::vector<Index>{}}).set().count == 0);
  CHECK(Elastic(sheet, EdgeSpring{}).set().count == 33);
}

TEST_CASE("what is not defined at the border of a mesh is counted") {
  const ConstraintSet bending = build(BodyView{grid({.columns = 4, .rows = 4}), {}, 0, "sheet"}, Bending{});
  CHECK(bending.count == 4);
  CHECK(bending.skipped == 12);
  const Mesh ring = torus({.major_segments = 8, .minor_segments = 6});
  CHECK(Elastic(ring, Bending{}).set().skipped == 0);
  CHECK(Elastic(ring, Bending{}).set().count == 48);
  CHECK(Elastic(ring, HingeBending{}).set().skipped == 0);
  CHECK(Elastic(ring, HingeBending{}).set().count == 144);
}

TEST_CASE("a stiffness for each constraint weighs each") {
  const Mesh rope = chain({.links = 3});
  Elastic elastic(rope, EdgeSpring{.stiffness = std::vector<Real>{1, 10, 100}});
  for (int link = 0; link < 3; ++link) {
    Positions q = rope.vertices;
    for (int i = link + 1; i <= 3; ++i) q(i, 2) -= 0.2;
    CHECK(elastic.energy(q) == doctest::Approx(0.5 * std::pow(10, link) * 0.04).epsilon(1e-12));
  }
}

TEST_CASE("bending given by arrays is the bending of the mesh") {
  const Mesh hexagon = [] {
    Mesh mesh;
    mesh.vertices = Positions::Zero(7, 3);
    for (Index i = 0; i < 6; ++i) {
      mesh.vertices.row(i + 1) << std::cos(i * std::numbers::pi / 3), std::sin(i * std::numbers::pi / 3), 0.1 * (i % 2);
      mesh.triangles.push_back({0, i + 1, (i + 1) % 6 + 1});
    }
    return mesh;
  }();
  Mesh flat = hexagon;
  flat.vertices.col(2).setZero();
  // Equilateral: cot 60° twice for every neighbor, and a third of the six areas.
  const Real cotangents = 2 / std::sqrt(3.0);
  Bending arrays{.stencils = {{0, 1, 2, 3, 4, 5, 6}}, .stiffness = 3, .areas = std::sqrt(3.0) / 2};
  arrays.cotangents.add(std::vector<Real>(6, cotangents));
  Positions q = hexagon.vertices;
  q(0, 2) = 0.4;
  const Real energy = Elastic(flat, Bending{.stiffness = 3}).energy(q);
  CHECK(energy > 0.1);
  CHECK(Elastic(flat, arrays).energy(q) == doctest::Approx(energy).epsilon(1e-12));
}

TEST_CASE("stencils of a second body carry on where those of the first end") {
  const Mesh sheet = grid({.columns = 3, .rows = 3});
  const ConstraintSet set = build(BodyView{sheet, sheet.vertices, 100, "second"}, TriangleStrain{});
  for (const Index vertex : set.batches[0]->stencil()) CHECK((vertex >= 100 && vertex < 109));
  const ConstraintSet pins = build(BodyView{sheet, sheet.vertices, 100, "second"}, Position{.on = {4}});
  CHECK(pins.batches[0]->pinned_vertices()[0] == 104);
}

TEST_CASE("a flat mesh is flat to bending, however it lies in space") {
  Random random;
  for (int i = 0; i < 10; ++i) {
    Mesh sheet = grid({.columns = 7, .rows = 7, .diagonals = Diagonals::alternating});
    sheet.vertices = moved(sheet.vertices, random.rotation(), random.vector(1));
    for (const Orientation orientation : {Orientation::absolute, Orientation::signed_}) {
      const Elastic bending(sheet, Bending{.orientation = orientation});
      const Elastic hinges(sheet, HingeBending{.orientation = orientation});
      for (const ConstraintSet* set : {&bending.set(), &hinges.set()}) {
        for (const auto& batch : set->batches) CHECK(dynamic_cast<Batch<FlatCurvature>*>(batch.get()) != nullptr);
      }
    }
  }
}

TEST_CASE("groups call themselves by the type that they were asked for, flat and curved, and in another order") {
  const Mesh flat = grid({.columns = 4, .rows = 4});
  Mesh curved = flat;
  for (Index v = 0; v < curved.vertex_count(); ++v) curved.vertices(v, 1) = std::pow(curved.vertices(v, 0), 2);
  for (const Mesh* mesh : std::initializer_list<const Mesh*>{&flat, &curved}) {
    for (const Orientation orientation : {Orientation::absolute, Orientation::signed_}) {
      const Elastic bending(*mesh, Bending{.orientation = orientation});
      const Elastic hinges(*mesh, HingeBending{.orientation = orientation});
      for (const auto& batch : bending.set().batches) CHECK(batch->type() == "bending");
      for (const auto& batch : hinges.set().batches) {
        CHECK(batch->type() == "hinge");
        std::vector<Index> order(static_cast<std::size_t>(batch->shape().count));
        std::iota(order.begin(), order.end(), 0);
        std::vector<Index> numbers(static_cast<std::size_t>(mesh->vertex_count()));
        std::iota(numbers.begin(), numbers.end(), 0);
        CHECK(batch->reordered(order, numbers)->type() == "hinge");
      }
    }
  }
}

}  // namespace test_builders
