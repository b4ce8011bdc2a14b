#pragma once
// A small simulation to be edited by a timeline, and where its pins go.
#include "pliant/constraints/builtin.h"
#include "pliant/forces/gravity.h"
#include "pliant/mesh/shapes.h"
#include "pliant/timeline/timeline.h"

namespace pliant_tests {

/// A sheet of 4 × 4 vertices in the plane xz, pinned at the corners of its upper row; steps of 0.1 s.
struct Rig {
  explicit Rig(pliant::Real time_step = 0.1) {
    using namespace pliant;
    simulation = Simulation({.time_step = time_step, .iterations = 5, .threads = 1});
    body = simulation.add_body(grid({.columns = 4, .rows = 4}), Mass::total(1), {.name = "sheet"});
    springs = simulation.add(body, EdgeSpring{.stiffness = 200}, "springs");
    pins = simulation.add(body, Position{.on = {12, 15}}, "pins");
    simulation.add(Gravity{});
  }

  void advance(int steps) {
    for (int i = 0; i < steps; ++i) timeline.step(simulation);
  }
  pliant::Vec3 pin(pliant::Index i) const { return simulation.target(pins, i); }
  pliant::Vec3 vertex(pliant::Index i) const { return pliant::row(simulation.state().positions, i); }

  pliant::Simulation simulation;
  pliant::Timeline timeline;
  pliant::BodyId body{};
  pliant::GroupId springs{};
  pliant::GroupId pins{};
};

}  // namespace pliant_tests
