#include "pliant/collision/pairs/planes.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pliant {
namespace {

constexpr Real unit_roundoff = std::numeric_limits<Real>::epsilon();
/// Of a distance: corners that come nearer than a tenth of it need a plane.
constexpr Real free_share = 0.9;
/// Of a gap: how far from the plane each side stays.
constexpr Real kept_share = 0.05;
/// Of a gap: what must be left of it where the ways end. A little less than the half-spaces leave, lest rounding count.
constexpr Real end_share = 0.09;
/// The same across the closest points: what has so much needs no plane by the first rule of choose().
constexpr Real clear_share = 0.1;
/// Of the distance, or of r if that is less: the gap of a plane that is worth to hold something back.
constexpr Real least_gap_share = 0.3;
constexpr int sweeps = 4;
/// In units of rounding, see the head of planes.h.
constexpr Real touching_units = 16;
constexpr Real certain_units = 100;
constexpr Real tight_units = 1000;
constexpr Real apart_units = 32;
constexpr Real end_units = 90;

std::uint8_t bit(std::size_t j) {
  return static_cast<std::uint8_t>(1U << j);
}

/// Calls visit(chunk, begin, end) for chunks of `size` in [0, count).
template <class Visit>
void for_each_part(ThreadPool& threads, Index count, Index size, Visit&& visit) {
  threads.parallel_for((count + size - 1) / size,
                       [&](Index chunk) { visit(chunk, chunk * size, std::min(count, chunk * size + size)); });
}

template <class Item>
void join(const std::vector<std::vector<Item>>& parts, Index count, std::vector<Item>& all) {
  all.clear();
  for (Index i = 0; i < count; ++i) all.insert(all.end(), parts[at(i)].begin(), parts[at(i)].end());
}

}  // namespace

/// A plane that might separate a pair.
struct Planes::Candidate {
  Vec3 normal = Vec3::Zero();
  std::array<Real, 4> heights{};  ///< of the corners over the middle of the gap
  Real gap = 0;
  Real end_gap = 0;  ///< between the sides where their ways end
  Real cost = 0;     ///< how far these ends pass it

  /// The room of a corner that lies on its own side.
  Real room(std::size_t j, bool is_first) const { return (is_first ? heights[j] : -heights[j]) - kept_share * gap; }
};

Shortened Planes::shorten(const PlanesInput& input, Positions& y, ThreadPool& threads) {
  Shortened done;
  begin(input, y, threads);
  find_near(threads);
  add_half_spaces();
  move_changed(y, threads);
  for (;;) {
    find_endangered(threads);
    if (endangered_.empty()) break;
    if (done.passes == 0) find_normals();
    ++done.passes;
    add_planes(threads, done);
    if (changed_.empty() && done.passes > 1) break;
    move_changed(y, threads);
  }
  done.vertices = static_cast<Index>(std::ranges::count(is_shortened_, char{1}));
  input_ = nullptr;
  return done;
}

void Planes::begin(const PlanesInput& input, const Positions& y, ThreadPool& threads) {
  input_ = &input;
  const auto count = static_cast<Index>(y.rows());
  wishes_.resize(count, 3);
  moves_.resize(count, 3);
  ways_.resize(at(count));
  slacks_.resize(at(count));
  reaches_.resize(at(count));
  for_each_part(threads, count, vertices_of_chunk, [&](Index, Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      moves_.row(i) = y.row(i) - input.begin.row(i);
      wishes_.row(i) = moves_.row(i);
      ways_[at(i)] = moves_.row(i).norm();
      slacks_[at(i)] = tight_units * unit_roundoff * (input.begin.row(i).cwiseAbs().maxCoeff() + ways_[at(i)]);
      reaches_[at(i)] = ways_[at(i)] + slacks_[at(i)];
    }
  });
  bounds_.clear();
  first_bound_.assign(at(count), -1);
  is_changed_.assign(at(count), 0);
  is_shortened_.assign(at(count), 0);
  changed_.clear();
}

