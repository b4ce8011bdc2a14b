#pragma once
// One simulation with every built-in constraint type and every force on three bodies.
#include "pliant/constraints/builtin.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/shapes.h"
#include "pliant/simulation/simulation.h"

namespace pliant_tests {

inline void add_everything_cloth(pliant::Simulation& simulation, pliant::Index size) {
  using namespace pliant;
  Mesh mesh = grid({.columns = size, .rows = size});
  for (Index i = 0; i < mesh.vertex_count(); ++i) mesh.vertices(i, 1) = 0.05 * std::sin(9 * mesh.vertices(i, 0));
  const Index last = size * size - 1;
  const BodyId cloth = simulation.add_body(std::move(mesh), Mass::area_density(0.3), {.name = "cloth"});
  simulation.add(cloth, EdgeSpring{.stiffness = 400});
  simulation.add(cloth, EdgeStrain{.measure = FibreMeasure::cloth, .stiffness = 30, .max_stretch = 1.02});
  simulation.add(cloth, TriangleStrain{.stiffness = 50, .min_stretch = 0.95, .max_stretch = 1.05});
  simulation.add(cloth, Bending{.stiffness = 1e-4, .orientation = Orientation::signed_});
  simulation.add(cloth, HingeBending{.stiffness = 1e-4});
  simulation.add(cloth, Position{.on = {last - size + 1, last}});
  simulation.add(cloth, Position{.on = {last - size / 2}, .hold = Hold::soft, .stiffness = 1e3});
  simulation.add(cloth, Line{.on = {0}, .stiffness = 100, .direction = Vec3(1, 1, 0)});
  simulation.add(cloth, Drag{.stencils = {{1, 2, size + 2}, {3}},
                             .weights = {{0.2, 0.3, 0.5}, {1}},
                             .stiffness = 20,
                             .targets = Vec3(0.5, 0.4, 0.1)});
  simulation.add(cloth, TriangleArea{.stiffness = 20, .min_area = 0.97});
  simulation.add(cloth, FibreStrain{.angle = 30, .stiffness = 30, .max_stretch = 1.01});
  simulation.add(cloth, EdgeSpring{.on = {1, 2, 3}, .stiffness = 30, .reduction = EdgeReduction::identity});
  simulation.add(cloth, OnPlane{.on = {size}, .stiffness = 50, .normal = Vec3(1, 0, 2)});
  simulation.add(cloth, InHalfSpace{.on = {size + 2}, .stiffness = 50, .normal = Vec3(0, 1, 1)});
  simulation.add(cloth, pliant::Wind{.velocity = {0, 3, 1}, .drag = 0.5, .gust_strength = 0.5});
  simulation.add(cloth, pliant::Wind{.velocity = {0, 0.2, 0}, .model = WindModel::thesis, .area = WindArea::rest});
  simulation.add(cloth, TestForce{.vertices = {size + 1}, .force = Vec3(0, 0.5, 0), .frames = {2, 6}});
  simulation.add(cloth, MouseSpring{.vertices = {2 * size + 1}, .anchor = {1, 1, 1}, .stiffness = 0.1});
}

inline void add_everything_solids(pliant::Simulation& simulation, pliant::Index size) {
  using namespace pliant;
  const BodyId block = simulation.add_body(bar({.cells = {size, 3, 3}}), Mass::density(500), {.name = "bar"});
  simulation.add(block, TetrahedronStrain{.stiffness = 2e4, .min_stretch = 0.9, .max_stretch = 1.1});
  simulation.add(block, TetrahedronVolume{.stiffness = 5e4, .max_volume = 1.02});
  simulation.add(block, EdgeStrain{.stiffness = 10, .min_stretch = 0.5});
  simulation.add(block, Position{.on = {0}});
  const BodyId ring =
      simulation.add_body(torus({.major_segments = size, .minor_segments = 8}), Mass::total(1), {.name = "torus"});
  simulation.add(ring, EdgeSpring{.stiffness = 200});
  simulation.add(ring, Bending{.stiffness = 1e-3});
  simulation.add(ring, HingeBending{.stiffness = 1e-3, .orientation = Orientation::signed_});
  simulation.add(ring, Position{.on = {0}, .hold = Hold::soft, .stiffness = 100});
}

inline pliant::Simulation everything(const pliant::SolverSettings& settings, pliant::Index size) {
  pliant::Simulation simulation(settings);
  add_everything_cloth(simulation, size);
  add_everything_solids(simulation, size);
  simulation.add(pliant::Gravity{});
  return simulation;
}

}  // namespace pliant_tests
