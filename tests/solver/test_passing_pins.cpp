// Pins that come while a simulation runs stand beside the factor: the result is as if they were in it, hard or soft,
// and neither their coming nor their going costs a factorization.
#include <algorithm>

#include <doctest/doctest.h>

#include "tests/solver/passing_rig.h"

namespace test_passing_pins {

using namespace pliant;
using namespace pliant_tests;
using namespace pliant_tests::passing;

namespace {

constexpr Index middle = side * side / 2;

/// Vertices far from each other and side by side, at most a third of them.
std::vector<Index> some_vertices(std::size_t count) {
  std::vector<Index> vertices;
  for (std::size_t i = 0; i < count; ++i) vertices.push_back(static_cast<Index>(i % 2 == 0 ? 3 * i : 3 * i - 2));
  return vertices;
}

void check_solve(Factor& factor, const LowerMatrix& matrix, const FactorRows& rows, Real rounding, Random& random) {
  Positions r = random.positions(matrix.size(), 1);
  for (std::size_t i = 0; i < rows.count(); ++i) {
    if (rows.holds[i] != 0) r.row(rows.vertices[rows.starts[i]]).setZero();
  }
  const Positions x = check_solution(factor, matrix, rows, r, rounding);
  for (std::size_t i = 0; i < rows.count(); ++i) {
    if (rows.holds[i] != 0) CHECK(x.row(rows.vertices[rows.starts[i]]).isZero(0));
  }
}

/// A sheet with a pin that came in the third step, and one that had it from the start; both in the same state.
struct Two {
  Hung late, early;
  GroupId late_pin{}, early_pin{};

