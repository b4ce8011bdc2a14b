#include "pliant/solver/rigid_balance.h"

#include <algorithm>
#include <limits>
#include <numeric>

namespace pliant {
namespace {

/// As `worthwhile`: what a motion after the first must gain, which costs next to nothing.
constexpr Real worth_going_on = 1e-13;
/// As `worthwhile`, after so many trials in a row that have gained nothing, as where a vertex rests where no move may
/// lead.
constexpr Real worth_insisting = 1e-9;
constexpr int few_trials_in_vain = 3;
/// Of the size of a component that touches nothing.
constexpr Real least_shift = 1e-6;
constexpr int most_motions = 12;
/// Each of some that touch each other moves as if the others stood still: many such motions only shake them.
constexpr int most_motions_of_many = 4;
constexpr int most_ways = 3;
/// Of the resistance to rotations: what keeps the matrix of a line positive definite, which resists none about itself.
constexpr Real about_itself = 1e-10;

using Motion = Eigen::Matrix<Real, 6, 1>;
using Matrix = Eigen::Matrix<Real, 6, 6>;

/// Where a force leads.
Motion motion_of(const Matrix& curvature, const Motion& force, RigidFreedom freedom) {
  Motion motion = Motion::Zero();
  const bool turns = freedom == RigidFreedom::all;
  if (turns) motion = curvature.ldlt().solve(force);
  if (!turns || !motion.allFinite()) {  // a line, a point: rotations about it are nothing
    motion << curvature.topLeftCorner<3, 3>().ldlt().solve(force.head<3>()), Vec3::Zero();
  }
  return motion;
}

/// Rows of what moves so freely.
Index rows_of(RigidFreedom freedom) {
  return freedom == RigidFreedom::all ? 6 : 3;
}

/// A motion about one point as one about another that is `arm` further: t + ω × arm, ω.
Matrix about(const Vec3& arm) {
  Matrix change = Matrix::Identity();
  for (int i = 0; i < 3; ++i) change.block<3, 1>(0, 3 + i) = Vec3::Unit(i).cross(arm);
  return change;
}

}  // namespace

bool RigidBalance::settle(const StepContext& context, WorkingState& work, LocalResult& local) {
  if (context.system.free_components().count() == 0 || !context.contact.is_anything_near()) return false;
  if (!has_masses_) find_masses(context.system, work.positions);
  for (Part& part : parts_) part.share_of_way = 1;
  bool has_moved = false;
  for (int i = 0; i < most_ways && find_placements(context, work, Motions::each); ++i) {
    has_moved |= go_there(context, work, local);
    if (is_as_expected()) break;
  }
  for (Part& part : parts_) part.share_of_way = 1;
  const bool are_several = parts_.size() > 1;
  if (are_several && find_placements(context, work, Motions::common)) has_moved |= go_there(context, work, local);
  return has_moved;
}

/// Contact is asked only where there may be something to gain: without it a motion would gain more. Returns whether
/// anything is to go elsewhere.
bool RigidBalance::find_placements(const StepContext& context, const WorkingState& work, Motions motions) {
  find_moments(context.system, work);
  if (std::ranges::none_of(parts_, may_gain)) return false;
  for (Part& part : parts_) part.placement_now = {};
  find_touching(context, work);
  ask_contact(context, work);
  std::swap(resistances_, trial_result_);
  for (Part& part : parts_) part.moments.subtract_contact(resistances_[part.component].force);
  energies_asked_before_.clear();
  for (const RigidResistance& each : resistances_) energies_asked_before_.push_back(each.energy);
  for (int i = 0; i < most_motions && find_motions(motions); ++i) {
    ask_contact(context, work);
    if (!judge_motions()) continue;
    for (Part& part : parts_) part.placement_now = part.placement;
    ask_contact(context, work);
    std::swap(resistances_, trial_result_);
  }
  return std::ranges::any_of(parts_, &Part::moves);
}

/// Where the masses are matters for how far a step of Newton's method goes, not for where it ends: once a substep.
void RigidBalance::find_masses(const System& system, const Positions& q) {
  const Components& free = system.free_components();
  parts_.assign(free.count(), {});
  part_of_component_.assign(system.components().count(), -1);
  for (std::size_t i = 0; i < free.count(); ++i) {
    Part& part = parts_[i];
    const std::span<const Index> vertices = free.component(i);
    part.component = at(system.components_of_vertices()[at(vertices.front())]);
    part.freedom = system.freedom(i);
    part_of_component_[part.component] = static_cast<Index>(i);
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

void RigidBalance::find_moments(const System& system, const WorkingState& work) {
  const Components& free = system.free_components();
  for (std::size_t i = 0; i < parts_.size(); ++i) {
    Part& part = parts_[i];
    part.placement = part.placement_now = {};
    part.rise = part.rise_now = 0;
    part.sliding = SlidingFriction::as_it_is;
    part.share_of_motion = 1;
    part.trials_in_vain = 0;
    part.is_tried = part.moves = false;
    if (part.freedom == RigidFreedom::none) continue;
    part.moments = RigidMoments(part.center, free.component(i), system.inertia_weights(), work);
  }
}

void RigidBalance::find_touching(const StepContext& context, const WorkingState& work) {
  const std::span<const Index> component_of_vertex = context.system.components_of_vertices();
  touching_.clear();
  couplings_.clear();
  context.contact.add_touching(component_of_vertex, touching_, couplings_);
  couplings_.finish();
  find_links();
  trial_.resize(work.positions.rows(), 3);
  joined_.resize(context.system.components().count());
  std::iota(joined_.begin(), joined_.end(), std::size_t{0});
  context.contact.join_components(component_of_vertex, joined_);
  sizes_of_joined_.assign(joined_.size(), 0);
  for (const std::size_t first : joined_) ++sizes_of_joined_[first];
  for (Part& part : parts_) {
    part.motions_left = sizes_of_joined_[joined_[part.component]] == 1 ? most_motions : most_motions_of_many;
  }
}

/// Which parts push each other.
void RigidBalance::find_links() {
  links_.clear();
  linked_.clear();
  const std::span<const RigidCoupling> couplings = couplings_.all();
  for (std::size_t i = 0; i < couplings.size(); ++i) {
    const Index a = part_of_component_[couplings[i].first];
    const Index b = part_of_component_[couplings[i].second];
    if (a < 0 || b < 0) continue;
    if (parts_[at(a)].freedom == RigidFreedom::none || parts_[at(b)].freedom == RigidFreedom::none) continue;
    links_.push_back({at(a), at(b)});
    linked_.push_back(i);
  }
  system_.lay_out(parts_.size(), links_);
}

/// Of all components where they are under trial.
void RigidBalance::ask_contact(const StepContext& context, const WorkingState& work) {
  const std::span<const Index> component_of_vertex = context.system.components_of_vertices();
  for (const Index v : touching_) {
    const Index place = part_of_component_[at(component_of_vertex[at(v)])];
    const Vec3 x = row(work.positions, v);
    trial_.row(v) = (place < 0 ? x : parts_[at(place)].placement_now.place(parts_[at(place)].center, x)).transpose();
  }
  trial_result_.assign(context.system.components().count(), {});
  for (const Part& part : parts_) {
    trial_result_[part.component].center = part.center;
    trial_result_[part.component].sliding = part.sliding;
  }
  couplings_.set_zero();
  context.contact.add_resistance(trial_, component_of_vertex, trial_result_, couplings_);
}

/// Whether a motion could if contact did not resist.
bool RigidBalance::may_gain(const Part& part) {
  if (part.freedom == RigidFreedom::none) return false;
  const Motion force = part.moments.residual();
  Matrix inertia = Matrix::Zero();
  inertia.diagonal().head<3>().setConstant(part.weight);
  inertia.bottomRightCorner<3, 3>() = part.inertia;
  const Motion motion = motion_of(inertia, force, part.freedom);
  return motion.allFinite() && motion.dot(force) / 2 > worthwhile * part.moments.energy();
}

/// What touches nothing any more moves as well: an iteration may have thrown it up. Returns whether any is to be tried.
bool RigidBalance::find_motions(Motions motions) {
  for (Part& part : parts_) {
    part.is_tried = false;
    part.placement_now = part.placement;
    part.rise_now = part.rise;
    if (part.freedom != RigidFreedom::none) find_force(part);
  }
  bool is_any = false;
  for (std::size_t set = 0; set < system_.set_count(); ++set) {
    const std::span<const std::size_t> bodies = system_.bodies(set);
    if (motions == Motions::common) {
      is_any |= bodies.size() > 1 && find_common_motion(set);
    } else if (bodies.size() > 1 && system_.is_small(set)) {
      is_any |= find_joint_motions(set);
    } else {
      for (const std::size_t i : bodies) is_any |= find_motion(parts_[i]);
    }
  }
  return is_any;
}

void RigidBalance::find_force(Part& part) const {
  const RigidResistance& contact = resistances_[part.component];
  part.force = part.moments.force(part.placement) + contact.force;
  part.curvature = contact.curvature.selfadjointView<Eigen::Lower>();
  part.is_light = part.curvature.isZero(0) && !is_misplaced(part);
  part.curvature.diagonal().head<3>().array() += part.weight;
  part.curvature.bottomRightCorner<3, 3>() += part.inertia;
}

/// Whether weight and inertia would shift it by more than rounding does, compared with its size. In flight they do not
/// after a global solve, which is exact for translations, and the energy of inertia is no measure: there is none.
bool RigidBalance::is_misplaced(const Part& part) {
  return part.force.head<3>().squaredNorm() / part.weight > least_shift * least_shift * part.inertia.trace();
}

/// Of motions that are known.
bool RigidBalance::is_worthwhile(std::span<const std::size_t> parts) const {
  Real gain = 0;
  Real energy = 0;
  bool have_moved = false;
  int trials_in_vain = 0;
  for (const std::size_t i : parts) {
    const Part& part = parts_[i];
    gain += part.motion.dot(part.force) / 2;
    energy += part.moments.energy() + part.rise + resistances_[part.component].energy;
    have_moved |= part.moves;
    trials_in_vain = std::max(trials_in_vain, part.trials_in_vain);
  }
  if (trials_in_vain >= few_trials_in_vain) return gain > worth_insisting * energy;
  return gain > (have_moved ? worth_going_on : worthwhile) * energy;
}

void RigidBalance::try_placement(const RigidPlacement& placement, Part& part) {
  part.is_tried = true;
  part.placement_now = placement;
  part.rise_now = part.moments.rise(placement);
}

/// As if all others stood still.
bool RigidBalance::find_motion(Part& part) {
  if (part.freedom == RigidFreedom::none || part.motions_left-- <= 0 || part.is_light) return false;
  part.motion = motion_of(part.curvature, part.force, part.freedom);
  const std::size_t number = static_cast<std::size_t>(&part - parts_.data());
  if (!part.motion.allFinite() || !is_worthwhile({&number, 1})) return false;
  try_placement(part.placement.moved(part.share_of_motion * part.motion), part);
  return true;
}

/// As all push each other.
bool RigidBalance::find_joint_motions(std::size_t set) {
  const std::span<const std::size_t> bodies = system_.bodies(set);
  bool are_light = true;
  bool are_motions_left = true;
  for (const std::size_t i : bodies) {
    are_light &= parts_[i].is_light;
    are_motions_left &= parts_[i].motions_left-- > 0;
  }
  if (are_light || !are_motions_left || !solve_jointly(set) || !is_worthwhile(bodies)) return false;
  for (const std::size_t i : bodies) {
    Part& part = parts_[i];
    try_placement(part.placement.moved(part.share_of_motion * part.motion), part);
  }
  return true;
}

bool RigidBalance::solve_jointly(std::size_t set) {
  system_.begin(set);
  motions_.resize(parts_.size());
  for (const std::size_t i : system_.bodies(set)) {
    const Index rows = rows_of(parts_[i].freedom);
    Matrix curvature = Matrix::Identity();
    curvature.topLeftCorner(rows, rows) = parts_[i].curvature.topLeftCorner(rows, rows);
    const Real turning = curvature.diagonal().tail<3>().sum();
    curvature.diagonal().tail<3>().array() += turning > 0 ? about_itself * turning : 1;
    system_.set_body(i, curvature);
    motions_[i].setZero();
    motions_[i].head(rows) = parts_[i].force.head(rows);
  }
  for (const std::size_t link : system_.links(set)) {
    const Index rows = rows_of(parts_[links_[link].first].freedom);
    const Index columns = rows_of(parts_[links_[link].second].freedom);
    Matrix coupling = Matrix::Zero();
    coupling.topLeftCorner(rows, columns) = couplings_.all()[linked_[link]].curvature.topLeftCorner(rows, columns);
    system_.set_link(link, coupling);
  }
  if (!system_.factorize(set)) return false;
  system_.solve(set, motions_);
  bool are_finite = true;
  for (const std::size_t i : system_.bodies(set)) {
    parts_[i].motion = motions_[i];
    are_finite &= motions_[i].allFinite();
  }
  return are_finite;
}

/// All of them alike, about their center of mass. What they do to each other adds up to no force, and to no torque but
/// that of friction.
bool RigidBalance::find_common_motion(std::size_t set) {
  const std::span<const std::size_t> bodies = system_.bodies(set);
  RigidFreedom freedom = RigidFreedom::all;
  bool are_light = true;
  Vec3 center = Vec3::Zero();
  Real weight = 0;
  for (const std::size_t i : bodies) {
    const Part& part = parts_[i];
    freedom = std::min(freedom, part.freedom);
    are_light &= part.is_light;
    center += part.weight * part.center;
    weight += part.weight;
  }
  if (are_light) return false;
  center /= weight;
  const auto change_of = [&](std::size_t i) { return about(parts_[i].center - center); };
  Matrix curvature = Matrix::Zero();
  Motion force = Motion::Zero();
  for (const std::size_t i : bodies) {
    const Matrix change = change_of(i);
    curvature += change.transpose() * parts_[i].curvature * change;
    force += change.transpose() * parts_[i].force;
  }
  for (const std::size_t link : system_.links(set)) {
    const Matrix both = change_of(links_[link].first).transpose() * couplings_.all()[linked_[link]].curvature *
                        change_of(links_[link].second);
    curvature += both + both.transpose();
  }
  const Motion motion = motion_of(curvature, force, freedom);
  if (!motion.allFinite()) return false;
  for (const std::size_t i : bodies) parts_[i].motion = change_of(i) * motion;
  if (!is_worthwhile(bodies)) return false;
  const Real share = parts_[bodies.front()].share_of_motion;
  const RigidPlacement way = RigidPlacement().moved(share * motion);
  for (const std::size_t i : bodies) {
    const Vec3 arm = parts_[i].center - center;
    try_placement({way.shift + way.turn * (arm + parts_[i].placement.shift) - arm, way.turn * parts_[i].placement.turn},
                  parts_[i]);
  }
  return true;
}

/// Friction that begins to slide, or to stick, on the way resists otherwise than where the way begins, and a motion may
/// go too far: in a parabola that lies above its energy everywhere it does not, but takes many times, so the motion
/// after that is again one of Newton's. What begins to touch on the way is in no parabola, so then the motion is
/// shortened. Returns whether contact is to be asked again where all have come to.
bool RigidBalance::judge_motions() {
  rises_.assign(joined_.size(), 0);
  for (std::size_t i = 0; i < joined_.size(); ++i) {
    Real& rise = rises_[joined_[i]];
    if (trial_result_[i].is_blocked) rise = std::numeric_limits<Real>::infinity();
    rise += trial_result_[i].energy - resistances_[i].energy;
  }
  for (const Part& part : parts_) rises_[joined_[part.component]] += part.rise_now - part.rise;
  bool has_any_come = false;
  bool has_any_stayed = false;
  bool is_sliding_other = false;
  for (Part& part : parts_) {
    if (!part.is_tried) continue;
    const SlidingFriction before = part.sliding;
    if (rises_[joined_[part.component]] <= 0) {
      part.placement = part.placement_now;
      part.rise = part.rise_now;
      part.moves = has_any_come = true;
      part.share_of_motion = std::min<Real>(1, part.share_of_motion / shorter);
      part.sliding = SlidingFriction::as_it_is;
      part.trials_in_vain = 0;
    } else {
      has_any_stayed = true;
      if (part.sliding == SlidingFriction::bounded) part.share_of_motion *= shorter;
      part.sliding = SlidingFriction::bounded;
      ++part.trials_in_vain;
    }
    is_sliding_other |= part.sliding != before;
  }
  if (has_any_come && !has_any_stayed && !is_sliding_other) std::swap(resistances_, trial_result_);
  const bool are_couplings_other = has_any_stayed && !links_.empty();  // those of the trial
  return is_sliding_other || are_couplings_other || (has_any_come && has_any_stayed);
}

}  // namespace pliant
