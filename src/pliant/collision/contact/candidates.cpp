// Which vertices may touch which colliders in a substep, and how they are kept outside.
#include <algorithm>
#include <limits>

#include "pliant/collision/contact/body_contact.h"
#include "pliant/collision/contact/contact.h"
#include "pliant/collision/contact/stiffness.h"

namespace pliant {
namespace {

/// Of r: the least distance that a move leaves.
constexpr Real least_gap = 0.05;
/// Cosine between the normals where a way goes in and where it ends, below which it goes on to another side.
constexpr Real same_side = 0.866;
constexpr int most_sweeps = 4;

/// Where a straight way in the frame of a convex shape goes in first, if it does: steps as long as the distance.
std::optional<Vec3> entry(const ColliderShape& shape, const Vec3& from, const Vec3& to, Real precision) {
  const Vec3 way = to - from;
  const Real length = way.stableNorm();
  Real gone = 0;
  for (int i = 0; i < 64; ++i) {
    const Vec3 point = from + gone / length * way;
    const Real distance = shape.distance(point).distance;
    if (distance <= precision) return point;
    gone += distance;
    if (gone >= length) return std::nullopt;
  }
  return from + gone / length * way;
}

/// The straight way of a vertex in the frame of a collider.
struct Way {
  Vec3 first, last;
  Real begin_distance, end_distance;

  Way(const ContactCollider& collider, const Vec3& from, const Vec3& to)
      : first(collider.begin.to_frame(from)),
        last(collider.end.to_frame(to)),
        begin_distance(collider.shape->distance(first).distance),
        end_distance(collider.shape->distance(last).distance) {}
  /// How far its end may go before it meets the collider: a way can do so only where it is as long as the distances at
  /// both ends together.
  Real reach() const { return (begin_distance + end_distance - (last - first).norm()) / 2; }
};

/// About some vertices.
struct Ball {
  Vec3 center;
  Real radius;

