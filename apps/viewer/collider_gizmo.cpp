#include "viewer/collider_gizmo.h"

#include <algorithm>
#include <functional>

namespace pliant_viewer {
namespace {

using View = MouseInteraction::View;
using Part = TransformGizmo::Part;

std::map<pliant::ColliderId, MovableCollider>::const_iterator find(const std::string& name, const Snapshot& snapshot) {
  return std::ranges::find_if(snapshot.movable, [&](const auto& entry) { return entry.second.name == name; });
}

/// By its name, since what is done before it may give colliders other numbers.
void act_on(Session& session, const std::string& name, const std::function<void(pliant::ColliderId)>& act) {
  if (const auto id = session.simulation().find_collider(name)) act(*id);
}

Part part(Part first, int axis) {
  return static_cast<Part>(static_cast<int>(first) + axis);
}

}  // namespace

void ColliderGizmo::select(const std::string& name) {
  cancel();
  name_ = name;
}

std::optional<Index> ColliderGizmo::number(const Snapshot& snapshot) const {
  const auto found = find(name_, snapshot);
  return found == snapshot.movable.end() ? std::nullopt : std::optional(static_cast<Index>(found->first));
}

void ColliderGizmo::follow(const Snapshot& snapshot, bool is_visible) {
  if (name_.empty() || !is_up_to_date(snapshot)) return;
  const auto found = find(name_, snapshot);
  if (found == snapshot.movable.end()) return cancel();
  pose_ = found->second.pose;
  if (!is_visible) return hide();
  Place place{.middle = pose_.position.cast<float>()};
  if (found->second.is_plane) {
    // Along its normal, and about two axes in it: those of space, turned no more than they need be.
    const Vec3f normal = (pose_.rotation * pliant::Vec3::UnitZ()).cast<float>();
    Index axis = 0;
    normal.cwiseAbs().maxCoeff(&axis);
    const int along = static_cast<int>(axis);
    const Vec3f nearest = (normal[along] < 0 ? -1.0F : 1.0F) * Vec3f::Unit(along);
    place.axes = Eigen::Quaternionf::FromTwoVectors(nearest, normal).toRotationMatrix();
    place.left_out = {Part::plane, part(Part::turn_x, along), part(Part::move_x, (along + 1) % 3),
                      part(Part::move_x, (along + 2) % 3)};
  }
  stand_at(place);
}

void ColliderGizmo::look_again(const View& view) {
  follow(*view.snapshot, view.shows_colliders);
}

/// Where the hand has taken it.
pliant::Pose ColliderGizmo::goal() const {
  const pliant::Vec3 rotation = motion().rotation.cast<Real>();
  const pliant::Pose turned = pliant::moved_on({.rotation = pose_.rotation}, pliant::Vec3::Zero(), rotation, 1);
  return {motion()(pose_.position), turned.rotation};
}

void ColliderGizmo::go_on_from(const RigidMotion&) {
  pose_ = goal();
}

std::uint64_t ColliderGizmo::move(const View& view) {
  has_turned_ = has_turned_ || !motion().rotation.isZero(0);  // and then back to where it was by a turn, too
  if (!has_turned_) {
    return post(view, LiveScene::Kind::steers, [name = name_, to = goal().position](Session& session) {
      act_on(session, name, [&](pliant::ColliderId id) { session.move_collider(id, to.cast<float>()); });
    });
  }
  const Eigen::AngleAxisd turn(goal().rotation);
  return post(view, LiveScene::Kind::steers,
              [name = name_, rotation = pliant::Vec3(turn.angle() * turn.axis())](Session& session) {
                act_on(session, name, [&](pliant::ColliderId id) { session.turn_collider(id, rotation); });
              });
}

std::uint64_t ColliderGizmo::let_go(const View& view) {
  return post(view, LiveScene::Kind::changes, [name = name_](Session& session) {
    act_on(session, name, [&](pliant::ColliderId id) { session.drop_collider(id); });
  });
}

/// On its surface.
void ColliderGizmo::draw_targets(const View& view, ImDrawList& list) const {
  constexpr std::size_t most = 400;
  const auto number_now = number(*view.snapshot);
  for (const pliant_render::DrawnCollider& each : view.snapshot->frame.content.colliders) {
    if (each.number != number_now) continue;
    const std::vector<Vec3f>& points = each.surface->points;
    const pliant::Pose there = goal();
    const std::size_t stride = std::max<std::size_t>(1, points.size() / most);
    for (std::size_t i = 0; i < points.size(); i += stride) {
      const pliant::Vec3 point = points[i].cast<Real>();
      draw_dot(view, each.pose.to_space(point).cast<float>(), there.to_space(point).cast<float>(), list);
    }
  }
}

}  // namespace pliant_viewer
