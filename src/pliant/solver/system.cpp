#include "pliant/solver/system.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

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
        weights[at(stencil[a])] += group.factor_stiffness() * group.rest_measure()[i] * sum * row[a];
      }
    }
  }
}

}  // namespace

void System::set_groups(Index vertex_count, std::vector<ConstraintGroup*> groups) {
  simulation_groups_ = groups;
  passing_groups_ = PassingGroups::take_out_of(groups, vertex_count);
  needs_begin_step_ = true;
  if (has_layout_of(vertex_count, groups)) return take_passing();
  passing_.clear();
  if (vertex_count != vertex_count_) groups_.set({});
  vertex_count_ = vertex_count;
  layout_groups_ = std::move(groups);
  is_laid_out_ = false;
}

bool System::has_layout_of(Index vertex_count, std::span<ConstraintGroup* const> groups) const {
  if (!is_laid_out_ || vertex_count != vertex_count_) return false;
  return std::ranges::equal(groups, layout_groups_) && has_stamped_revisions();
}

void System::take_passing() {
  passing_.set(passing_groups_, groups_);
  passing_revisions_.clear();
  for (const ConstraintGroup* group : passing_groups_) passing_revisions_.push_back(group->revision());
  all_groups_.assign(groups_.in_use().begin(), groups_.in_use().end());
  all_groups_.insert(all_groups_.end(), passing_.in_use().begin(), passing_.in_use().end());
  is_pinned_ = is_pinned_in_factor_;
  for (const ConstraintGroup* group : passing_.in_use()) {
    for (const Index v : group->pinned_vertices()) is_pinned_[at(v)] = 1;
  }
  find_free();
}

/// What passing groups hold is not free.
void System::find_free() {
  std::vector<char> is_held = is_pinned_;
  for (const ConstraintGroup* group : passing_.in_use()) {
    for (const Index v : group->stencil()) is_held[at(v)] = 1;
  }
  free_components_ = {};
  freedom_.clear();
  for (std::size_t i = 0; i < free_in_layout_.count(); ++i) {
    const std::span<const Index> component = free_in_layout_.component(i);
    if (std::ranges::any_of(component, [&](Index v) { return is_held[at(v)] != 0; })) continue;
    free_components_.vertices.insert(free_components_.vertices.end(), component.begin(), component.end());
    free_components_.starts.push_back(free_components_.vertices.size());
    freedom_.push_back(freedom_in_layout_[i]);
  }
}

void System::sync_parameters() {
  groups_.sync_parameters();
  passing_.sync_parameters();
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
  needs_begin_step_ = false;
}

void System::freeze_shapes(const Positions& q, const State& state, Real h) {
  const auto freezes = [](const ConstraintGroup* group) { return group->freezes_shape(); };
  if (std::ranges::none_of(simulation_groups_, freezes)) return;
  groups_.scatter(q, shape_);
  const StateView view{shape_, state.velocities, state.masses, state.step, state.time};
  for (ConstraintGroup* group : simulation_groups_) {
    if (freezes(group)) group->begin_step(view, h);
  }
  sync_parameters();
}

bool System::needs_layout() const {
  if (!is_laid_out_ || !has_stamped_revisions()) return true;
  for (std::size_t g = 0; g < passing_groups_.size(); ++g) {
    if (passing_groups_[g]->revision() != passing_revisions_[g]) return true;
  }
  return false;
}

bool System::has_stamped_revisions() const {
  for (std::size_t g = 0; g < layout_groups_.size(); ++g) {
    if (layout_groups_[g]->revision() != stamps_[g].revision) return false;
  }
  return true;
}

void System::lay_out() {
  is_laid_out_ = false;  // where this fails
  factor_step_ = 0;
  added_diagonal_.clear();
  layout_groups_ = simulation_groups_;  // one that has grown may stay out of the factor no longer
  passing_groups_ = PassingGroups::take_out_of(layout_groups_, vertex_count_);
  choose_order();
  const bool was_analyzed = std::exchange(is_analyzed_, false);  // also where the next line fails
  if (matrix_.set_groups(vertex_count_, groups_.in_use()) || !was_analyzed) {
    components_ = find_components(matrix_.matrix());
    component_of_vertex_ = component_of_vertex(components_);
  } else {
    is_analyzed_ = true;
  }
  stamps_.clear();
  places_.clear();
  for (const ConstraintGroup* group : layout_groups_) {
    places_.emplace(group, stamps_.size());
    stamps_.push_back({group->revision(), group->factor_stiffness()});
  }
  find_pinned();
  free_in_layout_ = find_free_components(components_, groups_.in_use(), is_pinned_in_factor_);
  freedom_in_layout_ = find_freedom(free_in_layout_, groups_.in_use());
  local_step_.set_components(component_of_vertex_);
  take_passing();
  is_laid_out_ = true;
}

