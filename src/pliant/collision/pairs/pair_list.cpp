#include "pliant/collision/pairs/pair_list.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "pliant/core/two_numbers.h"

namespace pliant {
namespace {

/// Of r: how much farther apart than r a pair may be to be listed.
constexpr Real list_slack = 1;
/// Of a distance: what a way that brings nothing together may take of it.
constexpr Real short_share = 0.9;
/// Of r: how far apart features of flat sheets are looked for at rest.
constexpr Real reach_at_rest = 3;
/// Of r: by how much boxes around ways are larger than these.
constexpr Real pad_of_ways = 0.1;
/// Of a bound: ways that are shorter bring nothing together. A little less than Planes has it.
constexpr Real free_share_of_bound = 0.89;
constexpr Real certain_share = 1e-6;  // of r
/// About so many vertices are asked where all go.
constexpr std::size_t vertices_asked = 256;

/// The largest of one side's corners and the largest of the other's together.
Real sum_of_sides(const Pair& pair, const std::vector<Real>& numbers) {
  const auto first = static_cast<std::size_t>(pair.first_side());
  Real a = 0, b = 0;
  for (std::size_t j = 0; j < 4; ++j) {
    Real& side = j < first ? a : b;
    side = std::max(side, numbers[at(pair.vertices[j])]);
  }
  return a + b;
}

/// A point of the one side and one of the other move against each other by no more than that.
Real relative_way(const Positions& from, const Positions& to, const Pair& pair) {
  const auto first = static_cast<std::size_t>(pair.first_side());
  std::array<Vec3, 4> ways;
  for (std::size_t j = 0; j < 4; ++j) ways[j] = row(to, pair.vertices[j]) - row(from, pair.vertices[j]);
  Real longest = 0;
  for (std::size_t i = 0; i < first; ++i) {
    for (std::size_t j = first; j < 4; ++j) longest = std::max(longest, (ways[i] - ways[j]).squaredNorm());
  }
  return std::sqrt(longest);
}

/// The distance of the sides' boxes: the pair is no nearer.
Real box_distance(const Positions& q, const Pair& pair) {
  const auto first = static_cast<std::size_t>(pair.first_side());
  Real sum = 0;
  for (Index axis = 0; axis < 3; ++axis) {
    const auto x = [&](std::size_t j) { return q(pair.vertices[j], axis); };
    const Real a = x(0), b = x(3);
    Real low_a = a, high_a = a, low_b = b, high_b = b;
    for (std::size_t j = 1; j < 3; ++j) {
      Real& low = j < first ? low_a : low_b;
      Real& high = j < first ? high_a : high_b;
      low = std::min(low, x(j));
      high = std::max(high, x(j));
    }
    const Real apart = std::max({low_a - high_b, low_b - high_a, Real(0)});
    sum += apart * apart;
  }
  return std::sqrt(sum);
}

}  // namespace

void PairList::set_surface(const Surface& surface, const Positions& rest, std::span<const Real> radii) {
  clear();
  surface_ = &surface;
  search_.emplace(surface);
  radii_.assign(radii.begin(), radii.end());
  smallest_radius_ = std::numeric_limits<Real>::infinity();
  largest_radius_ = 0;
  for (const Index v : surface.vertices) {
    smallest_radius_ = std::min(smallest_radius_, radii_[at(v)]);
    largest_radius_ = std::max(largest_radius_, radii_[at(v)]);
  }
  pads_.resize(radii.size());
  std::ranges::transform(radii, pads_.begin(), [](Real r) { return pad_of_ways * r; });
  find_own_radii(rest);
  find_sheets(rest);
  motion_.set_surface(surface, rest, radii);
}

void PairList::clear() {
  search_.reset();
  surface_ = nullptr;
  near_.clear();
  gaps_.clear();
  is_listed_ = is_of_before_ = false;
}

/// Two surfaces rest as far apart as the mean of their own distances.
Real PairList::radius_of(const Pair& pair) const {
  const auto second = static_cast<std::size_t>(pair.first_side());
  return (radii_[at(pair.vertices[0])] + radii_[at(pair.vertices[second])]) / 2;
}

void PairList::find_own_radii(const Positions& rest) {
  own_radii_.clear();
  std::vector<Real> pads(radii_.size());
  std::ranges::transform(radii_, pads.begin(), [](Real r) { return r / 2; });
  ThreadPool one(1);
  for (const Pair& pair : search_->find(rest, rest, pads, one)) {
    const Index body = surface_->body[at(pair.vertices[0])];
    if (surface_->body[at(pair.vertices[static_cast<std::size_t>(pair.first_side())])] != body) continue;
    const Real distance = measure(rest, pair).distance;
    if (distance < radius_of(pair)) own_radii_.push_back({pair, distance});
  }
}

/// Bodies that are flat at rest, and how near features are to each other there.
void PairList::find_sheets(const Positions& rest) {
  sheets_.set_surface(*surface_, rest);
  if (sheets_.is_empty()) return;
  const std::vector<Real> pads(radii_.size(), reach_at_rest / 2 * largest_radius_);
  std::vector<Real> nearest(radii_.size(), reach_at_rest * largest_radius_);
  const Positions flat = sheets_.flattened(rest, 4 * reach_at_rest * largest_radius_);
  ThreadPool one(1);
  if (!search_->try_find(flat, flat, pads, one)) std::ranges::fill(nearest, 0);
  for (const Pair& pair : search_->pairs()) {
    const Index sheet = sheets_.sheet_of(pair.vertices[0]);
    if (sheet < 0 || sheets_.sheet_of(pair.vertices[3]) != sheet) continue;
    const Real distance = measure(flat, pair).distance;
    for (const Index v : pair.vertices) nearest[at(v)] = std::min(nearest[at(v)], distance);
  }
  sheets_.set_nearest(nearest);
}

/// What was near in the substep before tells of the first way: of nothing else, for a step goes by its own state alone.
void PairList::begin(std::span<const char> is_pinned, const LetGo& let_go, const ReducedDistances& reduced) {
  is_of_before_ = (is_listed_ || is_of_before_) && has_listed_all_ && std::ranges::equal(is_held_, is_pinned);
  is_held_.assign(is_pinned.begin(), is_pinned.end());
  search_->set_held(is_pinned);
  let_go_ = &let_go;
  reduced_ = &reduced;
  is_listed_ = false;
  has_been_held_back_ = false;
}

// ---- near pairs

void PairList::take_along(const Positions& q) {
  reference_ = q;
  has_now_ = has_end_ = false;
  kept_.reset();
  motion_.forget();
}

bool PairList::update(const Positions& q, ThreadPool& threads) {
  if (is_listed_) {
    go_to(q);
    if (lasts()) return false;
  }
  list(q, threads);
  return true;
}

/// Whether no pair that is not listed can be nearer than r where all have gone.
bool PairList::lasts() {
  const auto has_room = [&](Index v) { return gone_[at(v)] < list_slack / 2 * radii_[at(v)]; };
  if (farthest_gone_ < list_slack / 2 * smallest_radius_) return true;
  if (std::ranges::all_of(surface_->vertices, has_room)) return true;
  return kept_now().is_radius;
}

const LocalMotion::Kept& PairList::kept_now() {
  if (!kept_) kept_ = motion_.kept(reference_, now_, farthest_gone_);
  return *kept_;
}

/// All pairs that can be nearer than r while no two features have gone farther against each other than the slack.
void PairList::list(const Positions& q, ThreadPool& threads) {
  const FarPairs far(*surface_, q, radii_);
  if (!sheets_.is_empty()) sheets_.find_spread(q, (1 + list_slack) * largest_radius_, threads);
  const std::span<const Pair> pairs =
      search_->find(q, q, radii_, threads, &far, sheets_.is_empty() ? nullptr : &sheets_);
  listed_chunks_.resize(std::max(listed_chunks_.size(), pairs.size() / pairs_of_chunk + 1));
  for_each_chunk_of(pairs.size(), pairs_of_chunk, threads, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    listed_chunks_[chunk].clear();
    for (std::size_t i = begin; i < end; ++i) {
      const Real radius = radius_of(pairs[i]);
      const Real reach = (1 + list_slack) * radius;  // begin_way() counts on it for all pairs
      if (let_go_->has(pairs[i])) continue;
      const Gap gap = measure(q, pairs[i]);
      if (gap.distance < reach) listed_chunks_[chunk].push_back({{pairs[i], radius, gap.distance}, gap});
    }
  });
  near_.clear();
  gaps_.clear();
  for (std::size_t i = 0; i * pairs_of_chunk < pairs.size(); ++i) {
    for (const Listed& each : listed_chunks_[i]) {
      near_.push_back(each.near);
      gaps_.push_back(each.gap);
    }
  }
  take_own_radii();
  reduce_radii();
  take_along(q);
  now_ = q;
  has_now_ = true;
  gone_.assign(at(static_cast<Index>(q.rows())), 0);
  farthest_gone_ = 0;
  is_listed_ = true;
  is_of_before_ = false;
  has_listed_all_ = let_go_->is_empty();
}

