// Meshes in random order: the solver works in an order of its own, and nobody else sees it.
#include <numeric>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "../simulation/everything.h"
#include "../simulation/run.h"
#include "pliant/forces/builtin.h"
#include "pliant/solver/local/local_step.h"
#include "pliant/solver/local/locality.h"

namespace test_locality {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Index side = 70;

/// Number of each vertex of a sheet: as it is, or another.
using Numbers = std::vector<Index>;

Numbers in_rows() {
  Numbers numbers(static_cast<std::size_t>(side * side));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

Numbers at_random() {
  Numbers numbers = in_rows();
  Random random;
  for (Index i = side * side; i > 1; --i) {
    std::swap(numbers[static_cast<std::size_t>(i) - 1], numbers[static_cast<std::size_t>(random.index(i))]);
  }
  return numbers;
}

Mesh sheet(const Numbers& numbers) {
  const Mesh rows = grid({.columns = side, .rows = side});
  Mesh mesh;
  mesh.vertices.resize(rows.vertices.rows(), 3);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    mesh.vertices.row(numbers[i]) = rows.vertices.row(static_cast<Index>(i));
  }
  mesh.triangles = rows.triangles;
  for (Triangle& triangle : mesh.triangles) {
    for (Index& corner : triangle) corner = numbers[static_cast<std::size_t>(corner)];
  }
  return mesh;
}

/// Every type that goes with a sheet, and edits; vertices are named as in rows.
struct Rig {
  Numbers numbers;
  Simulation simulation;
  BodyId body{};
  GroupId springs{}, corners{}, pins{}, hinges{};

  Index at(Index vertex) const { return numbers[static_cast<std::size_t>(vertex)]; }

  explicit Rig(Numbers order, Index threads = 1)
      : numbers(std::move(order)), simulation({.iterations = 5, .precision = Precision::double_, .threads = threads}) {
    body = simulation.add_body(sheet(numbers), Mass::total(1));
    springs = simulation.add(body, EdgeSpring{.stiffness = 400});
    simulation.add(body, EdgeStrain{.stiffness = 30, .max_stretch = 1.02});
    simulation.add(body, TriangleStrain{.stiffness = 50});
    simulation.add(body, Bending{.stiffness = 1e-4, .orientation = Orientation::signed_});
    hinges = simulation.add(body, HingeBending{.stiffness = 1e-4});
    corners = simulation.add(body, Position{.on = std::vector<Index>{at(0)}});
    simulation.add(body, Position{.on = std::vector<Index>{at(side - 1)}});
    pins = simulation.add(body, Position{.on = std::vector<Index>{at(40)}, .hold = Hold::soft, .stiffness = 1e3});
    simulation.add(body, Line{.on = std::vector<Index>{at(99)}, .stiffness = 100, .direction = Vec3(1, 1, 0)});
    simulation.add(body, Drag{.stencils = {{at(300), at(301), at(301 + side)}}, .targets = Vec3(0.5, 0.4, 0.1)});
    simulation.add(body, Wind{.velocity = {0, 3, 1}, .drag = 0.5});
    add_gravity(simulation);
  }

  void edit() {
    simulation.set_stiffness(springs, 900);
    simulation.set_target(corners, 0, Vec3(0.1, 0.05, 0));
    simulation.set_target(pins, 0, Vec3(0.5, 0.1, 0.1));
    simulation.remove(hinges);
    simulation.add(body, Position{.on = std::vector<Index>{at(2000)}});
  }