  Ball(const Positions& positions, Index begin, Index end) {
    const auto rows = positions.middleRows(begin, end - begin);
    const Vec3 least = rows.colwise().minCoeff().transpose();
    const Vec3 most = rows.colwise().maxCoeff().transpose();
    center = (least + most) / 2;
    radius = (most - least).norm() / 2;
  }
};

/// How near a vertex of a contact distance that goes so far in a substep is worth a look.
Real slack_of(Real contact_distance, Real way) {
  return 2 * contact_distance + way / 2;
}

}  // namespace

void Contact::begin_substep(const ContactStep& step, const ContactState& state, Positions& q, ThreadPool& threads) {
  step_.emplace(step);
  stiffening_ = state.stiffening;
  held_back_ = 0;
  turns_.clear();
  for (const ContactCollider& each : colliders_) {
    const Mat3 rotation = each.end.rotation.toRotationMatrix();
    turns_.push_back({rotation, rotation == Mat3::Identity()});
  }
  const auto count = static_cast<Index>(q.rows());
  reference_.resize(count, 3);
  margins_.resize(at(count));
  chunks_.resize(at((count + vertices_of_chunk - 1) / vertices_of_chunk));
  memory_of_vertices_.assign(at(count), count_of(state.memory));
  for (Index i = count_of(state.memory); i-- > 0;) memory_of_vertices_[at(state.memory[at(i)].vertex)] = i;
  for_each_chunk(threads, [&](Chunk& chunk, Index begin, Index end) {
    chunk.candidates.clear();
    find_candidates(chunk, begin, end, q);
    hold_back(chunk, begin, end, q);
    for (Candidate& each : chunk.candidates) recall(state, q, each);
  });
  find_forces(q, threads);
}

HeldBack Contact::hold_back(Positions& q, ThreadPool& threads) {
  for_each_chunk(threads, [&](Chunk& chunk, Index begin, Index end) {
    if (!is_current(begin, end, q)) find_candidates(chunk, begin, end, q);
    hold_back(chunk, begin, end, q);
  });
  HeldBack sum;
  for (const Chunk& chunk : chunks_) {
    sum.has_moved |= chunk.done.has_moved;
    sum.has_new_potential |= chunk.done.has_new_potential;
    held_back_ += chunk.held_back;
  }
  return sum;
}

bool Contact::is_current(Index begin, Index end, const Positions& q) const {
  for (Index i = begin; i < end; ++i) {
    const Real margin = margins_[at(i)];
    if (!((q.row(i) - reference_.row(i)).squaredNorm() <= margin * margin)) return false;
  }
  return true;
}

/// How far the vertices of a chunk may still go from q before one of them can touch a collider, and the way from its
/// beginning counted; 0 where each must be looked at by itself. They lie in a ball about the middle of theirs, at the
/// beginning and now, and nearer to a collider by no more than its radius.
void Contact::find_reaches(Chunk& chunk, Index begin, Index end, const Positions& q) const {
  const Ball first(step_->begin, begin, end);
  const Ball last(q, begin, end);
  const Real spread = first.radius + last.radius;
  const Real radius = *std::ranges::max_element(step_->radii.subspan(at(begin), at(end - begin)));
  const Real slack = slack_of(radius, (last.center - first.center).norm() + spread);
  chunk.reaches.clear();
  for (const ContactCollider& each : colliders_) {
    const Way way(each, first.center, last.center);
    const Real reach = std::min(way.end_distance - last.radius - radius, way.reach() - spread);
    chunk.reaches.push_back(reach >= slack ? reach : 0);
  }
}

/// All that were candidates before stay.
void Contact::find_candidates(Chunk& chunk, Index begin, Index end, const Positions& q) {
  std::swap(chunk.before, chunk.candidates);
  chunk.candidates.clear();
  find_reaches(chunk, begin, end, q);
  auto old = chunk.before.begin();
  for (Index i = begin; i < end; ++i) {
    reference_.row(i) = q.row(i);
    Real& margin = margins_[at(i)];
    margin = std::numeric_limits<Real>::infinity();
    if (step_->is_pinned[at(i)] || is_inner(i)) continue;
    const Real radius = step_->radii[at(i)];
    const Vec3 from = row(step_->begin, i);
    const Vec3 to = row(q, i);
    const Real slack = slack_of(radius, (to - from).norm());
    for (Index c = 0; c < count_of(colliders_); ++c) {
      if (old != chunk.before.end() && old->vertex == i && old->collider == c) {
        chunk.candidates.push_back(*old++);
        continue;
      }
      Real reach = chunk.reaches[at(c)];
      if (!(reach > 0)) {
        const Way way(colliders_[at(c)], from, to);
        reach = std::min(way.end_distance - radius, way.reach());
        if (!(reach >= slack)) {
          chunk.candidates.push_back(
              make_candidate(i, c, colliders_[at(c)].end.to_space(way.first), way.begin_distance));
          continue;
        }
      }
      margin = std::min(margin, reach);
    }
  }
}

/// A vertex that begins inside is led out by one contact distance a step, and no move may lead it further in.
ContactCandidate Contact::make_candidate(Index vertex, Index collider, const Vec3& begin, Real begin_distance) const {
  const Real radius = step_->radii[at(vertex)];
  const auto number = at(number_of(vertex));
  Candidate made;
  made.vertex = vertex;
  made.collider = collider;
  made.begin = begin;
  made.begin_distance = begin_distance;
  made.radius = std::min(radius, begin_distance + radius);
  made.floor = std::min(least_gap * radius, begin_distance);
  made.stiffness = least_stiffness(vertex);
  if (!stiffening_.empty()) made.stiffness *= stiffening_[number];
  made.coefficient = coefficient(vertex, colliders_[at(collider)]);
  return made;
}

/// k where κ = 1.
Real Contact::least_stiffness(Index vertex) const {
  return stiffness_ratio * step_->masses[at(vertex)] / (step_->time_step * step_->time_step);
}

Real Contact::coefficient(Index vertex, const ContactCollider& collider) const {
  if (step_->frictions.empty() || step_->frictions[at(vertex)] < 0) return collider.friction;
  const std::optional<Real> of_collider = collider.has_own_friction ? std::optional(collider.friction) : std::nullopt;
  return friction_between(step_->frictions[at(vertex)], of_collider, collider.friction);
}

/// What the last step has left of a contact.
void Contact::recall(const ContactState& state, const Positions& q, Candidate& candidate) const {
  const Index number = number_of(candidate.vertex);
  const Index collider = colliders_[at(candidate.collider)].number;
  for (Index i = memory_of_vertices_[at(number)]; i < count_of(state.memory); ++i) {
    const ContactMemory& each = state.memory[at(i)];
    if (each.vertex != number) return;
    if (each.collider != collider) continue;
    candidate.has_anchor = true;
    candidate.anchor = carried(candidate, colliders_[at(candidate.collider)].end.to_space(each.anchor));
    candidate.load = each.load;
    candidate.room = 0;
    look_at(candidate, row(q, candidate.vertex));
    candidate.friction_normal = candidate.normal;
  }
}

void Contact::find_distance(Candidate& candidate, const Vec3& x) const {
  const SignedDistance found = distance_at(candidate, x);
  candidate.place = x;
  candidate.distance = found.distance;
  candidate.normal = found.normal;
  if (!candidate.is_guarded) candidate.room = candidate.room_there();
}

SignedDistance Contact::distance_at(const Candidate& candidate, const Vec3& x) const {
  if (candidate.is_guarded) return {candidate.normal.dot(x) - candidate.guard_offset, candidate.normal};
  const ContactCollider& collider = colliders_[at(candidate.collider)];
  const Turn& turn = turns_[at(candidate.collider)];
  const Vec3 arm = x - collider.end.position;
  if (turn.is_none) return collider.shape->distance(arm);
  const SignedDistance found = collider.shape->distance(turn.rotation.transpose() * arm);
  return {found.distance, turn.rotation * found.normal};
}

/// Makes the collider a half-space to a vertex whose way here, where it was looked at, leads through it.
bool Contact::guard(Candidate& candidate) const {
  const ContactCollider& collider = colliders_[at(candidate.collider)];
  const ColliderShape& shape = *collider.shape;
  const Vec3 from = collider.end.to_frame(candidate.begin);
  const Vec3 to = collider.end.to_frame(candidate.place);
  const Vec3 last_normal = collider.end.rotation.conjugate() * candidate.normal;
  if (shape.distance(from).normal.dot(last_normal) >= same_side) return false;
  const std::optional<Vec3> place = entry(shape, from, to, least_gap * least_gap * step_->radii[at(candidate.vertex)]);
  if (!place) return false;
  const Vec3 normal = shape.distance(*place).normal;
  if (normal.dot(last_normal) >= same_side) return false;
  candidate.is_guarded = true;
  candidate.room = 0;
  candidate.normal = collider.end.rotation * normal;
  candidate.guard_offset = candidate.normal.dot(collider.end.to_space(*place));
  candidate.distance = candidate.normal.dot(candidate.place) - candidate.guard_offset;
  return true;
}

/// A vertex that has gone far may meet what it could not meet where it was.
void Contact::hold_back(Chunk& chunk, Index begin, Index end, Positions& q) {
  chunk.done = {};
  chunk.held_back = 0;
  for (int round = 0; round < most_sweeps; ++round) {
    if (round > 0) find_candidates(chunk, begin, end, q);
    const Index before = chunk.held_back;
    const std::span<Candidate> all = chunk.candidates;
    chunk.forces.resize(all.size());
    for (std::size_t i = 0, next = 0; i < all.size(); i = next) {
      const Vec3 x = row(q, all[i].vertex);
      bool is_far = true;
      for (; next < all.size() && all[next].vertex == all[i].vertex; ++next) {
        look_at(all[next], x);
        is_far &= all[next].distance >= all[next].floor && !all[next].may_pass();
      }
      if (!is_far) hold_back(all.subspan(i, next - i), chunk, q);
      for (std::size_t k = i; k < next; ++k) chunk.forces[k] = force(all[k]);
    }
    if (chunk.held_back == before || is_current(begin, end, q)) return;
  }
}

/// Where it is held back from one collider it may get too near to another: a few sweeps.
void Contact::hold_back(std::span<Candidate> of_vertex, Chunk& chunk, Positions& q) const {
  for (int sweep = 0; sweep < most_sweeps; ++sweep) {
    bool has_moved = false;
    for (Candidate& each : of_vertex) {
      const Vec3 x = row(q, each.vertex);
      look_at(each, x);
      if (each.may_pass()) chunk.done.has_new_potential |= guard(each);
      if (!(each.distance < each.floor)) continue;
      const Vec3 held = x + (each.floor - each.distance) * each.normal;
      if (held == x) continue;
      q.row(each.vertex) = held.transpose();
      has_moved = true;
      ++chunk.held_back;
    }
    chunk.done.has_moved |= has_moved;
    if (!has_moved || of_vertex.size() == 1) break;
  }
  for (Candidate& each : of_vertex) look_at(each, row(q, each.vertex));
}

}  // namespace pliant
