// A chain of 20 links, pinned at its first vertex, swings for a second.
#include <cmath>
#include <cstdio>

#include <pliant/pliant.h>

int main() {
  pliant::Simulation simulation({.iterations = 20});
  const auto chain =
      simulation.add_body(pliant::chain({.links = 20, .direction = {1, 0, 0}}), pliant::Mass::per_vertex(0.01));
  simulation.add(chain, pliant::EdgeSpring{.stiffness = 1e4});
  simulation.add(chain, pliant::Position{.on = {0}});
  simulation.add(pliant::Gravity{});
  for (int i = 0; i < 60; ++i) simulation.step();

  const pliant::Vec3 end = simulation.state().positions.row(20).transpose();
  std::printf("after %.1f s the end of the chain is at (%.3f, %.3f, %.3f) m\n", simulation.state().time, end.x(),
              end.y(), end.z());
  return std::isfinite(end.sum()) && end.z() < -0.1 ? 0 : 1;
}