/// That of the simulation, unless its constraints are scattered and an order of our own is much better.
void System::choose_order() {
  groups_.set(layout_groups_);
  local_step_.set_groups(vertex_count_, groups_.in_use());
  const Real chunks = local_step_.chunks_of_vertex();
  if (chunks <= scattered_chunks || !groups_.reorder(vertex_count_)) return;
  local_step_.set_groups(vertex_count_, groups_.in_use());
  if (local_step_.chunks_of_vertex() <= better_order * chunks) return;
  groups_.set(layout_groups_);
  local_step_.set_groups(vertex_count_, groups_.in_use());
}

void System::find_pinned() {
  none_pinned_.assign(at(vertex_count_), 0);
  is_pinned_in_factor_ = none_pinned_;
  no_weights_.assign(at(vertex_count_), 0);
  for (const ConstraintGroup* group : groups_.in_use()) {
    for (const Index vertex : group->pinned_vertices()) is_pinned_in_factor_[at(vertex)] = 1;
  }
}

void System::set_inertia(std::span<const Real> masses, Real step) {
  inertia_weights_.resize(masses.size());
  for (std::size_t i = 0; i < masses.size(); ++i) inertia_weights_[i] = is_pinned_[i] ? 0 : masses[i] / (step * step);
  translation_weights_ = inertia_weights_;
  for (const ConstraintGroup* group : passing_.in_use()) {
    for (const Index v : group->pinned_vertices()) {
      if (!is_pinned_in_factor_[at(v)]) translation_weights_[at(v)] = masses[at(v)] / (step * step);
    }
  }
  for (ConstraintGroup* group : groups_.in_use()) {
    if (!group->is_external() || !group->targets().empty()) continue;
    add_translation_weights(*group, translation_weights_);
  }
  for (std::size_t i = 0; i < added_diagonal_.size(); ++i) translation_weights_[i] += added_diagonal_[i];
}

bool System::needs_factor(Real step, std::span<const Real> diagonal) const {
  if (factor_step_ != step || !std::ranges::equal(added_diagonal_, diagonal)) return true;
  for (std::size_t g = 0; g < layout_groups_.size(); ++g) {
    if (layout_groups_[g]->factor_stiffness() != stamps_[g].stiffness) return true;
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
  for (std::size_t g = 0; g < layout_groups_.size(); ++g) stamps_[g].stiffness = layout_groups_[g]->factor_stiffness();
  factor_step_ = 0;  // until this succeeds
  matrix_.assemble(masses, step, groups_.in_use(), is_pinned_in_factor_);
  matrix_.copy_diagonal(diagonal_in_factor_);
  diagonal_ = diagonal_in_factor_;
}

void System::factorize_sum(Precision precision, ThreadPool& threads, SetUpTimes& times) {
  const Stopwatch watch;
  if (!is_analyzed_) global_step_.analyze(matrix_.matrix());
  is_analyzed_ = true;
  times.symbolic = watch.seconds();
  global_step_.factorize(matrix_.matrix(), precision, translation_weights_, free_in_layout_, threads, times);
  correct_factor();
}

/// Where it fails there is no factor.
void System::correct_factor() {
  if (!is_factor_corrected()) return;
  const Real step = std::exchange(factor_step_, 0);
  const FactorRows& rows = passing_.rows(is_pinned_);
  const bool is_other = global_step_.correct(rows);
  factor_step_ = step;
  if (!is_other) return;
  diagonal_ = diagonal_in_factor_;
  rows.add_to_diagonal(diagonal_);
}

LocalResult System::local_step(const Positions& q, const Positions& s, Positions& r, ThreadPool& threads) {
  LocalResult result = local_step_.run(q, s, inertia_weights_, is_pinned_, r, threads);
  if (!passing_.has_forces()) return result;
  result.elastic += passing_.add_forces(q, is_pinned_, r);
  result.residual = std::sqrt(r.rowwise().squaredNorm().maxCoeff<Eigen::PropagateNaN>());
  return result;
}

void System::elastic_step(const Positions& q, Positions& forces, std::span<Real> energies, ThreadPool& threads) {
  local_step_.run(q, q, no_weights_, none_pinned_, forces, threads);
  passing_.add_forces(q, none_pinned_, forces);
  local_step_.elastic_energies(q, energies);
}

SolveTimes System::global_step(Positions& r, Real largest, Positions& q, ThreadPool& threads) {
  return global_step_.move(r, largest, q, threads);
}

SolveTimes System::solve(Positions& r, Real largest, Positions& x, ThreadPool& threads) {
  return global_step_.solve(r, largest, x, threads);
}

Real System::elastic_energy(const ConstraintGroup& group) const {
  const auto found = places_.find(&group);
  if (!is_laid_out_) return 0;
  if (found == places_.end()) return passing_.elastic_energy(group);
  return local_step_.elastic_energy(found->second);
}

}  // namespace pliant
