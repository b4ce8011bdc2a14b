// Which vertex leaves for a place that is not finite, and why: asked only once a step has failed.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/solver/solver.h"

namespace pliant {
namespace {

/// Positions past this count as diverged [m]: energies of such bodies overflow.
constexpr Real farthest = 1e100;

/// Whether a coordinate is past that, or not a number.
template <class Coordinates>
bool is_far(const Coordinates& x) {
  return !(x.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>() <= farthest);
}

[[noreturn]] void fail(const State& state, Real time_step, Index vertex, const std::string& reason) {
  throw Error(ErrorKind::diverged,
              fmt::format("step {} (t = {} s): vertex {} would leave for a place that is not finite: {}",
                          state.step + 1, state.time + time_step, vertex, reason));
}

std::string without_bound(const Force& force) {
  return fmt::format("the force `{}` on it has grown without bound; {}", force.type(), force.remedy());
}

}  // namespace

/// The force that brings a group, or null.
const Force* Solver::owner(const ConstraintGroup& group) const {
  for (const Force* force : forces_) {
    if (std::ranges::count(force->groups(), &group) > 0) return force;
  }
  return nullptr;
}

void Solver::check_finite(const State& state) const {
  if (is_far(q_)) report_divergence(state);
}

void Solver::report_divergence(const State& state) const {
  const Real h = substep();
  // In the order of the step. One solve takes the whole body along, so the cause is looked for before that.
  for (Index i = 0; i < vertex_count_; ++i) {
    if (!is_pinned_[static_cast<std::size_t>(i)] && is_far(s_.row(i))) {
      fail(state, h, local_groups_.vertex(i), force_reason(state, local_groups_.vertex(i)));
    }
  }
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Index local = local_step_.first_not_finite(g, q_);
    if (local < 0) continue;
    const Index constraint = local_groups_.constraint(g, local);
    const auto first = static_cast<std::size_t>(constraint) * static_cast<std::size_t>(groups_[g]->shape().vertices);
    if (const Force* force = owner(*groups_[g])) fail(state, h, groups_[g]->stencil()[first], without_bound(*force));
    fail(state, h, groups_[g]->stencil()[first],
         fmt::format("constraint {} of type {} has a force that is not finite; reduce its stiffness", constraint,
                     groups_[g]->type()));
  }
  for (Index i = 0; i < vertex_count_; ++i) {
    if (!std::isfinite(inertia_weights_[static_cast<std::size_t>(i)])) {
      fail(state, h, local_groups_.vertex(i), "its m/h² is not finite; give a larger time step");
    }
    if (is_far(q_.row(i)) || !residual_.row(i).allFinite()) {
      fail(state, h, local_groups_.vertex(i),
           "the system of equations is too badly conditioned; reduce the ratio of stiffness to m/h²");
    }
  }
  fail(state, h, 0, "the residual has grown past all numbers; reduce the forces or the stiffness");
}

std::string Solver::force_reason(const State& state, Index vertex) const {
  const Real h = substep();
  const Real mass = state.masses[static_cast<std::size_t>(vertex)];
  Positions alone(vertex_count_, 3);
  for (Force* force : forces_) {
    alone.setZero();
    force->add_to(alone, state.view(), h);
    if (!is_far(alone.row(vertex) * h * h / mass)) continue;
    return without_bound(*force);
  }
  return "its velocity has grown without bound; reduce the forces or the time step";
}

}  // namespace pliant
