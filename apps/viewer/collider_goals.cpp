#include "viewer/collider_goals.h"

#include <algorithm>
#include <numbers>

#include "pliant/collision/colliders/builtin.h"
#include "viewer/suggestions.h"

namespace pliant_viewer {
namespace {

constexpr Real turning_speed = std::numbers::pi;  // the most by which they turn [rad/s]
constexpr Real least_turn = 1e-9;                 // [rad]: less is the same rotation, but for rounding

bool is_plane(const pliant::Simulation& simulation, pliant::ColliderId id) {
  return simulation.collider(id).shape->type() == pliant::PlaneCollider::info.name;
}

}  // namespace

ColliderGoals::ColliderGoals(const pliant::Simulation& simulation) : speed_(suggest_collider_speed(simulation)) {}

bool ColliderGoals::can_move(const pliant::Simulation& simulation, pliant::ColliderId id) {
  const auto found = simulation.colliders().find(id);
  return found != simulation.colliders().end() && (found->second.shape->is_bounded() || is_plane(simulation, id));
}

pliant::Pose ColliderGoals::pose(const pliant::Simulation& simulation, pliant::ColliderId id) const {
  const auto goal = goals.find(id);
  return goal == goals.end() ? simulation.pose(id) : goal->second;
}

void ColliderGoals::move(const pliant::Simulation& simulation, pliant::ColliderId id, const pliant::Vec3& position) {
  pliant::Pose goal = pose(simulation, id);
  if (is_plane(simulation, id)) {
    const pliant::Vec3 normal = goal.rotation * pliant::Vec3::UnitZ();
    goal.position += normal.dot(position - goal.position) * normal;
  } else {
    goal.position = position;
  }
  goals[id] = goal;
}

void ColliderGoals::turn(const pliant::Simulation& simulation, pliant::ColliderId id, const pliant::Vec3& rotation) {
  pliant::Pose goal = pose(simulation, id);
  goal.rotation = pliant::moved_on({}, pliant::Vec3::Zero(), rotation, 1).rotation;
  goals[id] = goal;
}

void ColliderGoals::steer(pliant::Simulation& simulation) {
  const Real most = speed_ * simulation.settings().time_step;
  const Real most_turn = turning_speed * simulation.settings().time_step;
  std::erase_if(goals, [&](const auto& entry) {
    const auto& [id, goal] = entry;
    if (!simulation.colliders().contains(id)) return true;
    pliant::Pose pose = simulation.pose(id);
    const pliant::Vec3 way = goal.position - pose.position;
    const Real length = way.norm(), angle = pose.rotation.angularDistance(goal.rotation);
    if (length == 0 && angle <= least_turn) return true;
    pose.position = length > most ? pliant::Vec3(pose.position + way * (most / length)) : goal.position;
    if (angle > most_turn) {
      pose.rotation = pose.rotation.slerp(most_turn / angle, goal.rotation);
    } else if (angle > least_turn) {
      pose.rotation = goal.rotation;
    }
    simulation.set_target(id, pose);
    return false;
  });
}

}  // namespace pliant_viewer
