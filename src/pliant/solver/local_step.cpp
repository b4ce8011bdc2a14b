#include "pliant/solver/local_step.h"

#include <algorithm>
#include <cmath>

#include "pliant/core/error.h"
#include "pliant/core/stopwatch.h"

namespace pliant {
namespace {

// Large enough to hide the cost of handing out work, small enough for what a chunk reads and writes to stay in the
// second-level cache: about 200 kB for tetrahedra.
constexpr Index constraints_per_chunk = 1024;
constexpr Index vertices_per_chunk = 1024;

/// The larger one; NaN when one is NaN, so that no tolerance is ever reached with it.
Real larger(Real a, Real b) {
  return a > b || std::isnan(a) ? a : b;
}

}  // namespace

void LocalStep::set_groups(Index vertex_count, std::span<ConstraintGroup* const> groups) {
  lay_out_slots(groups);
  lay_out_gathers(vertex_count);
}

void LocalStep::lay_out_slots(std::span<ConstraintGroup* const> groups) {
  groups_.assign(groups.begin(), groups.end());
  group_slots_.clear();
  chunks_.clear();
  std::size_t slots = 0;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const GroupShape shape = groups_[g]->shape();
    const auto rows = static_cast<std::size_t>(shape.rows);
    group_slots_.push_back(slots);
    for (Index begin = 0; begin < shape.count; begin += constraints_per_chunk) {
      const Index end = std::min(shape.count, begin + constraints_per_chunk);
      chunks_.push_back({g, begin, end, slots + static_cast<std::size_t>(begin) * rows});
    }
    slots += static_cast<std::size_t>(shape.count) * rows;
  }
  if (slots > std::numeric_limits<std::uint32_t>::max()) {
    fail_input("the constraints have more than 2^32 - 1 rows; use a coarser mesh");
  }
  slots_.assign(3 * slots, 0);
  chunk_energies_.assign(chunks_.size(), 0);
}

void LocalStep::lay_out_gathers(Index vertex_count) {
  const auto for_each_entry = [this](auto&& visit) {
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      const auto n = static_cast<std::size_t>(groups_[g]->shape().vertices);
      const auto rows = static_cast<std::size_t>(groups_[g]->shape().rows);
      const std::span<const Index> stencil = groups_[g]->stencil();
      const std::span<const Real> reduction = groups_[g]->reduction();
      for (std::size_t place = 0; place < reduction.size(); ++place) {
        const std::size_t row = place / n;  // within the group
        if (reduction[place] != 0) visit(stencil[row / rows * n + place % n], group_slots_[g] + row, reduction[place]);
      }
    }
  };
  gather_offsets_.assign(static_cast<std::size_t>(vertex_count) + 1, 0);
  for_each_entry([this](Index vertex, std::size_t, Real) { ++gather_offsets_[static_cast<std::size_t>(vertex) + 1]; });
  for (std::size_t i = 1; i < gather_offsets_.size(); ++i) gather_offsets_[i] += gather_offsets_[i - 1];
  gather_slots_.resize(gather_offsets_.back());
  gather_coefficients_.resize(gather_offsets_.back());
  std::vector<std::size_t> next(gather_offsets_.begin(), gather_offsets_.end() - 1);
  for_each_entry([&](Index vertex, std::size_t slot, Real coefficient) {
    const std::size_t place = next[static_cast<std::size_t>(vertex)]++;
    gather_slots_[place] = static_cast<std::uint32_t>(slot);
    gather_coefficients_[place] = coefficient;
  });
  vertex_sums_.resize(static_cast<std::size_t>((vertex_count + vertices_per_chunk - 1) / vertices_per_chunk));
}

LocalResult LocalStep::run(const Positions& q, const Positions& s, std::span<const Real> inertia_weights,
                           std::span<const char> is_held, Positions& r, ThreadPool& threads) {
  LocalResult result;
  const Stopwatch projections;
  threads.parallel_for(static_cast<Index>(chunks_.size()), [&](Index i) {
    const Chunk& chunk = chunks_[static_cast<std::size_t>(i)];
    chunk_energies_[static_cast<std::size_t>(i)] =
        groups_[chunk.group]->project(q, std::span<Real>(slots_).subspan(3 * chunk.first_slot), chunk.begin, chunk.end);
  });
  result.seconds_projections = projections.seconds();
  const auto vertex_count = static_cast<Index>(q.rows());
  threads.parallel_for(static_cast<Index>(vertex_sums_.size()), [&](Index i) {
    const Index begin = i * vertices_per_chunk;
    const Index end = std::min(vertex_count, begin + vertices_per_chunk);
    vertex_sums_[static_cast<std::size_t>(i)] = gather(begin, end, q, s, inertia_weights, is_held, r);
  });
  for (const Real energy : chunk_energies_) result.elastic += energy;
  for (const VertexSums& sums : vertex_sums_) {
    result.inertia += sums.inertia;
    result.residual = larger(result.residual, sums.squared_residual);
  }
  result.residual = std::sqrt(result.residual);
  return result;
}

LocalStep::VertexSums LocalStep::gather(Index begin, Index end, const Positions& q, const Positions& s,
                                        std::span<const Real> inertia_weights, std::span<const char> is_held,
                                        Positions& r) const {
  VertexSums sums;
  for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
    Real* out = r.data() + 3 * i;
    if (is_held[i]) {
      std::fill_n(out, 3, Real(0));
      continue;
    }
    Real x = 0, y = 0, z = 0;
    for (std::size_t entry = gather_offsets_[i]; entry < gather_offsets_[i + 1]; ++entry) {
      const Real* slot = slots_.data() + 3 * static_cast<std::size_t>(gather_slots_[entry]);
      const Real coefficient = gather_coefficients_[entry];
      x += coefficient * slot[0];
      y += coefficient * slot[1];
      z += coefficient * slot[2];
    }
    const Real* from = q.data() + 3 * i;
    const Real* to = s.data() + 3 * i;
    const Real weight = inertia_weights[i];
    const Real dx = to[0] - from[0], dy = to[1] - from[1], dz = to[2] - from[2];
    sums.inertia += weight / 2 * (dx * dx + dy * dy + dz * dz);
    out[0] = x + weight * dx;
    out[1] = y + weight * dy;
    out[2] = z + weight * dz;
    sums.squared_residual = larger(sums.squared_residual, out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
  }
  return sums;
}

Real LocalStep::elastic_energy(std::size_t group) const {
  Real energy = 0;
  for (std::size_t i = 0; i < chunks_.size(); ++i) {
    if (chunks_[i].group == group) energy += chunk_energies_[i];
  }
  return energy;
}

Index LocalStep::first_not_finite(std::size_t group) const {
  const GroupShape shape = groups_[group]->shape();
  const auto size = static_cast<std::size_t>(3 * shape.rows);
  for (std::size_t i = 0; i < static_cast<std::size_t>(shape.count); ++i) {
    const std::span<const Real> slot = std::span<const Real>(slots_).subspan(3 * group_slots_[group] + i * size, size);
    if (!std::ranges::all_of(slot, [](Real x) { return std::isfinite(x); })) return static_cast<Index>(i);
  }
  return -1;
}

}  // namespace pliant
