#include "pliant/solver/local/local_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"
#include "pliant/solver/constraint_rows.h"

namespace pliant {
namespace {

// Slots of a chunk: as many as there are for 64 chunks, but enough to hide the cost of handing out work, and few enough
// to stay in the second-level cache (100 kB). The size of the problem alone decides, so that the bits do.
constexpr std::size_t most_chunk_slots = max_reduction_rows;
constexpr std::size_t fewest_chunk_slots = 1024;
constexpr std::size_t chunks_wanted = 64;
constexpr Index vertices_per_chunk = 1024;
constexpr Index rows_per_chunk = 512;       // of linear forces
constexpr Index constraints_together = 64;  // that kernels take at once

/// Of a constraint.
std::size_t slots_of(const ConstraintGroup& group) {
  return static_cast<std::size_t>(takes_forces(group) ? group.shape().vertices : group.shape().rows);
}

/// Between begin_local_step() and end_local_step() of every group.
class OpenLocalStep {
 public:
  OpenLocalStep(std::span<ConstraintGroup* const> groups, const Positions& q) : groups_(groups) {
    for (; begun_ < groups.size(); ++begun_) {
      try {
        groups[begun_]->begin_local_step(q);
      } catch (...) {
        end();
        throw;
      }
    }
  }
  ~OpenLocalStep() { end(); }
  OpenLocalStep(const OpenLocalStep&) = delete;
  OpenLocalStep& operator=(const OpenLocalStep&) = delete;

 private:
  void end() const {
    for (ConstraintGroup* group : groups_.first(begun_)) group->end_local_step();
  }

  std::span<ConstraintGroup* const> groups_;
  std::size_t begun_ = 0;
};

/// The larger one; NaN when one is NaN, so that no tolerance is ever reached with it.
Real larger(Real a, Real b) {
  return a > b || std::isnan(a) ? a : b;
}

}  // namespace

/// Finds the partials of one chunk after the other.
class LocalStep::Layout {
 public:
  Layout(LocalStep& step, Index vertex_count)
      : step_(step),
        entry_counts_(static_cast<std::size_t>(vertex_count), 0),
        after_last_group_(entry_counts_.size(), 0) {}

  void add(Chunk& chunk) {
    chunk.first_partial = step_.partial_ends_.size();
    chunk.first_entry = step_.entries_.size();
    chunk.first_coefficient = step_.coefficients_.size();
    if (chunk.is_linear) return add_rows(chunk);
    chunk.coefficients = Coefficients::ones;
    touched_.clear();
    for_each_entry(chunk, [&](Index vertex, std::size_t, Real coefficient) {
      if (entry_counts_[static_cast<std::size_t>(vertex)]++ == 0) touched_.push_back(vertex);
      const auto one = coefficient == 1 ? Coefficients::ones : Coefficients::signs;
      chunk.coefficients = std::max(chunk.coefficients, std::abs(coefficient) == 1 ? one : Coefficients::any);
    });
    // By their number of entries, so that the loop over those ends where it is foreseen to.
    std::ranges::sort(touched_, {}, [&](Index vertex) { return std::pair(entry_counts_[at(vertex)], vertex); });
    place_entries(chunk);
    for (const Index vertex : touched_) {
      entry_counts_[static_cast<std::size_t>(vertex)] = 0;
      std::size_t& after = after_last_group_[static_cast<std::size_t>(vertex)];
      vertices_met_ += after != chunk.group + 1;
      after = chunk.group + 1;
    }
    partial_vertices_.insert(partial_vertices_.end(), touched_.begin(), touched_.end());
    partials_met_ += touched_.size();
    chunk.last_partial = step_.partial_ends_.size();
  }
  std::span<const Index> partial_vertices() const { return partial_vertices_; }
  Real chunks_of_vertex() const {
    return vertices_met_ == 0 ? 0 : static_cast<Real>(partials_met_) / static_cast<Real>(vertices_met_);
  }

