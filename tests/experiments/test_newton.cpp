// Newton's method of the experiments, which others are measured against: its derivatives, and where it ends.
#include <Eigen/Eigenvalues>
#include <doctest/doctest.h>

#include "../simulation/run.h"
#include "experiments/support/newton.h"
#include "pliant/constraints/builtin.h"
#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"

namespace test_newton {

using namespace pliant;
using namespace pliant_experiments;
using namespace pliant_tests;

namespace {

/// A cloth with a soft pin, a hard pin and gravity, out of shape and in motion: some springs are pulled, others
/// pressed.
Simulation disturbed_cloth(const SolverSettings& settings, Real stiffness = 300) {
  Simulation simulation(settings);
  const Mesh mesh = grid({.columns = 5, .rows = 4, .size = {.4, .3}});
  BodyOptions options{.start = mesh.vertices, .velocities = mesh.vertices};
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    const Real u = 9 * mesh.vertices(i, 0) + 5 * mesh.vertices(i, 2);
    options.start.row(i) += .03 * Eigen::RowVector3d(std::sin(2 * u), std::sin(u), std::cos(3 * u));
    options.velocities.row(i) << std::cos(u), std::sin(3 * u), -.5;
  }
  const BodyId body = simulation.add_body(mesh, Mass::per_vertex(.02), options);
  simulation.add(body, EdgeSpring{.stiffness = stiffness});
  simulation.add(body, Position{.on = {15}, .hold = Hold::soft, .stiffness = 2e3});
  simulation.add(body, Position{.on = {19}});
  add_gravity(simulation);
  return simulation;
}

/// The lower triangle of the Hessian, made whole.
Eigen::MatrixXd whole(const Eigen::SparseMatrix<double>& lower) {
  const Eigen::MatrixXd dense = lower;
  return dense.selfadjointView<Eigen::Lower>();
}

constexpr Index held_vertex = 19;
constexpr double difference = 1e-6;

}  // namespace

TEST_CASE("the objective is that of the solver") {
  Simulation simulation = disturbed_cloth({.iterations = 3, .precision = Precision::double_, .threads = 1});
  const MassSpring model = mass_spring(simulation);
  const EulerStep step = next_step(simulation, model);
  simulation.step();
  CHECK(objective(model, step, simulation.state().positions) ==
        doctest::Approx(simulation.evaluate().objective()).epsilon(1e-12));
  CHECK(gradient(model, step, simulation.state().positions).rowwise().norm().maxCoeff() ==
        doctest::Approx(simulation.evaluate().residual).epsilon(1e-9));
}

TEST_CASE("the gradient is that of the objective, the Hessian that of the gradient") {
  const Simulation simulation = disturbed_cloth({});
  const MassSpring model = mass_spring(simulation);
  const EulerStep step = next_step(simulation, model);
  const Positions q = simulation.state().positions;
  const Positions g = gradient(model, step, q);
  const Eigen::MatrixXd hessian = whole(Newton(model).assemble(step, q, Curvature::exact));
  for (Index i = 0; i < 3 * model.vertex_count(); ++i) {
    if (i / 3 == held_vertex) continue;
    Positions before = q;
    Positions behind = q;
    before.data()[i] -= difference;
    behind.data()[i] += difference;
    const double slope = (objective(model, step, behind) - objective(model, step, before)) / (2 * difference);
    CHECK(g.data()[i] == doctest::Approx(slope).epsilon(1e-6).scale(10));
    const Positions change = (gradient(model, step, behind) - gradient(model, step, before)) / (2 * difference);
    for (Index j = 0; j < 3 * model.vertex_count(); ++j) {
      CHECK(hessian(j, i) == doctest::Approx(change.data()[j]).epsilon(1e-6).scale(1e3));
    }
  }
}

TEST_CASE("held vertices have neither gradient nor part in the Hessian") {
  const Simulation simulation = disturbed_cloth({});
  const MassSpring model = mass_spring(simulation);
  const EulerStep step = next_step(simulation, model);
  const Positions q = simulation.state().positions;
  CHECK(step.predicted.row(held_vertex) == q.row(held_vertex));
  CHECK(gradient(model, step, q).row(held_vertex).isZero(0));
  Eigen::MatrixXd hessian = whole(Newton(model).assemble(step, q, Curvature::exact));
  CHECK(hessian.block<3, 3>(3 * held_vertex, 3 * held_vertex) == Mat3::Identity());
  hessian.block<3, 3>(3 * held_vertex, 3 * held_vertex).setZero();
  CHECK(hessian.middleRows<3>(3 * held_vertex).isZero(0));
}

TEST_CASE("without its negative terms the Hessian is positive definite where the exact one is not") {
  const Simulation simulation = disturbed_cloth({}, 1e5);
  const MassSpring model = mass_spring(simulation);
  const EulerStep step = next_step(simulation, model);
  const Positions q = .5 * simulation.state().positions;  // all springs are pressed together
  Newton newton(model);
  const auto least = [](const Eigen::MatrixXd& matrix) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().minCoeff();
  };
  CHECK(least(whole(newton.assemble(step, q, Curvature::exact))) < -1e3);
  CHECK(least(whole(newton.assemble(step, q, Curvature::positive))) > 0);
}

TEST_CASE("Newton's method ends at the minimum, which the iterations of the solver come to") {
  for (const Real stiffness : {30., 300.}) {  // much stiffer ones crumple, which there are several ways to do
    CAPTURE(stiffness);
    SolverSettings settings = converged(1e-11);
    settings.precision = Precision::double_;
    Simulation simulation = disturbed_cloth(settings, stiffness);
    const MassSpring model = mass_spring(simulation);
    const EulerStep step = next_step(simulation, model);
    Positions q = step.predicted;
    Newton newton(model);
    CHECK(newton.minimize(step, q, 100) < 100);
    CHECK(gradient(model, step, q).rowwise().norm().maxCoeff() < 1e-14 * stiffness);
    CHECK(objective(model, step, q) < objective(model, step, step.predicted));
    CHECK(q.row(held_vertex) == step.predicted.row(held_vertex));

    simulation.step();
    CHECK(largest_difference(q, simulation.state().positions) < 1e-9);
  }
}

TEST_CASE("lengths at rest are those of the springs") {
  Simulation simulation;
  const BodyId body = simulation.add_body(chain({.links = 2, .length = 1}), Mass::per_vertex(1));
  simulation.add(body, EdgeSpring{.stiffness = std::vector<Real>{100, 200}, .rest_length = std::vector<Real>{.4, .7}});
  const MassSpring model = mass_spring(simulation);
  REQUIRE(model.springs.size() == 2);
  CHECK(model.springs[0].stiffness == 100);
  CHECK(model.springs[1].stiffness == 200);
  CHECK(model.springs[0].rest_length == doctest::Approx(.4).epsilon(1e-15));
  CHECK(model.springs[1].rest_length == doctest::Approx(.7).epsilon(1e-15));
}

TEST_CASE("what is no spring and no pin is refused") {
  Simulation simulation;
  const BodyId body = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::per_vertex(1));
  simulation.add(body, TriangleStrain{});
  CHECK_THROWS_WITH_AS(mass_spring(simulation), doctest::Contains("triangle_strain"), Error);
}

}  // namespace test_newton
