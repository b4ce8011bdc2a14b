#include "pliant/solver/contact_solver.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>

#include "pliant/collision/pairs/pair_resistance.h"
#include "pliant/core/stopwatch.h"

namespace pliant {
namespace {

/// Of the iterations, after which friction is refreshed.
constexpr std::array<Real, 2> refreshed_after = {0.3, 0.8};

/// Of inertia and elasticity where a component is held back as a whole: what they must be more than, so many times,
/// where single vertices are.
constexpr Real worth_stopping = 2;

/// In so many steps in a row contact must have been light to leave the factor.
constexpr Index light_steps_needed = 10;

/// Adds the time that it lives to a sum.
class AddedTime {
 public:
  explicit AddedTime(double& sum) : sum_(sum) {}
  ~AddedTime() { sum_ += watch_.seconds(); }
  AddedTime(const AddedTime&) = delete;
  AddedTime& operator=(const AddedTime&) = delete;

 private:
  double& sum_;
  Stopwatch watch_;
};

}  // namespace

void ContactSolver::set(std::vector<SolverCollider> colliders, std::vector<Real> radii, std::vector<Real> frictions,
                        std::vector<char> inner) {
  is_inner_ = std::move(inner);
  colliders_ = std::move(colliders);
  radii_ = std::move(radii);
  frictions_ = std::move(frictions);
  std::vector<ContactCollider> of_contact;
  for (const SolverCollider& each : colliders_) {
    of_contact.push_back({each.number, each.shape.get(), each.surface_velocity, each.friction, each.has_own_friction});
  }
  contact_.set_colliders(std::move(of_contact));
}

void ContactSolver::set_surfaces(SolverSurfaces surfaces) {
  surfaces_ = std::move(surfaces);
  is_laid_out_ = false;
  if (!has_pairs()) pairs_.clear();
  pair_energy_ = 0;
}

void ContactSolver::forget_order() {
  contact_.forget_substep();
  pairs_.forget_substep();
  is_laid_out_ = false;
}

void ContactSolver::lay_out_surfaces(const System& system) {
  if (is_laid_out_) return;
  const std::span<const Index> vertices = system.order().vertices();
  std::vector<Index> places(vertices.size());
  for (std::size_t i = 0; i < vertices.size(); ++i) places[at(vertices[i])] = static_cast<Index>(i);
  Positions rest;
  system.order().gather(surfaces_.rest, rest);
  Surface surface(surfaces_.parts, system.vertex_count(), places);
  surface.ignored = surfaces_.ignored;
  std::vector<Joint> joints = surfaces_.joints;
  if (!places.empty()) {
    for (Joint& each : joints) each = {places[at(each.a)], places[at(each.b)], each.is_alone};
  }
  surface.joined = JoinedVertices(joints, system.vertex_count());
  pairs_.set_surface(std::move(surface), rest, surfaces_.frictions, local_radii_);
  is_laid_out_ = true;
}

void ContactSolver::begin_step(const State& state, Real h) {
  begin_.clear();
  end_.clear();
  seconds_ = 0;
  for (std::size_t i = 0; i < colliders_.size(); ++i) {
    const ColliderState& now = state.contact.colliders[i];
    const ColliderMotion& motion = colliders_[i].motion;
    begin_.push_back(now.pose);
    end_.push_back(now.target ? *now.target : moved_on(now.pose, motion.velocity, motion.angular_velocity, h));
  }
}

void ContactSolver::gather(const State& state, const System& system, WorkingState& work) const {
  work.in_factor.clear();
  if (is_active()) system.order().gather(state.contact.in_factor, work.in_factor);
  work.light_steps = state.contact.light_steps;
  work.contact_energies.clear();
  if (has_pairs()) system.order().gather(state.contact.energies, work.contact_energies);
}

void ContactSolver::begin_substep(const State& state, Real begin, Real end, Real h, System& system, WorkingState& work,
                                  ThreadPool& threads) {
  const AddedTime timed(seconds_);
  const std::span<ContactCollider> colliders = contact_.colliders();
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    colliders[i].begin = begin == 0 ? begin_[i] : interpolate(begin_[i], end_[i], begin);
    colliders[i].end = interpolate(begin_[i], end_[i], end);
  }
  system.order().gather(radii_, local_radii_);
  system.order().gather(frictions_, local_frictions_);
  refreshes_ = 0;
  const ContactStep step{.begin = work.begin.positions,
                         .masses = work.begin.masses,
                         .radii = local_radii_,
                         .is_pinned = system.is_pinned(),
                         .vertices = system.order().vertices(),
                         .time_step = h,
                         .frictions = local_frictions_,
                         .is_inner = is_inner_};
  if (has_pairs()) {
    lay_out_surfaces(system);
    start_with_loads(state, system, work);
  }
  contact_.begin_substep(step, state.contact, work.positions, threads);
  if (!has_pairs()) return;
  pairs_.begin_substep(step, state.contact, work.positions, threads);
  start_as_a_whole(system, work, threads);
  pairs_.begin_at(work.positions, has_load_, threads);
  contact_.find_forces(work.positions, threads);
}