  Positions rows_of(const Positions& x) const {
    Positions result(x.rows(), 3);
    for (std::size_t i = 0; i < numbers.size(); ++i) result.row(static_cast<Index>(i)) = x.row(numbers[i]);
    return result;
  }
};

void check_same(Rig& a, Rig& b) {
  const State& x = a.simulation.state();
  const State& y = b.simulation.state();
  CHECK(largest_difference(a.rows_of(x.positions), b.rows_of(y.positions)) < 1e-11);
  CHECK(largest_difference(a.rows_of(x.velocities), b.rows_of(y.velocities)) < 1e-9);
  const Evaluation of_a = a.simulation.evaluate();
  const Evaluation of_b = b.simulation.evaluate();
  CHECK(of_a.residual == doctest::Approx(of_b.residual).epsilon(1e-6));
  CHECK(of_a.inertia == doctest::Approx(of_b.inertia).epsilon(1e-8));
  CHECK(of_a.elastic == doctest::Approx(of_b.elastic).epsilon(1e-8));
  for (const auto& entry : a.simulation.groups()) {
    const GroupId id = entry.first;
    CAPTURE(entry.second.type);
    CHECK(a.simulation.elastic_energy(id) == doctest::Approx(b.simulation.elastic_energy(id)).epsilon(1e-8));
  }
}

std::vector<ConstraintGroup*> batches_of(const Simulation& simulation) {
  std::vector<ConstraintGroup*> batches;
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) batches.push_back(batch.get());
  }
  return batches;
}

/// One that has no copy in another order.
class Stubborn final : public ConstraintGroup {
 public:
  explicit Stubborn(Index vertex) : vertex_(vertex) {}
  std::string_view type() const override { return "stubborn"; }
  GroupShape shape() const override { return {1, 1, 1}; }
  std::span<const Index> stencil() const override { return {&vertex_, 1}; }
  std::span<const Real> reduction() const override { return {&one_, 1}; }
  std::span<const Real> rest_measure() const override { return {&one_, 1}; }
  Real project(const Positions& q, std::span<Real> out, Index, Index) const override {
    for (std::size_t axis = 0; axis < 3; ++axis) out[axis] = -q(vertex_, static_cast<Index>(axis));
    return q.row(vertex_).squaredNorm() / 2;
  }

 private:
  Index vertex_;
  Real one_ = 1;
};

}  // namespace

TEST_CASE("a mesh in random order counts as scattered, in an order of our own it does not") {
  LocalStep step;
  const Rig ordered(in_rows());
  step.set_groups(side * side, batches_of(ordered.simulation));
  CHECK(step.chunks_of_vertex() < 1.5);

  const Rig shuffled(at_random());
  LocalGroups groups;
  groups.set(batches_of(shuffled.simulation));
  step.set_groups(side * side, groups.in_use());
  CHECK(step.chunks_of_vertex() > 2.5);
  CHECK(groups.reorder(side * side));
  CHECK(groups.is_reordered());
  step.set_groups(side * side, groups.in_use());
  CHECK(step.chunks_of_vertex() < 1.5);
}

TEST_CASE("an order of our own has every vertex and every constraint once") {
  const Rig shuffled(at_random());
  const std::vector<ConstraintGroup*> batches = batches_of(shuffled.simulation);
  const LocalOrder order = find_local_order(side * side, batches);
  const auto check_permutation = [](std::vector<Index> list, Index count) {
    REQUIRE(list.size() == static_cast<std::size_t>(count));
    std::ranges::sort(list);
    for (Index i = 0; i < count; ++i) CHECK(list[static_cast<std::size_t>(i)] == i);
  };
  check_permutation(order.vertices, side * side);
  for (std::size_t i = 0; i < order.vertices.size(); ++i) {
    CHECK(order.numbers[static_cast<std::size_t>(order.vertices[i])] == static_cast<Index>(i));
  }
  REQUIRE(order.constraints.size() == batches.size());
  for (std::size_t g = 0; g < batches.size(); ++g) check_permutation(order.constraints[g], batches[g]->shape().count);
}

