#include "pliant/solver/rigid_balance.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace pliant {
namespace {

/// Of the energies of inertia and contact: what a motion must gain to be worth it. A force out of balance by 3e-6 of
/// the weight gains as much.
constexpr Real worthwhile = 1e-11;
/// Of the size of a component that touches nothing.
constexpr Real least_shift = 1e-6;
constexpr int most_motions = 8;
constexpr Real shorter = 0.4;
constexpr int most_trials = 3;  // of motions without those that have gone back

}  // namespace

bool RigidBalance::settle(const StepContext& context, WorkingState& work, LocalResult& local) {
  if (context.system.free_components().count() == 0) return false;
  if (!has_masses_) find_masses(context.system, work.positions);
  for (Part& part : parts_) {
    part.sliding = SlidingFriction::as_it_is;
    part.share = 1;
  }
  bool has_moved = false;
  for (int i = 0; i < most_motions && find_motions(context, work); ++i) has_moved |= try_motions(context, work, local);
  return has_moved;
}

/// Friction that begins to slide, or to stick, on the way resists otherwise than where the way begins, and a motion may
/// go too far: in a parabola that lies above its energy everywhere it does not, but takes many times, so the motion
/// after that is again one of Newton's. What begins to touch on the way is in no parabola, so then the motion is
/// shortened. Returns whether anything has moved.
bool RigidBalance::try_motions(const StepContext& context, WorkingState& work, LocalResult& local) {
  const Components& free = context.system.free_components();
  context.contact.subtract(work.residual, context.threads);
  positions_before_ = work.positions;
  residual_before_ = work.residual;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    part.goes_back = false;
    if (part.moves) part.rise = move(part, free.component(i), context.system.inertia_weights(), work);
  }
  judge(context, work);
  bool has_moved = false;
  for (Part& part : parts_) {
    if (part.moves) {
      local.inertia += part.rise;
      part.share = std::min<Real>(1, part.share / shorter);
      part.sliding = SlidingFriction::as_it_is;
      has_moved = true;
    } else if (part.goes_back) {
      if (part.sliding == SlidingFriction::bounded) part.share *= shorter;
      part.sliding = SlidingFriction::bounded;
    }
  }
  if (!has_moved) context.contact.find_forces(work.positions, context.threads);
  context.contact.add(work, local, context.threads);
  return has_moved;
}

/// Takes motions back that have raised the objective, or all where anything is in the way of one. Those that are left
/// are judged again without the others: what has gone back may be in their way now.
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
  const std::size_t count = context.system.components().count();
  joined_.resize(count);
  std::iota(joined_.begin(), joined_.end(), std::size_t{0});
  context.contact.join_components(component_of_vertex, joined_);
  energies_.assign(count, 0);
  context.contact.add_energies(component_of_vertex, energies_);
  rises_.assign(count, 0);
  for (std::size_t i = 0; i < count; ++i) rises_[joined_[i]] += energies_[i] - resistances_[i].energy;
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

/// Where the masses are matters for how far a step of Newton's method goes, not for where it ends: once a substep.
void RigidBalance::find_masses(const System& system, const Positions& q) {
  const Components& free = system.free_components();
  parts_.assign(free.count(), {});
  for (std::size_t i = 0; i < free.count(); ++i) {
    Part& part = parts_[i];
    const std::span<const Index> vertices = free.component(i);
    part.component = at(system.components_of_vertices()[at(vertices.front())]);
    part.freedom = system.freedom(i);
    Vec3 first = Vec3::Zero();
    for (const Index v : vertices) {
      const Real w = system.inertia_weights()[at(v)];
      part.weight += w;
      first += w * row(q, v);
    }
    part.center = first / part.weight;
    Mat3 second = Mat3::Zero();
    for (const Index v : vertices) {
      const Vec3 arm = row(q, v) - part.center;
      second += system.inertia_weights()[at(v)] * arm * arm.transpose();
    }
    part.inertia = second.trace() * Mat3::Identity() - second;
  }
  has_masses_ = true;
}

