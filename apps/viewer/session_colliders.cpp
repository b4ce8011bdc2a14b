// Colliders of a session: moved and turned by hand.
#include <array>

#include "viewer/session.h"

namespace pliant_viewer {
namespace {

/// Ends what a collider does by itself.
void stop_collider(pliant::Simulation& simulation, pliant::ColliderId id) {
  for (const pliant::Parameter& each : list_parameters(simulation, id)) {
    const bool moves_it = each.handle.option == "velocity" || each.handle.option == "angular_velocity";
    if (moves_it && !each.value.isZero(0)) set_parameter(simulation, each.handle, pliant::Vec3::Zero());
  }
}

}  // namespace

void Session::take_collider(pliant::ColliderId collider) {
  scene_.timeline.leave_alone(scene_.simulation, collider);
  left_alone_.insert(collider);
  stop_collider(scene_.simulation, collider);
}

void Session::move_collider(pliant::ColliderId collider, const Vec3f& position) {
  if (!ColliderGoals::can_move(simulation(), collider) || !position.allFinite()) return;
  const auto noted = note(action::MoveCollider{static_cast<Index>(collider), position});
  take_collider(collider);
  goals_.move(simulation(), collider, position.cast<Real>());
}

void Session::turn_collider(pliant::ColliderId collider, const pliant::Vec3& rotation) {
  if (!ColliderGoals::can_move(simulation(), collider) || !rotation.allFinite()) return;
  const auto noted = note(action::TurnCollider{static_cast<Index>(collider), rotation});
  take_collider(collider);
  goals_.turn(simulation(), collider, rotation);
}

void Session::drop_collider(pliant::ColliderId collider) {
  const auto noted = note(action::DropCollider{static_cast<Index>(collider)});
  const auto goal = goals_.goals.find(collider);
  if (goal == goals_.goals.end() || simulation().state().step > 0) return;
  const pliant::Pose before = simulation().pose(collider);
  // The mouse knows places in single precision, a saved scene has them as they are written.
  const bool is_turned = before.position.cast<float>() == goal->second.position.cast<float>();
  if (is_turned) goal->second.position = before.position;
  Edit edit{.what = is_turned ? "turn a collider" : "move a collider", .before = changes_};
  SceneChanges changes = changes_;
  const std::string& name = simulation().colliders().at(collider).name;
  changes.collider_poses[name] = goal->second;
  for (const char* option : {".center", ".from", ".to", ".rotation", ".position", ".normal"}) {
    changes.values.erase("collider:" + name + option);
  }
  pliant::Scene next = make_with(changes, unchanged_);
  goals_.goals.erase(goal);
  left_alone_.erase(collider);
  changes_ = std::move(changes);
  take(std::move(next));
  remember(std::move(edit));
}

std::map<pliant::ColliderId, MovableCollider> Session::movable_colliders() const {
  std::map<pliant::ColliderId, MovableCollider> movable;
  for (const auto& [id, collider] : simulation().colliders()) {
    if (!ColliderGoals::can_move(simulation(), id)) continue;
    movable[id] = {collider.name, goals_.pose(simulation(), id), !collider.shape->is_bounded()};
  }
  return movable;
}

/// Of another scene, by their names.
void Session::renumber_colliders(const pliant::Simulation& next) {
  const auto number_of = [&](pliant::ColliderId id) {
    const auto before = simulation().colliders().find(id);
    return before == simulation().colliders().end() ? std::nullopt : next.find_collider(before->second.name);
  };
  std::set<pliant::ColliderId> left_alone;
  for (const pliant::ColliderId id : left_alone_) {
    if (const auto now = number_of(id)) left_alone.insert(*now);
  }
  std::map<pliant::ColliderId, pliant::Pose> goals;
  for (const auto& [id, goal] : goals_.goals) {
    if (const auto now = number_of(id)) goals[*now] = goal;
  }
  left_alone_ = std::move(left_alone);
  goals_.goals = std::move(goals);
}

}  // namespace pliant_viewer
