#include "pliant/solver/global/system_matrix.h"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

#include "pliant/core/error.h"

namespace pliant {
namespace {

/// Calls visit(row, column, a, b) for every pair of different stencil places with row > column.
template <class Visit>
void for_each_pair(std::span<const Index> stencil, std::size_t n, Visit&& visit) {
  for (std::size_t first = 0; first + n <= stencil.size(); first += n) {
    for (std::size_t a = 1; a < n; ++a) {
      for (std::size_t b = 0; b < a; ++b) {
        const Index u = stencil[first + a];
        const Index v = stencil[first + b];
        visit(std::max(u, v), std::min(u, v), first / n, a, b);
      }
    }
  }
}

}  // namespace

bool SystemMatrix::set_groups(Index vertex_count, std::span<const ConstraintGroup* const> groups) {
  std::unordered_map<std::uint64_t, UnitMatrix> before;
  std::vector<UnitMatrix> units = std::exchange(units_, {});  // none stays where this fails
  const bool may_keep = matrix_.size() == vertex_count;
  for (UnitMatrix& unit : units) {
    if (may_keep) before.try_emplace(unit.revision, std::move(unit));
  }
  units.assign(groups.size(), {});
  bool has_all_pairs = may_keep;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (const auto found = before.find(groups[g]->revision()); found != before.end()) {
      units[g] = std::move(found->second);
      before.erase(found);
    } else {
      has_all_pairs = has_all_pairs && has_pairs_of(*groups[g]);
    }
  }
  if (has_all_pairs) {
    find_units(groups, units);
    if (is_all_used(units)) {
      units_ = std::move(units);
      return false;
    }
  }
  const LowerMatrix old = std::exchange(matrix_, find_pattern(vertex_count, groups));
  if (may_keep) move_units(units, old);
  find_units(groups, units);
  units_ = std::move(units);
  return matrix_.rows != old.rows || matrix_.column_starts != old.column_starts;
}

/// Those that did not stay.
void SystemMatrix::find_units(std::span<const ConstraintGroup* const> groups, std::span<UnitMatrix> units) const {
  std::vector<Real> sums(matrix_.rows.size(), 0);
  std::vector<char> touched(matrix_.rows.size(), 0);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (units[g].revision != groups[g]->revision()) units[g] = unit_matrix(*groups[g], sums, touched);
  }
}

bool SystemMatrix::has_pairs_of(const ConstraintGroup& group) const {
  bool has_all = true;
  for_each_pair(group.stencil(), static_cast<std::size_t>(group.shape().vertices),
                [&](Index row, Index column, auto...) { has_all = has_all && place(row, column) != none; });
  return has_all;
}

/// Whether each entry but the diagonal is one of a group.
bool SystemMatrix::is_all_used(std::span<const UnitMatrix> units) const {
  std::vector<char> is_used(matrix_.rows.size(), 0);
  for (const Index diagonal : std::span(matrix_.column_starts).first(at(matrix_.size()))) is_used[at(diagonal)] = 1;
  for (const UnitMatrix& unit : units) {
    for (const Index where : unit.places) is_used[at(where)] = 1;
  }
  return std::ranges::all_of(is_used, [](char used) { return used != 0; });
}

/// From the pattern before, each of whose entries that a unit matrix has is in this one.
void SystemMatrix::move_units(std::span<UnitMatrix> units, const LowerMatrix& before) const {
  std::vector<Index> places(before.rows.size(), none);
  for_each_entry(before, [&](Index row, Index column, std::size_t e) { places[e] = place(row, column); });
  for (UnitMatrix& unit : units) {
    for (Index& where : unit.places) where = places[at(where)];
  }
}

