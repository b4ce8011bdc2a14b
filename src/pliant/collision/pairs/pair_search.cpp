#include "pliant/collision/pairs/pair_search.h"

#include <algorithm>
#include <numeric>

#include <fmt/format.h>

#include "pliant/core/error.h"

namespace pliant {

using collision::BoxTree;
using collision::FloatBox;
using collision::FourFloats;
using collision::MeetingItems;
using collision::OwnedTree;

namespace {

/// Vertices or pairs that a thread takes at once.
constexpr Index items_of_chunk = 1024;

/// The places in Surface::vertices of the corners of each item, one after another.
template <class Item>
std::vector<Index> places_of_corners(std::span<const Item> items, std::span<const Index> places) {
  std::vector<Index> corners;
  corners.reserve(items.size() * std::tuple_size_v<Item>);
  for (const Item& item : items) {
    for (const Index vertex : item) corners.push_back(places[at(vertex)]);
  }
  return corners;
}

#ifdef __SSE2__
/// Three pairs of numbers, the last two of which are of interest in all; each rounded as rounded_down() does.
void round_down(__m128d a, __m128d b, __m128d c, FourFloats& ab, FourFloats& c_alone) {
  const __m128d limit = _mm_set1_pd(Real{std::numeric_limits<float>::max()});
  const auto nearest = [&](__m128d& x) {
    x = _mm_min_pd(_mm_max_pd(x, -limit), limit);
    return _mm_cvtpd_ps(x);
  };
  const auto is_above = [](__m128 rounded, __m128d x) { return _mm_castpd_ps(_mm_cmpgt_pd(_mm_cvtps_pd(rounded), x)); };
  const auto lowered = [](__m128 rounded, __m128 is_too_high) {
    const __m128i bits = _mm_castps_si128(rounded);
    // 1 below 0, and −1 above
    const __m128i down = _mm_or_si128(_mm_set1_epi32(1), _mm_srai_epi32(_mm_xor_si128(bits, _mm_set1_epi32(-1)), 31));
    return _mm_castsi128_ps(_mm_add_epi32(bits, _mm_and_si128(down, _mm_castps_si128(is_too_high))));
  };
  const __m128 of_a = nearest(a), of_b = nearest(b), of_c = nearest(c);
  const __m128 above = _mm_shuffle_ps(is_above(of_a, a), is_above(of_b, b), _MM_SHUFFLE(2, 0, 2, 0));
  const __m128 above_c = _mm_shuffle_ps(is_above(of_c, c), _mm_setzero_ps(), _MM_SHUFFLE(2, 0, 2, 0));
  ab = reinterpret_cast<FourFloats>(lowered(_mm_movelh_ps(of_a, of_b), above));
  c_alone = reinterpret_cast<FourFloats>(lowered(of_c, above_c));
}

FloatBox box_of_way(const Positions& begin, const Positions& end, Index vertex, Real pad) {
  const Real* const from = begin.data() + 3 * vertex;
  const Real* const to = end.data() + 3 * vertex;
  const __m128d from_xy = _mm_loadu_pd(from), to_xy = _mm_loadu_pd(to);
  const __m128d from_z = _mm_load_sd(from + 2), to_z = _mm_load_sd(to + 2);
  const __m128d pads = _mm_set1_pd(pad);
  const __m128d low_xy = _mm_min_pd(from_xy, to_xy) - pads, high_xy = _mm_max_pd(from_xy, to_xy) + pads;
  const __m128d low_z = _mm_min_pd(from_z, to_z) - pads, high_z = _mm_max_pd(from_z, to_z) + pads;
  FourFloats low, high;  // x, y and z of the low corner, z of the other one turned over; its x and y
  round_down(low_xy, _mm_unpacklo_pd(low_z, -high_z), -high_xy, low, high);
  const FourFloats none{};
  return {__builtin_shufflevector(low, none, 0, 1, 2, 4),
          __builtin_shufflevector(-high, __builtin_shufflevector(-low, none, 3, 4, 4, 4), 0, 1, 4, 5)};
}
#else
FloatBox box_of_way(const Positions& begin, const Positions& end, Index vertex, Real pad) {
  FloatBox box{};
  for (Eigen::Index a = 0; a < 3; ++a) {
    const auto& [low, high] = std::minmax(begin(vertex, a), end(vertex, a));
    box.low[a] = collision::rounded_down(low - pad);
    box.high[a] = collision::rounded_up(high + pad);
  }
  return box;
}
#endif

}  // namespace

PairSearch::PairSearch(const Surface& surface, std::int64_t most)
    : surface_(&surface), most_(most), boxes_(surface.vertices.size()) {
  std::vector<Index> place_of_vertex(surface.body.size(), -1);
  for (std::size_t i = 0; i < surface.vertices.size(); ++i) {
    place_of_vertex[at(surface.vertices[i])] = static_cast<Index>(i);
  }
  std::vector<Index> all_vertices(surface.vertices.size());
  std::iota(all_vertices.begin(), all_vertices.end(), 0);
  const std::span edges(surface.edges);
  const std::span loose = edges.subspan(at(surface.loose_begin));
  const auto add = [&](std::vector<Index> corners, Index corner_count) {
    std::vector<Index> body;
    for (std::size_t c = 0; c < corners.size(); c += at(corner_count)) {
      body.push_back(surface.body[at(surface.vertices[at(corners[c])])]);
    }
    items_.push_back({BoxTree(std::move(corners), corner_count), std::move(body), {}, {}, -1, {}, -1});
  };
  add(places_of_corners(std::span(surface.triangles), place_of_vertex), 3);
  add(places_of_corners(edges, place_of_vertex), 2);
  add(std::move(all_vertices), 1);
  add(places_of_corners(loose, place_of_vertex), 2);
  const Index height =
      std::ranges::max_element(items_, {}, [](const Items& items) { return items.tree.height(); })->tree.height();
  for (Items& items : items_) items.tree.raise(height);
}

void PairSearch::set_held(std::span<const char> is_held) {
  if (std::ranges::none_of(is_held, std::identity{})) is_held = {};
  const auto set = [&](std::size_t place, std::size_t count, auto&& corners_of) {
    std::vector<char>& held = items_[place].is_held;
    held.resize(is_held.empty() ? 0 : count);
    for (std::size_t i = 0; i < held.size(); ++i) {
      held[i] = std::ranges::all_of(corners_of(i), [&](Index v) { return is_held[at(v)] != 0; }) ? 1 : 0;
    }
    items_[place].owned_build = -1;
  };
  set(triangles_place, surface_->triangles.size(), [&](std::size_t i) { return surface_->triangles[i]; });
  set(edges_place, surface_->edges.size(), [&](std::size_t i) { return surface_->edges[i]; });
  set(vertices_place, surface_->vertices.size(), [&](std::size_t i) { return std::array{surface_->vertices[i]}; });
  const auto loose = at(surface_->loose_begin);
  set(loose_edges_place, surface_->edges.size() - loose, [&](std::size_t i) { return surface_->edges[loose + i]; });
}

void PairSearch::set_boxes(const Positions& begin, const Positions& end, std::span<const Real> pads, ThreadPool& pool) {
  const Index count = count_of(surface_->vertices);
  pool.parallel_for((count + items_of_chunk - 1) / items_of_chunk, [&](Index chunk) {
    const Index chunk_end = std::min(count, (chunk + 1) * items_of_chunk);
    for (Index i = chunk * items_of_chunk; i < chunk_end; ++i) {
      const Index vertex = surface_->vertices[at(i)];
      boxes_[at(i)] = box_of_way(begin, end, vertex, pads[at(vertex)]);
    }
  });
}

/// Where all pairs are wanted there are none, which is quicker.
void PairSearch::update_owners(Items& items) {
  const bool all_wanted = items.is_held.empty() && std::ranges::all_of(surface_->meets_itself, std::identity{}) &&
                          std::ranges::none_of(surface_->ignored, std::identity{});
  if (all_wanted) {
    items.owned_build = -1;
  } else if (items.owned_build != items.tree.build_count()) {
    items.owners.set(items.tree, items.body, items.is_held);
    items.owned_build = items.tree.build_count();
  }
}

void PairSearch::update_places(Items& items, const FlatSheets& sheets) {
  if (items.placed_build == items.tree.build_count()) return;
  items.places.set(*surface_, items.tree, sheets);
  items.placed_build = items.tree.build_count();
}

OwnedTree PairSearch::owned(std::size_t place, const FlatSheets* sheets) const {
  const Items& items = items_[place];
  return {&items.tree, items.owned_build < 0 ? nullptr : &items.owners, sheets == nullptr ? nullptr : &items.places,
          sheets};
}

std::span<const Pair> PairSearch::find(const Positions& begin, const Positions& end, std::span<const Real> pads,
                                       ThreadPool& pool, const FarPairs* far, const FlatSheets* sheets) {
  if (!try_find(begin, end, pads, pool, far, sheets)) fail(end);
  return pairs_;
}

bool PairSearch::try_find(const Positions& begin, const Positions& end, std::span<const Real> pads, ThreadPool& pool,
                          const FarPairs* far, const FlatSheets* sheets) {
  set_boxes(begin, end, pads, pool);
  std::array<bool, places> is_fit{};
  for (std::size_t place = 0; place < places; ++place) is_fit[place] = items_[place].tree.refit(boxes_, pool);
  if (!std::ranges::all_of(is_fit, std::identity{})) {
    pool.parallel_for(places, [&](Index place) {
      if (!is_fit[at(place)]) items_[at(place)].tree.build(boxes_);
    });
    for (std::size_t place = 0; place < places; ++place) {
      if (!is_fit[place]) items_[place].tree.refit(boxes_, pool);
    }
  }
  for (Items& items : items_) {
    update_owners(items);
    if (sheets != nullptr) update_places(items, *sheets);
  }
  std::array<std::int64_t, 4> offsets{};
  for (std::size_t k = 0; k < meeting_.size(); ++k) {
    const auto& [kind, a, b] = kinds[k];
    if (!meeting_[k].find(*surface_, owned(a, sheets), owned(b, sheets), most_ - offsets[k], pool)) {
      pairs_.clear();
      crowded_ = k;
      return false;
    }
    if (far != nullptr) meeting_[k].drop_far(kind, *far, pool);
    if (!surface_->joined.is_empty()) meeting_[k].drop_joined(kind, *surface_, pool);
    offsets[k + 1] = offsets[k] + meeting_[k].count();
  }
  pairs_.resize(static_cast<std::size_t>(offsets.back()));
  for (std::size_t k = 0; k < meeting_.size(); ++k) {
    MeetingItems& meeting = meeting_[k];
    const PairKind kind = kinds[k].kind;
    const Index count = items_[kinds[k].a].tree.item_count();
    meeting.sort(count, pool);
    Pair* const to = pairs_.data() + offsets[k];
    pool.parallel_for((count + items_of_chunk - 1) / items_of_chunk, [&](Index chunk) {
      const Index chunk_end = std::min(count, (chunk + 1) * items_of_chunk);
      for (Index i = chunk * items_of_chunk; i < chunk_end; ++i) {
        for (Index p = meeting.begin(i); p < meeting.begin(i + 1); ++p) to[p] = pair_of(kind, i, meeting.second(p));
      }
    });
  }
  return true;
}

Pair PairSearch::pair_of(PairKind kind, Index first, Index second) const {
  const Surface& surface = *surface_;
  if (kind == PairKind::edge_edge) {
    const auto& [a, b] = surface.edges[at(first)];
    const auto& [c, d] = surface.edges[at(second)];
    return {kind, 0, {first, second}, {a, b, c, d}};
  }
  const Index vertex = surface.vertices[at(first)];
  if (kind == PairKind::vertex_triangle) {
    const auto& [a, b, c] = surface.triangles[at(second)];
    return {kind, surface.owned_by_triangle[at(second)], {first, second}, {vertex, a, b, c}};
  }
  const Index edge = surface.loose_begin + second;
  const auto& [a, b] = surface.edges[at(edge)];
  return {kind, surface.owned_by_edge[at(second)], {first, edge}, {vertex, a, b, b}};
}

void PairSearch::fail(const Positions& end) const {
  const Kind& kind = kinds[crowded_];
  const Index item = MeetingItems::crowded_item(*surface_, owned(kind.a, nullptr), owned(kind.b, nullptr), most_);
  const Index vertex = kind.kind == PairKind::edge_edge ? surface_->edges[at(item)][0] : surface_->vertices[at(item)];
  const auto place = std::ranges::find(surface_->vertices, vertex) - surface_->vertices.begin();
  fail_input(fmt::format(
      "contact: more than {} pairs of vertices, edges and triangles are near each other or would pass each other in "
      "one step, many of them at vertex {} of body {}, which goes to ({:g}, {:g}, {:g}) m: move surfaces that lie in "
      "one place apart, or reduce the contact distance or the time step",
      most_, surface_->vertex_in_body[static_cast<std::size_t>(place)], surface_->body[at(vertex)], end(vertex, 0),
      end(vertex, 1), end(vertex, 2)));
}

std::int64_t PairSearch::build_count() const {
  std::int64_t sum = 0;
  for (const Items& items : items_) sum += items.tree.build_count();
  return sum;
}

}  // namespace pliant