 private:
  void add_rows(Chunk& chunk) {
    for (Index row = chunk.begin; row < chunk.end; ++row) partial_vertices_.push_back(step_.linear_.vertex(at(row)));
    step_.partial_ends_.resize(partial_vertices_.size(), 0);
    chunk.last_partial = step_.partial_ends_.size();
  }
  template <class Visit>
  void for_each_entry(const Chunk& chunk, Visit&& visit) const {
    const ConstraintGroup& group = *step_.groups_[chunk.group];
    const auto n = static_cast<std::size_t>(group.shape().vertices);
    const auto rows = static_cast<std::size_t>(group.shape().rows);
    const auto first = static_cast<std::size_t>(chunk.begin);
    const auto count = static_cast<std::size_t>(chunk.end - chunk.begin);
    const std::span<const Index> stencil = group.stencil().subspan(first * n, count * n);
    const std::span<const Real> reduction = group.reduction().subspan(first * n * rows, count * n * rows);
    if (takes_forces(group)) {
      for (std::size_t place = 0; place < stencil.size(); ++place) visit(stencil[place], place, 1);
      return;
    }
    for (std::size_t place = 0; place < reduction.size(); ++place) {
      const std::size_t slot = place / n;
      if (reduction[place] != 0) visit(stencil[slot / rows * n + place % n], slot, reduction[place]);
    }
  }

  void place_entries(const Chunk& chunk) {
    std::uint32_t end = 0;
    for (const Index vertex : touched_) {
      std::uint32_t& count = entry_counts_[static_cast<std::size_t>(vertex)];
      const std::uint32_t begin = end;
      end += count;
      count = begin;  // from now on the place of its next entry
      step_.partial_ends_.push_back(end);
    }
    step_.entries_.resize(chunk.first_entry + end);
    const bool are_written = chunk.coefficients == Coefficients::any;
    if (are_written) step_.coefficients_.resize(chunk.first_coefficient + end);
    for_each_entry(chunk, [&](Index vertex, std::size_t slot, Real coefficient) {
      const std::size_t place = entry_counts_[static_cast<std::size_t>(vertex)]++;
      const bool is_negative = !are_written && coefficient < 0;
      step_.entries_[chunk.first_entry + place] = static_cast<std::uint16_t>(2 * slot + is_negative);
      if (are_written) step_.coefficients_[chunk.first_coefficient + place] = coefficient;
    });
  }

  LocalStep& step_;
  std::vector<std::uint32_t> entry_counts_;  // of each vertex in the chunk at hand; then, where the next one goes
  std::vector<Index> touched_;
  std::vector<std::size_t> after_last_group_;  // that met each vertex; 0: none
  std::size_t vertices_met_ = 0;               // by all groups together, linear ones apart
  std::size_t partials_met_ = 0;               // the same, by their chunks
  std::vector<Index> partial_vertices_;
};

void LocalStep::set_groups(Index vertex_count, std::span<ConstraintGroup* const> groups) {
  groups_.assign(groups.begin(), groups.end());
  is_rounding_known_ = false;
  lay_out_chunks(vertex_count);
  partial_ends_.clear();
  entries_.clear();
  coefficients_.clear();
  Layout layout(*this, vertex_count);
  for (Chunk& chunk : chunks_) layout.add(chunk);
  chunks_of_vertex_ = layout.chunks_of_vertex();
  lay_out_vertices(vertex_count, layout.partial_vertices());
}

void LocalStep::lay_out_chunks(Index vertex_count) {
  linear_.clear();
  slot_count_ = 0;
  for (const ConstraintGroup* group : groups_) {
    slot_count_ += static_cast<std::size_t>(group->shape().count) * slots_of(*group);
  }
  const std::size_t wanted = std::clamp(slot_count_ / chunks_wanted, fewest_chunk_slots, most_chunk_slots);
  chunks_.clear();
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const GroupShape shape = groups_[g]->shape();
    if (groups_[g]->is_linear()) {
      const LinearForces::Rows rows = linear_.add(*groups_[g], vertex_count);
      lay_out_linear(g, rows);
      if (rows.are_worth_it) continue;
    }
    auto count = static_cast<Index>(std::max<std::size_t>(1, wanted / slots_of(*groups_[g])));
    if (count > constraints_together) count -= count % constraints_together;
    for (Index begin = 0; begin < shape.count; begin += count) {
      chunks_.push_back({.group = g, .begin = begin, .end = std::min(shape.count, begin + count)});
    }
  }
  chunk_energies_.assign(chunks_.size(), 0);
}

void LocalStep::lay_out_linear(std::size_t group, LinearForces::Rows rows) {
  const auto last = static_cast<Index>(rows.end);
  for (auto begin = static_cast<Index>(rows.begin); begin < last; begin += rows_per_chunk) {
    chunks_.push_back(
        {.group = group, .begin = begin, .end = std::min(last, begin + rows_per_chunk), .is_linear = true});
  }
}

