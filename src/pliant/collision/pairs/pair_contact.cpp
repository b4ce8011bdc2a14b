#include "pliant/collision/pairs/pair_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pliant/collision/contact/stiffness.h"
#include "pliant/collision/pairs/pair_memory.h"
#include "pliant/collision/pairs/pair_resistance.h"

namespace pliant {
namespace {

/// Of r: what is nearer lies in one place.
constexpr Real least_gap_apart = 1e-6;
/// Of r: how far ahead of a pinned surface what it would run into begins.
constexpr Real kept_ahead = 0.5;
/// Of r: how far pinned vertices go at once as a substep begins, unless they would need more parts.
constexpr Real longest_part = 6;
constexpr Real most_parts = 16;

}  // namespace

// ---- what lasts
// ------------------------------------------------------------------------------------------------------

void PairContact::set_surface(Surface surface, const Positions& rest, SurfaceFrictions frictions,
                              std::vector<Real> radii) {
  clear();
  surface_ = std::move(surface);
  frictions_ = std::move(frictions);
  radii_ = std::move(radii);
  list_.set_surface(*surface_, rest, radii_);
  tangles_.set_surface(*surface_);
  common_.set_surface(*surface_);
}

void PairContact::clear() {
  forget_substep();
  list_.clear();
  tangles_.clear();
  reduced_.clear();
  weights_.clear();
  near_.clear();
  surface_.reset();
  report_ = {};
}

void PairContact::find_loaded_vertices(const ContactState& state, std::vector<char>& is_loaded) const {
  is_loaded.assign(surface_->body.size(), 0);
  for (const PairMemory& each : state.pairs) {
    for (const Index v : vertices_of(each, *surface_)) {
      if (v >= 0) is_loaded[at(v)] = 1;
    }
  }
}

// ---- who may touch whom in a substep
// ---------------------------------------------------------------------------------

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
  Real longest = 0, share = 0;
  for (const Index v : pinned_) {
    const Real way = (targets_.row(v) - start_.row(v)).norm();
    longest = std::max(longest, way);
    share = std::max(share, way / (longest_part * radii_[at(v)]));
  }
  const auto parts = static_cast<Index>(std::clamp<Real>(std::ceil(share), 1, most_parts));
  has_pushed_ahead_ = parts > 1;
  is_shortened_ = false;
  aims_ = q;
  for (Index left = parts; left > 0; --left) {
    if (parts > 1) q = left > 1 ? Positions(start_ + (aims_ - start_) / left) : aims_;
    if (longest > 0) push_ahead(2 * longest, q, threads);
    whole_ = q;
    is_shortened_ |= shorten(start_, q, threads);
    if (left > 1) start_ = q;
  }
}

/// Takes what a pinned body takes along to where the first way begins.
void PairContact::go_along(const Positions& q, ThreadPool& threads) {
  start_ = begin_;
  const CommonMotions::Input input{begin_, q, pinned_, step_->is_pinned, radii_};
  if (!common_.may_help(input)) return;
  list_.update(begin_, threads);
  if (common_.find(input, list_.near(), start_)) list_.take_along(start_);
}

void PairContact::begin_at(const Positions& q, std::span<const char> has_load, ThreadPool& threads) {
  has_let_go_ = false;
  list_.list_anew();
  list(q, threads);
  for (NearPair& each : near_) {
    each.push(q, begin_);
    const auto is_loaded = [&](Index v) { return !has_load.empty() && has_load[at(v)] != 0; };
    if (std::ranges::any_of(each.pair.vertices, is_loaded)) each.freeze(q, begin_);
  }
}

