// How a substep begins: who may touch whom, and the way from its start to the first iterate.
#include <algorithm>
#include <cmath>
#include <utility>

#include "pliant/collision/pairs/pair_contact.h"

namespace pliant {
namespace {

/// Of r: how far ahead of a pinned surface what it would run into begins.
constexpr Real kept_ahead = 0.5;
/// Of r: how far pinned vertices go at once as a substep begins, unless they would need more parts.
constexpr Real longest_part = 2;
constexpr Real most_parts = 16;

}  // namespace

void PairContact::begin_substep(const ContactStep& step, const ContactState& state, Positions& q, ThreadPool& threads) {
  step_.emplace(step);
  begin_ = step.begin;
  report_ = {};
  was_shortened_.assign(step.masses.size(), 0);
  stiffening_.assign(step.masses.size(), 1);
  for (std::size_t i = 0; i < state.stiffening.size(); ++i) {
    stiffening_[i] = state.stiffening[step.vertices.empty() ? i : at(step.vertices[i])];
  }
  memory_ = state.pairs;
  begin_exceptions(state, threads);
  weights_.clear();
  near_.clear();
  pinned_.clear();
  std::ranges::copy_if(surface_->vertices, std::back_inserter(pinned_), [&](Index v) { return is_pinned(v); });
  targets_ = q;
  go_along(q, threads);
  begin_ways(q, threads);
}

/// Pinned vertices that have far to go get there in parts, lest they be stopped by what each part pushes ahead.
void PairContact::begin_ways(Positions& q, ThreadPool& threads) {
  Real longest = 0;
  for (const Index v : pinned_) longest = std::max(longest, (targets_.row(v) - start_.row(v)).norm());
  const Index parts = longest > 0 ? parts_of_ways(q, threads) : 1;
  has_pushed_ahead_ = parts > 1;
  is_shortened_ = false;
  aims_ = q;
  for (Index left = parts; left > 0; --left) {
    if (parts > 1) {
      q = left > 1 ? Positions(start_ + (aims_ - start_) / left) : aims_;
      look_ahead(q, threads);
    }
    if (longest > 0) push_ahead(2 * longest, q);
    whole_ = q;
    is_shortened_ |= shorten(start_, q, threads);
    if (left > 1) start_ = q;
  }
}

/// The pairs that may meet on the next way.
void PairContact::look_ahead(const Positions& q, ThreadPool& threads) {
  list_.forget_before();
  list_.begin_way(start_, q);
  list_.on_the_way(start_, q, threads);
}

/// By what pinned vertices go that may meet something.
Index PairContact::parts_of_ways(const Positions& q, ThreadPool& threads) {
  look_ahead(q, threads);
  Real share = 1;
  const auto add = [&](Index v) {
    if (is_pinned(v)) share = std::max(share, (q.row(v) - start_.row(v)).norm() / (longest_part * radii_[at(v)]));
  };
  for (const Pair& pair : list_.last_on_the_way().pairs) std::ranges::for_each(pair.vertices, add);
  if (!list_.last_on_the_way().is_all) std::ranges::for_each(pinned_, add);
  return static_cast<Index>(std::min(std::ceil(share), most_parts));
}

/// Takes what a pinned body takes along to where the first way begins.
void PairContact::go_along(const Positions& q, ThreadPool& threads) {
  start_ = begin_;
  const CommonMotions::Input input{begin_, q, pinned_, step_->is_pinned, radii_};
  if (!common_.may_help(input)) return;
  list_.update(begin_, threads);
  if (common_.find(input, list_.near(), start_)) list_.take_along(start_);
}

/// What pinned surfaces would run into begins ahead of them, so that they need not wait until the iterations have moved
/// it there. Between pinned surfaces that close there may be no room; nothing is pushed farther in all than that.
void PairContact::push_ahead(Real farthest, Positions& q) {
  constexpr int sweeps = 3;
  const PairList::OnTheWay& found = list_.last_on_the_way();
  bool has_pushed = true;
  for (int i = 0; i < sweeps && has_pushed; ++i) {
    has_pushed_ahead_ |= i > 0;
    has_pushed = false;
    for (const Pair& pair : found.pairs) {
      const auto begin_of_second = static_cast<std::size_t>(pair.first_side());
      const std::span first = std::span(pair.vertices).first(begin_of_second);
      const std::span second = std::span(pair.vertices).subspan(begin_of_second);
      const auto pinned = [&](Index v) { return is_pinned(v); };
      if (std::ranges::all_of(second, pinned) && std::ranges::none_of(first, pinned)) {
        has_pushed |= push_ahead(pair, first, farthest, q);
      } else if (std::ranges::all_of(first, pinned) && std::ranges::none_of(second, pinned)) {
        has_pushed |= push_ahead(pair, second, farthest, q);
      }
    }
  }
}

/// Pushes one side of a pair along the normal, where it would be met by the other one. Returns whether it has.
bool PairContact::push_ahead(const Pair& pair, std::span<const Index> side, Real farthest, Positions& q) {
  const Gap gap = measure(start_, pair);
  const auto way = [&](Index v) { return Vec3(row(q, v) - row(start_, v)); };
  Vec3 relative = Vec3::Zero();
  for (std::size_t j = 0; j < 4; ++j) relative += gap.weights[j] * way(pair.vertices[j]);
  const Real closing = -gap.normal.dot(relative);
  const Real radius = (radii_[at(pair.vertices[0])] + radii_[at(pair.vertices[3])]) / 2;
  const Real too_far = closing - (gap.distance - std::min(gap.distance, kept_ahead * radius));
  if (!(too_far > 0)) return false;
  const Real share = std::min<Real>(1, gap.distance / closing);  // of the way, at which they meet if they do
  met_.resize(4, 3);
  Pair there = pair;
  for (Index j = 0; j < 4; ++j) {
    const Index v = pair.vertices[at(j)];
    met_.row(j) = (row(start_, v) + share * way(v)).transpose();
    there.vertices[at(j)] = j;
  }
  if (measure(met_, there).distance > radius) return false;
  const Vec3 push = (side.data() == pair.vertices.data() ? too_far : -too_far) * gap.normal;
  const auto is_too_far = [&](Index v) { return (row(aims_, v) + push - row(targets_, v)).norm() > farthest; };
  if (std::ranges::any_of(side, is_too_far)) return false;
  for (std::size_t j = 0; j < side.size(); ++j) {
    if (j > 0 && side[j] == side[j - 1]) continue;
    q.row(side[j]) += push.transpose();
    aims_.row(side[j]) += push.transpose();
  }
  return true;
}

/// Each component goes as far as all of its vertices may; where that does not do, it stays where it was.
bool PairContact::shorten_components(std::span<const Index> component_of_vertex, Positions& q, ThreadPool& threads) {
  constexpr int most_trials = 4;
  if (!is_shortened_ || has_pushed_ahead_) return false;
  const auto count = static_cast<Index>(q.rows());
  shares_.assign(at(*std::ranges::max_element(component_of_vertex) + 1), 1);
  bool is_shortened = true;
  for (int trial = 0; is_shortened && trial < most_trials; ++trial) {
    shares_before_ = shares_;
    for (const Index v : surface_->vertices) {
      if (is_pinned(v) || (row(q, v).array() == row(wish_, v).array()).all()) continue;
      const auto component = at(component_of_vertex[at(v)]);
      const Vec3 way = row(wish_, v) - row(start_, v);
      const Real gone = std::max<Real>(0, way.dot(row(q, v) - row(start_, v)) / way.squaredNorm());
      shares_[component] = std::min(shares_[component], trial == 0 ? gone : 0);
    }
    if (shares_ == shares_before_) return true;
    for (Index v = 0; v < count; ++v) {
      const Real share = is_pinned(v) ? 1 : shares_[at(component_of_vertex[at(v)])];
      q.row(v) = whole_.row(v);
      if (share < 1) q.row(v) = start_.row(v) + share * (whole_.row(v) - start_.row(v));
    }
    is_shortened = shorten(start_, q, threads);
  }
  return true;
}

void PairContact::begin_exceptions(const ContactState& state, ThreadPool& threads) {
  tangles_.begin(*step_, state.let_go);
  held_up_.begin(*step_, state.let_go);
  reduced_.clear();
  const std::vector<ReducedDistance>& reduced = state.let_go.reduced;
  for (Index v = 0; !reduced.empty() && v < count_of(step_->masses); ++v) {
    const Index number = number_of(v);
    auto each = std::ranges::lower_bound(reduced, number, {}, &ReducedDistance::vertex);
    for (; each != reduced.end() && each->vertex == number; ++each) {
      reduced_.set({v, each->body, each->share}, step_->masses.size());
    }
  }
  list_.begin(step_->is_pinned, tangles_.let_go(), reduced_);
  if (!tangles_.was_known()) begin_to_touch(threads);
}

/// Where surfaces have just begun to touch, what is nearer than r, and did not push before, keeps its distance.
void PairContact::begin_to_touch(ThreadPool& threads) {
  list_.update(step_->begin, threads);
  std::vector<LetGo::Vertices> in_one_place;
  auto pushed = memory_.begin();
  for (const PairList::Near& each : list_.near()) {
    const auto key = std::pair(each.pair.kind, each.pair.features);
    while (pushed != memory_.end() && std::pair(pushed->kind, pushed->features) < key) ++pushed;
    const bool has_pushed = pushed != memory_.end() && std::pair(pushed->kind, pushed->features) == key;
    if (each.distance < least_gap_apart * each.radius) {
      for_each_across(each.pair, [&](Index a, Index b) { in_one_place.push_back({a, b}); });
    } else if (!has_pushed && each.distance < each.radius) {
      reduced_.reduce(each.pair, *surface_, each.distance / each.radius);
    }
  }
  tangles_.let_go_too(in_one_place);
  list_.changed_exceptions();
}

}  // namespace pliant