  Two(const SolverSettings& settings, const Position& pin, bool is_shuffled = false, bool is_free = false)
      : late(settings, is_shuffled, is_free), early(settings, is_shuffled, is_free) {
    early_pin = early.simulation.add(early.body, pin);
    for (int i = 0; i < 2; ++i) late.simulation.step();
    late_pin = late.simulation.add(late.body, pin);
    const State state = late.simulation.state();
    for (Hung* each : {&late, &early}) each->simulation.set_state(state.positions, state.velocities);
  }
  /// Returns factorizations of the one where it came.
  int advance(int steps) {
    int factorizations = 0;
    for (int i = 0; i < steps; ++i) {
      factorizations += late.simulation.step().set_up.numeric > 0 ? 1 : 0;
      early.simulation.step();
    }
    return factorizations;
  }
  Real difference() const { return pliant_tests::passing::difference(late.simulation, early.simulation); }
};

Position pin_at(Index vertex, Hold hold, Real stiffness, const Hung& on) {
  const Vec3 target = row(on.simulation.state().positions, vertex) + Vec3(0.1, 0.2, 0.3);
  return {.on = {vertex}, .hold = hold, .stiffness = stiffness, .targets = target};
}

/// A block on a floor, whose contacts are so stiff that they go into the factor at once, with a pin in it or beside it.
Simulation pressed_block(bool is_late) {
  Simulation simulation({.iterations = 400, .precision = Precision::double_, .threads = 1});
  Mesh block = bar({.cells = {3, 3, 3}, .size = {0.3, 0.3, 0.3}});
  block.vertices.rowwise() += Eigen::RowVector3d(0, 0, 0.015);
  const Position pin{.on = {63}, .targets = Vec3(row(block.vertices, 63) - Vec3(0, 0, 0.01))};
  const BodyId body = simulation.add_body(std::move(block), Mass::density(300));
  simulation.add(body, TetrahedronStrain{.stiffness = 1e5});
  simulation.add(Gravity{});
  simulation.add(PlaneCollider{.friction = 0.0});
  simulation.set_contact({.distance = 0.02, .surfaces = false});
  if (!is_late) simulation.add(body, pin);
  State state = simulation.state();
  state.step = 1;
  state.velocities.col(2).setConstant(-0.5);
  state.contact.stiffening.assign(state.masses.size(), 50);
  simulation.restore(state);
  if (is_late) simulation.add(body, pin);
  return simulation;
}

}  // namespace

TEST_CASE("passing pins: a solve with held vertices is that of the matrix without them") {
  const LowerMatrix matrix = springs(14, 3, 100);
  Random random(5);
  for (const Precision precision : {Precision::double_, Precision::mixed}) {
    Factor factor(matrix, precision);
    for (const std::size_t count : {1u, 2u, 7u, 28u}) {
      for (const std::size_t soft : {0u, 4u}) {
        CAPTURE(count);
        CAPTURE(soft);
        FactorRows rows;
        for (const Index v : some_vertices(count)) rows.hold(v);
        for (std::size_t i = 0; i < soft; ++i) {  // of vertices that are not held
          rows.add(std::array{static_cast<Index>(3 * i + 2)}, std::array{Real(1)},
                   std::pow(Real(10), 3 * static_cast<Real>(i)));
        }
        CHECK(factor.step.correct(rows));
        CHECK_FALSE(factor.step.correct(rows));
        check_solve(factor, matrix, rows, precision == Precision::double_ ? 1e-10 : 1e-5, random);
      }
    }
    FactorRows soft;  // the same row, no longer held
    soft.add(std::array{Index(0)}, std::array{Real(1)}, 1);
    FactorRows held;
    held.hold(0);
    CHECK(factor.step.correct(held));
    CHECK(factor.step.correct(soft));
    check_solve(factor, matrix, soft, precision == Precision::double_ ? 1e-10 : 1e-5, random);
  }
}

TEST_CASE("passing pins: what nothing held in the factor moves as a whole where it is held or dragged now") {
  constexpr Real mass = 1e-4;  // against springs of 100 N/m, so that single precision alone would not do
  const LowerMatrix matrix = springs(14, mass, 100);
  Components all;
  for (Index v = 0; v < matrix.size(); ++v) all.vertices.push_back(v);
  all.starts.push_back(all.vertices.size());
  Random random(6);
  for (const Precision precision : {Precision::double_, Precision::mixed}) {
    Factor factor(matrix, precision, all, mass);
    for (const Real weight : {1e-3, 1.0, 1e6}) {
      CAPTURE(weight);
      FactorRows rows;
      rows.add(std::array{Index(40), Index(41)}, std::array{Real(0.3), Real(0.7)}, weight);
      CHECK(factor.step.correct(rows));
      check_solve(factor, matrix, rows, precision == Precision::double_ ? 1e-9 : 2e-3, random);
      rows.hold(100);
      CHECK(factor.step.correct(rows));
      check_solve(factor, matrix, rows, precision == Precision::double_ ? 1e-9 : 2e-3, random);
    }
  }
}

TEST_CASE("passing pins: a pin that comes moves a sheet as one that was there, and costs no factorization") {
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::lbfgs}) {
    // L-BFGS remembers its moves in single precision; 1.1e-6 on an Intel Xeon, below 1e-6 on an AMD EPYC.
    const Real rounding = acceleration == Acceleration::none ? 1e-9 : 1e-5;
    const SolverSettings settings{
        .iterations = 10, .acceleration = acceleration, .precision = Precision::double_, .threads = 1};
    for (const bool is_shuffled : {false, true}) {
      for (const bool is_free : {false, true}) {
        // and what is not converged goes other ways from there, in motions as large as these
        if (acceleration == Acceleration::lbfgs && (is_shuffled || is_free)) continue;
        for (const auto& pull : {std::pair{Hold::hard, 1.0}, {Hold::soft, 1.0}, {Hold::soft, 1e3}, {Hold::soft, 1e8}}) {
          const Hold hold = pull.first;
          const Real stiffness = pull.second;
          CAPTURE(static_cast<int>(acceleration));
          CAPTURE(is_shuffled);
          CAPTURE(is_free);
          CAPTURE(static_cast<int>(hold));
          CAPTURE(stiffness);
          const Position pin = pin_at(middle + 3, hold, stiffness, Hung(settings, is_shuffled, is_free));
          Two two(settings, pin, is_shuffled, is_free);
          CHECK(two.advance(6) == 0);
          CHECK(two.difference() < rounding);
          const Evaluation a = two.late.simulation.evaluate(), b = two.early.simulation.evaluate();
          CHECK(a.residual == doctest::Approx(b.residual).epsilon(1e-4));
          CHECK(a.elastic == doctest::Approx(b.elastic).epsilon(1e-4));
          const Vec3 target = Vec3(0.3, 0.1, 0.2);  // moved
          two.late.simulation.set_target(two.late_pin, 0, target);
          two.early.simulation.set_target(two.early_pin, 0, target);
          CHECK(two.advance(3) == 0);
          CHECK(two.difference() < rounding);
          if (hold == Hold::hard) CHECK(row(two.late.simulation.state().positions, middle + 3) == target);
          two.late.simulation.remove(two.late_pin);
          two.early.simulation.remove(two.early_pin);
          CHECK(two.advance(3) == 0);
          CHECK(two.difference() < rounding);
        }
      }
    }
  }
}