void RigidBalance::find_force(const System& system, std::span<const Index> vertices, const WorkingState& work,
                              Part& part) {
  Vec3 force = Vec3::Zero();
  Vec3 torque = Vec3::Zero();
  part.energy = 0;
  for (const Index v : vertices) {
    const Vec3 x = row(work.positions, v);
    const Vec3 r = row(work.residual, v);
    force += r;
    torque += (x - part.center).cross(r);
    part.energy += system.inertia_weights()[at(v)] / 2 * (row(work.prediction, v) - x).squaredNorm();
  }
  part.force << force, torque;
}

/// Contact is asked only where there may be something to gain: without it a motion would gain more. What touches
/// nothing any more moves as well: an iteration may have thrown it up.
bool RigidBalance::find_motions(const StepContext& context, const WorkingState& work) {
  const System& system = context.system;
  const Components& free = system.free_components();
  bool is_any = false;
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    if (parts_[i].freedom == RigidFreedom::none) continue;
    find_force(system, free.component(i), work, parts_[i]);
    is_any |= find_motion({}, parts_[i]);
  }
  if (!is_any) return false;
  resistances_.assign(system.components().count(), {});
  for (const Part& part : parts_) {
    resistances_[part.component].center = part.center;
    resistances_[part.component].sliding = part.sliding;
  }
  context.contact.add_resistance(work.positions, system.components_of_vertices(), resistances_);
  is_any = false;
  for (Part& part : parts_) {
    const RigidResistance& resistance = resistances_[part.component];
    if (!part.moves) continue;
    part.moves = false;
    if (resistance.curvature.isZero(0) && !is_misplaced(part)) continue;
    is_any |= find_motion(resistance, part);
  }
  return is_any;
}

/// Whether weight and inertia would shift it by more than rounding does, compared with its size. In flight they do not
/// after a global solve, which is exact for translations, and the energy of inertia is no measure: there is none.
bool RigidBalance::is_misplaced(const Part& part) {
  return part.force.head<3>().squaredNorm() / part.weight > least_shift * least_shift * part.inertia.trace();
}

/// Returns whether the component moves.
bool RigidBalance::find_motion(const RigidResistance& resistance, Part& part) {
  using Matrix = Eigen::Matrix<Real, 6, 6>;
  Matrix curvature = resistance.curvature.selfadjointView<Eigen::Lower>();
  curvature.diagonal().head<3>().array() += part.weight;
  curvature.bottomRightCorner<3, 3>() += part.inertia;
  const bool turns = part.freedom == RigidFreedom::all;
  Motion motion = Motion::Zero();
  if (turns) motion = curvature.ldlt().solve(part.force);
  if (!turns || !motion.allFinite()) {  // a line, a point: rotations about it are nothing
    motion << curvature.topLeftCorner<3, 3>().ldlt().solve(part.force.head<3>()), Vec3::Zero();
  }
  part.moves = motion.allFinite() && motion.dot(part.force) / 2 > worthwhile * (part.energy + resistance.energy);
  if (!part.moves) return false;
  motion *= part.share;
  part.shift = motion.head<3>();
  const Vec3 angle = motion.tail<3>();
  const Real size = angle.stableNorm();
  part.rotation = size > 0 ? Eigen::AngleAxis<Real>(size, angle / size).toRotationMatrix() : Mat3::Identity();
  return true;
}

/// Elastic forces turn with the component. The residual has no forces of contact here. Returns by how much the inertia
/// term has risen [J].
Real RigidBalance::move(const Part& part, std::span<const Index> vertices, std::span<const Real> weights,
                        WorkingState& work) {
  Real rise = 0;
  for (const Index v : vertices) {
    const Real weight = weights[at(v)];
    const Vec3 from = row(work.positions, v);
    const Vec3 to = part.center + part.shift + part.rotation * (from - part.center);
    const Vec3 goal = row(work.prediction, v);
    const Vec3 elastic = row(work.residual, v) - weight * (goal - from);
    rise += weight / 2 * (from - to).dot(2 * goal - from - to);
    work.positions.row(v) = to.transpose();
    work.residual.row(v) = (part.rotation * elastic + weight * (goal - to)).transpose();
  }
  return rise;
}

}  // namespace pliant
