// The system of equations knows what has to be made anew, and what a step works on keeps the user's state.
#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "../simulation/everything.h"
#include "pliant/constraints/batch.h"
#include "pliant/solver/system.h"
#include "pliant/solver/threads.h"
#include "pliant/solver/working_state.h"

namespace test_system {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// Three masses in a row, with two springs between them.
struct Row {
  Batch<EdgeSpringProjection> springs{10};
  System system;
  std::vector<Real> masses{1, 2, 3};
  ThreadPool threads{1};
  SetUpTimes times;
  std::vector<Real> more;  // on the diagonal

  Row() {
    for (const Index first : {0, 1}) add(first, first + 1);
    system.set_factorization(make_factorization(Backend::eigen));
    system.set_groups(3, {&springs});
  }
  void add(Index from, Index to) {
    const std::array<Index, 2> stencil = {from, to};
    const std::array<Real, 2> difference = {-1, 1};
    const Real length = 1;
    springs.add(stencil, difference, 1, {&length, 1});
  }
  void make(Real step) {
    if (system.needs_layout()) system.lay_out();
    if (system.needs_factor(step, more)) system.factorize(masses, more, step, Precision::double_, threads, times);
  }
};

}  // namespace

TEST_CASE("a system asks for a layout and a factor when something in it has changed, and only then") {
  Row row;
  CHECK(row.system.needs_layout());
  row.make(0.1);
  CHECK(!row.system.needs_layout());
  CHECK(!row.system.needs_factor(0.1, row.more));
  CHECK(row.system.needs_factor(0.2, row.more));
  row.springs.set_stiffness(20);
  CHECK(!row.system.needs_layout());
  CHECK(row.system.needs_factor(0.1, row.more));
  row.make(0.1);
  CHECK(!row.system.needs_factor(0.1, row.more));
  row.system.forget_factor();
  CHECK(row.system.needs_factor(0.1, row.more));
  row.make(0.1);
  row.add(0, 2);
  CHECK(row.system.needs_layout());
  row.make(0.1);
  CHECK(!row.system.needs_factor(0.1, row.more));
  row.system.set_groups(3, {});
  CHECK(row.system.needs_layout());
}

TEST_CASE("solving is what the factor of M/h² and the springs says") {
  Row row;
  row.make(0.5);
  Eigen::Matrix3d Y;
  Y << 4 + 10, -10, 0, -10, 8 + 20, -10, 0, -10, 12 + 10;
  Random random;
  Positions r = random.positions(3, 1);
  Positions x(3, 3);
  row.system.solve(r, x, row.threads);
  CHECK((Y * x - r).cwiseAbs().maxCoeff() < 1e-12);
  row.more = {1, 2, 3};
  CHECK(row.system.needs_factor(0.5, row.more));
  row.make(0.5);
  CHECK(!row.system.needs_factor(0.5, row.more));
  CHECK(row.system.needs_factor(0.5, {}));
  Y.diagonal() += Vec3(1, 2, 3);
  row.system.set_inertia(row.masses, 0.5);  // as each step does after it has found a factor that fits
  row.system.solve(r, x, row.threads);
  CHECK((Y * x - r).cwiseAbs().maxCoeff() < 1e-12);
  CHECK(row.system.components().count() == 1);
  CHECK(row.system.free_components().count() == 1);
}

TEST_CASE("a state comes back from the solver's order as it was") {
  Simulation simulation = everything({}, 9);
  const Index count = simulation.state().vertex_count();
  std::vector<ConstraintGroup*> groups;
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) groups.push_back(batch.get());
  }
  LocalGroups order;
  order.set(groups);
  REQUIRE(order.reorder(count));
  Random random;
  State state = simulation.state();
  state.velocities = random.positions(count, 1);
  state.previous_positions = random.positions(count, 1);
  state.previous_velocities = random.positions(count, 1);
  state.previous_time_step = 0.1;
  state.energy_surplus.assign(at(count), 0);
  state.energy_surplus[3] = 5;

  WorkingState work;
  work.resize(count);
  work.gather(state, order);
  bool is_moved = false;
  for (Index i = 0; i < count; ++i) {
    CHECK(work.begin.positions.row(i) == state.positions.row(order.vertex(i)));
    CHECK(work.begin.masses[at(i)] == state.masses[at(order.vertex(i))]);
    is_moved = is_moved || order.vertex(i) != i;
  }
  CHECK(is_moved);
  work.positions = work.begin.previous_positions;
  work.velocities = work.begin.previous_velocities;
  work.energy_surplus = work.begin.energy_surplus;
  State after = state;
  work.scatter(order, true, 0.2, after);
  CHECK(after.positions == state.previous_positions);
  CHECK(after.velocities == state.previous_velocities);
  CHECK(after.previous_positions == state.positions);
  CHECK(after.previous_velocities == state.velocities);
  CHECK(after.previous_time_step == 0.2);
  CHECK(after.energy_surplus == state.energy_surplus);
  work.scatter(order, false, 0.2, after);
  CHECK(after.previous_time_step == 0);
}

TEST_CASE("few slots have one thread, many as many as were asked for") {
  SolverThreads threads;
  threads.fit(3, 100);
  CHECK(threads.pool().thread_count() == 1);
  threads.fit(3, 1000000);
  CHECK(threads.pool().thread_count() == 3);
  threads.begin_iteration();
  CHECK(threads.active() == 3);
  threads.fit(1, 1000000);
  threads.begin_iteration();
  CHECK(threads.active() == 1);
}

}  // namespace test_system
