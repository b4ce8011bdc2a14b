// The identity as the reduction of an edge: the same energy and the same converged step, which iterations reach slowly.
#include <doctest/doctest.h>

#include "pliant/constraints/edge_spring.h"
#include "pliant/constraints/position.h"
#include "pliant/forces/gravity.h"
#include "pliant/simulation/simulation.h"

namespace test_edge_reduction {

using namespace pliant;

namespace {

constexpr Index links = 20;

/// Where a chain that hangs from its first vertex ends its first step of 1/30 s, from a horizontal line.
Positions chain_after(EdgeReduction reduction, int iterations) {
  Mesh mesh;
  mesh.vertices.setZero(links + 1, 3);
  for (Index i = 0; i <= links; ++i) mesh.vertices(i, 0) = 0.05 * i;
  for (Index i = 0; i < links; ++i) mesh.edges.push_back({i, i + 1});
  Simulation simulation({.time_step = 1.0 / 30, .iterations = iterations, .acceleration = Acceleration::none});
  const BodyId chain = simulation.add_body(mesh, Mass::total(1), {.name = "chain"});
  simulation.add(chain, EdgeSpring{.stiffness = 1e3, .reduction = reduction});
  simulation.add(chain, Position{.on = {0}});
  simulation.add(Gravity{});
  simulation.step();
  return simulation.state().positions;
}

}  // namespace

TEST_CASE("with the identity changes spread slowly along a chain, to the same step") {
  const Positions converged = chain_after(EdgeReduction::difference, 20000);
  CHECK((chain_after(EdgeReduction::identity, 20000) - converged).cwiseAbs().maxCoeff() < 1e-9);
  const auto error = [&](EdgeReduction reduction, int iterations) {
    return (chain_after(reduction, iterations) - converged).norm();
  };
  for (const int iterations : {5, 20}) {
    const Real difference = error(EdgeReduction::difference, iterations);
    const Real identity = error(EdgeReduction::identity, iterations);
    CAPTURE(difference);
    CAPTURE(identity);
    CHECK(identity > 1.5 * difference);
  }
}

}  // namespace test_edge_reduction