/// What pinned surfaces would run into begins ahead of them, so that they need not wait until the iterations have moved
/// it there. Between pinned surfaces that close there may be no room; nothing is pushed farther in all than that.
void PairContact::push_ahead(Real farthest, Positions& q, ThreadPool& threads) {
  constexpr int sweeps = 3;
  list_.forget_before();
  list_.begin_way(start_, q);
  const PairList::OnTheWay& found = list_.on_the_way(start_, q, threads);
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

/// The pairs that count, as they are listed and weighed now. All lists are in the order of pairs.
void PairContact::collect() {
  std::swap(near_, near_before_);
  near_.clear();
  auto old = near_before_.begin();
  auto each = memory_.begin();
  const std::span<const PairList::Near> listed = list_.near();
  for (std::size_t i = 0; i < listed.size(); ++i) {
    const Real weight = weights_.weights()[i];
    if (!(weight > 0)) continue;
    const Pair& pair = listed[i].pair;
    while (old != near_before_.end() && old->pair < pair) ++old;
    if (old != near_before_.end() && old->pair == pair) {
      near_.push_back(*old);
    } else {
      near_.push_back(make_near(pair, listed[i].radius));
      const auto key = std::pair(pair.kind, pair.features);
      while (each != memory_.end() && std::pair(each->kind, each->features) < key) ++each;
      if (each != memory_.end() && std::pair(each->kind, each->features) == key)
        near_.back().slide_before = each->slide;
    }
    near_.back().weight = weight;
    near_.back().gap = weights_.gaps()[i];
    near_.back().place = static_cast<Index>(i);
  }
}

void PairContact::list(const Positions& q, ThreadPool& threads) {
  if (!list_.update(q, threads)) return;
  weights_.update(list_, *surface_, q, threads);
  collect();
}

/// Whose κ m a pair goes by: a vertex its own, edges the largest of their ends. What is pinned moves as it is told to,
/// whatever it weighs; it goes by what it meets.
Index PairContact::stiffest_vertex(const Pair& pair) const {
  if (pair.kind != PairKind::edge_edge && !is_pinned(pair.vertices[0])) return pair.vertices[0];
  const auto weight = [&](Index v) { return is_pinned(v) ? 0 : stiffening_[at(v)] * step_->masses[at(v)]; };
  return *std::ranges::max_element(pair.vertices, {}, weight);
}

NearPair PairContact::make_near(const Pair& pair, Real radius) const {
  NearPair made;
  made.pair = pair;
  made.radius = radius;
  const Index stiffest = stiffest_vertex(pair);
  made.stiffening = stiffening_[at(stiffest)];
  made.stiffness =
      stiffness_ratio * (made.stiffening * step_->masses[at(stiffest)]) / (step_->time_step * step_->time_step);
  const Index a = surface_->body[at(pair.vertices[0])];
  const Index b = surface_->body[at(pair.vertices[static_cast<std::size_t>(pair.first_side())])];
  made.friction = frictions_.between(a, b);
  return made;
}

// ---- from iterate to iterate
// -----------------------------------------------------------------------------------------

/// What is in the way is pushed ahead by contact forces meanwhile.
HeldBack PairContact::hold_back(const Positions& from, Positions& q, ThreadPool& threads) {
  HeldBack held;
  for (const Index v : pinned_) q.row(v) = targets_.row(v);
  held.has_moved = shorten(from, q, threads);
  held.has_new_potential = std::exchange(has_let_go_, false) || std::ranges::any_of(pinned_, [&](Index v) {
                             return (q.row(v).array() != from.row(v).array()).any();
                           });
  return held;
}

/// Where a move is held back by what surrounds a crossing, it goes on as soon as that is let go too.
bool PairContact::shorten(const Positions& from, Positions& q, ThreadPool& threads) {
  constexpr int most_ways = 10;
  bool is_shortened = shorten_way(from, q, threads);
  for (int i = 0; i < most_ways && is_shortened && tangles_.follow(q); ++i) {
    has_let_go_ = true;
    list_.changed_exceptions();
    passed_ = q;
    q = wish_;
    is_shortened = shorten_way(passed_, q, threads);
  }
  return is_shortened;
}

/// What slides along a plane may come to where nothing was searched for. Then that is searched too; what slides farther
/// the next time stays within it.
bool PairContact::shorten_way(const Positions& from, Positions& q, ThreadPool& threads) {
  constexpr int free_searches = 2;
  list_.begin_way(from, q);
  if (list_.on_the_way(from, q, threads).pairs.empty()) return false;
  wish_ = q;
  for (int i = 0;; ++i) {
    const PairList::OnTheWay& found = i == 0 ? list_.last_on_the_way() : list_.on_the_way(from, wish_, threads);
    q = wish_;
    if (found.pairs.empty()) return false;
    const PlanesInput input{.begin = from,
                            .surface = *surface_,
                            .pairs = found.pairs,
                            .distances = found.distances,
                            .radii = radii_,
                            .within = i < free_searches ? nullptr : list_.boxes()};
    const Shortened done = planes_.shorten(input, q, threads);
    if (done.vertices == 0) return false;
    if (!list_.covers(from, wish_, q)) continue;
    report_.shortened += done.vertices;
    for (const Index v : surface_->vertices) {
      if ((row(q, v).array() != row(wish_, v).array()).any()) was_shortened_[at(v)] = 1;
    }
    return true;
  }
}

void PairContact::find_forces(const Positions& q, ThreadPool& threads) {
  list(q, threads);
  for_each_chunk_of(near_.size(), pairs_of_chunk, threads, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      NearPair& near = near_[i];
      const Real bound = list_.bound(list_.near()[at(near.place)]);
      if (bound < near.radius || near.load > 0) {
        near.look(q, begin_);
      } else {
        near.pass(bound);
      }
    }
  });
}