/// The longest of the first side and the longest of the second.
Real Planes::reach(const Pair& pair, const std::vector<Real>& lengths) const {
  const auto length = [&](std::size_t j) { return lengths[at(pair.vertices[j])]; };
  return pair.kind == PairKind::edge_edge ? std::max(length(0), length(1)) + std::max(length(2), length(3))
                                          : length(0) + std::max({length(1), length(2), length(3)});
}

/// Pairs that could meet if any of their ways became shorter.
void Planes::find_near(ThreadPool& threads) {
  const Index count = count_of(input_->pairs);
  const Index chunks = (count + pairs_of_chunk - 1) / pairs_of_chunk;
  if (count_of(near_chunks_) < chunks) near_chunks_.resize(at(chunks));
  for_each_part(threads, count, pairs_of_chunk, [&](Index chunk, Index first, Index last) {
    std::vector<Near>& found = near_chunks_[at(chunk)];
    found.clear();
    for (Index i = first; i < last; ++i) {
      Near near{i, input_->distances.empty() ? 0 : input_->distances[at(i)]};
      if (is_near(near)) found.push_back(near);
    }
  });
  join(near_chunks_, chunks, near_);
}

bool Planes::is_near(Near& near) const {
  // absolute ways: once some corners are held back, the others move against them
  const Real most = reach(input_->pairs[at(near.pair)], reaches_);
  if (most < free_share * near.distance) return false;
  near.is_waiting = is_endangered(near);  // measures it if that matters now
  return !(most < free_share * near.distance);
}

/// Whether a plane may be needed now.
bool Planes::is_endangered(Near& near) const {
  return is_in_reach(near) && !is_clear(near);
}

/// Whether the sides could come together: no points of them move farther against each other than two of their corners.
bool Planes::is_in_reach(Near& near) const {
  const Pair& pair = input_->pairs[at(near.pair)];
  const int first_side = pair.first_side();
  Real squared_motion = 0;
  for (int i = 0; i < first_side; ++i) {
    const auto move = moves_.row(pair.vertices[at(i)]);
    for (int j = first_side; j < 4; ++j) {
      squared_motion = std::max(squared_motion, (move - moves_.row(pair.vertices[at(j)])).squaredNorm());
    }
  }
  if (!(squared_motion > 0)) return false;
  const Real slack = reach(pair, slacks_);
  const auto is_far = [&] {
    const Real free = free_share * near.distance - slack;
    return free > 0 && squared_motion < free * free;
  };
  if (is_far()) return false;
  if (near.is_measured) return true;
  const Gap gap = measure(input_->begin, pair);
  near.distance = gap.distance;
  near.normal = gap.normal;
  near.is_measured = true;
  return !is_far();
}

/// Whether a measured pair is apart across its closest points at q and at the ends of the ways: what choose() finds
/// first, without the rest.
bool Planes::is_clear(const Near& near) const {
  const Pair& pair = input_->pairs[at(near.pair)];
  const Positions& q = input_->begin;
  const Vec3 origin = row(q, pair.vertices[0]);
  constexpr Real far = std::numeric_limits<Real>::infinity();
  std::array<Real, 2> above{far, far};
  std::array<Real, 2> below{-far, -far};
  const int first_side = pair.first_side();
  for (int j = 0; j < 4; ++j) {
    const Index vertex = pair.vertices[at(j)];
    const Real height = near.normal.dot(row(q, vertex) - origin);
    const Real end = height + near.normal.dot(row(moves_, vertex));
    if (j < first_side) above = {std::min(above[0], height), std::min(above[1], end)};
    if (j >= first_side) below = {std::max(below[0], height), std::max(below[1], end)};
  }
  const Real slack = reach(pair, slacks_);  // at least 500 u; choose() asks for certain_units and end_units
  const Real gap = above[0] - below[0];
  return gap >= slack && above[1] - below[1] >= std::max(clear_share * gap, slack);
}

