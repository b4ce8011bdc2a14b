#pragma once
// Colliders from frame to frame, for exports.
#include <map>
#include <memory>
#include <vector>

#include "pliant_io/export/animation.h"

namespace pliant_render {

class ColliderTracks {
 public:
  /// Of a collider without end a square below the middle of the bodies as they are now is shown, six times as wide as
  /// they are.
  explicit ColliderTracks(const pliant::Simulation& simulation);

  /// Where colliders are in a frame at this time [s], rising from call to call.
  void add_frame(const pliant::Simulation& simulation, pliant::Real time);
  /// Those that have a surface, with when each is there. One whose shape or name changes goes, and another one comes.
  std::vector<pliant::AnimatedCollider> take();

 private:
  struct Open {
    std::shared_ptr<const pliant::ColliderShape> shape;
    std::size_t place;  // in the list
  };

  bool looks_alike(const pliant::ColliderShape& a, const pliant::ColliderShape& b) const;
  void end_what_went(const pliant::Simulation& simulation, pliant::Real time);
  pliant::AnimatedCollider make(const pliant::Simulation& simulation, pliant::ColliderId id) const;

  pliant::Vec3 middle_ = pliant::Vec3::Zero();  // of the bodies [m]
  pliant::Real reach_ = 3;                      // from the middle of a shape without end to its edges [m]
  std::map<pliant::ColliderId, Open> open_;
  std::vector<pliant::AnimatedCollider> list_;
  bool has_frames_ = false;
};

}  // namespace pliant_render