TEST_CASE("passing pins: beside contact in the factor") {
  std::array<Simulation, 2> blocks = {pressed_block(false), pressed_block(true)};
  for (Simulation& block : blocks) CHECK(block.step().contact.refactorizations == 1);
  CHECK((blocks[0].state().positions - blocks[1].state().positions).cwiseAbs().maxCoeff() < 1e-8);
  blocks[0].step();
  CHECK(blocks[1].step().contact.contacts > 0);
  CHECK((blocks[0].state().positions - blocks[1].state().positions).cwiseAbs().maxCoeff() < 1e-7);
}

TEST_CASE("passing pins: the same bits for any number of threads, in a copy and after a state was restored") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const bool is_free : {false, true}) {
      CAPTURE(static_cast<int>(integrator));
      CAPTURE(is_free);
      SolverSettings settings{.integrator = integrator, .iterations = 6, .threads = 1};
      const auto add_pins = [](Hung& to) {
        to.simulation.add(to.body, Position{.on = {middle, middle + 1}});
        to.simulation.add(to.body, Position{.on = {middle + 20}, .hold = Hold::soft, .stiffness = 1e4});
      };
      Hung once(settings, true, is_free);
      once.simulation.step();
      const State before = once.simulation.state();
      add_pins(once);
      for (int i = 0; i < 6; ++i) once.simulation.step();
      Simulation copy = once.simulation.copy();
      const State at_copy = once.simulation.state();
      copy.restore(at_copy);
      copy.step();
      for (const Index threads : {2, 3}) {
        settings.threads = threads;
        Hung again(settings, true, is_free), resumed(settings, true, is_free);
        again.simulation.step();
        resumed.simulation.restore(before);  // its first step factorizes, with the pins there
        for (Hung* each : {&again, &resumed}) {
          add_pins(*each);
          for (int i = 0; i < 6; ++i) each->simulation.step();
          CHECK(same_bits(each->simulation.state().positions, once.simulation.state().positions));
        }
      }
      once.simulation.step();
      CHECK(same_bits(copy.state().positions, once.simulation.state().positions));
    }
  }
}