void LocalStep::lay_out_vertices(Index vertex_count, std::span<const Index> partial_vertices) {
  if (partial_vertices.size() > std::numeric_limits<std::uint32_t>::max()) {
    fail_input("the constraints touch more than 2^32 - 1 vertices; use a coarser mesh");
  }
  partials_.assign(3 * partial_vertices.size() + read_after_last, 0);
  vertex_offsets_.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for (const Index vertex : partial_vertices) ++vertex_offsets_[static_cast<std::size_t>(vertex) + 1];
  for (std::size_t i = 1; i < vertex_offsets_.size(); ++i) vertex_offsets_[i] += vertex_offsets_[i - 1];
  vertex_partials_.resize(partial_vertices.size());
  std::vector<std::size_t> next(vertex_offsets_.begin(), vertex_offsets_.end() - 1);
  for (std::size_t i = 0; i < partial_vertices.size(); ++i) {
    vertex_partials_[next[static_cast<std::size_t>(partial_vertices[i])]++] = static_cast<std::uint32_t>(i);
  }
  vertex_sums_.resize(static_cast<std::size_t>((vertex_count + vertices_per_chunk - 1) / vertices_per_chunk));
}

LocalResult LocalStep::run(const Positions& q, const Positions& s, std::span<const Real> inertia_weights,
                           std::span<const char> is_pinned, Positions& r, ThreadPool& threads) {
  LocalResult result;
  const Stopwatch projections;
  slots_.resize(static_cast<std::size_t>(threads.thread_count()));
  for (std::vector<Real>& slots : slots_) slots.resize(3 * most_chunk_slots + read_after_last);
  {
    const OpenLocalStep open(groups_, q);
    threads.parallel_for(static_cast<Index>(chunks_.size()), [&](Index i, int thread) {
      const auto chunk = static_cast<std::size_t>(i);
      chunk_energies_[chunk] = project(chunks_[chunk], q, slots_[static_cast<std::size_t>(thread)]);
    });
  }
  still_linear();
  result.seconds_projections = projections.seconds();
  const auto vertex_count = static_cast<std::size_t>(q.rows());
  const GatheredVertices vertices{.sums = partials_.data(),
                                  .offsets = vertex_offsets_.data(),
                                  .places = vertex_partials_.data(),
                                  .q = q.data(),
                                  .s = s.data(),
                                  .weights = inertia_weights.data(),
                                  .is_pinned = is_pinned.data(),
                                  .r = r.data(),
                                  .begin = 0,
                                  .end = 0};
  threads.parallel_for(static_cast<Index>(vertex_sums_.size()), [&](Index i) {
    const auto chunk = static_cast<std::size_t>(i);
    GatheredVertices these = vertices;
    these.begin = chunk * vertices_per_chunk;
    these.end = std::min(vertex_count, these.begin + vertices_per_chunk);
    vertex_sums_[chunk] = fastest_kernels().gather(these);
  });
  for (const Real energy : chunk_energies_) result.elastic += energy;
  if (result.elastic < 0) result.elastic = 0;  // by rounding, of linear forces
  for (const GatheredSums& sums : vertex_sums_) {
    result.inertia += sums.inertia;
    result.residual = larger(result.residual, sums.squared_residual);
  }
  result.residual = std::sqrt(result.residual);
  if (!is_rounding_known_) rounding_ = find_rounding(q);
  is_rounding_known_ = true;
  result.rounding = rounding_;
  return result;
}

/// Takes away the linear forces of groups that have none but what rounding makes.
void LocalStep::still_linear() {
  for (std::size_t first = 0, last; first < chunks_.size(); first = last) {
    bool is_rounding = chunks_[first].is_linear;
    for (last = first; last < chunks_.size() && chunks_[last].group == chunks_[first].group; ++last) {
      is_rounding = is_rounding && chunks_[last].is_rounding;
    }
    for (std::size_t c = first; c < last; ++c) chunks_[c].is_rounding = is_rounding;
    if (!is_rounding) continue;
    const std::size_t begin = chunks_[first].first_partial, end = chunks_[last - 1].last_partial;
    std::fill_n(partials_.data() + 3 * begin, 3 * (end - begin), Real(0));
    std::fill_n(chunk_energies_.data() + first, last - first, Real(0));
  }
}

Real LocalStep::find_rounding(const Positions& q) const {
  Real magnitude = 0;
  for (const Chunk& chunk : chunks_) {
    if (!chunk.is_linear) continue;
    magnitude += linear_.magnitude(groups_[chunk.group]->stiffness(), q, at(chunk.begin), at(chunk.end));
  }
  return 4 * std::numeric_limits<Real>::epsilon() * magnitude;
}

