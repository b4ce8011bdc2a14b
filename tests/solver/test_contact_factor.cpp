// Contact that goes into the factor in the middle of a step changes how the step is solved, not what it solves.
#include <doctest/doctest.h>

#include "contact_scenes.h"

namespace test_contact_factor {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// A block in the zone of contact with a floor, whose contacts are so stiff that they go into the factor at once.
struct PressedBlock {
  Simulation simulation;
  Index refactorizations = 0;

  explicit PressedBlock(Integrator integrator)
      : simulation({.integrator = integrator, .iterations = 400, .threads = 1}) {
    Mesh block = bar({.cells = {3, 3, 3}, .size = {0.3, 0.3, 0.3}});
    block.vertices.rowwise() += Eigen::RowVector3d(0, 0, 0.015);
    const BodyId body = simulation.add_body(std::move(block), Mass::density(300));
    simulation.add(body, TetrahedronStrain{.stiffness = 1e5});
    simulation.add(Gravity{});
    simulation.add(PlaneCollider{.friction = 0.0});
    simulation.set_contact({.distance = 0.02, .surfaces = false});
    State state = simulation.state();
    state.velocities.col(2).setConstant(-0.5);
    state.contact.stiffening.assign(state.masses.size(), 50);
    simulation.restore(state);
    refactorizations = simulation.step().contact.refactorizations;
  }
};

}  // namespace

TEST_CASE("contact factor: the first step of BDF2 stays one of implicit Euler when contact goes into the factor") {
  const PressedBlock euler(Integrator::implicit_euler);
  const PressedBlock bdf2(Integrator::bdf2);
  CHECK(euler.refactorizations == 1);
  CHECK(bdf2.refactorizations == 1);
  const Positions& expected = euler.simulation.state().positions;
  CHECK((expected.col(2).minCoeff()) < 0.02);
  CHECK((bdf2.simulation.state().positions - expected).cwiseAbs().maxCoeff() < 1e-8);
  CHECK((bdf2.simulation.state().velocities - euler.simulation.state().velocities).cwiseAbs().maxCoeff() < 1e-6);
}

}  // namespace test_contact_factor
