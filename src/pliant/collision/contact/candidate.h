#pragma once
// A vertex that may touch a collider in a substep.
#include <algorithm>
#include <limits>

#include "pliant/collision/contact/potential.h"

namespace pliant {

/// All places are in space, at the end of the substep.
struct ContactCandidate {
  Index vertex = 0;
  Index collider = 0;  ///< its place in the list
  bool is_guarded = false;
  bool has_anchor = false;
  Vec3 begin = Vec3::Zero();  ///< where it was at the beginning, carried by the collider
  Real begin_distance = 0;
  Real radius = 0;       ///< r, or less where the vertex begins inside
  Real floor = 0;        ///< least distance that a move may leave
  Real stiffness = 0;    ///< k [N/m]
  Real load = 0;         ///< λ of friction [N]
  Real coefficient = 0;  ///< μ
  Vec3 anchor = Vec3::Zero();
  Vec3 friction_normal = Vec3::UnitZ();
  // Where the vertex was looked at last; of a half-space the normal stays.
  Vec3 place = Vec3::Constant(std::numeric_limits<Real>::quiet_NaN());
  Real distance = 0;
  Vec3 normal = Vec3::UnitZ();
  Real guard_offset = 0;  ///< of the half-space along its normal
  Real room = 0;          ///< less far from there it touches nothing and may not pass [m]

  /// Of what is known of it, without another look.
  bool is_out_of_reach(const Vec3& x) const { return room > 0 && (x - place).squaredNorm() < room * room; }
  Potential push() const { return normal_potential(stiffness, radius, distance); }
  Friction friction() const { return friction_at(place); }
  Friction friction_at(const Vec3& x) const {
    const Real limit = coefficient * load;
    if (!has_anchor || !(limit > 0)) return {};
    const Vec3 way = x - anchor;
    return friction_potential(stiffness, limit, way - friction_normal.dot(way) * friction_normal);
  }
  /// Whether its way may lead through the collider: that of length l can only where the distances at both ends add up
  /// to no more than l.
  bool may_pass() const {
    if (is_guarded || begin_distance < 0) return false;
    const Real sum = begin_distance + distance;
    return !(sum > 0 && sum * sum > (place - begin).squaredNorm());
  }
  Real room_there() const {
    if (is_guarded || load > 0 || !(distance > radius)) return 0;
    return std::min(distance - radius, (begin_distance + distance - (place - begin).norm()) / 2);
  }
};

}  // namespace pliant