void Planes::add_bound(Index vertex, const Vec3& normal, Real room) {
  bounds_.push_back({normal, room, first_bound_[at(vertex)]});
  first_bound_[at(vertex)] = count_of(bounds_) - 1;
}

void Planes::mark(Index vertex) {
  if (is_changed_[at(vertex)] != 0) return;
  is_changed_[at(vertex)] = 1;
  is_shortened_[at(vertex)] = 1;
  changed_.push_back(vertex);
}

void Planes::add_half_spaces() {
  for (const HalfSpace& each : input_->half_spaces) {
    const Real room = std::max(Real{0}, each.room);
    add_bound(each.vertex, each.normal, room);
    if (each.normal.dot(row(moves_, each.vertex)) < -room) mark(each.vertex);
  }
}

/// Which pairs may need a plane now, of those that waited or have a corner that was changed in the last pass.
void Planes::find_endangered(ThreadPool& threads) {
  const Index count = count_of(near_);
  const Index chunks = (count + pairs_of_chunk - 1) / pairs_of_chunk;
  if (count_of(endangered_chunks_) < chunks) endangered_chunks_.resize(at(chunks));
  for_each_part(threads, count, pairs_of_chunk, [&](Index chunk, Index first, Index last) {
    std::vector<Index>& found = endangered_chunks_[at(chunk)];
    found.clear();
    for (Index i = first; i < last; ++i) {
      Near& near = near_[at(i)];
      if (near.is_done) continue;
      const auto& vertices = input_->pairs[at(near.pair)].vertices;
      const auto is_changed = [&](Index vertex) { return is_changed_[at(vertex)] != 0; };
      if (!near.is_waiting && std::ranges::none_of(vertices, is_changed)) continue;
      near.is_waiting = false;
      if (is_endangered(near)) found.push_back(i);
    }
  });
  join(endangered_chunks_, chunks, endangered_);
  for (const Index vertex : changed_) is_changed_[at(vertex)] = 0;
  changed_.clear();
}

/// Sums of the areas of the triangles around each vertex of a near pair.
void Planes::find_normals() {
  const Positions& q = input_->begin;
  has_normal_.assign(at(static_cast<Index>(q.rows())), 0);
  for (const Near& near : near_) {
    for (const Index vertex : input_->pairs[at(near.pair)].vertices) has_normal_[at(vertex)] = 1;
  }
  normals_.setZero(q.rows(), 3);
  for (const auto& [a, b, c] : input_->surface.triangles) {
    if (has_normal_[at(a)] == 0 && has_normal_[at(b)] == 0 && has_normal_[at(c)] == 0) continue;
    const Vec3 area = (row(q, b) - row(q, a)).cross(row(q, c) - row(q, a));
    for (const Index vertex : {a, b, c}) normals_.row(vertex) += area.transpose();
  }
}

/// Sets the rest of a candidate from its normal.
void Planes::look_at(const Pair& pair, Candidate& candidate) const {
  const Positions& q = input_->begin;
  const Vec3 origin = row(q, pair.vertices[0]);
  const auto first_side = static_cast<std::size_t>(pair.first_side());
  constexpr Real far = std::numeric_limits<Real>::infinity();
  std::array<Real, 2> above{far, far};
  std::array<Real, 2> below{-far, -far};
  std::array<Real, 4> ways{};
  for (std::size_t j = 0; j < 4; ++j) {
    ways[j] = candidate.normal.dot(row(moves_, pair.vertices[j]));
    candidate.heights[j] = candidate.normal.dot(row(q, pair.vertices[j]) - origin);
    const std::array<Real, 2> heights{candidate.heights[j], candidate.heights[j] + ways[j]};
    for (std::size_t end = 0; end < 2; ++end) {
      if (j < first_side) above[end] = std::min(above[end], heights[end]);
      if (j >= first_side) below[end] = std::max(below[end], heights[end]);
    }
  }
  candidate.gap = above[0] - below[0];
  candidate.end_gap = above[1] - below[1];
  const Real middle = below[0] + candidate.gap / 2;
  candidate.cost = 0;
  for (std::size_t j = 0; j < 4; ++j) {
    candidate.heights[j] -= middle;
    const Real towards = j < first_side ? -ways[j] : ways[j];
    candidate.cost = std::max(candidate.cost, towards - candidate.room(j, j < first_side));
  }
}