Real PairContact::add(Positions& r) const {
  Real energy = 0;
  for (const NearPair& each : near_) {
    if (!each.is_active()) continue;
    energy += each.energy();
    for (std::size_t j = 0; j < 4; ++j) r.row(each.pair.vertices[j]) += each.force_on(j).transpose();
  }
  return energy;
}

void PairContact::subtract(Positions& r) const {
  for (const NearPair& each : near_) {
    if (!each.is_active()) continue;
    for (std::size_t j = 0; j < 4; ++j) r.row(each.pair.vertices[j]) -= each.force_on(j).transpose();
  }
}

void PairContact::refresh(const Positions& q, ThreadPool& threads) {
  list_.go_to(q);
  weights_.refresh(list_, *surface_, q, threads);
  collect();
  for (NearPair& each : near_) each.push(q, begin_);
  refresh_loads(q);
}

void PairContact::refresh_loads(const Positions& q) {
  for (NearPair& each : near_) each.freeze(q, begin_);
}

Real PairContact::curvature(const Positions& p) const {
  Real sum = 0;
  for (const NearPair& each : near_) {
    if (each.is_active()) sum += each.curvature(p);
  }
  return sum;
}

Real PairContact::stiffened_curvature(const Positions& p) const {
  Real sum = 0;
  for (const NearPair& each : near_) {
    if (each.is_active() && each.stiffening > far_stiffer) sum += each.curvature(p);
  }
  return sum;
}

void PairContact::add_diagonal(std::span<Real> diagonal) const {
  for (const NearPair& each : near_) {
    if (!each.is_active()) continue;
    Real sum = 0, sum_of_friction = 0;
    for (std::size_t j = 0; j < 4; ++j) {
      sum += std::abs(each.gap.weights[j]);
      sum_of_friction += std::abs(each.friction_weights[j]);
    }
    for (std::size_t j = 0; j < 4; ++j) {
      diagonal[at(each.pair.vertices[j])] +=
          each.pushed.curvature * std::abs(each.gap.weights[j]) * sum +
          each.rubbed.curvature * std::abs(each.friction_weights[j]) * sum_of_friction;
    }
  }
}

void PairContact::join_touching(std::span<const Index> component_of_vertex, std::span<std::size_t> least,
                                std::span<char> touches) const {
  pliant::join_touching(near_, component_of_vertex, least, touches);
  for (const PairMemory& each : memory_) {
    const auto [first, second] = vertices_of(each, *surface_);
    if (first < 0 || second < 0) continue;
    const auto a = at(component_of_vertex[at(first)]);
    const auto b = at(component_of_vertex[at(second)]);
    join(a, b, least);
    touches[a] = touches[b] = 1;
  }
  for (const Index v : surface_->vertices) {
    if (was_shortened_[at(v)] != 0) touches[at(component_of_vertex[at(v)])] = 1;
  }
}

// ---- the end of a substep
// --------------------------------------------------------------------------------------------

