#include "pliant/solver/system.h"

#include <algorithm>
#include <numeric>

#include "pliant/core/stopwatch.h"
#include "pliant/solver/constraint_rows.h"
#include "pliant/solver/integration/integrator.h"

namespace pliant {
namespace {

/// Chunks of a vertex from which another order is tried, and the share of them that it must leave at most to be taken:
/// a box that is numbered row by row has many as well, and is none the slower.
constexpr Real scattered_chunks = 2;
constexpr Real better_order = 0.6;

/// What a group that a force brings adds to Y Σ x of a translation x, at each vertex [N/m].
void add_translation_weights(const ConstraintGroup& group, std::span<Real> weights) {
  const auto count = static_cast<std::size_t>(group.shape().count);
  const auto rows = static_cast<std::size_t>(group.shape().rows);
  for (std::size_t i = 0; i < count; ++i) {
    const std::span<const Index> stencil = stencil_of(group, i);
    for (std::size_t r = 0; r < rows; ++r) {
      const std::span<const Real> row = reduction_row(group, i, r);
      const Real sum = std::accumulate(row.begin(), row.end(), Real(0));
      for (std::size_t a = 0; a < row.size(); ++a) {
        weights[at(stencil[a])] += group.stiffness() * group.rest_measure()[i] * sum * row[a];
      }
    }
  }
}

}  // namespace

void System::set_groups(Index vertex_count, std::vector<ConstraintGroup*> groups) {
  if (vertex_count != vertex_count_) groups_.set({});
  vertex_count_ = vertex_count;
  simulation_groups_ = std::move(groups);
  is_laid_out_ = false;
}

void System::set_factorization(std::unique_ptr<Factorization> factorization) {
  global_step_.set_factorization(std::move(factorization));
  is_analyzed_ = false;
  factor_step_ = 0;
}

void System::begin_step(const State& state, Integrator integrator, Real h) {
  StateView view = state.view();
  const bool is_bdf2 = integrator == Integrator::bdf2 && has_history(state, h);
  view.inertia_step = is_bdf2 ? pliant::inertia_step(Integrator::bdf2, h) : h;
  if (is_bdf2) view.previous_positions = &state.previous_positions;
  for (ConstraintGroup* group : simulation_groups_) group->begin_step(view, h);
  local_step_.begin_step();
}

void System::freeze_shapes(const Positions& q, const State& state, Real h) {
  const auto freezes = [](const ConstraintGroup* group) { return group->freezes_shape(); };
  if (std::ranges::none_of(simulation_groups_, freezes)) return;
  groups_.scatter(q, shape_);
  const StateView view{shape_, state.velocities, state.masses, state.step, state.time};
  for (ConstraintGroup* group : simulation_groups_) {
    if (freezes(group)) group->begin_step(view, h);
  }
  groups_.sync_parameters();
}

bool System::needs_layout() const {
  if (!is_laid_out_) return true;
  for (std::size_t g = 0; g < simulation_groups_.size(); ++g) {
    if (simulation_groups_[g]->revision() != stamps_[g].revision) return true;
  }
  return false;
}

void System::lay_out() {
  added_diagonal_.clear();
  choose_order();
  if (matrix_.set_groups(vertex_count_, groups())) is_analyzed_ = false;
  stamps_.clear();
  places_.clear();
  for (const ConstraintGroup* group : simulation_groups_) {
    places_.emplace(group, stamps_.size());
    stamps_.push_back({group->revision(), group->stiffness()});
  }
  find_pinned();
  components_ = find_components(matrix_.matrix());
  free_components_ = find_free_components(components_, groups(), is_pinned_);
  freedom_ = find_freedom(free_components_, groups());
  component_of_vertex_ = component_of_vertex(components_);
  local_step_.set_components(component_of_vertex_);
  is_laid_out_ = true;
  factor_step_ = 0;
}

/// That of the simulation, unless its constraints are scattered and an order of our own is much better.
void System::choose_order() {
  groups_.set(simulation_groups_);
  local_step_.set_groups(vertex_count_, groups());
  const Real chunks = local_step_.chunks_of_vertex();
  if (chunks <= scattered_chunks || !groups_.reorder(vertex_count_)) return;
  local_step_.set_groups(vertex_count_, groups());
  if (local_step_.chunks_of_vertex() <= better_order * chunks) return;
  groups_.set(simulation_groups_);
  local_step_.set_groups(vertex_count_, groups());
}

void System::find_pinned() {
  none_pinned_.assign(at(vertex_count_), 0);
  is_pinned_ = none_pinned_;
  no_weights_.assign(at(vertex_count_), 0);
  for (const ConstraintGroup* group : groups()) {
    for (const Index vertex : group->pinned_vertices()) is_pinned_[at(vertex)] = 1;
  }
}

void System::set_inertia(std::span<const Real> masses, Real step) {
  inertia_weights_.resize(masses.size());
  for (std::size_t i = 0; i < masses.size(); ++i) inertia_weights_[i] = is_pinned_[i] ? 0 : masses[i] / (step * step);
  translation_weights_ = inertia_weights_;
  for (ConstraintGroup* group : groups()) {
    if (!group->is_external() || !group->targets().empty()) continue;
    add_translation_weights(*group, translation_weights_);
  }
  for (std::size_t i = 0; i < added_diagonal_.size(); ++i) translation_weights_[i] += added_diagonal_[i];
}

bool System::needs_factor(Real step, std::span<const Real> diagonal) const {
  if (factor_step_ != step || !std::ranges::equal(added_diagonal_, diagonal)) return true;
  for (std::size_t g = 0; g < simulation_groups_.size(); ++g) {
    if (simulation_groups_[g]->stiffness() != stamps_[g].stiffness) return true;
  }
  return false;
}

void System::factorize(std::span<const Real> masses, std::span<const Real> diagonal, Real step, Precision precision,
                       ThreadPool& threads, SetUpTimes& times) {
  const Stopwatch watch;
  added_diagonal_.assign(diagonal.begin(), diagonal.end());
  set_inertia(masses, step);
  sum(masses, step);
  if (!diagonal.empty()) matrix_.add_diagonal(diagonal);
  times.assembly = watch.seconds();
  factorize_sum(precision, threads, times);
  factor_step_ = step;
}

void System::sum(std::span<const Real> masses, Real step) {
  for (std::size_t g = 0; g < simulation_groups_.size(); ++g) stamps_[g].stiffness = simulation_groups_[g]->stiffness();
  factor_step_ = 0;  // until this succeeds
  matrix_.assemble(masses, step, groups(), is_pinned_);
  matrix_.copy_diagonal(diagonal_);
}

void System::factorize_sum(Precision precision, ThreadPool& threads, SetUpTimes& times) {
  const Stopwatch watch;
  if (!is_analyzed_) global_step_.analyze(matrix_.matrix());
  is_analyzed_ = true;
  times.symbolic = watch.seconds();
  global_step_.factorize(matrix_.matrix(), precision, translation_weights_, free_components_, threads, times);
}

LocalResult System::local_step(const Positions& q, const Positions& s, Positions& r, ThreadPool& threads) {
  return local_step_.run(q, s, inertia_weights_, is_pinned_, r, threads);
}

void System::elastic_step(const Positions& q, Positions& forces, std::span<Real> energies, ThreadPool& threads) {
  local_step_.run(q, q, no_weights_, none_pinned_, forces, threads);
  local_step_.elastic_energies(q, energies);
}

SolveTimes System::global_step(const Positions& r, Real largest, Positions& q, ThreadPool& threads) {
  return global_step_.move(r, largest, q, threads);
}

SolveTimes System::solve(const Positions& r, Real largest, Positions& x, ThreadPool& threads) {
  return global_step_.solve(r, largest, x, threads);
}

Real System::elastic_energy(const ConstraintGroup& group) const {
  const auto found = places_.find(&group);
  if (!is_laid_out_ || found == places_.end()) return 0;
  return local_step_.elastic_energy(found->second);
}

}  // namespace pliant
