#include "pliant/solver/contact_solver.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "pliant/core/stopwatch.h"

namespace pliant {
namespace {

/// Of the iterations, after which friction is refreshed.
constexpr std::array<Real, 2> refreshed_after = {0.3, 0.8};

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

void ContactSolver::set(std::vector<SolverCollider> colliders, std::vector<Real> radii) {
  colliders_ = std::move(colliders);
  radii_ = std::move(radii);
  std::vector<ContactCollider> of_contact;
  for (const SolverCollider& each : colliders_) {
    of_contact.push_back({each.number, each.shape.get(), each.surface_velocity, each.friction});
  }
  contact_.set_colliders(std::move(of_contact));
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
}

void ContactSolver::begin_substep(const State& state, Real begin, Real end, Real h, const System& system,
                                  WorkingState& work, ThreadPool& threads) {
  const AddedTime timed(seconds_);
  const std::span<ContactCollider> colliders = contact_.colliders();
  for (std::size_t i = 0; i < colliders.size(); ++i) {
    colliders[i].begin = begin == 0 ? begin_[i] : interpolate(begin_[i], end_[i], begin);
    colliders[i].end = interpolate(begin_[i], end_[i], end);
  }
  system.order().gather(radii_, local_radii_);
  refreshes_ = 0;
  const ContactStep step{work.begin.positions, work.begin.masses,         local_radii_,
                         system.is_pinned(),   system.order().vertices(), h};
  contact_.begin_substep(step, state.contact, work.positions, threads);
}

void ContactSolver::add(WorkingState& work, LocalResult& local, ThreadPool& threads) {
  const AddedTime timed(seconds_);
  const ContactSums sums = contact_.add(work.residual, threads);
  local.contact = sums.energy;
  local.residual = std::sqrt(sums.squared_residual);
}

bool ContactSolver::refresh(Index iteration, Index iterations, bool has_converged, WorkingState& work,
                            LocalResult& local, ThreadPool& threads) {
  if (refreshes_ == count_of(refreshed_after)) return false;
  const Real share = refreshed_after[at(refreshes_)];
  const auto due = std::max<Index>(1, static_cast<Index>(std::lround(share * static_cast<Real>(iterations))));
  if (iteration < due && !has_converged) return false;
  const AddedTime timed(seconds_);
  ++refreshes_;
  const ContactSums sums = contact_.refresh(work.residual, threads);
  local.contact = sums.energy;
  local.residual = std::sqrt(sums.squared_residual);
  return true;
}

HeldBack ContactSolver::hold_back(Positions& q, ThreadPool& threads) {
  const AddedTime timed(seconds_);
  return contact_.hold_back(q, threads);
}

void ContactSolver::commit_substep(const System& system, WorkingState& work, ThreadPool& threads, State& state,
                                   ContactReport& report) {
  const Stopwatch watch;
  contact_.commit(work.positions, system.diagonal(), state.contact, threads);
  if (work.light_steps >= light_steps_needed) work.in_factor.clear();
  state.contact.light_steps = work.in_factor.empty() ? 0 : work.light_steps;
  system.order().scatter(work.in_factor, state.contact.in_factor);
  report.held_back += contact_.held_back();
  report.contacts = count_of(contact_.points());
  report.deepest = 0;
  report.friction_power = 0;
  for (const ContactPoint& each : contact_.points()) {
    report.deepest = std::max(report.deepest, radii_[at(each.vertex)] - each.distance);
    report.friction_power += each.friction_power;
  }
  seconds_ += watch.seconds();
  report.seconds = seconds_;
}

void ContactSolver::commit_step(State& state) const {
  for (std::size_t i = 0; i < colliders_.size(); ++i) {
    state.contact.colliders[i].pose = end_[i];
    state.contact.colliders[i].target.reset();
  }
}

}  // namespace pliant