/// The plane that is least in the way; one that no corner passes where none is needed.
Planes::Plane Planes::choose(const Pair& pair, int pass) const {
  const Positions& q = input_->begin;
  Real size = 0;
  Real radius = std::numeric_limits<Real>::infinity();
  std::array<Vec3, 4> x;
  for (std::size_t j = 0; j < 4; ++j) {
    x[j] = row(q, pair.vertices[j]);
    size = std::max(size, x[j].cwiseAbs().maxCoeff());
    radius = std::min(radius, input_->radii[at(pair.vertices[j])]);
  }
  const Gap gap = measure(q, pair);
  if (!(gap.distance > touching_units * unit_roundoff * size)) return {.is_touching = true};
  // what only passes by a surface waits until what lies over it has a plane, lest it be taken for an obstacle ahead
  if (pass == 0 && !is_minimum_there(q, input_->surface, pair, gap)) return {.is_waiting = true};
  std::array<Vec3, 5> normals;
  normals.fill(Vec3::Zero());
  normals[0] = gap.normal;
  if (pair.kind == PairKind::edge_edge) normals[1] = (x[1] - x[0]).cross(x[3] - x[2]);
  if (pair.kind == PairKind::vertex_triangle) normals[1] = (x[2] - x[1]).cross(x[3] - x[1]);
  Vec3 motion = Vec3::Zero();
  for (std::size_t j = 0; j < 4; ++j) {
    const bool is_first = static_cast<int>(j) < pair.first_side();
    normals[is_first ? 2 : 3] += row(normals_, pair.vertices[j]);
    const Vec3 way = row(moves_, pair.vertices[j]);
    motion += is_first ? Vec3(way / pair.first_side()) : Vec3(-way / (4 - pair.first_side()));
  }
  // in the first pass a vertex that falls and runs ahead would find its way past the triangle below it
  if (pass > 0) normals[4] = gap.normal * motion.squaredNorm() - gap.normal.dot(motion) * motion;
  const Real thick = least_gap_share * std::min(gap.distance, radius);
  const Real certain = certain_units * unit_roundoff * size;
  const Real unit = unit_roundoff * (size + longest_way(pair));
  Candidate best;
  best.cost = std::numeric_limits<Real>::infinity();
  for (std::size_t i = 0; i < 5; ++i) {
    const Real length = normals[i].norm();
    if (!(length > 0)) continue;
    Candidate candidate;
    candidate.normal = normals[i] / (normals[i].dot(gap.normal) < 0 ? -length : length);
    look_at(pair, candidate);
    if (!(candidate.gap >= (i == 0 ? certain : tight_units * unit))) continue;
    if (candidate.end_gap >= std::max(end_share * candidate.gap, end_units * unit)) return {};
    if (candidate.cost < best.cost && (i == 0 || candidate.gap >= thick)) best = candidate;
  }
  return make_plane(pair, best, unit);
}

Real Planes::longest_way(const Pair& pair) const {
  Real longest = 0;
  for (const Index vertex : pair.vertices) longest = std::max(longest, ways_[at(vertex)]);
  return longest;
}