/// Components in which surfaces lie on each other begin with how they moved, not with what forces do to that: their
/// last balance goes on. Finds which vertices these have.
void ContactSolver::start_with_loads(const State& state, const System& system, WorkingState& work) {
  has_load_.clear();
  if (state.contact.pairs.empty()) return;
  pairs_.find_loaded_vertices(state.contact, has_load_);
  const std::span<const Index> component_of_vertex = system.components_of_vertices();
  is_loaded_component_.assign(system.components().count(), 0);
  for (std::size_t v = 0; v < has_load_.size(); ++v) {
    if (has_load_[v] != 0) is_loaded_component_[at(component_of_vertex[v])] = 1;
  }
  for (Index v = 0; v < system.vertex_count(); ++v) {
    has_load_[at(v)] = is_loaded_component_[at(component_of_vertex[at(v)])];
    const Real weight = system.inertia_weights()[at(v)];
    if (has_load_[at(v)] == 0 || !(weight > 0)) continue;
    work.positions.row(v) = work.prediction.row(v) - work.forces.row(v) / weight;
  }
}

/// A vertex that stops where its neighbors go on may stretch what is between them by more than iterations make good.
/// Then all of its component is held back.
void ContactSolver::start_as_a_whole(System& system, WorkingState& work, ThreadPool& threads) {
  const auto energy = [&] {
    const LocalResult local = system.local_step(work.positions, work.prediction, work.residual, threads);
    return local.inertia + local.elastic;
  };
  held_back_ = work.positions;
  if (!pairs_.shorten_components(system.components_of_vertices(), work.positions, threads)) return;
  const Real as_a_whole = energy();
  std::swap(held_back_, work.positions);
  if (worth_stopping * as_a_whole < energy()) std::swap(held_back_, work.positions);
}

void ContactSolver::find_forces(const Positions& q, ThreadPool& threads) {
  contact_.find_forces(q, threads);
  if (has_pairs()) pairs_.find_forces(q, threads);
}

void ContactSolver::subtract(Positions& r, ThreadPool& threads) {
  contact_.subtract(r, threads);
  if (has_pairs()) pairs_.subtract(r);
}

Real ContactSolver::curvature(const Positions& p) const {
  return contact_.curvature(p) + (has_pairs() ? pairs_.curvature(p) : 0);
}

Real ContactSolver::stiffened_curvature(const Positions& p) const {
  return contact_.stiffened_curvature(p) + (has_pairs() ? pairs_.stiffened_curvature(p) : 0);
}

void ContactSolver::add_diagonal(std::span<Real> diagonal) const {
  contact_.add_diagonal(diagonal);
  if (has_pairs()) pairs_.add_diagonal(diagonal);
}

void ContactSolver::add_touching(std::span<const Index> component_of_vertex, std::vector<Index>& vertices,
                                 RigidCouplings& couplings) const {
  contact_.add_touching(vertices);
  if (has_pairs()) pliant::add_touching(pairs_.near(), component_of_vertex, vertices, couplings);
}

