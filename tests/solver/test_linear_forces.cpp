// Forces of flat bending by one product with a sparse matrix, against the constraints one by one.
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include <doctest/doctest.h>

#include "../constraints/elastic.h"
#include "../core/random.h"
#include "pliant/constraints/curvature.h"
#include "pliant/constraints/kernels/local_kernels.h"
#include "pliant/mesh/join.h"
#include "pliant/pliant.h"

namespace test_linear_forces {

using namespace pliant;
using pliant_tests::Elastic;
using pliant_tests::Random;

namespace {

/// A sheet, bent and crumpled.
struct Crumpled {
  Mesh mesh = grid({.columns = 23, .rows = 19, .size = {1, 0.7}});
  Positions q = mesh.vertices;

  explicit Crumpled(Real size = 0.05) {
    Random random;
    for (Index i = 0; i < q.rows(); ++i) q.row(i) += random.vector(size).transpose();
  }
};

/// Energy and forces of all constraints, each by itself.
std::pair<Real, Positions> one_by_one(const ConstraintSet& set, const Positions& q) {
  Real energy = 0;
  Positions forces = Positions::Zero(q.rows(), 3);
  for (const auto& batch : set.batches) {
    const auto n = static_cast<std::size_t>(batch->shape().vertices);
    std::vector<Real> out(3 * n);
    for (Index i = 0; i < batch->shape().count; ++i) {
      energy += batch->ConstraintGroup::project_to_forces(q, out, i, i + 1);
      for (std::size_t j = 0; j < n; ++j) {
        const Index vertex = batch->stencil()[at(i) * n + j];
        for (Index axis = 0; axis < 3; ++axis) forces(vertex, axis) += out[3 * j + at(axis)];
      }
    }
  }
  return {energy, forces};
}

/// Rows of all flat batches of a set.
struct Rows {
  LinearForces forces;
  std::vector<std::pair<const ConstraintGroup*, LinearForces::Rows>> of;

