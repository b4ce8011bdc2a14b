#pragma once
// Colliders that are moved by hand, and travel to where it took them.
#include <map>
#include <string>

#include "pliant/simulation/simulation.h"
#include "render/vectors.h"

namespace pliant_viewer {

using pliant::Real;

/// A collider that a hand can move.
struct MovableCollider {
  std::string name;
  pliant::Pose pose{};    ///< where it will come to rest
  bool is_plane = false;  ///< moved along its normal alone
};

class ColliderGoals {
 public:
  /// For colliders beside these bodies; those under way are forgotten.
  explicit ColliderGoals(const pliant::Simulation& simulation);

  /// Whether a hand can move and turn it: it has an end, or is a plane.
  static bool can_move(const pliant::Simulation& simulation, pliant::ColliderId id);
  /// Where it will come to rest: its goal, or where it is.
  pliant::Pose pose(const pliant::Simulation& simulation, pliant::ColliderId id) const;
  /// To another place [m]; a plane goes along its normal alone.
  void move(const pliant::Simulation& simulation, pliant::ColliderId id, const pliant::Vec3& position);
  /// About its position, to this rotation: axis times angle [rad].
  void turn(const pliant::Simulation& simulation, pliant::ColliderId id, const pliant::Vec3& rotation);
  /// Sets where the next step takes those that are under way: no farther than their speed lets them.
  void steer(pliant::Simulation& simulation);

  std::map<pliant::ColliderId, pliant::Pose> goals;  ///< of those under way

 private:
  Real speed_;  // the most by which they go there [m/s]
};

}  // namespace pliant_viewer
