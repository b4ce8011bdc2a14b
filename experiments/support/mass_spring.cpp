#include "support/mass_spring.h"

#include "pliant/core/error.h"

namespace pliant_experiments {
namespace {

using namespace pliant;

Positions rest_positions(const Simulation& simulation) {
  Positions rest(simulation.state().positions.rows(), 3);
  for (const Body& body : simulation.bodies()) {
    rest.middleRows(body.first_vertex, body.mesh.vertex_count()) = body.mesh.vertices;
  }
  return rest;
}

/// The length of p = L z/‖z‖ is asked of the projection itself, since options may give other lengths than those at
/// rest.
void add_springs(const ConstraintGroup& group, const Positions& rest, std::vector<Spring>& springs) {
  const Index count = group.shape().count;
  std::vector<Real> pulls(3 * static_cast<std::size_t>(count));
  group.project(rest, pulls, 0, count);
  for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
    const Index from = group.stencil()[2 * i];
    const Index to = group.stencil()[2 * i + 1];
    const double stiffness = group.stiffness() * group.rest_measure()[i];
    const Vec3 pull(pulls.data() + 3 * i);
    const Vec3 p = row(rest, to) - row(rest, from) + pull / stiffness;
    springs.push_back({from, to, stiffness, p.norm()});
  }
}

void add_pins(const ConstraintGroup& group, MassSpring& model) {
  for (const Index i : group.pinned_vertices()) model.is_pinned[static_cast<std::size_t>(i)] = 1;
  if (!group.pinned_vertices().empty()) return;
  // targets() is not const, since points may be moved through it; here they are only read.
  const std::span<const Real> targets = const_cast<ConstraintGroup&>(group).targets();
  for (std::size_t i = 0; i < static_cast<std::size_t>(group.shape().count); ++i) {
    model.soft_pins.push_back(
        {group.stencil()[i], group.stiffness() * group.rest_measure()[i], Vec3(targets.data() + 3 * i)});
  }
}

bool is_pinned(const MassSpring& model, Index vertex) {
  return model.is_pinned[static_cast<std::size_t>(vertex)] != 0;
}

}  // namespace

MassSpring mass_spring(const Simulation& simulation) {
  MassSpring model;
  model.masses = simulation.state().masses;
  model.is_pinned.assign(model.masses.size(), 0);
  const Positions rest = rest_positions(simulation);
  for (const auto& [id, group] : simulation.groups()) {
    for (const auto& batch : group.set.batches) {
      if (group.type == "edge_spring") {
        add_springs(*batch, rest, model.springs);
      } else if (group.type == "position") {
        add_pins(*batch, model);
      } else {
        fail_input("a mass-spring system has no constraint '" + group.type + "'; leave it out");
      }
    }
  }
  return model;
}

EulerStep next_step(const Simulation& simulation, const MassSpring& model) {
  const State& state = simulation.state();
  const double h = simulation.settings().time_step;
  Positions forces = Positions::Zero(state.vertex_count(), 3);
  for (const auto& [id, force] : simulation.forces()) force->add_to(forces, state.view(), h);
  EulerStep step{h, state.positions};
  for (Index i = 0; i < model.vertex_count(); ++i) {
    if (is_pinned(model, i)) continue;
    step.predicted.row(i) +=
        h * state.velocities.row(i) + h * h / model.masses[static_cast<std::size_t>(i)] * forces.row(i);
  }
  return step;
}

double objective(const MassSpring& model, const EulerStep& step, const Positions& q) {
  double inertia = 0;
  for (Index i = 0; i < model.vertex_count(); ++i) {
    inertia += model.masses[static_cast<std::size_t>(i)] * (q.row(i) - step.predicted.row(i)).squaredNorm();
  }
  double elastic = 0;
  for (const Spring& spring : model.springs) {
    const double excess = (q.row(spring.to) - q.row(spring.from)).norm() - spring.rest_length;
    elastic += spring.stiffness * excess * excess;
  }
  for (const SoftPin& pin : model.soft_pins) elastic += pin.stiffness * (row(q, pin.vertex) - pin.target).squaredNorm();
  return inertia / (2 * step.time_step * step.time_step) + elastic / 2;
}

Positions gradient(const MassSpring& model, const EulerStep& step, const Positions& q) {
  Positions g(model.vertex_count(), 3);
  for (Index i = 0; i < model.vertex_count(); ++i) {
    const double inertia = model.masses[static_cast<std::size_t>(i)] / (step.time_step * step.time_step);
    g.row(i) = inertia * (q.row(i) - step.predicted.row(i));
  }
  for (const Spring& spring : model.springs) {
    const Vec3 edge = row(q, spring.to) - row(q, spring.from);
    const double length = edge.norm();
    const Vec3 pull = spring.stiffness * (length - spring.rest_length) / length * edge;
    g.row(spring.to) += pull.transpose();
    g.row(spring.from) -= pull.transpose();
  }
  for (const SoftPin& pin : model.soft_pins) {
    g.row(pin.vertex) += pin.stiffness * (row(q, pin.vertex) - pin.target).transpose();
  }
  for (Index i = 0; i < model.vertex_count(); ++i) {
    if (is_pinned(model, i)) g.row(i).setZero();
  }
  return g;
}

}  // namespace pliant_experiments
