#include "pliant/collision/pairs/pair_contact.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "pliant/collision/contact/stiffness.h"
#include "pliant/collision/pairs/pair_memory.h"
#include "pliant/collision/pairs/pair_resistance.h"

namespace pliant {

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
  constexpr int most_searches = 6;  // of numbers that are not finite none is covered
  list_.begin_way(from, q);
  const PairList::OnTheWay& found = list_.on_the_way(from, q, threads);
  if (found.is_all && found.pairs.empty()) return false;
  wish_ = q;
  for (int i = 0;; ++i) {
    if (i > 0) list_.on_the_way(from, wish_, threads);
    q = wish_;
    if (!found.is_all) return shorten_halves(from, q, threads);
    if (found.pairs.empty()) return false;
    const PlanesInput input{.begin = from,
                            .surface = *surface_,
                            .pairs = found.pairs,
                            .distances = found.distances,
                            .radii = radii_,
                            .within = i < free_searches ? nullptr : list_.boxes()};
    const Shortened done = planes_.shorten(input, q, threads);
    if (done.vertices == 0) return false;
    if (!list_.covers(from, wish_, q) && i + 1 < most_searches) continue;
    report_.shortened += done.vertices;
    for (const Index v : surface_->vertices) {
      if ((row(q, v).array() != row(wish_, v).array()).any()) was_shortened_[at(v)] = 1;
    }
    return true;
  }
}

/// What may meet on the way is too much to be looked at: half of the way, then the rest. Where that does not do, it
/// stays.
bool PairContact::shorten_halves(const Positions& from, Positions& q, ThreadPool& threads) {
  constexpr int most_halvings = 6;
  if (halvings_ == most_halvings) {
    for (const Index v : surface_->vertices) q.row(v) = from.row(v);
    report_.shortened += count_of(surface_->vertices);
    return true;
  }
  ++halvings_;
  const Positions to = q;
  Positions middle = from + (to - from) / 2;
  bool is_shortened = shorten_way(from, middle, threads);
  q = to;
  is_shortened |= shorten_way(middle, q, threads);
  --halvings_;
  wish_ = to;
  return is_shortened;
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
