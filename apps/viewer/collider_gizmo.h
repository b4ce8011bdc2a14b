#pragma once
// A handle to move and turn a collider, which a click selects.
#include <string>

#include "viewer/transform_gizmo.h"

namespace pliant_viewer {

class ColliderGizmo final : public TransformGizmo {
 public:
  /// Selects the collider of that name; "": none.
  void select(const std::string& name);
  const std::string& selected() const { return name_; }
  /// Its number in a snapshot, if it is there.
  std::optional<Index> number(const Snapshot& snapshot) const;
  /// Stands where the collider will come to rest, unless it is dragged. `is_visible`: colliders are drawn. Selects
  /// nothing where the collider is gone.
  void follow(const Snapshot& snapshot, bool is_visible);
  void cancel() { *this = ColliderGizmo(); }

 private:
  void look_again(const MouseInteraction::View& view) override;
  void go_on_from(const RigidMotion& motion) override;
  void take(const MouseInteraction::View&) override { has_turned_ = false; }
  std::uint64_t move(const MouseInteraction::View& view) override;
  std::uint64_t let_go(const MouseInteraction::View& view) override;
  void draw_targets(const MouseInteraction::View& view, ImDrawList& list) const override;
  pliant::Pose goal() const;

  std::string name_;
  pliant::Pose pose_{};      // before motion()
  bool has_turned_ = false;  // since it was taken
};

}  // namespace pliant_viewer
