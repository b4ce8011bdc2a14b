#include "pliant/solver/divergence.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

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

/// The force that brings a group, or null.
const Force* owner(const AppliedForces& forces, const ConstraintGroup* group) {
  for (const Force* force : forces.forces()) {
    if (std::ranges::count(force->groups(), group) > 0) return force;
  }
  return nullptr;
}

/// The first force that alone takes a vertex too far, or null.
const Force* endless_force(const StepContext& step, Index vertex) {
  const Real h = step.time_step;
  const Real mass = step.state.masses[at(vertex)];
  Positions alone(step.state.vertex_count(), 3);
  for (Force* force : step.forces.forces()) {
    alone.setZero();
    force->add_to(alone, step.state.view(), h);
    if (is_far(alone.row(vertex) * h * h / mass)) return force;
  }
  return nullptr;
}

DivergenceCause find_cause(const StepContext& step, const WorkingState& work) {
  const System& system = step.system;
  const LocalGroups& order = system.order();
  for (Index i = 0; i < system.vertex_count(); ++i) {
    const Index vertex = order.vertex(i);
    if (system.is_pinned()[at(i)] || !is_far(work.prediction.row(i))) continue;
    return {.vertex = vertex,
            .force = endless_force(step, vertex),
            .remark = "its velocity has grown without bound; reduce the forces or the time step"};
  }
  const std::span<ConstraintGroup* const> groups = system.groups_in_layout();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const Index local = system.projections().first_not_finite(g, work.positions);
    if (local < 0) continue;
    const Index constraint = order.constraint(g, local);
    const Index vertex = stencil_of(*groups[g], at(constraint)).front();
    return {.vertex = vertex, .force = owner(step.forces, groups[g]), .group = groups[g], .constraint = constraint};
  }
  const PassingGroups& passing = system.passing_groups();
  if (const auto found = passing.first_not_finite(work.positions)) {
    const ConstraintGroup* group = passing.of_simulation()[found->group];
    const Index vertex = stencil_of(*group, at(found->constraint)).front();
    return {.vertex = vertex, .group = group, .constraint = found->constraint};
  }
  for (Index i = 0; i < system.vertex_count(); ++i) {
    if (!std::isfinite(system.inertia_weights()[at(i)])) {
      return {.vertex = order.vertex(i), .remark = "its m/h² is not finite; give a larger time step"};
    }
    if (is_far(work.positions.row(i)) || !work.residual.row(i).allFinite()) {
      return {.vertex = order.vertex(i),
              .remark = "the system of equations is too badly conditioned; reduce the ratio of stiffness to m/h²"};
    }
  }
  return {.remark = "the residual has grown past all numbers; reduce the forces or the stiffness"};
}

std::string plain_message(const DivergenceCause& cause) {
  const std::string vertex = fmt::format("vertex {}", cause.vertex);
  const std::string force = cause.force == nullptr ? "" : fmt::format("the force `{}`", cause.force->type());
  const std::string constraint =
      cause.group == nullptr ? "" : fmt::format("constraint {} of type {}", cause.constraint, cause.group->type());
  return message_of(cause, vertex, force, constraint);
}

}  // namespace

std::string message_of(const DivergenceCause& cause, std::string_view vertex, std::string_view force,
                       std::string_view constraint) {
  std::string reason = cause.remark;
  if (cause.force != nullptr) {
    reason = fmt::format("{} on it has grown without bound; {}", force, cause.force->remedy());
  } else if (cause.group != nullptr) {
    reason = fmt::format("{} has a force that is not finite; reduce its stiffness", constraint);
  }
  return fmt::format("step {} (t = {} s): {} would leave for a place that is not finite: {}", cause.step, cause.time,
                     vertex, reason);
}

Divergence::Divergence(DivergenceCause cause)
    : Error(ErrorKind::diverged, plain_message(cause)), cause_(std::move(cause)) {}

void report_divergence(const StepContext& step, const WorkingState& work) {
  DivergenceCause cause = find_cause(step, work);
  cause.step = step.state.step + 1;
  cause.time = step.state.time + step.time_step;
  throw Divergence(std::move(cause));
}

void check_finite(const StepContext& step, const WorkingState& work) {
  if (is_far(work.positions)) report_divergence(step, work);
}

}  // namespace pliant
