#include "pliant/solver/solver.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <thread>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {
namespace {

/// Positions past this count as diverged [m]: energies of such bodies overflow.
constexpr Real farthest = 1e100;

/// Whether a coordinate is past that, or not a number.
template <class Coordinates>
bool is_far(const Coordinates& x) {
  return !(x.cwiseAbs().template maxCoeff<Eigen::PropagateNaN>() <= farthest);
}

/// Slots for which another thread is worth waking, when the number of threads is left to us.
constexpr std::size_t slots_per_thread = 8192;

int useful_threads(Index asked, std::size_t slots) {
  if (asked > 0) return asked;
  const auto processors = static_cast<std::size_t>(std::max(1U, std::thread::hardware_concurrency()));
  return static_cast<int>(std::clamp<std::size_t>(slots / slots_per_thread, 1, processors));
}

}  // namespace

Solver::Solver(const SolverSettings& settings) : threads_(std::make_unique<ThreadPool>(1)) {
  set_settings(settings);
}

void Solver::set_settings(const SolverSettings& settings) {
  check_options("settings", settings);
  if (settings.precision != Precision::double_) {
    fail_input("settings: precision: `mixed` is not in this version; use `double`");
  }
  if (!factorization_ || settings.backend != settings_.backend) {
    factorization_ = make_factorization(settings.backend);
    pattern_analyzed_ = false;
    factor_time_step_ = 0;
  }
  settings_ = settings;
  start_threads();
  history_.reserve(std::min(history_limit, static_cast<std::size_t>(settings_.iterations)));
}

void Solver::start_threads() {
  const int threads = useful_threads(settings_.threads, local_step_.slot_count());
  if (threads != thread_count()) threads_ = std::make_unique<ThreadPool>(threads);
}

void Solver::set_groups(Index vertex_count, std::vector<ConstraintGroup*> groups) {
  vertex_count_ = vertex_count;
  groups_ = std::move(groups);
  groups_laid_out_ = false;
  if (s_.rows() == vertex_count) return;
  for (Positions* x : {&force_, &s_, &q_, &residual_, &correction_}) x->setZero(vertex_count, 3);
  predicted_time_step_ = 0;
}

bool Solver::groups_changed() const {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (groups_[g]->revision() != stamps_[g].revision) return true;
  }
  return false;
}

bool Solver::stiffness_changed() const {
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    if (groups_[g]->stiffness() != stamps_[g].stiffness) return true;
  }
  return false;
}

void Solver::prepare(const State& state) {
  for (ConstraintGroup* group : groups_) group->begin_step(state.view(), settings_.time_step);
  if (!groups_laid_out_ || groups_changed()) lay_out_groups();
  if (factor_time_step_ != settings_.time_step || stiffness_changed()) factorize(state);
  history_.clear();
}

void Solver::lay_out_groups() {
  local_step_.set_groups(vertex_count_, groups_);
  start_threads();
  if (system_matrix_.set_groups(vertex_count_, groups_)) pattern_analyzed_ = false;
  stamps_.clear();
  for (const ConstraintGroup* group : groups_) stamps_.push_back({group->revision(), group->stiffness()});
  is_held_.assign(static_cast<std::size_t>(vertex_count_), 0);
  for (const ConstraintGroup* group : groups_) {
    for (const Index vertex : group->held_vertices()) is_held_[static_cast<std::size_t>(vertex)] = 1;
  }
  groups_laid_out_ = true;
  factor_time_step_ = 0;
}

void Solver::weigh_inertia(const State& state, Real time_step) {
  inertia_weights_.resize(state.masses.size());
  for (std::size_t i = 0; i < inertia_weights_.size(); ++i) {
    inertia_weights_[i] = is_held_[i] ? 0 : state.masses[i] / (time_step * time_step);
  }
}

void Solver::factorize(const State& state) {
  const Real h = settings_.time_step;
  weigh_inertia(state, h);
  for (std::size_t g = 0; g < groups_.size(); ++g) stamps_[g].stiffness = groups_[g]->stiffness();
  factor_time_step_ = 0;  // until this succeeds
  system_matrix_.sum(state.masses, h, groups_, is_held_);
  if (!pattern_analyzed_) factorization_->analyze(system_matrix_.matrix());
  pattern_analyzed_ = true;
  factorization_->factorize(system_matrix_.matrix());
  factor_time_step_ = h;
}

void Solver::check_finite(const State& state) const {
  // One pass for the common case; which vertex it was is asked only when there is one.
  if (!is_far(q_)) return;
  // Where the prediction is far already, the cause is that vertex; one solve then takes its whole body along.
  for (const Positions* x : {&s_, &q_}) {
    for (Index i = 0; i < vertex_count_; ++i) {
      const bool is_prediction_of_held = x == &s_ && is_held_[static_cast<std::size_t>(i)];
      if (!is_prediction_of_held && is_far(x->row(i))) report_divergence(state, i);
    }
  }
}

void Solver::report_divergence(const State& state, Index vertex) const {
  throw Error(ErrorKind::diverged,
              fmt::format("step {} (t = {} s): vertex {} would leave for a place that is not finite: {}",
                          state.step + 1, state.time + settings_.time_step, vertex, reason(state, vertex)));
}

std::string Solver::reason(const State& state, Index vertex) const {
  Positions alone(vertex_count_, 3);
  for (Force* force : forces_) {
    alone.setZero();
    force->add_to(alone, state.view(), settings_.time_step);
    const Real mass = state.masses[static_cast<std::size_t>(vertex)];
    if (is_far(alone.row(vertex) * settings_.time_step * settings_.time_step / mass)) {
      return "the force `" + std::string(force->type()) + "` on it has grown without bound; lessen it" +
             (force->type() == "wind" ? ", or give the wind `area` `rest` or the model `relative`" : "");
    }
  }
  if (is_far(s_.row(vertex))) return "its velocity has grown without bound; lessen the forces or the time step";
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const Index constraint = local_step_.first_not_finite(g);
    if (constraint >= 0) {
      return "constraint " + std::to_string(constraint) + " of type " + std::string(groups_[g]->type()) +
             " has a force that is not finite; lessen its stiffness";
    }
  }
  return "the system of equations is too badly conditioned; lessen the ratio of stiffness to m/h²";
}

}  // namespace pliant
