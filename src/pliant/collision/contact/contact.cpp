#include "pliant/collision/contact/contact.h"

#include <algorithm>
#include <cmath>

#include "pliant/collision/contact/stiffness.h"

namespace pliant {
namespace {

/// Of r: a vertex so near to where moves are cut has been held back.
constexpr Real at_floor = 1e-3;

Vec3 across(const Vec3& v, const Vec3& normal) {
  return v - normal * normal.dot(v);
}

}  // namespace

void Contact::set_colliders(std::vector<ContactCollider> colliders) {
  colliders_ = std::move(colliders);
  forget_substep();
  if (!colliders_.empty()) return;
  points_.clear();
  wrenches_.clear();
}

Contact::Force Contact::force(const Candidate& candidate) {
  const Potential pushed = candidate.push();
  const Friction rubbed = candidate.friction();
  return {candidate.vertex, pushed.force * candidate.normal + rubbed.force, pushed.energy + rubbed.energy};
}

void Contact::find_forces(const Positions& q, ThreadPool& threads) {
  for_each_chunk(threads, [&](Chunk& chunk, Index, Index) {
    chunk.forces.clear();
    for (Candidate& each : chunk.candidates) {
      look_at(each, row(q, each.vertex));
      chunk.forces.push_back(force(each));
    }
  });
}

ContactSums Contact::add(Positions& r, ThreadPool& threads) {
  for_each_chunk(threads, [&](Chunk& chunk, Index begin, Index end) {
    for (const Force& each : chunk.forces) r.row(each.vertex) += each.force.transpose();
    add_up(chunk, begin, end, r);
  });
  return total();
}

void Contact::subtract(Positions& r, ThreadPool& threads) {
  for_each_chunk(threads, [&](Chunk& chunk, Index, Index) {
    for (const Force& each : chunk.forces) r.row(each.vertex) -= each.force.transpose();
  });
}

bool Contact::is_anything_near() const {
  return std::ranges::any_of(chunks_, [](const Chunk& chunk) { return !chunk.candidates.empty(); });
}

void Contact::add_touching(std::vector<Index>& vertices) const {
  for (const Chunk& chunk : chunks_) {
    for (const Candidate& each : chunk.candidates) vertices.push_back(each.vertex);
  }
}

/// A candidate is large, so none is copied: where it would be looked at is found beside it.
void Contact::add_resistance(const Positions& q, std::span<const Index> component_of_vertex,
                             std::span<RigidResistance> components) const {
  for (const Chunk& chunk : chunks_) {
    for (const Candidate& each : chunk.candidates) {
      const Vec3 x = row(q, each.vertex);
      if (each.is_out_of_reach(x)) continue;
      const SignedDistance found = each.place == x ? SignedDistance{each.distance, each.normal} : distance_at(each, x);
      RigidResistance& sum = components[at(component_of_vertex[at(each.vertex)])];
      sum.is_blocked |= found.distance < std::min(each.floor, each.distance);
      add_resistance(each, x, found, sum);
    }
  }
}

void Contact::add_resistance(const Candidate& each, const Vec3& x, const SignedDistance& found, RigidResistance& sum) {
  const Potential pushed = normal_potential(each.stiffness, each.radius, found.distance);
  const Friction rubbed = each.friction_at(x);
  sum.energy += pushed.energy + rubbed.energy;
  sum.add_force(x, pushed.force * found.normal + rubbed.force);
  Mat3 stiffness = pushed.curvature * found.normal * found.normal.transpose();
  if (rubbed.curvature > 0) {
    stiffness -= rubbed.curvature * each.friction_normal * each.friction_normal.transpose();
    stiffness.diagonal().array() += rubbed.curvature;
    if (rubbed.curvature < each.stiffness && sum.sliding == SlidingFriction::as_it_is) {
      const Vec3 along = rubbed.force.normalized();
      stiffness -= rubbed.curvature * along * along.transpose();
    }
  }
  sum.add_stiffness(x, stiffness);
}

void Contact::add_energies(std::span<const Index> component_of_vertex, std::span<Real> components) const {
  for (const Chunk& chunk : chunks_) {
    for (const Force& each : chunk.forces) components[at(component_of_vertex[at(each.vertex)])] += each.energy;
  }
}

void Contact::add_stored_energies(std::span<const Index> component_of_vertex, std::span<Real> components) const {
  for (const Chunk& chunk : chunks_) {
    for (const Candidate& each : chunk.candidates) {
      if (each.room > 0) continue;
      components[at(component_of_vertex[at(each.vertex)])] +=
          each.push().energy + each.friction().stored_energy(each.stiffness);
    }
  }
}

void Contact::mark_driven(std::span<const Index> component_of_vertex, std::span<char> components) const {
  for (const Chunk& chunk : chunks_) {
    for (const Candidate& each : chunk.candidates) {
      if (!colliders_[at(each.collider)].is_still()) components[at(component_of_vertex[at(each.vertex)])] = 1;
    }
  }
}

void Contact::renew_force(Chunk& chunk, std::size_t i, Positions& r) {
  const Vec3 before = chunk.forces[i].force;
  chunk.forces[i] = force(chunk.candidates[i]);
  r.row(chunk.forces[i].vertex) += (chunk.forces[i].force - before).transpose();
}

std::optional<ContactSums> Contact::stiffen(Positions& r, std::span<const Real> diagonal, ThreadPool& threads) {
  if (stiffening_.empty()) stiffening_.assign(step_->masses.size(), 1);
  for_each_chunk(threads, [&](Chunk& chunk, Index begin, Index end) {
    chunk.is_stiffer = stiffen(chunk, r, diagonal);
    if (!chunk.is_stiffer) return;
    for (std::size_t i = 0; i < chunk.candidates.size(); ++i) renew_force(chunk, i, r);
    add_up(chunk, begin, end, r);
  });
  if (std::ranges::none_of(chunks_, &Chunk::is_stiffer)) return std::nullopt;
  return total();
}

/// Where the floor holds a vertex, and not the potential, each move is cut there again, and iterates do not get on.
bool Contact::stiffen(Chunk& chunk, const Positions& r, std::span<const Real> diagonal) {
  bool is_stiffer = false;
  for (const Candidate& each : chunk.candidates) {
    if (each.room > 0 || each.distance > each.floor + at_floor * step_->radii[at(each.vertex)]) continue;
    if (!(each.normal.dot(row(r, each.vertex)) < 0)) continue;
    const Real least = least_stiffness(each.vertex);
    const Real most = std::max<Real>(1, diagonal[at(each.vertex)] / least);
    Real& factor = stiffening_[at(number_of(each.vertex))];
    const Real now = std::min(stiffer * each.stiffness / least, most);
    if (!(now > factor)) continue;
    factor = now;
    is_stiffer = true;
  }
  if (!is_stiffer) return false;
  for (Candidate& each : chunk.candidates) {
    each.stiffness = least_stiffness(each.vertex) * stiffening_[at(number_of(each.vertex))];
  }
  return true;
}

ContactSums Contact::refresh(Positions& r, ThreadPool& threads) {
  for_each_chunk(threads, [&](Chunk& chunk, Index begin, Index end) {
    if (chunk.candidates.empty()) return;
    for (std::size_t i = 0; i < chunk.candidates.size(); ++i) {
      freeze(chunk.candidates[i]);
      renew_force(chunk, i, r);
    }
    add_up(chunk, begin, end, r);
  });
  return total();
}

void Contact::add_up(Chunk& chunk, Index begin, Index end, const Positions& r) {
  chunk.sums = {};
  for (const Force& each : chunk.forces) chunk.sums.energy += each.energy;
  for (Index i = begin; i < end; ++i) {
    chunk.sums.squared_residual = std::max(chunk.sums.squared_residual, r.row(i).squaredNorm());
  }
}

ContactSums Contact::total() const {
  ContactSums sums;
  for (const Chunk& chunk : chunks_) {
    sums.energy += chunk.sums.energy;
    sums.squared_residual = std::max(sums.squared_residual, chunk.sums.squared_residual);
  }
  return sums;
}

/// Friction goes by what presses now.
void Contact::freeze(Candidate& candidate) const {
  candidate.load = candidate.push().force;
  if (!(candidate.load > 0)) return;
  candidate.friction_normal = candidate.normal;
  if (candidate.has_anchor) return;
  candidate.anchor = carried(candidate, candidate.begin);
  candidate.has_anchor = true;
}

/// Where the surface velocity takes a point of the collider.
Vec3 Contact::carried(const Candidate& candidate, const Vec3& point) const {
  const ContactCollider& collider = colliders_[at(candidate.collider)];
  if (collider.surface_velocity.isZero(0)) return point;
  const Vec3 normal = collider.shape->distance(collider.end.to_frame(point)).normal;
  return point + step_->time_step * (collider.end.rotation * across(collider.surface_velocity, normal));
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

Real Contact::curvature(const Candidate& candidate, const Vec3& way) const {
  const Real along = candidate.normal.dot(way);
  const Real sum = candidate.push().curvature * along * along;
  const Real of_friction = candidate.friction().curvature;
  if (!(of_friction > 0)) return sum;
  return sum + of_friction * across(way, candidate.friction_normal).squaredNorm();
}

void Contact::add_diagonal(std::span<Real> diagonal) const {
  for (const Chunk& chunk : chunks_) {
    for (const Candidate& each : chunk.candidates) {
      diagonal[at(each.vertex)] += std::max(each.push().curvature, each.friction().curvature);
    }
  }
}

void Contact::commit(const Positions& q, std::span<const Real> diagonal, ContactState& state, ThreadPool& threads) {
  const std::size_t count = step_->masses.size();
  state.stiffening.assign(count, 1);
  for (std::size_t i = 0; i < stiffening_.size(); ++i) state.stiffening[i] = std::max<Real>(1, softer * stiffening_[i]);
  of_vertices_.assign(count, {});
  for_each_chunk(threads, [&](Chunk& chunk, Index, Index) {
    for (Candidate& each : chunk.candidates) {
      look_at(each, row(q, each.vertex));
      stiffen(each, diagonal, state);
      std::span<Candidate>& of_vertex = of_vertices_[at(number_of(each.vertex))];
      of_vertex = {of_vertex.empty() ? &each : of_vertex.data(), of_vertex.size() + 1};
    }
  });
  state.memory.clear();
  points_.clear();
  for (const std::span<Candidate> of_vertex : of_vertices_) {
    for (Candidate& each : of_vertex) keep(each, state);
  }
  add_up_wrenches();
}

void Contact::keep(Candidate& candidate, ContactState& state) {
  const ContactPoint point = point_of(candidate);
  if (point.force.isZero(0)) return;
  points_.push_back(point);
  freeze(candidate);
  if (candidate.load > 0) state.memory.push_back(memory_of(candidate));
}

/// The anchor follows what slides, so far that friction pulls with its limit.
ContactMemory Contact::memory_of(const Candidate& candidate) const {
  const ContactCollider& collider = colliders_[at(candidate.collider)];
  const Vec3 slide = across(candidate.place - candidate.anchor, candidate.friction_normal);
  const Real length = slide.norm();
  const Real most = candidate.coefficient * candidate.load / candidate.stiffness;
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

ContactPoint Contact::point_of(const Candidate& candidate) const {
  const Friction rubbed = candidate.friction();
  ContactPoint point;
  point.vertex = number_of(candidate.vertex);
  point.collider = colliders_[at(candidate.collider)].number;
  point.point = candidate.place - candidate.distance * candidate.normal;
  point.normal = candidate.normal;
  point.distance = candidate.distance;
  point.force = candidate.push().force * candidate.normal + rubbed.force;
  const Vec3 slide = candidate.place - carried(candidate, candidate.begin);
  point.friction_power = -rubbed.force.dot(slide) / step_->time_step;
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
