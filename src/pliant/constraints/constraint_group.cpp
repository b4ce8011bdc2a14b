#include "pliant/constraints/constraint_group.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {

std::uint64_t ConstraintGroup::next_revision() {
  static std::atomic<std::uint64_t> last = 0;
  return ++last;
}

void ConstraintGroup::begin_step(const StateView&, Real) {}

void ConstraintGroup::begin_local_step(const Positions&) {}

void ConstraintGroup::end_local_step() noexcept {}

Real ConstraintGroup::project_to_forces(const Positions& positions, std::span<Real> out, Index begin, Index end) const {
  const auto n = static_cast<std::size_t>(shape().vertices);
  const auto rows = static_cast<std::size_t>(shape().rows);
  std::array<Real, 3 * max_force_rows> room;
  const std::span<Real> slots = std::span<Real>(room).first(3 * rows);
  Real energy = 0;
  for (Index i = begin; i < end; ++i) {
    energy += project(positions, slots, i, i + 1);
    const std::span<const Real> A = reduction().subspan(static_cast<std::size_t>(i) * rows * n, rows * n);
    for (std::size_t j = 0; j < n; ++j) {
      Real* const force = out.data() + 3 * (static_cast<std::size_t>(i - begin) * n + j);
      std::fill_n(force, 3, Real(0));
      for (std::size_t row = 0; row < rows; ++row) {
        for (std::size_t axis = 0; axis < 3; ++axis) force[axis] += A[row * n + j] * slots[3 * row + axis];
      }
    }
  }
  return energy;
}

std::span<const Index> ConstraintGroup::pinned_vertices() const {
  return {};
}

std::span<Real> ConstraintGroup::targets() {
  return {};
}

bool ConstraintGroup::limits_stretches() const {
  return false;
}

bool ConstraintGroup::is_external() {
  return !targets().empty();
}

void ConstraintGroup::move_guess(Positions&, std::span<const Real>) const {}

std::span<Real> ConstraintGroup::anchor(Index i) {
  const auto first = 3 * static_cast<std::size_t>(i);
  return first < targets().size() ? targets().subspan(first, 3) : std::span<Real>();
}

std::span<Real> ConstraintGroup::parameters() {
  return targets();
}

std::unique_ptr<ConstraintGroup> ConstraintGroup::copy() const {
  return nullptr;
}

bool ConstraintGroup::scale_measures(std::span<const Real> factors) {
  const std::span<Real> measures = own_measures();
  if (measures.size() != factors.size()) return false;
  for (std::size_t i = 0; i < measures.size(); ++i) measures[i] *= factors[i];
  changed();
  return true;
}

std::unique_ptr<ConstraintGroup> ConstraintGroup::reordered(std::span<const Index>, std::span<const Index>) const {
  return nullptr;
}

void ConstraintGroup::sync_parameters(const ConstraintGroup& from, std::span<const Index>) {
  stiffness_ = from.stiffness_;
  factor_stiffness_ = from.factor_stiffness_;
  factor_share_ = from.factor_share_;
  is_driven_ = from.is_driven_;
}

namespace {

[[noreturn]] void fail_index(Index vertex, Index vertex_count, const std::string& where) {
  fail_input(where + ": vertex " + std::to_string(vertex) + " is out of range; there are vertices 0 to " +
             std::to_string(vertex_count - 1));
}

void check_lengths(const ConstraintGroup& group, const std::string& where) {
  const GroupShape shape = group.shape();
  if (shape.count < 0 || shape.vertices < 1 || shape.rows < 1) {
    fail_input(where + ": its shape has no vertices, no rows or a negative count; fix shape()");
  }
  if (shape.vertices > max_stencil) {
    fail_input(fmt::format("{}: its constraints have {} vertices, of {} at most; split them", where, shape.vertices,
                           max_stencil));
  }
  if (shape.rows > max_reduction_rows) {
    fail_input(fmt::format("{}: its reductions have {} rows, of {} at most; split the constraint", where, shape.rows,
                           max_reduction_rows));
  }
  const auto count = static_cast<std::size_t>(shape.count);
  const std::size_t stencil = count * static_cast<std::size_t>(shape.vertices);
  const std::size_t reduction = stencil * static_cast<std::size_t>(shape.rows);
  if (group.stencil().size() != stencil || group.reduction().size() != reduction ||
      group.rest_measure().size() != count) {
    fail_input(where + ": the lengths of stencil, reduction and measure do not fit its shape; give count × n, " +
               "count × k × n and count entries");
  }
}

}  // namespace

void check_group(ConstraintGroup& group, Index vertex_count, std::string_view name) {
  const std::string where(name);
  check_lengths(group, where);
  const GroupShape shape = group.shape();
  const auto n = static_cast<std::size_t>(shape.vertices);
  const auto finite = [](Real x) { return std::isfinite(x); };
  for (std::size_t i = 0; i < static_cast<std::size_t>(shape.count); ++i) {
    const auto constraint = [&] { return where + ": constraint " + std::to_string(i); };
    const std::span<const Index> stencil = group.stencil().subspan(i * n, n);
    for (std::size_t a = 0; a < n; ++a) {
      if (stencil[a] < 0 || stencil[a] >= vertex_count) fail_index(stencil[a], vertex_count, constraint());
      if (std::ranges::find(stencil.first(a), stencil[a]) == stencil.first(a).end()) continue;
      fail_input(constraint() + " names vertex " + std::to_string(stencil[a]) + " twice; its vertices must differ");
    }
    const std::size_t size = n * static_cast<std::size_t>(shape.rows);
    if (!std::ranges::all_of(group.reduction().subspan(i * size, size), finite)) {
      fail_input(constraint() + " has a coefficient that is not finite; fix its rest shape");
    }
    if (!(group.rest_measure()[i] > 0) || !std::isfinite(group.rest_measure()[i])) {
      fail_input(constraint() + " has a measure that is not positive and finite; fix its rest shape or stiffness");
    }
  }
  for (const Index vertex : group.pinned_vertices()) {
    if (vertex < 0 || vertex >= vertex_count) fail_index(vertex, vertex_count, where);
  }
  if (3 * group.pinned_vertices().size() > group.targets().size()) {
    fail_input(where + " holds vertices that have no target; give each a point");
  }
  if (!std::ranges::all_of(group.targets(), finite)) fail_input(where + ": a target is not finite; fix it");
}

void ConstraintGroup::set_stiffness(Real stiffness) {
  if (!(stiffness > 0) || !std::isfinite(stiffness)) {
    fail_input(
        fmt::format("stiffness: {} is not a positive finite number; give one, or remove the constraints", stiffness));
  }
  stiffness_ = stiffness;
  factor_stiffness_ = factor_share_ * stiffness;
}

void ConstraintGroup::set_beside_factor(bool is_beside) {
  if (is_beside == is_beside_factor_) return;
  is_beside_factor_ = is_beside;
  changed();
}

void ConstraintGroup::set_factor_share(Real share) {
  if (!(share > 0) || !std::isfinite(share)) {
    fail_input(fmt::format("share of the stiffness in the factor: found {}; give a number above 0", share));
  }
  factor_share_ = share;
  factor_stiffness_ = share * stiffness_;
}

void ConstraintGroup::set_passing_stiffness(Real stiffness) {
  set_stiffness(stiffness);
  int exponent = 0;
  const Real fraction = std::frexp(stiffness, &exponent);
  const Real nearest = std::ldexp(Real{1}, fraction * fraction < Real{0.5} ? exponent - 1 : exponent);
  if (std::isfinite(nearest)) factor_stiffness_ = factor_share_ * nearest;
}

}  // namespace pliant
