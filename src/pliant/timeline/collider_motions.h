#pragma once
// Colliders on their paths: the part of a Timeline that moves them.
#include <memory>
#include <set>
#include <vector>

#include "pliant/timeline/path.h"

namespace pliant {

/// What a motion of a collider keeps of its begin; plain numbers, which a checkpoint holds.
struct ColliderMotionNumbers {
  Index event = -1;                              ///< that began it; -1: it was begun outside of events
  Index order = 0;                               ///< among those that began there
  MotionNumbers numbers;                         ///< of one point, the position of the collider
  Quaternion rotation = Quaternion::Identity();  ///< of the collider when the motion began
};

class ColliderMotions {
 public:
  bool empty() const { return motions_.empty(); }
  /// Takes over from an earlier motion of the collider. A jump is where the next step takes it.
  void start(Simulation& simulation, ColliderId id, std::shared_ptr<Path> path, Index event, Index order);
  void stop(const Simulation& simulation, ColliderId id);
  /// Ends the motion of a collider; those that would start later do not.
  void leave_alone(const Simulation& simulation, ColliderId id);

  /// Before a step: motions end whose colliders are gone.
  void prepare(const Simulation& simulation);
  /// Sets where the step takes the colliders.
  void go_on(Simulation& simulation);
  /// After a step that failed.
  void go_back(Simulation& simulation) const;
  /// After one that was taken.
  void end_what_arrived();

  std::vector<ColliderMotionNumbers> numbers() const;
  /// Puts back what numbers() has returned; motions of others end. Throws Error(input) on numbers of a motion that has
  /// not begun, and on those that no motion can have.
  void restore(const Simulation& simulation, const std::vector<ColliderMotionNumbers>& numbers);

 private:
  struct Motion {
    ColliderId collider{};
    std::shared_ptr<Path> path;
    ColliderMotionNumbers state;
    std::optional<Pose> before{};  // the target before the step under way
    bool has_arrived = false;      // with that step
  };

  static Pose pose(const Simulation& simulation, const Motion& motion, Real elapsed);
  void leave(ColliderId id);

  std::vector<Motion> motions_;
  std::set<ColliderId> left_alone_;
};

}  // namespace pliant