void PairContact::commit(const Positions& q, std::span<const Real> diagonal, ContactState& state, ThreadPool& threads) {
  find_forces(q, threads);
  report_.pairs = count_of(list_.near());
  report_.active = 0;
  report_.smallest_gap = std::numeric_limits<Real>::infinity();
  const auto stiffen = [&](Index v, Real share_of_radius) {
    if (!(share_of_radius < light_gap)) return;
    const Real before = stiffening_[at(v)];
    const Real plain = stiffness_ratio * step_->masses[at(v)] / (step_->time_step * step_->time_step);
    const Real most = std::max<Real>(1, diagonal[at(v)] / plain);
    Real& factor = state.stiffening[at(number_of(v))];
    factor =
        std::max(factor, share_of_radius < pressed_gap ? std::min(stiffer * before, std::max(most, before)) : before);
  };
  for (const PairList::Near& each : list_.near()) {
    if (list_.bound(each) < report_.smallest_gap) {
      report_.smallest_gap = std::min(report_.smallest_gap, measure(q, each.pair).distance);
    }
  }
  for (const NearPair& each : near_) {
    for (const Index v : each.pair.vertices) stiffen(v, each.gap.distance / each.radius);
    if (each.pushed.force > 0) ++report_.active;
    if (!(each.load > 0) || !(each.pushed.force > 0)) {
      if (each.pushed.force > 0) state.pairs.push_back({each.pair.kind, each.pair.features, Vec3::Zero()});
      continue;
    }
    const Real most = each.friction * each.load / (each.weight * each.stiffness);
    const Real length = each.slide.norm();
    state.pairs.push_back(
        {each.pair.kind, each.pair.features, length > most ? Vec3(most / length * each.slide) : each.slide});
  }
  commit_exceptions(q, state.let_go, threads);
}

void PairContact::commit_exceptions(const Positions& q, LetGoState& state, ThreadPool& threads) {
  held_up_.commit(*step_, pinned_, targets_, q);
  report_.lag = held_up_.largest_lag();
  const LetGo before = tangles_.let_go();
  if (held_up_.is_any_stuck()) let_go_of_stuck();
  tangles_.commit(q, held_up_.lags());
  reduced_.grow(step_->time_step);
  keep_distances(before, q, threads);
  report_.let_go = tangles_.count();
  report_.let_go_bodies = tangles_.new_bodies(q);
  tangles_.write(state);
  held_up_.write(*step_, state);
  state.reduced.clear();
  reduced_.for_each([&](Index vertex, Index body, Real share) {
    state.reduced.push_back({number_of(vertex), body, share});
  });
  std::ranges::sort(state.reduced, {}, [](const ReducedDistance& each) { return std::pair(each.vertex, each.body); });
}

/// What is no longer let go begins with the distance that it has. Surfaces that lie in one place cross no more than
/// those that are apart, but have no sides on which planes could hold them, so they stay as they are.
void PairContact::keep_distances(const LetGo& before, const Positions& q, ThreadPool& threads) {
  const LetGo& now = tangles_.let_go();
  if (std::ranges::includes(now.pairs(), before.pairs())) return;
  std::vector<LetGo::Vertices> in_one_place;
  for (const PairList::Near& each : list_.nearer_than_radius(q, before, threads)) {
    if (now.has(each.pair)) continue;
    if (each.distance < least_gap_apart * each.radius) {
      for_each_across(each.pair, [&](Index a, Index b) { in_one_place.push_back({a, b}); });
    } else {
      reduced_.reduce(each.pair, *surface_, each.distance / each.radius);
    }
  }
  tangles_.let_go_too(in_one_place);
}

/// With all that is near to them.
void PairContact::let_go_of_stuck() {
  std::vector<LetGo::Vertices> stuck;
  for (const PairList::Near& each : list_.near()) {
    if (!(list_.bound(each) < each.radius)) continue;
    for_each_across(each.pair, [&](Index a, Index b) {
      if (held_up_.is_stuck(a) || held_up_.is_stuck(b)) stuck.push_back({a, b});
    });
  }
  tangles_.let_go_of(stuck);
}

}  // namespace pliant
