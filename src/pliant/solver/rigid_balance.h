#pragma once
// Free components that touch something, moved rigidly to where the forces on them as a whole are in balance.
#include "pliant/solver/step_context.h"

namespace pliant {

/// The residual of a component that nothing holds adds up to a force and a torque: what the iterations have left of the
/// balance of its weight, inertia and contact. Global solves reach that late, since the factor resists rotations, and
/// does not know how contact resists anything. No constraint of such a component resists a rigid motion, so a step of
/// Newton's method in its six unknowns is cheap, and forces of contact and friction add up to what they should however
/// far the rest has converged.
///
/// Components with a constraint that a rotation does not leave as it is are only translated, and those that the air
/// pushes on, or another force that acts through constraints, stay as they are (RigidFreedom). Each is judged by
/// itself: the motion of one that would raise the objective is taken back and found again.
class RigidBalance {
 public:
  /// Forgets what it knows of the masses: a substep begins.
  void begin() { has_masses_ = false; }
  /// Moves the iterate of `work` a few times; residual and local result, those of that iterate, go with it. Leaves it
  /// where a motion would raise the objective or lead into a collider, and where there is nothing to gain. Returns
  /// whether it has moved anything.
  bool settle(const StepContext& context, WorkingState& work, LocalResult& local);

 private:
  using Motion = RigidResistance::Motion;

  /// A free component.
  struct Part {
    std::size_t component = 0;
    RigidFreedom freedom = RigidFreedom::none;
    Vec3 center = Vec3::Zero();
    Real weight = 0;                // Σ w with w = M/η² [N/m]
    Mat3 inertia = Mat3::Zero();    // Σ w (|a|² − a aᵀ) of the arms a [N m]
    Motion force = Motion::Zero();  // Σ r and its torque about the center
    Real energy = 0;                // of its inertia [J]
    SlidingFriction sliding = SlidingFriction::as_it_is;
    Real share = 1;  // of a motion that is taken
    bool moves = false;
    bool goes_back = false;
    Vec3 shift = Vec3::Zero();
    Mat3 rotation = Mat3::Identity();
    Real rise = 0;  // of the objective [J]
  };

  void find_masses(const System& system, const Positions& q);
  static void find_force(const System& system, std::span<const Index> vertices, const WorkingState& work, Part& part);
  bool find_motions(const StepContext& context, const WorkingState& work);
  static bool is_misplaced(const Part& part);
  static bool find_motion(const RigidResistance& resistance, Part& part);
  void find_rises(const StepContext& context);
  bool try_motions(const StepContext& context, WorkingState& work, LocalResult& local);
  void judge(const StepContext& context, WorkingState& work);
  static Real move(const Part& part, std::span<const Index> vertices, std::span<const Real> weights,
                   WorkingState& work);
  void take_back(std::span<const Index> vertices, WorkingState& work) const;

  bool has_masses_ = false;
  std::vector<Part> parts_;
  std::vector<RigidResistance> resistances_;  // of each component
  std::vector<Real> energies_;                // of contact, of each component [J]
  std::vector<std::size_t> joined_;           // of each component, the first of those that it may touch
  std::vector<Real> rises_;                   // of the objective, of each of those [J]
  Positions positions_before_, residual_before_;
};

}  // namespace pliant
