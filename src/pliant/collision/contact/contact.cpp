#include "pliant/collision/contact/contact.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "pliant/collision/contact/potential.h"

namespace pliant {
namespace {

/// κ of a vertex goes up where it is pressed below this share of r, and slowly down above the other one.
constexpr Real pressed_gap = 0.3;
constexpr Real light_gap = 0.6;
constexpr Real stiffer = 2;
constexpr Real softer = 0.98;
constexpr Real far_stiffer = 4;

Vec3 across(const Vec3& v, const Vec3& normal) {
  return v - normal * normal.dot(v);
}

}  // namespace

void Contact::set_colliders(std::vector<ContactCollider> colliders) {
  colliders_ = std::move(colliders);
  step_.reset();
  if (colliders_.empty()) points_.clear();
}

ContactSums Contact::add(const Positions& q, Positions& r, ThreadPool& threads) {
  for_each_chunk(threads, [&](Chunk& chunk, Index begin, Index end) {
    chunk.sums = {};
    for (Candidate& each : chunk.candidates) {
      const Vec3 x = row(q, each.vertex);
      look_at(each, x);
      const Potential push = normal_potential(each.stiffness, each.radius, each.distance);
      each.normal_force = push.force;
      each.normal_curvature = push.curvature;
      add_friction(each, x);
      chunk.sums.energy += push.energy + each.friction_energy;
      r.row(each.vertex) += (push.force * each.normal + each.friction).transpose();
    }
    for (Index i = begin; i < end; ++i) {
      chunk.sums.squared_residual = std::max(chunk.sums.squared_residual, r.row(i).squaredNorm());
    }
  });
  return total();
}

ContactSums Contact::refresh(const Positions& q, Positions& r, ThreadPool& threads) {
  for_each_chunk(threads, [&](Chunk& chunk, Index begin, Index end) {
    if (chunk.candidates.empty()) return;
    for (Candidate& each : chunk.candidates) {
      const Vec3 before = each.friction;
      const Real energy_before = each.friction_energy;
      freeze(each);
      add_friction(each, row(q, each.vertex));
      chunk.sums.energy += each.friction_energy - energy_before;
      r.row(each.vertex) += (each.friction - before).transpose();
    }
    chunk.sums.squared_residual = 0;
    for (Index i = begin; i < end; ++i) {
      chunk.sums.squared_residual = std::max(chunk.sums.squared_residual, r.row(i).squaredNorm());
    }
  });
  return total();
}

ContactSums Contact::total() const {
  ContactSums sums;
  for (const Chunk& chunk : chunks_) {
    sums.energy += chunk.sums.energy;
    sums.squared_residual = std::max(sums.squared_residual, chunk.sums.squared_residual);
  }
  return sums;
}

/// The force of friction at x, its curvature and its energy.
void Contact::add_friction(Candidate& candidate, const Vec3& x) const {
  candidate.friction.setZero();
  candidate.friction_curvature = 0;
  candidate.friction_energy = 0;
  const Real limit = colliders_[at(candidate.collider)].friction * candidate.load;
  if (!candidate.has_anchor || !(limit > 0)) return;
  const Vec3 slide = across(x - candidate.anchor, candidate.friction_normal);
  const Real length = slide.norm();
  const Potential pull = friction_potential(candidate.stiffness, limit, length);
  if (length > 0) candidate.friction = -pull.force / length * slide;
  candidate.friction_curvature = pull.curvature;
  candidate.friction_energy = pull.energy;
}

/// Friction goes by what presses now.
void Contact::freeze(Candidate& candidate) const {
  candidate.load = candidate.normal_force;
  if (!(candidate.load > 0)) return;
  candidate.friction_normal = candidate.normal;
  if (candidate.has_anchor) return;
  candidate.anchor =
      carried(candidate, colliders_[at(candidate.collider)].begin.to_frame(row(step_->begin, candidate.vertex)));
  candidate.has_anchor = true;
}

/// Where a point of the collider's surface, in its frame at the beginning, is in space at the end of the substep.
Vec3 Contact::carried(const Candidate& candidate, const Vec3& point) const {
  const ContactCollider& collider = colliders_[at(candidate.collider)];
  Vec3 moved = point;
  if (!collider.surface_velocity.isZero(0)) {
    moved += step_->time_step * across(collider.surface_velocity, collider.shape->distance(point).normal);
  }
  return collider.end.to_space(moved);
}

Real Contact::curvature(const Positions& p) const {
  Real sum = 0;
  for (const Chunk& chunk : chunks_) {
    for (const Candidate& each : chunk.candidates) sum += curvature(each, row(p, each.vertex));
  }
  return sum;
}

Real Contact::stiffened_curvature(const Positions& p) const {
  Real sum = 0;
  if (stiffening_.empty()) return sum;
  for (const Chunk& chunk : chunks_) {
    for (const Candidate& each : chunk.candidates) {
      if (stiffening_[at(number_of(each.vertex))] > far_stiffer) sum += curvature(each, row(p, each.vertex));
    }
  }
  return sum;
}

Real Contact::curvature(const Candidate& candidate, const Vec3& way) {
  const Real along = candidate.normal.dot(way);
  const Real sum = candidate.normal_curvature * along * along;
  if (!(candidate.friction_curvature > 0)) return sum;
  return sum + candidate.friction_curvature * across(way, candidate.friction_normal).squaredNorm();
}

void Contact::add_diagonal(std::span<Real> diagonal) const {
  for (const Chunk& chunk : chunks_) {
    for (const Candidate& each : chunk.candidates) {
      diagonal[at(each.vertex)] += std::max(each.normal_curvature, each.friction_curvature);
    }
  }
}

void Contact::commit(const Positions& q, std::span<const Real> diagonal, ContactState& state) {
  state.memory.clear();
  points_.clear();
  state.stiffening.assign(step_->masses.size(), 1);
  for (std::size_t i = 0; i < stiffening_.size(); ++i) state.stiffening[i] = std::max<Real>(1, softer * stiffening_[i]);
  for (Chunk& chunk : chunks_) {
    for (Candidate& each : chunk.candidates) {
      const Vec3 x = row(q, each.vertex);
      look_at(each, x);
      stiffen(each, diagonal, state);
      each.normal_force = normal_potential(each.stiffness, each.radius, each.distance).force;
      add_friction(each, x);
      if (!(each.normal_force > 0) && each.friction.isZero(0)) continue;
      points_.push_back(point_of(each, x));
      freeze(each);
      if (each.load > 0) state.memory.push_back(memory_of(each, x));
    }
  }
  const auto by_vertex = [](const auto& a, const auto& b) {
    return std::tie(a.vertex, a.collider) < std::tie(b.vertex, b.collider);
  };
  std::ranges::sort(points_, by_vertex);
  std::ranges::sort(state.memory, by_vertex);
  add_up_wrenches();
  if (std::ranges::all_of(state.stiffening, [](Real factor) { return factor == 1; })) state.stiffening.clear();
}

/// The anchor follows what slides, so far that friction pulls with its limit.
ContactMemory Contact::memory_of(const Candidate& candidate, const Vec3& x) const {
  const ContactCollider& collider = colliders_[at(candidate.collider)];
  const Vec3 slide = across(x - candidate.anchor, candidate.friction_normal);
  const Real length = slide.norm();
  const Real most = collider.friction * candidate.load / candidate.stiffness;
  Vec3 anchor = candidate.anchor;
  if (length > most) anchor += (1 - most / length) * slide;
  return {number_of(candidate.vertex), collider.number, collider.end.to_frame(anchor), candidate.load};
}

/// Never beyond what the constraints and the inertia of the vertex resist with.
void Contact::stiffen(const Candidate& candidate, std::span<const Real> diagonal, ContactState& state) const {
  const auto number = at(number_of(candidate.vertex));
  const Real before = stiffening_.empty() ? 1 : stiffening_[number];
  const Real most = std::max<Real>(1, diagonal[at(candidate.vertex)] * before / candidate.stiffness);
  Real& factor = state.stiffening[number];
  if (candidate.distance < pressed_gap * candidate.radius) {
    factor = std::max(factor, std::min(stiffer * before, most));
  } else if (candidate.distance < light_gap * candidate.radius) {
    factor = std::max(factor, before);
  }
}

ContactPoint Contact::point_of(const Candidate& candidate, const Vec3& x) const {
  const ContactCollider& collider = colliders_[at(candidate.collider)];
  ContactPoint point;
  point.vertex = number_of(candidate.vertex);
  point.collider = collider.number;
  point.point = x - candidate.distance * candidate.normal;
  point.normal = candidate.normal;
  point.distance = candidate.distance;
  point.force = candidate.normal_force * candidate.normal + candidate.friction;
  const Vec3 slide = x - carried(candidate, collider.begin.to_frame(row(step_->begin, candidate.vertex)));
  point.friction_power = -candidate.friction.dot(slide) / step_->time_step;
  return point;
}

void Contact::add_up_wrenches() {
  wrenches_.clear();
  for (const ContactCollider& each : colliders_) wrenches_.push_back({each.number, {}});
  for (const ContactPoint& each : points_) {
    const auto place = std::ranges::lower_bound(colliders_, each.collider, {}, &ContactCollider::number);
    Wrench& sum = wrenches_[static_cast<std::size_t>(place - colliders_.begin())].second;
    const Vec3 vertex = each.point + each.distance * each.normal;
    sum.force -= each.force;
    sum.torque -= (vertex - place->end.position).cross(each.force);
  }
}

Wrench Contact::wrench(Index number) const {
  const auto found = std::ranges::find(wrenches_, number, &std::pair<Index, Wrench>::first);
  return found == wrenches_.end() ? Wrench{} : found->second;
}

}  // namespace pliant
