#include "pliant/solver/local/local_step.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <unordered_map>
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

void LocalStep::set_groups(Index vertex_count, std::span<ConstraintGroup* const> groups) {
  groups_.assign(groups.begin(), groups.end());
  is_rounding_known_ = false;
  lay_out_groups(vertex_count);
  lay_out_chunks();
  lay_out_vertices(vertex_count);
}

void LocalStep::lay_out_groups(Index vertex_count) {
  slot_count_ = 0;
  for (const ConstraintGroup* group : groups_) {
    slot_count_ += static_cast<std::size_t>(group->shape().count) * slots_of(*group);
  }
  const std::size_t wanted = std::clamp(slot_count_ / chunks_wanted, fewest_chunk_slots, most_chunk_slots);
  std::unordered_map<std::uint64_t, std::unique_ptr<const GroupLayout>> before;
  for (auto& layout : std::exchange(layouts_, {})) before.emplace(layout->revision(), std::move(layout));
  GroupLayout::Scratch scratch(vertex_count);
  for (const ConstraintGroup* group : groups_) {
    const auto found = before.find(group->revision());
    if (found != before.end() && found->second && found->second->is_of(*group, wanted)) {
      layouts_.push_back(std::move(found->second));
    } else {
      layouts_.push_back(std::make_unique<const GroupLayout>(*group, wanted, scratch));
    }
  }
}

void LocalStep::lay_out_chunks() {
  chunks_.clear();
  std::size_t partials = 0, vertices_met = 0, partials_met = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const GroupLayout& layout = *layouts_[g];
    for (const GroupLayout::Chunk& part : layout.chunks()) {
      chunks_.push_back({.group = g, .layout = &layout, .part = part, .first_partial = partials + part.first_partial});
    }
    partials += layout.partial_vertices().size();
    vertices_met += layout.vertices_met();
    partials_met += layout.partials_met();
  }
  chunks_of_vertex_ = vertices_met == 0 ? 0 : static_cast<Real>(partials_met) / static_cast<Real>(vertices_met);
  chunk_energies_.assign(chunks_.size(), 0);
  if (partials > std::numeric_limits<std::uint32_t>::max()) {
    fail_input("the constraints touch more than 2^32 - 1 vertices; use a coarser mesh");
  }
  partials_.assign(3 * partials + read_after_last, 0);
  vertex_partials_.resize(partials);
}

void LocalStep::lay_out_vertices(Index vertex_count) {
  vertex_offsets_.assign(at(vertex_count) + 1, 0);
  for (const auto& layout : layouts_) {
    for (const Index vertex : layout->partial_vertices()) ++vertex_offsets_[at(vertex) + 1];
  }
  for (std::size_t i = 1; i < vertex_offsets_.size(); ++i) vertex_offsets_[i] += vertex_offsets_[i - 1];
  std::vector<std::size_t> next(vertex_offsets_.begin(), vertex_offsets_.end() - 1);
  std::uint32_t partial = 0;
  for (const auto& layout : layouts_) {
    for (const Index vertex : layout->partial_vertices()) vertex_partials_[next[at(vertex)]++] = partial++;
  }
  vertex_sums_.resize(at((vertex_count + vertices_per_chunk - 1) / vertices_per_chunk));
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
    const GroupLayout& layout = *chunks_[first].layout;
    last = first + layout.chunks().size();
    if (!layout.is_linear()) continue;
    const std::span<Chunk> chunks = std::span(chunks_).subspan(first, last - first);
    const bool is_rounding = std::ranges::all_of(chunks, &Chunk::is_rounding);
    for (Chunk& chunk : chunks) chunk.is_rounding = is_rounding;
    if (!is_rounding) continue;
    std::fill_n(partials_.data() + 3 * chunks.front().first_partial, 3 * layout.partial_vertices().size(), Real(0));
    std::fill_n(chunk_energies_.data() + first, chunks.size(), Real(0));
  }
}

Real LocalStep::find_rounding(const Positions& q) const {
  Real magnitude = 0;
  for (const Chunk& chunk : chunks_) {
    if (!chunk.layout->is_linear()) continue;
    const Real stiffness = groups_[chunk.group]->stiffness();
    magnitude += chunk.layout->linear().magnitude(stiffness, q, at(chunk.part.begin), at(chunk.part.end));
  }
  return 4 * std::numeric_limits<Real>::epsilon() * magnitude;
}

Real LocalStep::project(Chunk& chunk, const Positions& q, std::vector<Real>& slots) {
  const ConstraintGroup& group = *groups_[chunk.group];
  const auto [begin, end] = std::pair(chunk.part.begin, chunk.part.end);
  Real* const sums = partials_.data() + 3 * chunk.first_partial;
  if (chunk.layout->is_linear()) {
    const LinearForces::Found found = chunk.layout->linear().run(group.stiffness(), q, at(begin), at(end), sums);
    chunk.is_rounding = found.is_rounding;
    return found.energy;
  }
  const Real energy = project_to_slots(group, q, slots, begin, end);
  chunk.layout->collect(chunk.part, slots.data(), sums);
  return energy;
}

/// Of what stands side by side in a chunk, each with the vertices of one component: calls visit(begin, end, component)
/// until it returns false.
template <class Visit>
void LocalStep::for_each_run(const Chunk& chunk, Visit&& visit) const {
  const ConstraintGroup& group = *groups_[chunk.group];
  const bool is_linear = chunk.layout->is_linear();
  const std::span<const Index> vertices = is_linear ? chunk.layout->partial_vertices() : group.stencil();
  const std::size_t n = is_linear ? 1 : static_cast<std::size_t>(group.shape().vertices);
  const auto component = [&](Index item) { return component_of_vertex_[at(vertices[at(item) * n])]; };
  for (Index begin = chunk.part.begin, end = begin; begin < chunk.part.end; begin = end) {
    while (end < chunk.part.end && component(end) == component(begin)) ++end;
    if (!visit(begin, end, component(begin))) return;
  }
}

void LocalStep::set_components(std::span<const Index> component_of_vertex) {
  component_of_vertex_ = component_of_vertex;
  for (Chunk& chunk : chunks_) {
    for_each_run(chunk, [&](Index, Index end, Index component) {
      chunk.component = end == chunk.part.end ? component : mixed;
      return false;
    });
  }
}

void LocalStep::elastic_energies(const Positions& q, std::span<Real> of_components) {
  std::ranges::fill(of_components, Real(0));
  for (std::size_t c = 0; c < chunks_.size(); ++c) {
    const Chunk& chunk = chunks_[c];
    ConstraintGroup& group = *groups_[chunk.group];
    if (group.works_from_outside() || chunk.is_rounding) continue;
    if (chunk.component != mixed) {
      of_components[at(chunk.component)] += chunk_energies_[c];
      continue;
    }
    std::vector<Real>& slots = slots_.front();
    for_each_run(chunk, [&](Index begin, Index end, Index component) {
      of_components[at(component)] +=
          chunk.layout->is_linear()
              ? chunk.layout->linear().run(group.stiffness(), q, at(begin), at(end), slots.data()).energy
              : project_to_slots(group, q, slots, begin, end);
      return true;
    });
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
  info.local_list_bytes = 0;
  for (const auto& layout : layouts_) info.local_list_bytes += static_cast<std::int64_t>(layout->bytes());
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
