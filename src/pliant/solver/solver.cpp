#include "pliant/solver/solver.h"

#include <algorithm>
#include <numeric>
#include <thread>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"
#include "pliant/solver/integration/integrator.h"

namespace pliant {
namespace {

/// Slots for which another thread is worth waking: below, handing out the work takes longer than the work, and so even
/// who asks for threads is given fewer. Where their number is left to us, the clock decides among these (ThreadChoice).
constexpr std::size_t slots_per_thread = 4096;

/// Chunks of a vertex from which another order is tried, and the share of them that it must leave at most to be taken:
/// a box that is numbered row by row has many as well, and is none the slower.
constexpr Real scattered_chunks = 2;
constexpr Real better_order = 0.6;

int useful_threads(Index asked, std::size_t slots) {
  const auto processors = static_cast<std::size_t>(std::max(1U, std::thread::hardware_concurrency()));
  const std::size_t most = asked > 0 ? static_cast<std::size_t>(asked) : processors;
  return static_cast<int>(std::clamp<std::size_t>(slots / slots_per_thread, 1, most));
}

/// What a group that a force brings adds to Y Σ x of a translation x, at each vertex [N/m].
void add_translation_weights(const ConstraintGroup& group, std::span<Real> weights) {
  const GroupShape shape = group.shape();
  const auto n = static_cast<std::size_t>(shape.vertices);
  const std::size_t row_count = static_cast<std::size_t>(shape.count) * static_cast<std::size_t>(shape.rows);
  for (std::size_t r = 0; r < row_count; ++r) {
    const std::size_t i = r / static_cast<std::size_t>(shape.rows);
    const std::span<const Real> row = group.reduction().subspan(r * n, n);
    const Real sum = std::accumulate(row.begin(), row.end(), Real(0));
    for (std::size_t a = 0; a < n; ++a) {
      weights[static_cast<std::size_t>(group.stencil()[i * n + a])] +=
          group.stiffness() * group.rest_measure()[i] * sum * row[a];
    }
  }
}

}  // namespace

Solver::Solver(const SolverSettings& settings) : threads_(std::make_unique<ThreadPool>(1)) {
  set_settings(settings);
}

void Solver::set_settings(const SolverSettings& settings) {
  check_options("settings", settings);
  std::unique_ptr<Factorization> other;
  if (!global_step_.has_factorization() || settings.backend != settings_.backend ||
      settings.ordering != settings_.ordering) {
    other = make_factorization(settings.backend, settings.ordering);
  }
  start_threads(settings.threads);  // may fail; nothing has changed until here
  if (other) {
    global_step_.set_factorization(std::move(other));
    pattern_analyzed_ = false;
    factor_step_ = 0;
  }
  if (settings.precision != settings_.precision) factor_step_ = 0;
  settings_ = settings;
  history_.reserve(std::min(history_limit, static_cast<std::size_t>(settings_.iterations)));
}

void Solver::start_threads(Index asked) {
  const int threads = useful_threads(asked, local_step_.slot_count());
  const bool is_same_pool = threads == threads_->thread_count();
  if (!is_same_pool) threads_ = std::make_unique<ThreadPool>(threads);
  if (asked > 0) {
    thread_choice_ = ThreadChoice::fixed(threads);
  } else if (!is_same_pool || settings_.threads > 0) {
    thread_choice_ = ThreadChoice(threads);
  } else {
    thread_choice_.restart();
  }
}

void Solver::set_groups(Index vertex_count, std::vector<ConstraintGroup*> groups) {
  vertex_count_ = vertex_count;
  groups_ = std::move(groups);
  groups_laid_out_ = false;
  if (s_.rows() == vertex_count) return;
  local_groups_.set({});
  for (Positions* x : {&force_, &s_, &q_, &residual_}) x->setZero(vertex_count, 3);
  predicted_step_ = 0;
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

void Solver::prepare(const State& state, StepReport& report) {
  const Stopwatch total;
  SetUpTimes times;
  begin_groups(state);
  const Stopwatch watch;
  if (!groups_laid_out_ || groups_changed()) {
    build_layout();
    times.layout = watch.seconds();
  } else {
    local_groups_.sync_parameters();
  }
  if (factor_step_ != inertia_step(settings_.integrator, substep()) || stiffness_changed()) factorize(state, times);
  history_.clear();
  if (times.numeric > 0 || report.seconds_factor == 0) report.set_up = times;
  report.seconds_factor += total.seconds();
}

void Solver::begin_groups(const State& state) {
  StateView view = state.view();
  const bool is_bdf2 = settings_.integrator == Integrator::bdf2 && has_history(state, substep());
  view.inertia_step = is_bdf2 ? inertia_step(Integrator::bdf2, substep()) : substep();
  if (is_bdf2) view.previous_positions = &state.previous_positions;
  for (ConstraintGroup* group : groups_) group->begin_step(view, substep());
}

/// That of the simulation, unless its constraints are scattered and an order of our own is much better.
void Solver::choose_order() {
  local_groups_.set(groups_);
  local_step_.set_groups(vertex_count_, groups_);
  const Real chunks = local_step_.chunks_of_vertex();
  if (chunks <= scattered_chunks || !local_groups_.reorder(vertex_count_)) return;
  local_step_.set_groups(vertex_count_, local_groups_.in_use());
  if (local_step_.chunks_of_vertex() <= better_order * chunks) return;
  local_groups_.set(groups_);
  local_step_.set_groups(vertex_count_, groups_);
}

void Solver::build_layout() {
  s_ = local_groups_.in_simulation_order(s_);
  choose_order();
  s_ = local_groups_.in_local_order(s_);
  const std::span<ConstraintGroup* const> groups = local_groups_.in_use();
  start_threads(settings_.threads);
  if (system_matrix_.set_groups(vertex_count_, groups)) pattern_analyzed_ = false;
  stamps_.clear();
  places_.clear();
  for (const ConstraintGroup* group : groups_) {
    places_.emplace(group, stamps_.size());
    stamps_.push_back({group->revision(), group->stiffness()});
  }
  is_pinned_.assign(static_cast<std::size_t>(vertex_count_), 0);
  for (const ConstraintGroup* group : groups) {
    for (const Index vertex : group->pinned_vertices()) is_pinned_[static_cast<std::size_t>(vertex)] = 1;
  }
  lay_out_components(groups);
  groups_laid_out_ = true;
  factor_step_ = 0;
}

void Solver::lay_out_components(std::span<ConstraintGroup* const> groups) {
  Components components = find_components(system_matrix_.matrix());
  free_components_ = find_free_components(components, groups, is_pinned_);
  energy_.set_components(components, free_components_, is_pinned_);
  local_step_.set_components(energy_.component_of_vertex());
  for (Index& vertex : components.vertices) vertex = local_groups_.vertex(vertex);
  std::vector<char> is_pinned(is_pinned_.size());
  for (std::size_t i = 0; i < is_pinned.size(); ++i) {
    is_pinned[static_cast<std::size_t>(local_groups_.vertex(static_cast<Index>(i)))] = is_pinned_[i];
  }
  damping_.set_components(std::move(components), std::move(is_pinned));
}

void Solver::weigh_inertia(const State& state, Real step) {
  masses_.resize(state.masses.size());
  inertia_weights_.resize(state.masses.size());
  for (std::size_t i = 0; i < inertia_weights_.size(); ++i) {
    masses_[i] = state.masses[static_cast<std::size_t>(local_groups_.vertex(static_cast<Index>(i)))];
    inertia_weights_[i] = is_pinned_[i] ? 0 : masses_[i] / (step * step);
  }
  translation_weights_ = inertia_weights_;
  for (ConstraintGroup* group : local_groups_.in_use()) {
    if (group->is_external() && group->targets().empty()) add_translation_weights(*group, translation_weights_);
  }
}

void Solver::factorize(const State& state, SetUpTimes& times) {
  Stopwatch watch;
  const Real step = inertia_step(settings_.integrator, substep());
  for (std::size_t g = 0; g < groups_.size(); ++g) stamps_[g].stiffness = groups_[g]->stiffness();
  factor_step_ = 0;  // until this succeeds
  weigh_inertia(state, step);
  system_matrix_.assemble(masses_, step, local_groups_.in_use(), is_pinned_);
  times.assembly = watch.lap();
  if (!pattern_analyzed_) global_step_.analyze(system_matrix_.matrix());
  pattern_analyzed_ = true;
  times.symbolic = watch.lap();
  global_step_.factorize(system_matrix_.matrix(), settings_.precision, translation_weights_, free_components_,
                         *threads_, times);
  factor_step_ = step;
}

Real Solver::elastic_energy(const ConstraintGroup& group) const {
  const auto found = places_.find(&group);
  if (!groups_laid_out_ || found == places_.end()) return 0;
  return local_step_.elastic_energy(found->second);
}

}  // namespace pliant