Planes::Plane Planes::make_plane(const Pair& pair, const Candidate& best, Real unit) const {
  Plane plane;
  plane.normal = best.normal;
  const bool is_tight = !(best.gap > tight_units * unit);
  const auto first_side = static_cast<std::size_t>(pair.first_side());
  for (std::size_t j = 0; j < 4; ++j) {
    const Index vertex = pair.vertices[j];
    plane.rooms[j] = is_tight ? -apart_units * unit : std::max(Real{0}, best.room(j, j < first_side));
    const Real moved = plane.normal.dot(row(moves_, vertex));
    // what stays may do so, whatever the room
    const bool has_moved = (moves_.row(vertex).array() != 0).any();
    if (has_moved && (j < first_side ? moved : -moved) < -plane.rooms[j]) plane.passed |= bit(j);
  }
  return plane;
}

/// Gives a plane to the endangered pairs that need one, and marks the vertices that pass it. What needs none is looked
/// at again when one of its corners is moved.
void Planes::add_planes(ThreadPool& threads, Shortened& done) {
  const Index count = count_of(endangered_);
  const int pass = done.passes - 1;
  planes_.resize(at(count));
  for_each_part(threads, count, Index{32}, [&](Index, Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      planes_[at(i)] = choose(input_->pairs[at(near_[at(endangered_[at(i)])].pair)], pass);
    }
  });
  for (Index i = 0; i < count; ++i) {
    Near& near = near_[at(endangered_[at(i)])];
    const Plane& plane = planes_[at(i)];
    near.is_done = plane.is_touching || plane.passed != 0;
    near.is_waiting = plane.is_waiting;
    if (plane.is_touching) ++done.touching;
    if (plane.passed == 0) continue;
    ++done.planes;
    const Pair& pair = input_->pairs[at(near.pair)];
    const std::size_t corners = pair.kind == PairKind::vertex_edge ? 3 : 4;
    for (std::size_t j = 0; j < corners; ++j) {
      const bool is_first = static_cast<int>(j) < pair.first_side();
      add_bound(pair.vertices[j], is_first ? plane.normal : Vec3(-plane.normal), plane.rooms[j]);
      if ((plane.passed & bit(j)) != 0) mark(pair.vertices[j]);
    }
  }
}

/// The way of a vertex from q to where it wants, as far as its half-spaces let it.
Vec3 Planes::bounded_way(Index vertex) const {
  const auto for_each_bound = [&](auto&& visit) {
    for (Index i = first_bound_[at(vertex)]; i >= 0; i = bounds_[at(i)].next) visit(bounds_[at(i)]);
  };
  Vec3 way = row(wishes_, vertex);
  for (int sweep = 0; sweep < sweeps; ++sweep) {
    for_each_bound([&](const Bound& bound) {
      const Real moved = bound.normal.dot(way);
      if (moved < -bound.room) way += (-bound.room - moved) * bound.normal;
    });
  }
  const Real length = way.norm();
  Real share = length > ways_[at(vertex)] ? ways_[at(vertex)] / length : 1;
  for_each_bound([&](const Bound& bound) {
    const Real moved = bound.normal.dot(way);
    if (bound.room >= 0 && moved < -bound.room) share = std::min(share, bound.room / -moved);
  });
  if (input_->within != nullptr) share = std::min(share, input_->within->share_within(input_->begin, vertex, way));
  for_each_bound([&](const Bound& bound) {
    if (bound.room < 0 && share * bound.normal.dot(way) < -bound.room / 2) share = 0;
  });
  return share * way;
}

/// Vertices depend on their own half-spaces alone, so their order does not matter.
void Planes::move_changed(Positions& y, ThreadPool& threads) {
  for_each_part(threads, count_of(changed_), Index{64}, [&](Index, Index first, Index last) {
    for (Index i = first; i < last; ++i) {
      const Index vertex = changed_[at(i)];
      const Vec3 way = bounded_way(vertex);
      y.row(vertex) = input_->begin.row(vertex);
      if ((way.array() != 0).any()) y.row(vertex) += way.transpose();
      moves_.row(vertex) = way.transpose();
    }
  });
}

}  // namespace pliant