LowerMatrix SystemMatrix::find_pattern(Index vertex_count, std::span<const ConstraintGroup* const> groups) {
  LowerMatrix matrix;
  // All pairs into buckets by column, then each bucket sorted and rid of what is double.
  std::vector<std::size_t> bucket_ends(at(vertex_count) + 1, 0);
  const auto for_all_pairs = [&](auto&& visit) {
    for (const ConstraintGroup* group : groups) {
      for_each_pair(group->stencil(), static_cast<std::size_t>(group->shape().vertices), visit);
    }
  };
  for_all_pairs([&](Index, Index column, auto...) { ++bucket_ends[at(column) + 1]; });
  for (std::size_t c = 1; c < bucket_ends.size(); ++c) bucket_ends[c] += bucket_ends[c - 1];
  std::vector<Index> entries(bucket_ends.back());
  std::vector<std::size_t> next(bucket_ends.begin(), bucket_ends.end() - 1);
  for_all_pairs([&](Index row, Index column, auto...) { entries[next[at(column)]++] = row; });

  matrix.column_starts.reserve(at(vertex_count) + 1);
  for (Index column = 0; column < vertex_count; ++column) {
    const auto begin = entries.begin() + static_cast<std::ptrdiff_t>(bucket_ends[at(column)]);
    const auto end = entries.begin() + static_cast<std::ptrdiff_t>(bucket_ends[at(column) + 1]);
    std::sort(begin, end);
    matrix.rows.push_back(column);
    matrix.rows.insert(matrix.rows.end(), begin, std::unique(begin, end));
    if (matrix.rows.size() > at(std::numeric_limits<Index>::max())) {
      fail_input("the system matrix has more than 2^31 - 1 entries; use a coarser mesh");
    }
    matrix.column_starts.push_back(static_cast<Index>(matrix.rows.size()));
  }
  matrix.values.assign(matrix.rows.size(), 0);
  return matrix;
}

Index SystemMatrix::place(Index row, Index column) const {
  const auto begin = matrix_.rows.begin() + matrix_.column_starts[at(column)];
  const auto end = matrix_.rows.begin() + matrix_.column_starts[at(column) + 1];
  const auto found = std::lower_bound(begin, end, row);
  return found != end && *found == row ? static_cast<Index>(found - matrix_.rows.begin()) : none;
}

SystemMatrix::UnitMatrix SystemMatrix::unit_matrix(const ConstraintGroup& group, std::vector<Real>& sums,
                                                   std::vector<char>& touched) const {
  const GroupShape shape = group.shape();
  const auto n = static_cast<std::size_t>(shape.vertices);
  const auto k = static_cast<std::size_t>(shape.rows);
  const std::span<const Real> reduction = group.reduction();
  const std::span<const Real> measure = group.rest_measure();
  UnitMatrix unit;
  unit.revision = group.revision();
  const auto add = [&](Index where, std::size_t i, std::size_t a, std::size_t b) {
    Real product = 0;
    for (std::size_t row = 0; row < k; ++row) {
      const Real* coefficients = &reduction[(i * k + row) * n];
      product += coefficients[a] * coefficients[b];
    }
    if (!touched[at(where)]) {
      touched[at(where)] = 1;
      unit.places.push_back(where);
    }
    sums[at(where)] += measure[i] * product;
  };
  const std::span<const Index> stencil = group.stencil();
  for (std::size_t s = 0; s < stencil.size(); ++s) add(matrix_.column_starts[at(stencil[s])], s / n, s % n, s % n);
  for_each_pair(stencil, n, [&](Index row, Index column, std::size_t i, std::size_t a, std::size_t b) {
    add(place(row, column), i, a, b);
  });
  unit.values.reserve(unit.places.size());
  for (const Index where : unit.places) {
    unit.values.push_back(std::exchange(sums[at(where)], 0));
    touched[at(where)] = 0;
  }
  return unit;
}

void SystemMatrix::assemble(std::span<const Real> masses, Real time_step,
                            std::span<const ConstraintGroup* const> groups, std::span<const char> is_pinned) {
  std::ranges::fill(matrix_.values, Real(0));
  const Index m = matrix_.size();
  for (Index i = 0; i < m; ++i) {
    matrix_.values[at(matrix_.column_starts[at(i)])] = masses[at(i)] / (time_step * time_step);
  }
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const UnitMatrix& unit = units_[g];
    const Real stiffness = groups[g]->factor_stiffness();
    for (std::size_t e = 0; e < unit.places.size(); ++e) {
      matrix_.values[at(unit.places[e])] += stiffness * unit.values[e];
    }
  }
  for_each_entry(matrix_, [&](Index row, Index column, std::size_t e) {
    if (row != column && (is_pinned[at(column)] || is_pinned[at(row)])) matrix_.values[e] = 0;
  });
}

void SystemMatrix::add_diagonal(std::span<const Real> diagonal) {
  for (std::size_t i = 0; i < diagonal.size(); ++i) matrix_.values[at(matrix_.column_starts[i])] += diagonal[i];
}

void SystemMatrix::copy_diagonal(std::vector<Real>& diagonal) const {
  diagonal.resize(at(matrix_.size()));
  for (std::size_t i = 0; i < diagonal.size(); ++i) diagonal[i] = matrix_.values[at(matrix_.column_starts[i])];
}

}  // namespace pliant
