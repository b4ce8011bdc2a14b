#include "pliant/solver/local/group_layout.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace pliant {
namespace {

constexpr Index rows_per_chunk = 512;       // of linear forces
constexpr Index constraints_together = 64;  // that kernels take at once

/// Calls visit(vertex, slot of the chunk, coefficient) for all that is collected.
template <class Visit>
void for_each_collected(const GroupLayout::Chunk& chunk, const ConstraintGroup& group, Visit&& visit) {
  const auto n = static_cast<std::size_t>(group.shape().vertices);
  const auto rows = static_cast<std::size_t>(group.shape().rows);
  const std::size_t first = at(chunk.begin), count = at(chunk.end - chunk.begin);
  const std::span<const Index> stencil = group.stencil().subspan(first * n, count * n);
  if (takes_forces(group)) {
    for (std::size_t place = 0; place < stencil.size(); ++place) visit(stencil[place], place, Real(1));
    return;
  }
  const std::span<const Real> reduction = group.reduction().subspan(first * n * rows, count * n * rows);
  for (std::size_t place = 0; place < reduction.size(); ++place) {
    const std::size_t slot = place / n;
    if (reduction[place] != 0) visit(stencil[slot / rows * n + place % n], slot, reduction[place]);
  }
}

}  // namespace

std::size_t slots_of(const ConstraintGroup& group) {
  return static_cast<std::size_t>(takes_forces(group) ? group.shape().vertices : group.shape().rows);
}

GroupLayout::GroupLayout(const ConstraintGroup& group, std::size_t chunk_slots, Scratch& scratch)
    : revision_(group.revision()), chunk_size_(constraints_in_chunk(group, chunk_slots)) {
  const auto vertex_count = static_cast<Index>(scratch.entry_counts.size());
  if (group.is_linear() && linear_.add(group, vertex_count).are_worth_it) {
    lay_out_rows();
    return;
  }
  linear_ = {};
  const Index count = group.shape().count;
  for (Index begin = 0; begin < count; begin += chunk_size_) {
    chunks_.push_back({.begin = begin, .end = std::min(count, begin + chunk_size_)});
    lay_out(chunks_.back(), group, scratch);
  }
  for (const Index vertex : partial_vertices_) vertices_met_ += std::exchange(scratch.is_met[at(vertex)], 1) == 0;
  for (const Index vertex : partial_vertices_) scratch.is_met[at(vertex)] = 0;
}

bool GroupLayout::is_of(const ConstraintGroup& group, std::size_t chunk_slots) const {
  return group.revision() == revision_ && (is_linear_ || constraints_in_chunk(group, chunk_slots) == chunk_size_);
}

Index GroupLayout::constraints_in_chunk(const ConstraintGroup& group, std::size_t chunk_slots) {
  const auto count = static_cast<Index>(std::max<std::size_t>(1, chunk_slots / slots_of(group)));
  return count > constraints_together ? count - count % constraints_together : count;
}

void GroupLayout::lay_out_rows() {
  is_linear_ = true;
  partial_vertices_.assign(linear_.vertices().begin(), linear_.vertices().end());
  const auto last = static_cast<Index>(partial_vertices_.size());
  for (Index begin = 0; begin < last; begin += rows_per_chunk) {
    const Index end = std::min(last, begin + rows_per_chunk);
    chunks_.push_back({.begin = begin, .end = end, .first_partial = at(begin), .last_partial = at(end)});
  }
}

void GroupLayout::lay_out(Chunk& chunk, const ConstraintGroup& group, Scratch& scratch) {
  chunk.first_partial = partial_ends_.size();
  chunk.first_entry = entries_.size();
  chunk.first_coefficient = coefficients_.size();
  chunk.coefficients = Coefficients::ones;
  std::vector<std::uint32_t>& entry_counts = scratch.entry_counts;
  for_each_collected(chunk, group, [&](Index vertex, std::size_t, Real coefficient) {
    if (entry_counts[at(vertex)]++ == 0) partial_vertices_.push_back(vertex);
    const auto one = coefficient == 1 ? Coefficients::ones : Coefficients::signs;
    chunk.coefficients = std::max(chunk.coefficients, std::abs(coefficient) == 1 ? one : Coefficients::any);
  });
  const std::span<Index> touched = std::span(partial_vertices_).subspan(chunk.first_partial);
  // By their number of entries, so that the loop over those ends where it is foreseen to.
  std::ranges::sort(touched, {}, [&](Index vertex) { return std::pair(entry_counts[at(vertex)], vertex); });
  place_entries(chunk, group, touched, scratch);
  for (const Index vertex : touched) entry_counts[at(vertex)] = 0;
  chunk.last_partial = partial_ends_.size();
}

void GroupLayout::place_entries(const Chunk& chunk, const ConstraintGroup& group, std::span<const Index> touched,
                                Scratch& scratch) {
  std::uint32_t end = 0;
  for (const Index vertex : touched) {
    const std::uint32_t begin = end;
    end += scratch.entry_counts[at(vertex)];
    scratch.entry_counts[at(vertex)] = begin;  // from now on the place of its next entry
    partial_ends_.push_back(end);
  }
  entries_.resize(chunk.first_entry + end);
  const bool are_written = chunk.coefficients == Coefficients::any;
  if (are_written) coefficients_.resize(chunk.first_coefficient + end);
  for_each_collected(chunk, group, [&](Index vertex, std::size_t slot, Real coefficient) {
    const std::size_t place = scratch.entry_counts[at(vertex)]++;
    const bool is_negative = !are_written && coefficient < 0;
    entries_[chunk.first_entry + place] = static_cast<std::uint16_t>(2 * slot + is_negative);
    if (are_written) coefficients_[chunk.first_coefficient + place] = coefficient;
  });
}

void GroupLayout::collect(const Chunk& chunk, const Real* slots, Real* sums) const {
  const CollectedVertices vertices{.slots = slots,
                                   .entries = entries_.data() + chunk.first_entry,
                                   .coefficients = coefficients_.data() + chunk.first_coefficient,
                                   .ends = partial_ends_.data() + chunk.first_partial,
                                   .count = chunk.last_partial - chunk.first_partial,
                                   .sums = sums};
  switch (chunk.coefficients) {
    case Coefficients::ones:
      return fastest_kernels().collect_ones(vertices);
    case Coefficients::signs:
      return fastest_kernels().collect_signs(vertices);
    case Coefficients::any:
      return fastest_kernels().collect_any(vertices);
  }
}

std::size_t GroupLayout::bytes() const {
  if (is_linear_) return linear_.bytes();
  return std::span(entries_).size_bytes() + std::span(coefficients_).size_bytes() +
         std::span(partial_ends_).size_bytes();
}

}  // namespace pliant
