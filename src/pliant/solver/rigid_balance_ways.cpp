// How far components go on the ways that rigid_balance.cpp has found.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "pliant/solver/rigid_balance.h"

namespace pliant {
namespace {

constexpr int most_trials = 3;  // of ways without those that have gone back

}  // namespace

/// What begins to touch on it was not asked. Returns whether anything has moved.
bool RigidBalance::go_there(const StepContext& context, WorkingState& work, LocalResult& local) {
  const Components& free = context.system.free_components();
  energies_before_.assign(joined_.size(), 0);
  context.contact.add_energies(context.system.components_of_vertices(), energies_before_);
  context.contact.subtract(work.residual, context.threads);
  positions_before_ = work.positions;
  residual_before_ = work.residual;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    part.goes_back = false;
    if (!part.moves) continue;
    part.placement = part.placement.share(part.share_of_way);
    part.rise = part.moments.rise(part.placement);
    move(part, free.component(i), context.system.inertia_weights(), work);
  }
  judge(context, work);
  bool has_moved = false;
  for (Part& part : parts_) {
    if (part.moves) {
      local.inertia += part.rise;
      part.share_of_way = 1;
      has_moved = true;
    } else if (part.goes_back) {
      part.share_of_way *= shorter;
    }
  }
  if (!has_moved) context.contact.find_forces(work.positions, context.threads);
  context.contact.add(work, local, context.threads);
  return has_moved;
}

/// Whether all have come to where they should, and nothing touches there that was not asked.
bool RigidBalance::is_as_expected() const {
  Real difference = 0;
  Real energy = 0;
  for (std::size_t i = 0; i < energies_.size(); ++i) {
    const Real expected = resistances_[i].energy - energies_asked_before_[i];
    difference += std::abs(energies_[i] - energies_before_[i] - expected);
    energy += resistances_[i].energy;
  }
  return difference <= worthwhile * energy &&
         std::ranges::none_of(parts_, [](const Part& part) { return part.goes_back || part.share_of_way < 1; });
}

/// Takes ways back that have raised the objective, or all where anything is in the way of one. Those that are left are
/// judged again without the others: what has gone back may be in their way now.
void RigidBalance::judge(const StepContext& context, WorkingState& work) {
  const Components& free = context.system.free_components();
  bool is_decided = false;
  for (int trial = 0; !is_decided; ++trial) {
    const HeldBack held = context.contact.hold_back(positions_before_, work.positions, context.threads);
    const bool may_stay = trial < most_trials && !held.has_moved && !held.has_new_potential;
    if (!may_stay) work.positions = positions_before_;
    find_rises(context);
    bool is_any_left = false;
    bool has_gone_back = false;
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      Part& part = parts_[i];
      if (!part.moves) continue;
      part.moves = may_stay && rises_[joined_[part.component]] <= 0;
      is_any_left |= part.moves;
      if (part.moves) continue;
      take_back(free.component(i), work);
      part.goes_back = has_gone_back = true;
    }
    is_decided = !is_any_left || !has_gone_back;
  }
}

/// By how much the objective has risen, of all together that may touch each other.
void RigidBalance::find_rises(const StepContext& context) {
  const std::span<const Index> component_of_vertex = context.system.components_of_vertices();
  std::iota(joined_.begin(), joined_.end(), std::size_t{0});
  context.contact.join_components(component_of_vertex, joined_);
  energies_.assign(joined_.size(), 0);
  context.contact.add_energies(component_of_vertex, energies_);
  rises_.assign(joined_.size(), 0);
  for (std::size_t i = 0; i < joined_.size(); ++i) rises_[joined_[i]] += energies_[i] - energies_before_[i];
  for (const Part& part : parts_) {
    if (part.moves) rises_[joined_[part.component]] += part.rise;
  }
}

void RigidBalance::take_back(std::span<const Index> vertices, WorkingState& work) const {
  for (const Index v : vertices) {
    work.positions.row(v) = positions_before_.row(v);
    work.residual.row(v) = residual_before_.row(v);
  }
}

/// Elastic forces turn with the component. The residual has no forces of contact here.
void RigidBalance::move(const Part& part, std::span<const Index> vertices, std::span<const Real> weights,
                        WorkingState& work) {
  for (const Index v : vertices) {
    const Real weight = weights[at(v)];
    const Vec3 from = row(work.positions, v);
    const Vec3 to = part.placement.place(part.center, from);
    const Vec3 goal = row(work.prediction, v);
    const Vec3 elastic = row(work.residual, v) - weight * (goal - from);
    work.positions.row(v) = to.transpose();
    work.residual.row(v) = (part.placement.turn * elastic + weight * (goal - to)).transpose();
  }
}

}  // namespace pliant