/// Both lists are in the order of pairs.
void PairList::take_own_radii() {
  auto own = own_radii_.begin();
  for (Near& each : near_) {
    while (own != own_radii_.end() && own->pair < each.pair) ++own;
    if (own == own_radii_.end()) return;
    if (own->pair == each.pair) each.radius = own->radius;
  }
}

Real PairList::find_lengths(const Positions& a, const Positions& b, const Vec3& common,
                            std::vector<Real>& lengths) const {
  const auto count = static_cast<Index>(b.rows());
  lengths.resize(at(count));
  // two vertices at once: six numbers in a row
  const std::array<TwoNumbers, 3> commons{TwoNumbers{common[0], common[1]}, TwoNumbers{common[2], common[0]},
                                          TwoNumbers{common[1], common[2]}};
  TwoNumbers longest_of_two{};
  Index v = 0;
  for (; v + 1 < count; v += 2) {
    std::array<TwoNumbers, 3> squares;
    for (std::size_t i = 0; i < 3; ++i) {
      const TwoNumbers way =
          two_numbers_at(b.data() + 3 * v + 2 * i) - two_numbers_at(a.data() + 3 * v + 2 * i) - commons[i];
      squares[i] = way * way;
    }
    const TwoNumbers x = __builtin_shufflevector(squares[0], squares[1], 0, 3);
    const TwoNumbers y = __builtin_shufflevector(squares[0], squares[2], 1, 2);
    const TwoNumbers z = __builtin_shufflevector(squares[1], squares[2], 0, 3);
    std::array<Real, 2> sums;
    const TwoNumbers sum = x + (y + z);
    for (std::size_t i = 0; i < 2; ++i) sums[i] = std::sqrt(sum[i]);
    __builtin_memcpy(&lengths[at(v)], sums.data(), sizeof sums);
    const TwoNumbers length = two_numbers_at(sums.data());
    longest_of_two = length > longest_of_two ? length : longest_of_two;
  }
  if (v < count) lengths[at(v)] = (row(b, v) - row(a, v) - common).norm();
  const Real of_last = v < count ? lengths[at(v)] : 0;
  return std::max(std::max(longest_of_two[0], longest_of_two[1]), of_last);
}