Real LocalStep::project(Chunk& chunk, const Positions& q, std::vector<Real>& slots) {
  const ConstraintGroup& group = *groups_[chunk.group];
  if (chunk.is_linear) {
    Real* const out = partials_.data() + 3 * chunk.first_partial;
    const LinearForces::Found found = linear_.run(group.stiffness(), q, at(chunk.begin), at(chunk.end), out);
    chunk.is_rounding = found.is_rounding;
    return found.energy;
  }
  const Real energy = project_to_slots(group, q, slots, chunk.begin, chunk.end);
  collect(chunk, slots.data());
  return energy;
}

void LocalStep::collect(const Chunk& chunk, const Real* slots) {
  const CollectedVertices vertices{.slots = slots,
                                   .entries = entries_.data() + chunk.first_entry,
                                   .coefficients = coefficients_.data() + chunk.first_coefficient,
                                   .ends = partial_ends_.data() + chunk.first_partial,
                                   .count = chunk.last_partial - chunk.first_partial,
                                   .sums = partials_.data() + 3 * chunk.first_partial};
  switch (chunk.coefficients) {
    case Coefficients::ones:
      return fastest_kernels().collect_ones(vertices);
    case Coefficients::signs:
      return fastest_kernels().collect_signs(vertices);
    case Coefficients::any:
      return fastest_kernels().collect_any(vertices);
  }
}

Index LocalStep::component_of(const Chunk& chunk, Index item) const {
  const Index vertex = chunk.is_linear ? linear_.vertex(at(item)) : stencil_of(*groups_[chunk.group], at(item)).front();
  return component_of_vertex_[at(vertex)];
}

void LocalStep::set_components(std::span<const Index> component_of_vertex) {
  component_of_vertex_ = component_of_vertex;
  for (Chunk& chunk : chunks_) {
    chunk.component = component_of(chunk, chunk.begin);
    for (Index i = chunk.begin; i < chunk.end && chunk.component != mixed; ++i) {
      if (component_of(chunk, i) != chunk.component) chunk.component = mixed;
    }
  }
}

void LocalStep::elastic_energies(const Positions& q, std::span<Real> of_components) {
  std::ranges::fill(of_components, Real(0));
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    const Chunk& chunk = chunks_[c];
    ConstraintGroup& group = *groups_[chunk.group];
    if (group.works_from_outside() || chunk.is_rounding) continue;
    if (chunk.component != mixed) {
      of_components[static_cast<std::size_t>(chunk.component)] += chunk_energies_[c];
      continue;
    }
    for (Index begin = chunk.begin, end = begin; begin < chunk.end; begin = end) {
      const Index component = component_of(chunk, begin);
      while (end < chunk.end && component_of(chunk, end) == component) ++end;
      Real* const slots = slots_.front().data();
      of_components[at(component)] += chunk.is_linear
                                          ? linear_.run(group.stiffness(), q, at(begin), at(end), slots).energy
                                          : project_to_slots(group, q, slots_.front(), begin, end);
    }
  }
}

Real LocalStep::elastic_energy(std::size_t group) const {
  Real energy = 0;
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    if (chunks_[i].group == group) energy += chunk_energies_[i];
  }
  return energy < 0 ? 0 : energy;
}

void LocalStep::describe(SystemInfo& info) const {
  const auto bytes = [](const auto& list) { return static_cast<std::int64_t>(std::span(list).size_bytes()); };
  info.local_list_bytes =
      bytes(entries_) + bytes(coefficients_) + bytes(partial_ends_) + static_cast<std::int64_t>(linear_.bytes());
  info.partial_bytes = bytes(partials_);
  info.partial_list_bytes = bytes(vertex_offsets_) + bytes(vertex_partials_);
}

Index LocalStep::first_not_finite(std::size_t group, const Positions& q) const {
  const ConstraintGroup& constraints = *groups_[group];
  const GroupShape shape = constraints.shape();
  std::vector<Real> slot(static_cast<std::size_t>(3 * shape.rows));
  const auto is_finite = [&](Index vertex) { return q.row(vertex).allFinite(); };
  for (Index i = 0; i < shape.count; ++i) {
    if (!std::ranges::all_of(stencil_of(constraints, at(i)), is_finite)) continue;
    constraints.project(q, slot, i, i + 1);
    if (!std::ranges::all_of(slot, [](Real x) { return std::isfinite(x); })) return i;
  }
  return -1;
}

}  // namespace pliant
