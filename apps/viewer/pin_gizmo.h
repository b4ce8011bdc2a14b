#pragma once
// A handle to move and turn pins together.
#include <vector>

#include "viewer/transform_gizmo.h"

namespace pliant_viewer {

class PinGizmo final : public TransformGizmo {
 public:
  /// Stands in the middle of the selected pins, unless it is dragged.
  void follow(const std::vector<std::uint32_t>& selected, const Snapshot& snapshot);
  void cancel() { *this = PinGizmo(); }

 private:
  void look_again(const MouseInteraction::View& view) override;
  void go_on_from(const RigidMotion& motion) override;
  void take(const MouseInteraction::View& view) override;
  std::uint64_t move(const MouseInteraction::View& view) override;
  std::uint64_t let_go(const MouseInteraction::View& view) override;
  void draw_targets(const MouseInteraction::View& view, ImDrawList& list) const override;

  std::vector<Index> pins_;     // vertices
  std::vector<Vec3f> targets_;  // of these, before motion() [m]
};

}  // namespace pliant_viewer