/// The middle of a box about some of them: whatever it is, bounds hold.
Vec3 PairList::common_way(const Positions& a, const Positions& b) const {
  const std::span<const Index> vertices = surface_->vertices;
  const std::size_t stride = vertices.size() / vertices_asked + 1;
  Vec3 low = Vec3::Constant(std::numeric_limits<Real>::infinity());
  Vec3 high = -low;
  for (std::size_t i = 0; i < vertices.size(); i += stride) {
    const Vec3 way = row(b, vertices[i]) - row(a, vertices[i]);
    low = low.cwiseMin(way);
    high = high.cwiseMax(way);
  }
  return (low + high) / 2;
}

void PairList::reduce_radii() {
  if (reduced_->is_empty()) return;
  for (Near& each : near_) each.radius *= reduced_->share(each.pair, *surface_);
}

std::vector<PairList::Near> PairList::nearer_than_radius(const Positions& q, const LetGo& among, ThreadPool& threads) {
  std::vector<Near> found;
  for (const Pair& pair : search_->find(q, q, radii_, threads)) {
    if (!among.has(pair)) continue;
    const auto own = std::ranges::lower_bound(own_radii_, pair, {}, &OwnRadius::pair);
    const bool has_own = own != own_radii_.end() && own->pair == pair;
    const Near near{pair, has_own ? own->radius : radius_of(pair), measure(q, pair).distance};
    if (near.distance < near.radius) found.push_back(near);
  }
  return found;
}

