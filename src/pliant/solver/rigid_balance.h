#pragma once
// Free components that touch something, moved rigidly to where the forces on them as a whole are in balance.
#include "pliant/collision/contact/rigid_couplings.h"
#include "pliant/solver/rigid_moments.h"
#include "pliant/solver/rigid_system.h"
#include "pliant/solver/step_context.h"

namespace pliant {

/// The residual of a component that nothing holds adds up to a force and a torque: what the iterations have left of the
/// balance of its weight, inertia and contact. Global solves reach that late, since the factor resists rotations, and
/// does not know how contact resists anything. No constraint of such a component resists a rigid motion, so steps of
/// Newton's method in its six unknowns are cheap: inertia and elasticity are sums that are made once, and contact is
/// asked at the vertices that touch. Forces of contact and friction then add up to what they should however far the
/// rest has converged.
///
/// Components with a constraint that a rotation does not leave as it is are only translated, and those that the air
/// pushes on, or another force that acts through constraints, stay as they are (RigidFreedom). Each is judged by
/// itself, or with those that it may touch: what would raise the objective is found again.
class RigidBalance {
 public:
  /// Forgets what it knows of the masses: a substep begins.
  void begin() { has_masses_ = false; }
  /// Moves the iterate of `work`; residual and local result, those of that iterate, go with it. Leaves it where a
  /// motion would raise the objective or lead into a collider, and where there is nothing to gain. Returns whether it
  /// has moved anything.
  bool settle(const StepContext& context, WorkingState& work, LocalResult& local);

 private:
  using Motion = RigidResistance::Motion;
  using Matrix = Eigen::Matrix<Real, 6, 6>;

  /// Of the energies of inertia and contact: what a motion must gain to be worth it. A force out of balance by 3e-6 of
  /// the weight gains as much.
  static constexpr Real worthwhile = 1e-11;
  static constexpr Real shorter = 0.4;  // than a motion or way that has raised the objective

  /// What moves on its own: each component, or those that push each other all alike.
  enum class Motions { each, common };

  /// A free component.
  struct Part {
    std::size_t component = 0;
    RigidFreedom freedom = RigidFreedom::none;
    Vec3 center = Vec3::Zero();
    Real weight = 0;              // Σ w with w = M/η² [N/m]
    Mat3 inertia = Mat3::Zero();  // Σ w (|a|² − a aᵀ) of the arms a [N m]
    RigidMoments moments;
    RigidPlacement placement;      // found so far
    RigidPlacement placement_now;  // under trial
    Real rise = 0;                 // of the energy of inertia, there [J]
    Real rise_now = 0;
    Motion force = Motion::Zero();      // on it where it has come to
    Matrix curvature = Matrix::Zero();  // M + C there
    Motion motion = Motion::Zero();     // to be tried from there
    SlidingFriction sliding = SlidingFriction::as_it_is;
    Real share_of_motion = 1;
    Real share_of_way = 1;
    int motions_left = 0;
    int trials_in_vain = 0;  // since one was good
    bool is_light = false;   // nothing touches it, and it would not move either
    bool is_tried = false;   // placement_now
    bool moves = false;
    bool goes_back = false;
  };

  void find_masses(const System& system, const Positions& q);
  void find_moments(const System& system, const WorkingState& work);
  void find_touching(const StepContext& context, const WorkingState& work);
  void find_links();
  void ask_contact(const StepContext& context, const WorkingState& work);

  bool find_placements(const StepContext& context, const WorkingState& work, Motions motions);
  static bool may_gain(const Part& part);
  bool find_motions(Motions motions);
  void find_force(Part& part) const;
  static bool is_misplaced(const Part& part);
  bool is_worthwhile(std::span<const std::size_t> parts) const;
  bool find_motion(Part& part);
  bool find_joint_motions(std::size_t set);
  bool solve_jointly(std::size_t set);
  bool find_common_motion(std::size_t set);
  static void try_placement(const RigidPlacement& placement, Part& part);
  bool judge_motions();

  bool go_there(const StepContext& context, WorkingState& work, LocalResult& local);
  bool is_as_expected() const;
  void judge(const StepContext& context, WorkingState& work);
  void find_rises(const StepContext& context);
  static void move(const Part& part, std::span<const Index> vertices, std::span<const Real> weights,
                   WorkingState& work);
  void take_back(std::span<const Index> vertices, WorkingState& work) const;

  bool has_masses_ = false;
  std::vector<Part> parts_;
  std::vector<Index> part_of_component_;       // −1: it is not free
  std::vector<Index> touching_;                // vertices
  Positions trial_;                            // of those
  RigidSystem system_;                         // of parts that push each other
  RigidCouplings couplings_;                   // of components, where they have come to; without links, anything
  std::vector<RigidLink> links_;               // of parts
  std::vector<std::size_t> linked_;            // of each link, its coupling
  std::vector<Motion> motions_;                // of each part; scratch
  std::vector<RigidResistance> resistances_;   // of each component, where it has come to
  std::vector<RigidResistance> trial_result_;  // and under trial
  std::vector<Real> energies_asked_before_;    // of contact, of each component, where placements begin [J]
  std::vector<Real> energies_before_;          // the same, of pairs within components too [J]
  std::vector<Real> energies_;
  std::vector<std::size_t> joined_;  // of each component, the first of those that it may touch
  std::vector<Index> sizes_of_joined_;
  std::vector<Real> rises_;  // of the objective, of each of those [J]
  Positions positions_before_, residual_before_;
};

}  // namespace pliant
