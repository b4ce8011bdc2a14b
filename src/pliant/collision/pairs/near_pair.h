#pragma once
// A pair that may touch in a substep, and what it does where it was looked at last.
#include "pliant/collision/pairs/gap.h"
#include "pliant/collision/pairs/pair_potential.h"

namespace pliant {

struct NearPair {
  Pair pair;
  Real radius = 0;      ///< r, or less where the surfaces are nearer at rest
  Real stiffness = 0;   ///< k without the weight [N/m]
  Real friction = 0;    ///< μ
  Real weight = 1;      ///< w, frozen at a refresh
  Index place = 0;      ///< in the list of near pairs
  Real stiffening = 1;  ///< κ of what its stiffness comes from
  // Friction, frozen at a refresh.
  Real load = 0;  ///< λ [N]; 0: none
  std::array<Real, 4> friction_weights{};
  Vec3 friction_normal = Vec3::UnitZ();
  Vec3 slide_before = Vec3::Zero();  ///< ξ [m]
  // Where it was looked at last.
  Gap gap;
  Potential pushed;
  Friction rubbed;
  Vec3 slide = Vec3::Zero();

  bool is_active() const { return pushed.force > 0 || load > 0; }

  void look(const Positions& q, const Positions& begin) {
    gap = measure(q, pair);
    push(q, begin);
  }
  /// It is known to be at least that far apart, r or more, and has no friction.
  void pass(Real distance) {
    gap.distance = distance;
    pushed = {};
    rubbed = {};
  }
  /// The forces, at the gap that is known.
  void push(const Positions& q, const Positions& begin) {
    const Real k = weight * stiffness;
    pushed = gap.distance < radius && k > 0 ? pair_potential(k, radius, gap.distance) : Potential{};
    rubbed = {};
    if (!(load > 0) || !(k > 0)) return;
    Vec3 way = slide_before;
    for (std::size_t j = 0; j < 4; ++j) {
      const Index v = pair.vertices[j];
      way += friction_weights[j] * (row(q, v) - row(begin, v));
    }
    slide = way - friction_normal.dot(way) * friction_normal;
    rubbed = friction_potential(k, friction * load, slide);
  }
  /// Friction goes by what presses now.
  void freeze(const Positions& q, const Positions& begin) {
    load = pushed.force;
    if (load > 0) {
      friction_weights = gap.weights;
      friction_normal = gap.normal;
    }
    push(q, begin);
  }
  /// pᵀ C p [N m]
  Real curvature(const Positions& p) const {
    Vec3 way = Vec3::Zero();
    Vec3 slid = Vec3::Zero();
    for (std::size_t j = 0; j < 4; ++j) {
      const Vec3 of_vertex = row(p, pair.vertices[j]);
      way += gap.weights[j] * of_vertex;
      slid += friction_weights[j] * of_vertex;
    }
    const Real along = gap.normal.dot(way);
    const Vec3 across = slid - friction_normal.dot(slid) * friction_normal;
    return pushed.curvature * along * along + rubbed.curvature * across.squaredNorm();
  }
  Real energy() const { return pushed.energy + rubbed.energy; }
  /// What of it the pair may give back: without what friction has taken away.
  Real stored_energy() const {
    const Real k = weight * stiffness;
    return pushed.energy + (k > 0 ? rubbed.stored_energy(k) : 0);
  }
  Vec3 force_on(std::size_t corner) const {
    return gap.weights[corner] * pushed.force * gap.normal + friction_weights[corner] * rubbed.force;
  }
};

}  // namespace pliant
