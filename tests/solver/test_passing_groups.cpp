// Drags stay out of the factor, whose solves are corrected for them: the result is as if they were in it, and they cost
// no factorization.
#include <algorithm>
#include <cmath>

#include <doctest/doctest.h>

#include "tests/solver/passing_rig.h"

namespace test_passing_groups {

using namespace pliant;
using namespace pliant_tests;
using namespace pliant_tests::passing;

TEST_CASE("passing groups: a corrected solve is that of the whole matrix, whatever pulls and however hard") {
  const LowerMatrix matrix = springs(12, 3, 100);
  Random random(3);
  for (const Precision precision : {Precision::double_, Precision::mixed}) {
    const Real rounding = precision == Precision::double_ ? 1e-10 : 1e-5;
    Factor factor(matrix, precision);
    for (const std::size_t count : {1u, 2u, 3u, 4u, 8u, 32u}) {
      for (const Real weight : {1e-6, 1.0, 1e3, 1e9}) {
        CAPTURE(count);
        CAPTURE(weight);
        const FactorRows rows = some_rows(count, weight, random);
        CHECK(factor.step.correct(rows));
        CHECK_FALSE(factor.step.correct(rows));
        Positions r = random.positions(matrix.size(), 1);
        // and the pull of a stiff spring far from its target, beside which the rest must not be lost
        for (std::size_t e = rows.starts[0]; e < rows.starts[1]; ++e) {
          r.row(rows.vertices[e]) += 0.1 * weight * rows.coefficients[e] * Vec3(1, -2, 3).transpose();
        }
        check_solution(factor, matrix, rows, r, rounding);
      }
    }
    CHECK(factor.step.correct({}));
    Positions r = random.positions(matrix.size(), 1);
    Positions x(r.rows(), 3);
    factor.step.solve(r, 1, x, factor.threads);
    CHECK((x - Positions(dense(matrix, {}).ldlt().solve(r))).cwiseAbs().maxCoeff() < rounding);
  }
}

TEST_CASE("passing groups: another stiffness, and rows that are there twice") {
  const LowerMatrix matrix = springs(6, 3, 100);
  Factor factor(matrix, Precision::double_);
  const std::array<Index, 2> vertices = {4, 5};
  const std::array<Real, 2> coefficients = {0.25, 0.75};
  FactorRows rows;
  for (const Real weight : {1e17, 2e17, 3e17}) rows.add(vertices, coefficients, weight);
  rows.add({}, {}, 1);
  CHECK(rows.count() == 1);
  CHECK(rows.weights[0] == 6e17);
  CHECK(factor.step.correct(rows));
  rows.weights[0] = 20;
  CHECK(factor.step.correct(rows));
  Random random;
  Positions r = random.positions(matrix.size(), 1);
  Positions x(r.rows(), 3);
  factor.step.solve(r, 1, x, factor.threads);
  CHECK((dense(matrix, rows) * x - r).cwiseAbs().maxCoeff() < 1e-12);
  rows.weights[0] = std::numeric_limits<Real>::infinity();
  CHECK_THROWS_WITH_AS(factor.step.correct(rows), doctest::Contains("reduce its stiffness"), Error);
}

TEST_CASE("passing groups: what numbers do not hold is refused in every step, not in the first alone") {
  Simulation simulation;
  const BodyId dust = simulation.add_body(grid({.columns = 3, .rows = 3, .size = {1, 1}}), Mass::total(1e-9));
  simulation.step();
  const GroupId drag = simulation.add(dust, Drag{.stencils = {{4}}, .stiffness = 1e305});
  for (int i = 0; i < 3; ++i) {
    CHECK_THROWS_WITH_AS(simulation.step(), doctest::Contains("reduce its stiffness"), Error);
  }
  simulation.remove(drag);
  CHECK(simulation.step().iterations > 0);
}

TEST_CASE("passing groups: drags of the same triangle, or next to each other, hold what they hold") {
  for (const Real stiffness : {1e3, 1e6, 1e9}) {
    CAPTURE(stiffness);
    Hung hung({.iterations = 10, .threads = 1});
    const Triangle triangle = hung.simulation.bodies()[0].mesh.triangles[40];
    const std::array<Index, 3> t = {triangle[0], triangle[1], triangle[2]};
    Drag drag{.stiffness = stiffness};
    std::vector<Vec3> targets;
    for (const auto& weights : {std::array<Real, 3>{0.5, 0.3, 0.2},
                                {0.2, 0.5, 0.3},
                                {0.3, 0.2, 0.5},
                                {0.4, 0.3, 0.3},
                                {0.4, 0.300001, 0.299999},
                                {0.1, 0.1, 0.8}}) {
      drag.stencils.add(t);
      drag.weights.add(weights);
      Vec3 point = Vec3(0.02, 0, 0.05);
      for (std::size_t j = 0; j < 3; ++j) point += weights[j] * row(hung.simulation.state().positions, t[j]);
      targets.push_back(point);
    }
    drag.targets = targets;
    hung.simulation.add(hung.body, drag);
    for (int i = 0; i < 120; ++i) hung.simulation.step();
    for (const Index v : t) {
      const Vec3 moved = row(hung.simulation.state().positions, v) - row(hung.simulation.bodies()[0].mesh.vertices, v);
      CHECK((moved - Vec3(0.02, 0, 0.05)).norm() < 0.01);
    }
    CHECK(rms(hung.simulation) < 0.1);
  }
}

TEST_CASE("passing groups: a drag moves a sheet as a soft pin does, which is in the factor") {
  for (const Acceleration acceleration : {Acceleration::none, Acceleration::lbfgs}) {
    // L-BFGS remembers its moves in single precision.
    const Real rounding = acceleration == Acceleration::none ? 1e-9 : 1e-6;
    for (const bool is_shuffled : {false, true}) {
      for (const Real stiffness : {1.0, 1e3, 1e8}) {
        CAPTURE(static_cast<int>(acceleration));
        CAPTURE(is_shuffled);
        CAPTURE(stiffness);
        const SolverSettings settings{
            .iterations = 10, .acceleration = acceleration, .precision = Precision::double_, .threads = 1};
        Hung dragged(settings, is_shuffled), pinned(settings, is_shuffled);
        const Index vertex = side * side / 2 + 3;
        const Vec3 target = row(dragged.simulation.state().positions, vertex) + Vec3(0.1, 0.2, 0.3);
        for (int i = 0; i < 3; ++i) {
          dragged.simulation.step();
          pinned.simulation.step();
        }
        const GroupId drag = dragged.simulation.add(
            dragged.body, Drag{.stencils = {{vertex}}, .stiffness = stiffness, .targets = {target}});
        const GroupId pin = pinned.simulation.add(
            pinned.body, Position{.on = {vertex}, .hold = Hold::soft, .stiffness = stiffness, .targets = {target}});
        for (int i = 0; i < 6; ++i) {
          const StepReport report = dragged.simulation.step();
          CHECK(report.set_up.numeric == 0);
          pinned.simulation.step();
        }
        CHECK(difference(dragged.simulation, pinned.simulation) < rounding);
        const Evaluation a = dragged.simulation.evaluate(), b = pinned.simulation.evaluate();
        CHECK(a.residual == doctest::Approx(b.residual).epsilon(1e-4));
        CHECK(a.elastic == doctest::Approx(b.elastic).epsilon(1e-4));
        CHECK(dragged.simulation.elastic_energy(drag) ==
              doctest::Approx(pinned.simulation.elastic_energy(pin)).epsilon(1e-4));
        dragged.simulation.set_stiffness(drag, 3 * stiffness);
        pinned.simulation.set_stiffness(pin, 3 * stiffness);
        for (int i = 0; i < 3; ++i) {
          CHECK(dragged.simulation.step().set_up.numeric == 0);
          pinned.simulation.step();
        }
        CHECK(difference(dragged.simulation, pinned.simulation) < rounding);
        dragged.simulation.remove(drag);
        pinned.simulation.remove(pin);
        CHECK(dragged.simulation.step().set_up.numeric == 0);
        pinned.simulation.step();
        CHECK(difference(dragged.simulation, pinned.simulation) < rounding);
      }
    }
  }
}

TEST_CASE("passing groups: the same bits for any number of threads, and after a state was restored") {
  for (const Integrator integrator : {Integrator::implicit_euler, Integrator::bdf2}) {
    for (const bool is_free : {false, true}) {
      CAPTURE(static_cast<int>(integrator));
      CAPTURE(is_free);
      SolverSettings settings{.integrator = integrator, .iterations = 6, .threads = 1};
      Hung once(settings, true, is_free);
      once.simulation.step();
      const State before = once.simulation.state();
      once.add_drag(1e5);
      for (int i = 0; i < 6; ++i) once.simulation.step();
      for (const Index threads : {2, 3}) {
        settings.threads = threads;
        Hung again(settings, true, is_free), resumed(settings, true, is_free);
        again.simulation.step();
        resumed.simulation.restore(before);  // its first step factorizes, with the drag there
        for (Hung* each : {&again, &resumed}) {
          each->add_drag(1e5);
          for (int i = 0; i < 6; ++i) each->simulation.step();
          CHECK(same_bits(each->simulation.state().positions, once.simulation.state().positions));
          CHECK(each->simulation.thread_count() == threads);
        }
      }
    }
  }
}

TEST_CASE("passing groups: more of them than a few are in the factor") {
  Hung hung({.iterations = 10, .threads = 1});
  hung.simulation.step();
  Stencils few, many;
  for (Index v = 20; v < 28; ++v) few.add({v});
  for (Index v = 40; v < 49; ++v) many.add({v});
  const GroupId first = hung.simulation.add(hung.body, Drag{.stencils = few, .stiffness = 100});
  CHECK(hung.simulation.step().set_up.numeric == 0);
  const GroupId second = hung.simulation.add(hung.body, Drag{.stencils = {{60}}, .stiffness = 100});
  CHECK(hung.simulation.step().set_up.numeric > 0);
  CHECK(hung.simulation.step().set_up.numeric == 0);
  hung.simulation.remove(first);
  CHECK(hung.simulation.step().set_up.numeric > 0);  // there is room for the second
  hung.simulation.remove(second);
  CHECK(hung.simulation.step().set_up.numeric == 0);
  hung.simulation.add(hung.body, Drag{.stencils = many, .stiffness = 100});
  CHECK(hung.simulation.step().set_up.numeric > 0);
}

TEST_CASE("passing groups: what is dragged is not free, and is again when it is let go") {
  Simulation simulation;
  simulation.set_settings({.iterations = 10, .threads = 1});
  const Mesh mesh = grid({.columns = 5, .rows = 5, .size = {1, 1}});
  const BodyId first = simulation.add_body(mesh, Mass::area_density(0.2));
  const BodyId second = simulation.add_body(mesh, Mass::area_density(0.2));
  for (const BodyId body : {first, second}) simulation.add(body, EdgeSpring{.stiffness = 1e5});
  const auto free_of = [&] {
    std::vector<Index> first_vertices;
    for (const FreeComponent& each : simulation.system_info().free_components)
      first_vertices.push_back(each.first_vertex);
    return first_vertices;
  };
  CHECK(free_of() == std::vector<Index>{0, 25});
  const Vec3 target = row(mesh.vertices, 3) + Vec3(0, 0, 0.1);
  const GroupId drag = simulation.add(second, Drag{.stencils = {{3}}, .stiffness = 1e6, .targets = {target}});
  CHECK(free_of() == std::vector<Index>{0});
  for (int i = 0; i < 60; ++i) simulation.step();
  CHECK((row(simulation.state().positions, 28) - target).norm() < 1e-3);  // it hangs there
  simulation.remove(drag);
  CHECK(free_of() == std::vector<Index>{0, 25});
}

TEST_CASE("passing groups: a drag of pinned vertices does nothing, one of a pinned and a free one half") {
  const SolverSettings settings{.iterations = 40, .threads = 1};
  Hung still(settings), dragged(settings), half(settings), soft(settings);
  dragged.simulation.add(dragged.body, Drag{.stencils = {{0}}, .stiffness = 1e4, .targets = {Vec3(5, 5, 5)}});
  const Vec3 corner = row(still.simulation.state().positions, 0), next = row(still.simulation.state().positions, 1);
  const Vec3 target = next + Vec3(0, 0, 0.05);
  half.simulation.add(half.body,
                      Drag{.stencils = {{0, 1}}, .stiffness = 400, .targets = {Vec3((corner + target) / 2)}});
  soft.simulation.add(soft.body, Position{.on = {1}, .hold = Hold::soft, .stiffness = 100, .targets = {target}});
  for (int i = 0; i < 10; ++i) {
    for (Hung* each : {&still, &dragged, &half, &soft}) each->simulation.step();
  }
  CHECK(difference(still.simulation, dragged.simulation) == 0);
  CHECK(difference(half.simulation, soft.simulation) < 1e-9);
  CHECK(difference(still.simulation, soft.simulation) > 1e-3);
}

TEST_CASE("passing groups: the fastest vibration knows of them") {
  Hung hung({.iterations = 10, .threads = 1});
  const Real without = hung.simulation.system_info().fastest_frequency;
  hung.add_drag(1e8);
  Hung pinned({.iterations = 10, .threads = 1});
  Stencils same;
  for (int i = 0; i < 65; ++i) same.add(std::array<Index, 1>{70});
  pinned.simulation.add(pinned.body, Drag{.stencils = same, .stiffness = 1e8 / 65});  // too many: in the matrix
  Hung one({.iterations = 10, .threads = 1});
  one.simulation.add(one.body, Drag{.stencils = {{70}}, .stiffness = 1e8});
  CHECK(hung.simulation.system_info().fastest_frequency > 10 * without);
  CHECK(one.simulation.system_info().fastest_frequency ==
        doctest::Approx(pinned.simulation.system_info().fastest_frequency).epsilon(1e-9));
}

TEST_CASE("passing groups: other masses are taken up") {
  Hung hung({.iterations = 10, .threads = 1}), fresh({.iterations = 10, .threads = 1});
  hung.add_drag(1e3);
  for (int i = 0; i < 3; ++i) hung.simulation.step();
  hung.simulation.set_mass(hung.body, Mass::area_density(1));
  fresh.add_drag(1e3);
  fresh.simulation.set_mass(fresh.body, Mass::area_density(1));
  fresh.simulation.set_state(hung.simulation.state().positions, hung.simulation.state().velocities);
  CHECK(hung.simulation.step().set_up.numeric > 0);
  fresh.simulation.step();
  CHECK(same_bits(hung.simulation.state().positions, fresh.simulation.state().positions));
}

}  // namespace test_passing_groups