void ContactSolver::add_resistance(const Positions& q, std::span<const Index> component_of_vertex,
                                   std::span<RigidResistance> components, RigidCouplings& couplings) const {
  contact_.add_resistance(q, component_of_vertex, components);
  if (!has_pairs()) return;
  pliant::add_resistance(pairs_.near(), q, pairs_.begin(), component_of_vertex, components, couplings);
}

void ContactSolver::add_energies(std::span<const Index> component_of_vertex, std::span<Real> components) const {
  contact_.add_energies(component_of_vertex, components);
  if (has_pairs()) pliant::add_energies(pairs_.near(), component_of_vertex, components);
}

void ContactSolver::add_stored_energies(std::span<const Index> component_of_vertex, std::span<Real> components) const {
  contact_.add_stored_energies(component_of_vertex, components);
  if (has_pairs()) pliant::add_stored_energies(pairs_.near(), component_of_vertex, components);
}

void ContactSolver::find_touching(std::span<const Index> component_of_vertex, std::span<std::size_t> least,
                                  std::span<char> touches, std::span<char> is_driven) const {
  std::iota(least.begin(), least.end(), std::size_t{0});
  pairs_.join_touching(component_of_vertex, least, touches);
  flatten(least);
  contact_.mark_driven(component_of_vertex, is_driven);
}

Real ContactSolver::steep_energy() const {
  return pairs_push() ? pliant::steep_energy(pairs_.near()) : 0;
}

void ContactSolver::join_components(std::span<const Index> component_of_vertex, std::span<std::size_t> least) const {
  if (has_pairs()) pliant::join_components(pairs_.near(), component_of_vertex, least);
}

/// Pinned vertices feel nothing.
void ContactSolver::finish(WorkingState& work, LocalResult& local, const ContactSums& sums) {
  local.contact = sums.energy;
  local.residual = std::sqrt(sums.squared_residual);
  if (!has_pairs()) return;
  pair_energy_ = pairs_.add(work.residual);
  local.contact += pair_energy_;
  Real largest = 0;
  for (Index v = 0; v < static_cast<Index>(work.residual.rows()); ++v) {
    if (pairs_.is_pinned(v)) work.residual.row(v).setZero();
    largest = std::max(largest, work.residual.row(v).squaredNorm());
  }
  local.residual = std::sqrt(largest);
}

void ContactSolver::add(WorkingState& work, LocalResult& local, ThreadPool& threads) {
  const AddedTime timed(seconds_);
  finish(work, local, contact_.add(work.residual, threads));
}

void ContactSolver::add_colliders(WorkingState& work, LocalResult& local, ThreadPool& threads) {
  const AddedTime timed(seconds_);
  of_colliders_ = contact_.add(work.residual, threads);
  local.contact = of_colliders_.energy;
}

void ContactSolver::add_pairs(WorkingState& work, LocalResult& local) {
  const AddedTime timed(seconds_);
  finish(work, local, of_colliders_);
}

bool ContactSolver::is_refresh_due(Index iteration, Index iterations, bool has_converged) const {
  if (!is_active() || refreshes_ == count_of(refreshed_after)) return false;
  const Real share = refreshed_after[at(refreshes_)];
  const auto due = std::max<Index>(1, static_cast<Index>(std::lround(share * static_cast<Real>(iterations))));
  return iteration >= due || has_converged;
}

bool ContactSolver::stiffen(const System& system, WorkingState& work, LocalResult& local, ThreadPool& threads) {
  if (!is_active() || contact_.held_back() == 0) return false;
  const AddedTime timed(seconds_);
  const std::optional<ContactSums> sums = contact_.stiffen(work.residual, system.diagonal(), threads);
  if (!sums) return false;
  if (has_pairs()) pairs_.subtract(work.residual);
  finish(work, local, *sums);
  return true;
}

void ContactSolver::refresh(WorkingState& work, LocalResult& local, ThreadPool& threads) {
  const AddedTime timed(seconds_);
  ++refreshes_;
  if (has_pairs()) {
    pairs_.subtract(work.residual);
    pairs_.refresh(work.positions, threads);
  }
  finish(work, local, contact_.refresh(work.residual, threads));
}

