#include "pliant/solver/passing_groups.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "pliant/solver/constraint_rows.h"

namespace pliant {

namespace {

std::vector<Index> in_order(Index count) {
  std::vector<Index> numbers(at(count));
  std::iota(numbers.begin(), numbers.end(), 0);
  return numbers;
}

/// Whether it is what it says it is. Copies in another order are asked for later.
bool may_pass(ConstraintGroup& group, Index vertex_count) {
  if (group.targets().empty()) return false;
  return group.is_external() && group.reordered(in_order(group.shape().count), in_order(vertex_count)) != nullptr;
}

}  // namespace

std::int64_t rows_beside_factor(const ConstraintGroup& group) {
  const GroupShape shape = group.shape();
  return std::int64_t{shape.count} * shape.rows + static_cast<std::int64_t>(group.pinned_vertices().size());
}

std::vector<ConstraintGroup*> PassingGroups::take_out_of(std::vector<ConstraintGroup*>& groups, Index vertex_count) {
  std::vector<ConstraintGroup*> taken;
  std::int64_t room_for_drags = most_rows_of_drags, room_for_pins = most_rows_of_pins;
  std::erase_if(groups, [&](ConstraintGroup* group) {
    if (!group->is_beside_factor()) return false;
    std::int64_t& room = group->comes_and_goes() ? room_for_drags : room_for_pins;
    const std::int64_t rows = rows_beside_factor(*group);
    if (rows > room || !may_pass(*group, vertex_count)) return false;
    room -= rows;
    taken.push_back(group);
    return true;
  });
  return taken;
}

void PassingGroups::set(std::vector<ConstraintGroup*> groups, const LocalGroups& order) {
  groups_ = std::move(groups);
  in_use_ = groups_;
  copies_.clear();
  same_order_.clear();
  energies_.assign(groups_.size(), 0);
  if (!order.is_reordered()) return;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    same_order_.push_back(in_order(groups_[g]->shape().count));
    copies_.push_back(groups_[g]->reordered(same_order_.back(), order.numbers()));
    in_use_[g] = copies_[g].get();
  }
}

void PassingGroups::sync_parameters() {
  for (std::size_t g = 0; g < copies_.size(); ++g) copies_[g]->sync_parameters(*groups_[g], same_order_[g]);
}

bool PassingGroups::has_forces() const {
  return std::ranges::any_of(groups_, [](const ConstraintGroup* group) { return group->shape().count > 0; });
}

Real PassingGroups::add_forces(const Positions& q, std::span<const char> is_pinned, Positions& forces) {
  Real energy = 0;
  for (std::size_t g = 0; g < in_use_.size(); ++g) {
    const ConstraintGroup& group = *in_use_[g];
    const auto rows = static_cast<std::size_t>(group.shape().rows);
    slots_.resize(3 * rows);
    energies_[g] = 0;
    for (Index i = 0; i < group.shape().count; ++i) {
      energies_[g] += group.project(q, slots_, i, i + 1);
      const std::span<const Index> stencil = stencil_of(group, at(i));
      for (std::size_t r = 0; r < rows; ++r) {
        const Eigen::Map<const Vec3> slot(slots_.data() + 3 * r);
        const std::span<const Real> row = reduction_row(group, at(i), r);
        for (std::size_t a = 0; a < row.size(); ++a) {
          if (is_pinned[at(stencil[a])] == 0) forces.row(stencil[a]) += row[a] * slot.transpose();
        }
      }
    }
    energy += energies_[g];
  }
  return energy;
}

std::optional<PassingGroups::Place> PassingGroups::first_not_finite(const Positions& q) const {
  std::vector<Real> slots;
  for (std::size_t g = 0; g < in_use_.size(); ++g) {
    slots.resize(3 * static_cast<std::size_t>(in_use_[g]->shape().rows));
    for (Index i = 0; i < in_use_[g]->shape().count; ++i) {
      const std::span<const Index> stencil = stencil_of(*in_use_[g], at(i));
      if (!std::ranges::all_of(stencil, [&](Index v) { return q.row(v).allFinite(); })) continue;
      in_use_[g]->project(q, slots, i, i + 1);
      if (!std::ranges::all_of(slots, [](Real each) { return std::isfinite(each); })) return Place{g, i};
    }
  }
  return std::nullopt;
}

Real PassingGroups::elastic_energy(const ConstraintGroup& group) const {
  const auto found = std::ranges::find(groups_, &group);
  return found == groups_.end() ? 0 : energies_[static_cast<std::size_t>(found - groups_.begin())];
}

const FactorRows& PassingGroups::rows(std::span<const char> is_pinned) {
  rows_.clear();
  for (const ConstraintGroup* group : in_use_) {
    for (const Index vertex : group->pinned_vertices()) rows_.hold(vertex);
    for (std::size_t i = 0; i < at(group->shape().count); ++i) {
      const std::span<const Index> stencil = stencil_of(*group, i);
      for (std::size_t r = 0; r < static_cast<std::size_t>(group->shape().rows); ++r) {
        const std::span<const Real> row = reduction_row(*group, i, r);
        vertices_.clear();
        coefficients_.clear();
        for (std::size_t a = 0; a < row.size(); ++a) {
          if (is_pinned[at(stencil[a])] != 0 || row[a] == 0) continue;
          vertices_.push_back(stencil[a]);
          coefficients_.push_back(row[a]);
        }
        rows_.add(vertices_, coefficients_, group->stiffness() * group->rest_measure()[i]);
      }
    }
  }
  return rows_;
}

}  // namespace pliant