/// Most moves end where they were to lead, and the next one begins there.
void PairList::go_to(const Positions& q) {
  if (has_now_ && is_same(q, now_)) return;
  if (has_end_ && is_same(q, end_)) {
    std::swap(now_, end_);
    std::swap(gone_, gone_at_end_);
    std::swap(farthest_gone_, farthest_at_end_);
    std::swap(kept_, kept_at_end_);
    return std::swap(has_now_, has_end_);
  }
  now_ = q;
  has_now_ = true;
  kept_.reset();
  farthest_gone_ = find_lengths(reference_, q, common_way(reference_, q), gone_);
}

/// To the last bit.
bool PairList::is_same(const Positions& a, const Positions& b) {
  return a.rows() == b.rows() &&
         std::memcmp(a.data(), b.data(), sizeof(Real) * static_cast<std::size_t>(a.size())) == 0;
}

Real PairList::bound(const Near& near) const {
  return near.distance - sum_of_sides(near.pair, gone_);
}

// ---- ways

void PairList::begin_way(const Positions& from, const Positions& to) {
  if (is_listed_ || is_of_before_) go_to(from);
  take_way(from, to, !has_been_held_back_);
}

/// Between the ends of a way no vertex is farther from what is common to all than at one of them.
void PairList::take_way(const Positions& from, const Positions& to, bool is_relative) {
  is_relative_ = is_relative;
  common_ = is_relative ? common_way(from, to) : Vec3::Zero();
  longest_way_ = find_lengths(from, to, common_, ways_);
  is_short_ = is_listed_ || (is_of_before_ && is_relative);
  if (is_short_) {
    if (is_relative && !(has_end_ && is_same(to, end_))) {
      end_ = to;
      has_end_ = true;
      kept_at_end_.reset();
      farthest_at_end_ = find_lengths(reference_, to, common_way(reference_, to), gone_at_end_);
    }
    is_short_ = is_short_way();
  }
  if (!is_short_) set_boxes(from, to);
}

/// Whether no pair that is not listed can meet on it.
bool PairList::is_short_way() {
  const auto has_room = [&](Index v) {
    const Real gone = is_relative_ ? std::max(gone_[at(v)], gone_at_end_[at(v)]) : gone_[at(v)] + ways_[at(v)];
    return gone < short_share * (1 + list_slack) / 2 * radii_[at(v)];
  };
  if (std::ranges::all_of(surface_->vertices, has_room)) return true;
  if (!is_relative_ || !kept_now().is_some) return false;
  if (!kept_at_end_) kept_at_end_ = motion_.kept(reference_, end_, farthest_at_end_);
  return kept_at_end_->is_some;
}

/// In a frame that goes as all do, things meet where they meet in space.
void PairList::set_boxes(const Positions& from, const Positions& to) {
  boxes_.high = to.rowwise() - common_.transpose();
  boxes_.low = from.cwiseMin(boxes_.high);
  boxes_.high = boxes_.high.cwiseMax(from);
}

