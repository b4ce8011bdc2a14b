#include "pliant/collision/pairs/held_up_vertices.h"

#include <algorithm>

namespace pliant {
namespace {

/// A vertex does not get on where it comes less than this share of its way in a substep, and stays behind by more than
/// r; so many substeps in a row are long.
constexpr Real least_progress = 0.1;
constexpr Index long_time = 10;
/// Of r: what is no lag.
constexpr Real no_lag = 1e-3;

}  // namespace

void HeldUpVertices::begin(const ContactStep& step, const LetGoState& state) {
  substeps_.clear();
  if (state.held_up.empty()) return;
  for (Index v = 0; v < count_of(step.masses); ++v) {
    const Index number = step.vertices.empty() ? v : step.vertices[at(v)];
    const auto found = std::ranges::lower_bound(state.held_up, number, {}, &HeldUpVertex::vertex);
    if (found != state.held_up.end() && found->vertex == number) substeps_[v] = found->substeps;
  }
}

void HeldUpVertices::commit(const ContactStep& step, std::span<const Index> pinned, const Positions& targets,
                            const Positions& q) {
  const std::map<Index, Index> before = std::move(substeps_);
  substeps_.clear();
  lags_.assign(step.masses.size(), 0);
  largest_lag_ = 0;
  for (const Index v : pinned) {
    const Real lag = (q.row(v) - targets.row(v)).norm();
    largest_lag_ = std::max(largest_lag_, lag);
    lags_[at(v)] = lag > no_lag * step.radii[at(v)] ? lag : 0;
    const Real way = (targets.row(v) - step.begin.row(v)).norm();
    const bool gets_on = (q.row(v) - step.begin.row(v)).norm() > least_progress * way;
    if (gets_on || !(lag > step.radii[at(v)])) continue;
    const auto found = before.find(v);
    substeps_[v] = std::min(long_time, 1 + (found == before.end() ? 0 : found->second));
  }
}

void HeldUpVertices::write(const ContactStep& step, LetGoState& state) const {
  state.held_up.clear();
  for (const auto& [v, substeps] : substeps_) {
    state.held_up.push_back({step.vertices.empty() ? v : step.vertices[at(v)], substeps});
  }
  std::ranges::sort(state.held_up, {}, &HeldUpVertex::vertex);
}

bool HeldUpVertices::is_stuck(Index vertex) const {
  const auto found = substeps_.find(vertex);
  return found != substeps_.end() && found->second >= long_time;
}

bool HeldUpVertices::is_any_stuck() const {
  return std::ranges::any_of(substeps_, [](const auto& each) { return each.second >= long_time; });
}

}  // namespace pliant