void ContactSolver::refresh_loads(WorkingState& work, LocalResult& local, ThreadPool& threads) {
  const AddedTime timed(seconds_);
  if (has_pairs()) {
    pairs_.subtract(work.residual);
    pairs_.refresh_loads(work.positions);
  }
  finish(work, local, contact_.refresh(work.residual, threads));
}

HeldBack ContactSolver::hold_back(const Positions& from, Positions& q, ThreadPool& threads) {
  HeldBack held = hold_back_at_colliders(q, threads);
  const HeldBack by_pairs = hold_back_at_surfaces(from, q, threads);
  held.has_moved |= by_pairs.has_moved;
  held.has_new_potential |= by_pairs.has_new_potential;
  return held;
}

HeldBack ContactSolver::hold_back_at_colliders(Positions& q, ThreadPool& threads) {
  const AddedTime timed(seconds_);
  return contact_.hold_back(q, threads);
}

HeldBack ContactSolver::hold_back_at_surfaces(const Positions& from, Positions& q, ThreadPool& threads) {
  if (!has_pairs()) return {};
  const AddedTime timed(seconds_);
  const HeldBack held = pairs_.hold_back(from, q, threads);
  if (held.has_moved) contact_.find_forces(q, threads);
  pairs_.find_forces(q, threads);
  return held;
}

void ContactSolver::commit_substep(const System& system, WorkingState& work, ThreadPool& threads, State& state,
                                   ContactReport& report) {
  const Stopwatch watch;
  contact_.commit(work.positions, system.diagonal(), state.contact, threads);
  state.contact.pairs.clear();
  if (has_pairs()) pairs_.commit(work.positions, system.diagonal(), state.contact, threads);
  std::vector<Real>& stiffening = state.contact.stiffening;
  if (std::ranges::all_of(stiffening, [](Real factor) { return factor == 1; })) stiffening.clear();
  if (work.light_steps >= light_steps_needed) work.in_factor.clear();
  state.contact.light_steps = work.in_factor.empty() ? 0 : work.light_steps;
  system.order().scatter(work.in_factor, state.contact.in_factor);
  system.order().scatter(work.contact_energies, state.contact.energies);
  report.held_back += contact_.held_back();
  report.contacts = count_of(contact_.points());
  report.deepest = 0;
  report.friction_power = 0;
  for (const ContactPoint& each : contact_.points()) {
    report.deepest = std::max(report.deepest, radii_[at(each.vertex)] - each.distance);
    report.friction_power += each.friction_power;
  }
  const PairReport& pairs = pairs_.report();
  report.pairs = pairs.pairs;
  report.active = pairs.active;
  report.smallest_gap = pairs.smallest_gap;
  report.shortened += pairs.shortened;
  report.lag = pairs.lag;
  report.let_go = pairs.let_go;
  report.let_go_bodies.insert(report.let_go_bodies.end(), pairs.let_go_bodies.begin(), pairs.let_go_bodies.end());
  seconds_ += watch.seconds();
  report.seconds = seconds_;
}

void ContactSolver::add_touches(const System& system, std::span<VertexTouch> touches) const {
  for (const ContactPoint& each : contact_.points()) {
    VertexTouch& touch = touches[at(each.vertex)];
    touch.gap = std::min(touch.gap, each.distance);
    touch.force += each.force;
  }
  if (!has_pairs() || !pairs_.has_begun()) return;
  const std::span<const Index> vertices = system.order().vertices();
  for (const NearPair& each : pairs_.near()) {
    if (!each.is_active()) continue;
    for (std::size_t j = 0; j < 4; ++j) {
      if (each.gap.weights[j] == 0) continue;
      const Index local = each.pair.vertices[j];
      VertexTouch& touch = touches[at(vertices.empty() ? local : vertices[at(local)])];
      touch.gap = std::min(touch.gap, each.gap.distance);
      touch.force += each.force_on(j);
    }
  }
}

void ContactSolver::commit_step(State& state) const {
  for (std::size_t i = 0; i < colliders_.size(); ++i) {
    state.contact.colliders[i].pose = end_[i];
    state.contact.colliders[i].target.reset();
  }
}

}  // namespace pliant