bool PairList::covers(const Positions& from, const Positions& to, const Positions& q) {
  if (is_relative_) {
    has_been_held_back_ = true;
    take_way(from, to, false);
    return false;
  }
  const auto is_inside = [&](Index v) {
    const Real pad = pads_[at(v)] / 2;
    return (boxes_.low.row(v) - q.row(v)).maxCoeff() <= pad && (q.row(v) - boxes_.high.row(v)).maxCoeff() <= pad;
  };
  if (is_short_ || std::ranges::all_of(surface_->vertices, is_inside)) return true;
  boxes_.low = boxes_.low.cwiseMin(q);
  boxes_.high = boxes_.high.cwiseMax(q);
  return false;
}

/// A bound below certain_share of r is nothing that rounding could not undo.
void PairList::add_on_the_way(const Pair& pair, Real bound, OnTheWay& found) const {
  if (let_go_->has(pair)) return;
  const bool is_certain = bound > certain_share * radii_[at(pair.vertices[0])];
  if (is_certain && sum_of_sides(pair, ways_) < free_share_of_bound * bound) return;
  found.pairs.push_back(pair);
  found.distances.push_back(std::max<Real>(0, bound));
}

const PairList::OnTheWay& PairList::on_the_way(const Positions& from, const Positions& to, ThreadPool& threads) {
  if (is_short_) {
    collect_near_on_the_way(from, to, threads);
    if (!is_of_before_ || on_the_way_.pairs.empty()) return on_the_way_;
    is_short_ = false;
    set_boxes(from, to);
  }
  const bool has_spread = is_relative_ && !sheets_.is_empty();
  if (has_spread) sheets_.find_spread(from, to, largest_radius_, threads);
  const bool is_all =
      search_->try_find(boxes_.low, boxes_.high, pads_, threads, nullptr, has_spread ? &sheets_ : nullptr);
  const std::span<const Pair> pairs = search_->pairs();
  collect_on_the_way(pairs.size(), threads, [&](std::size_t i, OnTheWay& found) {
    add_on_the_way(pairs[i], box_distance(from, pairs[i]), found);
  });
  on_the_way_.is_all = is_all;
  return on_the_way_;
}

void PairList::collect_near_on_the_way(const Positions& from, const Positions& to, ThreadPool& threads) {
  const Real most_certain = certain_share * largest_radius_;
  const Real longest = 2 * (longest_way_ / free_share_of_bound + farthest_gone_) + most_certain;
  // Where a single pair would have all ways searched, it is looked at by itself.
  const auto is_apart = [&](const Near& near) {
    return is_of_before_ && bound(near) > most_certain &&
           relative_way(from, to, near.pair) < free_share_of_bound * bound(near);
  };
  collect_on_the_way(near_.size(), threads, [&](std::size_t i, OnTheWay& found) {
    const Near& near = near_[i];
    if (!(near.distance > longest) && !is_apart(near)) add_on_the_way(near.pair, bound(near), found);
  });
}

/// add(i, found) adds pair i of so many if it belongs there.
template <class Add>
void PairList::collect_on_the_way(std::size_t count, ThreadPool& threads, Add&& add) {
  way_chunks_.resize(std::max(way_chunks_.size(), count / pairs_of_chunk + 1));
  for_each_chunk_of(count, pairs_of_chunk, threads, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    OnTheWay& found = way_chunks_[chunk];
    found.pairs.clear();
    found.distances.clear();
    for (std::size_t i = begin; i < end; ++i) add(i, found);
  });
  on_the_way_.pairs.clear();
  on_the_way_.distances.clear();
  on_the_way_.is_all = true;
  for (std::size_t i = 0; i * pairs_of_chunk < count; ++i) {
    const OnTheWay& found = way_chunks_[i];
    on_the_way_.pairs.insert(on_the_way_.pairs.end(), found.pairs.begin(), found.pairs.end());
    on_the_way_.distances.insert(on_the_way_.distances.end(), found.distances.begin(), found.distances.end());
  }
}

}  // namespace pliant
