#pragma once
// Energy projection: after a step, positions and velocities go onto the energy that each connected component should
// have, so that the integrator neither takes nor adds any (after Dinev et al. 2018, FEPR; here each component by
// itself, positions in the metric of the system matrix, and with the work of forces and moved pins).
//
//     H* = T(vₙ) + V(qₙ) + W                     what the component had, and what was done on it from outside
//     q ← q + λ Y⁻¹ ∇H,  v ← v_rigid + (1 + λ) (v − v_rigid)      with λ such that T + V = H*
//
// V is the elastic energy of all constraints but external ones (ConstraintGroup::is_external: soft pins, drags, what a
// force brings): these count as forces from outside, with the force at which the step leaves them, so their own springs
// stay damped by the step. A component that nothing holds is seen from its center, whose flight is left alone, and
// v_rigid is its turning with the angular momentum that it should have; of a component that something holds v_rigid
// is 0. What a step has too much and may not be taken at once is the surplus: T + V = H* + surplus, always.
#include <cmath>

#include "pliant/solver/global/components.h"
#include "pliant/solver/integration/rigid_motion.h"

namespace pliant {

/// How the vertices stand at one end of a step, in the order of the local step.
struct StepEnd {
  const Positions& positions;       ///< m × 3 [m]
  const Positions& velocities;      ///< m × 3 [m/s]
  std::span<const Real> elastic;    ///< V of each component [J]
  const Positions& elastic_forces;  ///< −∇V, pinned vertices among them, m × 3 [N]
};

class EnergyBalance {
 public:
  /// The components, which of them nothing holds, and which vertices are pinned.
  void set_components(Components components, const Components& free_components, std::span<const char> is_pinned);

  /// Keeps what a step begins with. threads: of all that follows until finish(). Masses [kg] are referred to until
  /// finish(). Surplus [J]: what components have had too much and are not to be given back, at any vertex of each; or
  /// none.
  void begin(const StepEnd& begin, std::span<const Real> masses, std::span<const Real> surplus, ThreadPool& threads);

  /// Balances a step of length h [s] that ends so. outside: what acts on the vertices from outside in it, m × 3 [N];
  /// its work is F·(qₙ₊₁ − qₙ), along the path that the vertices take: no other sum is free of drift, since velocities
  /// are what the projection itself changes. share: of what is missing, how much is to be given back. Writes the force
  /// −∇H on each vertex, m × 3 [N], zero at pinned ones.
  void balance(const StepEnd& end, const Positions& outside, Real h, Real share, Positions& forces);

  /// Moves the positions at that end along `direction`, which is Y⁻¹ of those forces. weights: M/h² of each vertex.
  /// `positions` may be those of the end.
  void move(const StepEnd& end, const Positions& forces, const Positions& direction, std::span<const Real> weights,
            Positions& positions);

  /// Gives the velocities what is missing still where move() has left the positions; their V and the forces are now
  /// those there. `velocities` may be those of the end.
  void finish(const StepEnd& end, const Positions& outside, Positions& velocities);

  /// Surplus for the next step, m numbers [J].
  void write_surplus(std::span<Real> surplus) const;

 private:
  struct Account {
    Real target = 0;                       // T + V of the beginning, then what it should be at the end
    Real elastic = 0;                      // at the end, before move()
    Real work = 0;                         // from outside, up to there
    Real surplus = 0;                      // see begin()
    Real noise = 0;                        // energies that are no larger are rounding
    Vec3 center = Vec3::Zero();            // at the beginning, of a component that nothing holds
    Vec3 velocity = Vec3::Zero();          // of it
    Vec3 angular_momentum = Vec3::Zero();  // about it: of the beginning, then that of the end
  };

  /// What is done on a component from outside.
  struct Work {
    Real sum = 0;   // relative to the center of a component that nothing holds [J]
    Real size = 0;  // of its terms
    Vec3 torque = Vec3::Zero();
    void add(Real energy) {
      sum += energy;
      size += std::abs(energy);
    }
    Work& operator+=(const Work& other) {
      sum += other.sum;
      size += other.size;
      torque += other.torque;
      return *this;
    }
  };

  // Of one component; inside: the threads of loops over its vertices, or none.
  RigidMotion rigid_motion(std::size_t component, const Positions& positions, const Positions& velocities,
                           ThreadPool* inside) const;
  Real non_rigid_energy(std::size_t component, const RigidMotion& rigid, const Positions& positions,
                        const Positions& velocities, ThreadPool* inside) const;
  Work outside_work(std::size_t component, const RigidMotion& rigid, const StepEnd& end, const Positions& outside,
                    ThreadPool* inside) const;
  Vec3 allowed_momentum(std::size_t component, const RigidMotion& rigid, Real elastic, Real scaled) const;
  void begin_component(std::size_t component, const StepEnd& begin, std::span<const Real> surplus, ThreadPool* inside);
  void balance_component(std::size_t component, const StepEnd& end, const Positions& outside, Real h, Real share,
                         ThreadPool* inside);
  void write_forces(std::size_t component, const StepEnd& end, const Positions& outside, Positions& forces,
                    ThreadPool* inside) const;
  void move_component(std::size_t component, const StepEnd& end, const Positions& forces, const Positions& direction,
                      std::span<const Real> weights, Positions& positions, ThreadPool* inside) const;
  void finish_component(std::size_t component, const StepEnd& end, const Positions& outside, Positions& velocities,
                        ThreadPool* inside);

  Components components_;
  std::vector<char> is_free_;    // of each component
  std::vector<char> is_pinned_;  // of each vertex
  std::vector<Account> accounts_;
  ThreadPool* threads_ = nullptr;
  std::span<const Real> masses_;
  Positions positions_, velocities_, elastic_forces_;  // at the beginning
};

}  // namespace pliant
