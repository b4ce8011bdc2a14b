// A curtain of a square meter, pinned at two corners, falls for a second.
#include <cstdio>

#include <pliant/pliant.h>
#include <pliant_io/pliant_io.h>

int main() {
  //! [first steps]
  pliant::Simulation simulation;
  const auto cloth = simulation.add_body(pliant::grid({.columns = 32, .rows = 32}), pliant::Mass::area_density(0.2));
  simulation.add(cloth, pliant::EdgeSpring{.stiffness = 1e3});
  simulation.add(cloth, pliant::Bending{.stiffness = 1e-4});
  simulation.add(cloth, pliant::Position{.on = {992, 1023}});
  simulation.add(pliant::Gravity{});
  simulation.add(pliant::Wind{.velocity = {0, 3, 0}, .gust_strength = 0.5});

  for (int i = 0; i < 60; ++i) simulation.step();
  pliant::write_obj("curtain.obj", simulation.body(cloth).mesh, simulation.state().positions);
  //! [first steps]
  std::printf("curtain.obj: the curtain after %.1f s\n", simulation.state().time);
  return 0;
}
