#include "pliant/collision/pairs/tangles.h"

#include <algorithm>
#include <map>
#include <tuple>

#include "pliant/collision/crossings.h"

namespace pliant {
namespace {

/// So many are let go at most; what crosses beyond them is held as it is.
constexpr std::size_t most_crossings = 1'000'000;

std::array<Index, 2> in_order(Index a, Index b) {
  return {std::min(a, b), std::max(a, b)};
}

}  // namespace

void Tangles::clear() {
  let_go_.clear();
  held_up_.clear();
  crossings_.clear();
  first_crossings_.clear();
  known_bodies_.clear();
}

void Tangles::begin(const ContactStep& step, const LetGoState& state) {
  begin_ = &step.begin;
  is_pinned_ = step.is_pinned;
  numbers_ = step.vertices;
  bodies_.assign(at(*std::ranges::max_element(surface_->body) + 1), {});
  for (const Index v : surface_->vertices) {
    BodyPins& pins = bodies_[at(surface_->body[at(v)])];
    (is_pinned_[at(v)] != 0 ? pins.has_pinned : pins.has_free) = true;
  }
  was_known_ = state.is_known;
  clear();
  std::vector<LetGo::Vertices> pairs;
  if (!state.pairs.empty()) {
    std::vector<Index> places(step.masses.size());
    for (std::size_t i = 0; i < places.size(); ++i)
      places[at(number_of(static_cast<Index>(i)))] = static_cast<Index>(i);
    for (const LetGoVertices& each : state.pairs) {
      const LetGo::Vertices pair{places[at(each.vertices[0])], places[at(each.vertices[1])]};
      if (each.is_held_up) held_up_.push_back(pair);
      if (each.is_held_up || was_known_) pairs.push_back(pair);
      known_bodies_.insert({in_order(surface_->body[at(pair[0])], surface_->body[at(pair[1])]), each.is_held_up});
    }
  }
  if (!was_known_) {
    find_all(step.begin);
    const std::vector<LetGo::Vertices> crossing = crossing_vertices();
    pairs.insert(pairs.end(), crossing.begin(), crossing.end());
    first_crossings_ = crossings_;
  }
  let_go_.set(std::move(pairs), step.masses.size());
}

// ---- crossings

void Tangles::find_all(const Positions& q) {
  const std::span edges(surface_->edges);
  find(q, surface_->triangles, edges.subspan(at(surface_->loose_begin)));
}

/// With whole triangles around the centers and around what these have, so that the checker sees all that lies around
/// a point there.
void Tangles::find_around(const std::vector<char>& is_center, const Positions& q) {
  is_around_ = is_center;
  const auto has_one = [](const auto& feature, const std::vector<char>& marks) {
    return std::ranges::any_of(feature, [&](Index v) { return marks[at(v)] != 0; });
  };
  for (const Triangle& each : surface_->triangles) {
    if (!has_one(each, is_center)) continue;
    for (const Index v : each) is_around_[at(v)] = 1;
  }
  triangles_.clear();
  edges_.clear();
  std::ranges::copy_if(surface_->triangles, std::back_inserter(triangles_),
                       [&](const Triangle& each) { return has_one(each, is_around_); });
  std::copy_if(surface_->edges.begin() + surface_->loose_begin, surface_->edges.end(), std::back_inserter(edges_),
               [&](const Edge& each) { return has_one(each, is_around_); });
  find(q, triangles_, edges_);
}

void Tangles::find(const Positions& q, std::span<const Triangle> triangles, std::span<const Edge> edges) {
  crossings_.clear();
  const CrossingInput input{
      .positions = q, .triangles = triangles, .edges = edges, .most_effort = usual_crossing_effort(triangles.size())};
  visit_crossings(input, [&](const Crossing& crossing) {
    const Triangle& triangle = triangles[at(crossing.triangle)];
    const Index a = surface_->body[at(crossing.edge[0])];
    const Index b = surface_->body[at(triangle[0])];
    if (!surface_->may_meet(a, b) || crossings_.size() == most_crossings) return;
    if (!surface_->joined.is_empty() && surface_->joined.are_joined(crossing.edge, triangle)) return;
    if (a == b && goes_as_told(crossing.edge) && goes_as_told(triangle)) return;
    crossings_.push_back({crossing.edge, triangle, crossing.point});
  });
}

std::vector<LetGo::Vertices> Tangles::crossing_vertices() const {
  std::vector<LetGo::Vertices> pairs;
  for (const Passage& each : crossings_) {
    for (const Index end : each.edge) {
      for (const Index corner : each.triangle) pairs.push_back({end, corner});
    }
  }
  return pairs;
}

void Tangles::mark_let_go() {
  is_center_.resize(surface_->body.size());
  for (std::size_t v = 0; v < is_center_.size(); ++v) is_center_[v] = let_go_.has(static_cast<Index>(v)) ? 1 : 0;
}

bool Tangles::follow(const Positions& q) {
  if (let_go_.is_empty()) return false;
  mark_let_go();
  find_around(is_center_, q);
  return let_go_.add(crossing_vertices(), surface_->body.size());
}

// ---- the end of a substep

void Tangles::let_go_too(std::span<const LetGo::Vertices> pairs) {
  if (!pairs.empty()) let_go_.add(pairs, surface_->body.size());
}

void Tangles::let_go_of(std::span<const LetGo::Vertices> held_up) {
  held_up_.insert(held_up_.end(), held_up.begin(), held_up.end());
}

/// Of two pinned surfaces no pairs are looked at, so they may have begun to cross where one has moved.
void Tangles::commit(const Positions& q, std::span<const Real> lags) {
  std::erase_if(held_up_,
                [&](const LetGo::Vertices& pair) { return lags[at(pair[0])] == 0 && lags[at(pair[1])] == 0; });
  const bool are_several_pinned = std::ranges::count_if(bodies_, &BodyPins::has_pinned) > 1;
  const auto may_cross = [&](Index v) {
    return is_pinned_[at(v)] != 0 &&
           (are_several_pinned || lags[at(v)] > 0 || !bodies_[at(surface_->body[at(v)])].is_held());
  };
  lags_ = lags;
  const auto has_moved = [&](Index v) { return may_cross(v) && (q.row(v).array() != begin_->row(v).array()).any(); };
  const bool have_pins_moved = std::ranges::any_of(surface_->vertices, has_moved);
  crossings_.clear();
  if (have_pins_moved || !let_go_.is_empty()) {
    mark_let_go();
    for (const Index v : surface_->vertices) {
      if (have_pins_moved && may_cross(v)) is_center_[at(v)] = 1;
    }
    find_around(is_center_, q);
  }
  lags_ = {};
  std::vector<LetGo::Vertices> pairs = crossing_vertices();
  pairs.insert(pairs.end(), held_up_.begin(), held_up_.end());
  let_go_.set(std::move(pairs), surface_->body.size());
}

void Tangles::write(LetGoState& state) const {
  state.is_known = true;
  LetGo held_up;
  held_up.set(held_up_, surface_->body.size());
  state.pairs.clear();
  for (const auto& [a, b] : let_go_.pairs()) {
    state.pairs.push_back({in_order(number_of(a), number_of(b)), held_up.has(a, b)});
  }
  std::ranges::sort(state.pairs, {}, &LetGoVertices::vertices);
}

Index Tangles::count() const {
  std::set<Index> vertices;
  for (const LetGo::Vertices& each : held_up_) {
    for (const Index v : each) {
      if (is_pinned_[at(v)] != 0) vertices.insert(v);
    }
  }
  return count_of(crossings_) + count_of(vertices);
}

/// In the numbers of the simulation.
LetGoBodies Tangles::bodies_of(const Passage& passage) const {
  LetGoBodies made;
  made.bodies = in_order(surface_->body[at(passage.edge[0])], surface_->body[at(passage.triangle[0])]);
  made.edge = in_order(number_of(passage.edge[0]), number_of(passage.edge[1]));
  for (std::size_t i = 0; i < 3; ++i) made.triangle[i] = number_of(passage.triangle[i]);
  made.place = passage.point;
  return made;
}

LetGoBodies Tangles::bodies_of(const LetGo::Vertices& held_up, const Positions& q) const {
  const std::size_t pinned = is_pinned_[at(held_up[0])] != 0 ? 0 : 1;
  const Index vertex = number_of(held_up[pinned]);
  const Index other = number_of(held_up[1 - pinned]);
  LetGoBodies made;
  made.bodies = in_order(surface_->body[at(held_up[0])], surface_->body[at(held_up[1])]);
  made.is_held_up = true;
  made.edge = {vertex, vertex};
  made.triangle = {other, other, other};
  made.place = row(q, held_up[pinned]);
  return made;
}

std::vector<LetGoBodies> Tangles::new_bodies(const Positions& q) const {
  std::map<BodiesKey, LetGoBodies> found;
  const auto note = [&](const LetGoBodies& each) {
    const BodiesKey key{each.bodies, each.is_held_up};
    if (known_bodies_.contains(key)) return;
    LetGoBodies& first = found.try_emplace(key, each).first->second;
    if (std::tie(each.edge, each.triangle) < std::tie(first.edge, first.triangle)) first = each;
  };
  for (const Passage& each : first_crossings_) note(bodies_of(each));
  for (const Passage& each : crossings_) note(bodies_of(each));
  for (const LetGo::Vertices& each : held_up_) note(bodies_of(each, q));
  std::vector<LetGoBodies> bodies;
  for (const auto& [key, each] : found) bodies.push_back(each);
  return bodies;
}

}  // namespace pliant
