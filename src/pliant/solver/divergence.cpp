#include "pliant/solver/divergence.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/solver/constraint_rows.h"

namespace pliant {
namespace {

/// Positions past this count as diverged [m]: energies of such bodies overflow.
constexpr Real farthest = 1e100;

/// Whether a coordinate is past that, or not a number.
template <class Coordinates>
bool is_far(const Coordinates& x) {
  return !(x.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>() <= farthest);
}

/// `vertex` in the order of the simulation.
[[noreturn]] void fail(const StepContext& step, Index vertex, const std::string& reason) {
  throw Error(ErrorKind::diverged,
              fmt::format("step {} (t = {} s): vertex {} would leave for a place that is not finite: {}",
                          step.state.step + 1, step.state.time + step.time_step, vertex, reason));
}

std::string without_bound(const Force& force) {
  return fmt::format("the force `{}` on it has grown without bound; {}", force.type(), force.remedy());
}

/// The force that brings a group, or null.
const Force* owner(const AppliedForces& forces, const ConstraintGroup* group) {
  for (const Force* force : forces.forces()) {
    if (std::ranges::count(force->groups(), group) > 0) return force;
  }
  return nullptr;
}

std::string force_reason(const StepContext& step, Index vertex) {
  const Real h = step.time_step;
  const Real mass = step.state.masses[at(vertex)];
  Positions alone(step.state.vertex_count(), 3);
  for (Force* force : step.forces.forces()) {
    alone.setZero();
    force->add_to(alone, step.state.view(), h);
    if (is_far(alone.row(vertex) * h * h / mass)) return without_bound(*force);
  }
  return "its velocity has grown without bound; reduce the forces or the time step";
}

void check_constraints(const StepContext& step, const Positions& q) {
  const std::span<ConstraintGroup* const> groups = step.system.groups_of_simulation();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Index local = step.system.projections().first_not_finite(g, q);
    if (local < 0) continue;
    const Index constraint = step.system.order().constraint(g, local);
    const Index vertex = stencil_of(*groups[g], at(constraint)).front();
    if (const Force* force = owner(step.forces, groups[g])) fail(step, vertex, without_bound(*force));
    fail(step, vertex,
         fmt::format("constraint {} of type {} has a force that is not finite; reduce its stiffness", constraint,
                     groups[g]->type()));
  }
}

}  // namespace

void report_divergence(const StepContext& step, const WorkingState& work) {
  const System& system = step.system;
  for (Index i = 0; i < system.vertex_count(); ++i) {
    const Index vertex = system.order().vertex(i);
    if (!system.is_pinned()[at(i)] && is_far(work.prediction.row(i))) fail(step, vertex, force_reason(step, vertex));
  }
  check_constraints(step, work.positions);
  for (Index i = 0; i < system.vertex_count(); ++i) {
    const Index vertex = system.order().vertex(i);
    if (!std::isfinite(system.inertia_weights()[at(i)])) {
      fail(step, vertex, "its m/h² is not finite; give a larger time step");
    }
    if (is_far(work.positions.row(i)) || !work.residual.row(i).allFinite()) {
      fail(step, vertex, "the system of equations is too badly conditioned; reduce the ratio of stiffness to m/h²");
    }
  }
  fail(step, 0, "the residual has grown past all numbers; reduce the forces or the stiffness");
}

void check_finite(const StepContext& step, const WorkingState& work) {
  if (is_far(work.positions)) report_divergence(step, work);
}

}  // namespace pliant