TEST_CASE("constraints in another order project to the same bits, after changes as well") {
  Simulation simulation = everything({}, 9);
  const std::vector<ConstraintGroup*> batches = batches_of(simulation);
  const auto count = simulation.state().vertex_count();
  LocalGroups groups;
  groups.set(batches);
  REQUIRE(groups.reorder(count));
  Random random;
  const Positions q = simulation.state().positions + random.positions(count, 0.05);
  Positions local_q, back;
  groups.gather(q, local_q);
  groups.scatter(local_q, back);
  CHECK(back == q);
  for (const bool changed : {false, true}) {
    for (ConstraintGroup* batch : batches) {
      if (!changed) continue;
      batch->set_stiffness(7);
      for (Real& number : batch->targets()) number += 0.1;
      batch->begin_step(simulation.state().view(), 0.1);
    }
    if (changed) groups.sync_parameters();
    for (std::size_t g = 0; g < batches.size(); ++g) {
      CAPTURE(batches[g]->type());
      const ConstraintGroup& copy = *groups.in_use()[g];
      CHECK(copy.pinned_vertices().size() == batches[g]->pinned_vertices().size());
      const auto rows = static_cast<std::size_t>(batches[g]->shape().rows);
      std::vector<Real> expected(3 * rows), found(3 * rows);
      for (Index i = 0; i < copy.shape().count; ++i) {
        const Index from = groups.constraint(g, i);
        const Real energy = batches[g]->project(q, expected, from, from + 1);
        CHECK(copy.project(local_q, found, i, i + 1) == energy);
        CHECK(found == expected);
      }
    }
  }
}

TEST_CASE("a mesh in random order moves as one in order, through edits, on any number of threads") {
  Rig ordered(in_rows());
  Rig shuffled(at_random());
  Rig threaded(at_random(), 3);
  for (Rig* rig : {&ordered, &shuffled, &threaded}) advance(rig->simulation, 4);
  check_same(ordered, shuffled);
  for (Rig* rig : {&ordered, &shuffled, &threaded}) rig->edit();
  check_same(ordered, shuffled);  // against the prediction of the step before the edit
  for (Rig* rig : {&ordered, &shuffled, &threaded}) advance(rig->simulation, 4);
  check_same(ordered, shuffled);
  CHECK(threaded.simulation.state().positions == shuffled.simulation.state().positions);
  for (const Index vertex : {0, 2000}) {
    const State& state = shuffled.simulation.state();
    CHECK(state.velocities.row(shuffled.at(vertex)).norm() == 0);
  }
  CHECK(shuffled.simulation.state().positions.row(shuffled.at(0)) == Eigen::RowVector3d(0.1, 0.05, 0));
}

TEST_CASE("what is reported of a mesh in random order has the user's numbers") {
  Simulation simulation;
  const BodyId body = simulation.add_body(sheet(at_random()), Mass::total(1));
  simulation.add(body, EdgeSpring{.stiffness = 400});
  const SystemInfo info = simulation.system_info();
  REQUIRE(info.free_components.size() == 1);
  CHECK(info.free_components[0].first_vertex == 0);
  CHECK(info.free_components[0].vertex_count == side * side);
  simulation.add(TestForce{.vertices = {50}, .force = Vec3(0, 1e200, 0), .frames = {1, TestForce::forever}});
  const State before = simulation.state();
  const std::string message = error_of([&] { advance(simulation, 3); }, ErrorKind::diverged);
  CAPTURE(message);
  CHECK(contains(message, "vertex 50 "));
}

TEST_CASE("a group that cannot be put in another order leaves all as they are") {
  Rig ordered(in_rows());
  Rig shuffled(at_random());
  for (Rig* rig : {&ordered, &shuffled}) {
    ConstraintSet set;
    set.batches.push_back(std::make_unique<Stubborn>(rig->at(2500)));
    set.count = 1;
    rig->simulation.add_set(rig->body, std::move(set), "stubborn");
  }
  LocalGroups groups;
  groups.set(batches_of(shuffled.simulation));
  CHECK(!groups.reorder(side * side));
  CHECK(!groups.is_reordered());
  for (Rig* rig : {&ordered, &shuffled}) advance(rig->simulation, 4);
  check_same(ordered, shuffled);
}

}  // namespace test_locality