  Rows(const ConstraintSet& set, Index vertex_count) {
    for (const auto& batch : set.batches) {
      if (batch->is_linear()) of.emplace_back(batch.get(), forces.add(*batch, vertex_count));
    }
  }
};

ConstraintSet hinges_of(const Mesh& mesh, Values stiffness = 0.3) {
  return build(BodyView{mesh, mesh.vertices, 0, "sheet"}, HingeBending{.stiffness = std::move(stiffness)});
}

}  // namespace

TEST_CASE("hinges of a flat sheet are linear, those of a curved one are not") {
  const Crumpled sheet;
  const ConstraintSet flat = hinges_of(sheet.mesh);
  REQUIRE(flat.batches.size() == 1);
  CHECK(flat.batches[0]->is_linear());
  const Rows rows(flat, sheet.mesh.vertex_count());
  CHECK(rows.of[0].second.are_worth_it);
  CHECK(rows.of[0].second.end - rows.of[0].second.begin == at(sheet.mesh.vertex_count()));
  for (const auto& batch : hinges_of(sphere({.subdivisions = 2})).batches) CHECK_FALSE(batch->is_linear());
  const ConstraintSet fans = build(BodyView{sheet.mesh, sheet.mesh.vertices, 0, "sheet"}, Bending{});
  for (const auto& [group, of_group] : Rows(fans, sheet.mesh.vertex_count()).of) CHECK_FALSE(of_group.are_worth_it);
}

TEST_CASE("forces and energy are those of the constraints, whatever the bending") {
  const Crumpled sheet;
  const auto check = [&](const auto& options) {
    Elastic elastic(sheet.mesh, options);
    const auto pair = one_by_one(elastic.set(), sheet.q);
    const Real energy = pair.first;
    const Positions& forces = pair.second;
    REQUIRE(energy > 1e-3);
    CHECK(elastic.energy(sheet.q) == doctest::Approx(energy).epsilon(1e-12));
    CHECK((elastic.forces(sheet.q) - forces).cwiseAbs().maxCoeff() < 1e-12 * forces.cwiseAbs().maxCoeff());
  };
  check(HingeBending{.stiffness = 0.3});
  check(Bending{.stiffness = 0.3});
  check(TriangleBending{.stiffness = 0.3});
  std::vector<Real> each(hinges(sheet.mesh).stencils.size());
  for (std::size_t i = 0; i < each.size(); ++i) each[i] = 0.1 + 0.01 * static_cast<Real>(i % 7);
  check(HingeBending{.stiffness = each});
}

TEST_CASE("all instruction sets have the same bits of forces") {
  const Crumpled sheet;
  // A matrix of our own, since the class asks the fastest of them alone: every vertex with the next three.
  const auto m = static_cast<std::int32_t>(sheet.q.rows());
  std::vector<std::int32_t> vertices, columns;
  std::vector<std::uint32_t> offsets{0};
  std::vector<double> values;
  Random random;
  for (std::int32_t v = 0; v < m; ++v) {
    vertices.push_back(v);
    for (std::int32_t k = 1; k <= 3; ++k) {
      columns.push_back((v + k) % m);
      values.push_back(random.uniform(-1, 1));
    }
    offsets.push_back(static_cast<std::uint32_t>(columns.size()));
  }
  std::vector<double> first;
  double energy = 0;
  for (const LocalKernels* kernels : local_kernels()) {
    CAPTURE(kernels->instruction_set);
    std::vector<double> forces(3 * vertices.size());
    const double found = kernels->linear_forces({.positions = sheet.q.data(),
                                                 .vertices = vertices.data(),
                                                 .offsets = offsets.data(),
                                                 .columns = columns.data(),
                                                 .values = values.data(),
                                                 .stiffness = 0.7,
                                                 .begin = 0,
                                                 .end = vertices.size(),
                                                 .forces = forces.data()});
    if (first.empty()) {
      first = forces;
      energy = found;
    }
    CHECK(forces == first);
    CHECK(found == energy);
  }
}

TEST_CASE("a stiff plate at rest, turned and moved, feels no force and stays where it is") {
  Mesh mesh = grid({.columns = 30, .rows = 30, .size = {0.3, 0.3}});
  const Mat3 turn = Eigen::AngleAxisd(1, Vec3(1, 2, -3).normalized()).toRotationMatrix();
  for (const Vec3& to : {Vec3(0, 0, 0), Vec3(3, -2, 1), Vec3(-200, 0.1, 30)}) {
    CAPTURE(to);
    Mesh moved = mesh;
    moved.vertices = pliant_tests::moved(mesh.vertices, turn, to);
    Elastic elastic(moved, HingeBending{.stiffness = 17});
    CHECK(elastic.forces(moved.vertices).isZero(0));
    CHECK(elastic.energy(moved.vertices) == 0);

    Simulation simulation({.iterations = 5, .threads = 1});
    const BodyId plate = simulation.add_body(moved, Mass::area_density(7.8));
    simulation.add(plate, TriangleStrain{.stiffness = 1e6});
    simulation.add(plate, HingeBending{.stiffness = 17});
    for (int i = 0; i < 100; ++i) simulation.step();
    CHECK((simulation.state().positions - moved.vertices).cwiseAbs().maxCoeff() < 1e-12);
  }
}

TEST_CASE("a bend that is far above rounding has its force") {
  const Mesh mesh = grid({.columns = 30, .rows = 30, .size = {0.3, 0.3}});
  Positions q = mesh.vertices;
  q.row(435) += Vec3(1e-12, 1e-12, 1e-12).transpose();
  Elastic elastic(mesh, HingeBending{.stiffness = 17});
  const Positions forces = one_by_one(elastic.set(), q).second;
  CHECK((elastic.forces(q) - forces).cwiseAbs().maxCoeff() < 1e-2 * forces.cwiseAbs().maxCoeff());
}

TEST_CASE("a group with a row for every pair of vertices is left to its constraints") {
  constexpr int n = 40;
  Batch<FlatCurvature> batch(1, n);
  std::vector<Index> stencil(n);
  std::vector<Real> coefficients(n, 1);
  coefficients[0] = 1 - n;
  for (Index i = 0; i < n; ++i) stencil[at(i)] = i;
  batch.add(stencil, coefficients, 1, {});
  LinearForces forces;
  CHECK_FALSE(forces.add(batch, n).are_worth_it);
  CHECK(forces.bytes() <= 8);
}

TEST_CASE("energies of components, in one chunk and in many, are those of their constraints") {
  Mesh two = grid({.columns = 20, .rows = 20, .size = {1, 1}});
  const Index half = two.vertex_count();
  two = join(std::vector<MeshPart>{{"", two}, {"", two}});
  Positions q = two.vertices;
  Random random;
  for (Index i = 0; i < q.rows(); ++i) q.row(i) += random.vector(i < half ? 0.01 : 0.03).transpose();
  const ConstraintSet set = hinges_of(two);
  std::vector<ConstraintGroup*> groups;
  for (const auto& batch : set.batches) groups.push_back(batch.get());
  LocalStep step;
  step.set_groups(two.vertex_count(), groups);
  std::vector<Index> component(at(two.vertex_count()), 0);
  for (Index i = half; i < two.vertex_count(); ++i) component[at(i)] = 1;
  step.set_components(component);
  ThreadPool threads(2);
  const std::vector<Real> weights(at(two.vertex_count()), 0);
  const std::vector<char> none(at(two.vertex_count()), 0);
  Positions forces(q.rows(), 3);
  const LocalResult result = step.run(q, q, weights, none, forces, threads);
  CHECK(result.rounding > 0);
  CHECK(result.rounding < 1e-12 * result.elastic);
  std::vector<Real> energies(2);
  step.elastic_energies(q, energies);
  CHECK(energies[0] + energies[1] == doctest::Approx(result.elastic).epsilon(1e-12));
  Positions only_first = two.vertices;
  only_first.topRows(half) = q.topRows(half);
  CHECK(energies[0] == doctest::Approx(one_by_one(set, only_first).first).epsilon(1e-12));
  CHECK(energies[1] > 2 * energies[0]);
  step.run(two.vertices, two.vertices, weights, none, forces, threads);
  step.elastic_energies(two.vertices, energies);
  CHECK(energies == std::vector<Real>{0, 0});
}

}  // namespace test_linear_forces
