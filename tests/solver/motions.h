#pragma once
// Motions by which integrators and damping are judged.
#include <cmath>

#include "pliant/constraints/builtin.h"
#include "pliant/mesh/shapes.h"
#include "pliant/simulation/simulation.h"

namespace pliant_tests {

using namespace pliant;

inline constexpr Real amplitude = 0.01;  // [m]

inline SolverSettings oscillator_settings(Integrator integrator, Real h, Real damping = 0) {
  return {.time_step = h,
          .integrator = integrator,
          .iterations = 20,
          .damping = damping,
          .precision = Precision::double_,
          .threads = 1};
}

/// Two masses of 1 kg on a spring of 1 m that is stretched by `amplitude`; k so that ω is as given.
inline Simulation two_masses(const SolverSettings& settings, Real omega) {
  Simulation simulation(settings);
  Mesh mesh = chain({.links = 1, .direction = {1, 0, 0}});
  BodyOptions options{.start = mesh.vertices};
  options.start(0, 0) -= amplitude / 2;
  options.start(1, 0) += amplitude / 2;
  const BodyId body = simulation.add_body(std::move(mesh), Mass::per_vertex(1), options);
  simulation.add(body, EdgeSpring{.stiffness = omega * omega / 2});
  return simulation;
}

inline Real stretch(const Simulation& simulation) {
  return (simulation.state().positions.row(1) - simulation.state().positions.row(0)).norm() - 1;
}

struct Momenta {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();  // about the origin
};

/// Of the vertices [begin, end).
inline Momenta momenta_of(const State& state, Index begin, Index end) {
  Momenta sum;
  for (Index i = begin; i < end; ++i) {
    const Vec3 p = state.masses[static_cast<std::size_t>(i)] * row(state.velocities, i);
    sum.linear += p;
    sum.angular += row(state.positions, i).cross(p);
  }
  return sum;
}
inline Momenta momenta_of(const State& state) {
  return momenta_of(state, 0, state.vertex_count());
}

/// A torus that flies, turns and vibrates, and a chain beside it that does so too.
inline Simulation flying_bodies(const SolverSettings& settings) {
  Simulation simulation(settings);
  const auto add = [&](Mesh mesh, const Vec3& turning) {
    BodyOptions options{.start = mesh.vertices, .velocities = Positions(mesh.vertices.rows(), 3)};
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      const Vec3 x = row(mesh.vertices, i);
      const Vec3 shake = 0.3 * Vec3(std::sin(9.0 * i), std::cos(7.0 * i), std::sin(5.0 * i + 1));
      options.velocities.row(i) = (Vec3(1, 2, 3) + turning.cross(x) + shake).transpose();
    }
    const BodyId body = simulation.add_body(std::move(mesh), Mass::total(1), options);
    simulation.add(body, EdgeSpring{.stiffness = 200});
  };
  add(torus({.major_segments = 12, .minor_segments = 6}), {1, -2, 3});
  add(chain({.links = 5}), {0, 4, 0});
  return simulation;
}

}  // namespace pliant_tests