TEST_CASE("passing pins: which are in the factor") {
  Hung hung({.iterations = 10, .threads = 1});
  hung.simulation.step();
  std::vector<Index> few, many;
  for (Index v = 20; v < 52; ++v) few.push_back(v);
  const GroupId first = hung.simulation.add(hung.body, Position{.on = few});
  CHECK(hung.simulation.step().set_up.numeric == 0);
  CHECK(hung.simulation.system_info().pinned_vertices == 34);
  const GroupId second = hung.simulation.add(hung.body, Position{.on = {100}});
  CHECK(hung.simulation.step().set_up.numeric > 0);  // there is no more room
  hung.simulation.add(hung.body, Drag{.stencils = {{90}, {91}}, .stiffness = 100});
  CHECK(hung.simulation.step().set_up.numeric == 0);  // drags have their own
  hung.simulation.release(first, std::array<Index, 1>{20});
  CHECK(hung.simulation.step().set_up.numeric == 0);  // what is in the factor stays there
  hung.simulation.release(first, std::array<Index, 2>{21, 22});
  CHECK(hung.simulation.step().set_up.numeric == 0);
  hung.simulation.replace(second, Position{.on = {101}, .hold = Hold::soft});
  CHECK(hung.simulation.step().set_up.numeric > 0);
  std::vector<Index> rest(few.begin() + 3, few.end());
  hung.simulation.release(first, rest);  // all that are left
  CHECK(hung.simulation.step().set_up.numeric == 0);
  hung.simulation.replace(first, Position{.on = few});
  CHECK(hung.simulation.step().set_up.numeric == 0);
  hung.simulation.remove(first);
  CHECK(hung.simulation.step().set_up.numeric == 0);
  const GroupId pins = hung.simulation.find_group("position").value();  // that it hung by from the start
  hung.simulation.release(pins, std::array<Index, 1>{0});
  CHECK(hung.simulation.step().set_up.numeric > 0);
  CHECK(hung.simulation.system_info().pinned_vertices == 1);
}

TEST_CASE("passing pins: a body that a pin holds is not free, and its energy is that of one that was pinned") {
  SolverSettings settings{.iterations = 40, .precision = Precision::double_, .threads = 1};
  settings.energy_projection = 1;
  const Position pin = pin_at(middle, Hold::hard, 1, Hung(settings));
  Two two(settings, pin, false, true);
  CHECK(two.late.simulation.system_info().free_components.empty());
  for (int i = 0; i < 10; ++i) {
    two.advance(1);
    CHECK(two.difference() < 1e-7);
  }
  two.late.simulation.remove(two.late_pin);
  CHECK(two.late.simulation.system_info().free_components.size() == 1);
}

TEST_CASE("passing pins: steps whose inertia is not that of the factor, as the first one of BDF2") {
  const auto make = [](Acceleration acceleration) {
    Simulation sheet({.integrator = Integrator::bdf2,
                      .iterations = 80,
                      .acceleration = acceleration,
                      .precision = Precision::double_,
                      .threads = 1});
    const BodyId body = sheet.add_body(grid({.columns = 24, .rows = 24}), Mass::area_density(0.3));
    sheet.add(body, TriangleStrain{.stiffness = 1e4});
    sheet.add(Gravity{});
    return sheet;
  };
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::chebyshev}) {
    CAPTURE(static_cast<int>(acceleration));
    Simulation dragged = make(acceleration), pinned = make(acceleration);
    const Vec3 target = row(dragged.state().positions, 300);
    dragged.add(BodyId{0}, Drag{.stencils = {{300}}, .stiffness = 1e4, .targets = target});
    pinned.add(BodyId{0}, Position{.on = {300}, .hold = Hold::soft, .stiffness = 1e4, .targets = target});
    for (Simulation* sheet : {&dragged, &pinned}) sheet->step();
    CHECK(difference(dragged, pinned) < 1e-5);
  }
}

TEST_CASE("passing pins: a drag of a vertex that a pin holds does nothing") {
  Hung still({.iterations = 10, .threads = 1}), dragged({.iterations = 10, .threads = 1});
  for (Hung* each : {&still, &dragged}) {
    each->simulation.step();
    each->simulation.add(each->body, Position{.on = {middle}});
  }
  dragged.simulation.add(dragged.body, Drag{.stencils = {{middle}}, .stiffness = 1e4, .targets = {Vec3(5, 5, 5)}});
  for (int i = 0; i < 5; ++i) {
    still.simulation.step();
    dragged.simulation.step();
  }
  CHECK(difference(still.simulation, dragged.simulation) == 0);
}

}  // namespace test_passing_pins
