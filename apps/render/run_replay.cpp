#include "render/run_replay.h"

#include <map>

#include "pliant/collision/colliders/surface.h"

namespace pliant_render {
namespace {

using pliant::AnimatedCollider;
using pliant::ColliderId;
using pliant::Vec3;

/// Takes the colliders where a step would.
void move_colliders(pliant::Simulation& simulation) {
  if (simulation.colliders().empty()) return;
  pliant::State state = simulation.state();
  bool has_moved = false;
  for (pliant::ColliderState& each : state.contact.colliders) {
    const pliant::ColliderMotion& motion = simulation.collider(ColliderId{each.collider}).motion;
    const pliant::Pose before = each.pose;
    each.pose = each.target.value_or(
        moved_on(before, motion.velocity, motion.angular_velocity, simulation.settings().time_step));
    has_moved = has_moved || each.target || !(each.pose == before);
    each.target.reset();
  }
  if (has_moved) simulation.restore(state);
}

/// The ball around all bodies where they are.
struct Surroundings {
  Vec3 middle = Vec3::Zero();
  pliant::Real radius = 0.5;
};

Surroundings surroundings_of(const pliant::Simulation& simulation) {
  const pliant::Positions& x = simulation.state().positions;
  if (x.rows() == 0) return {};
  const Vec3 low = x.colwise().minCoeff().transpose(), high = x.colwise().maxCoeff().transpose();
  return {(low + high) / 2, std::max<pliant::Real>((high - low).norm() / 2, 1e-3)};
}

AnimatedCollider make_collider(const pliant::Simulation& simulation, ColliderId id, const Surroundings& bodies) {
  constexpr pliant::Real radii = 6;  // from the middle of a plane to its edges
  const pliant::ColliderShape& shape = *simulation.collider(id).shape;
  AnimatedCollider made{simulation.name(id), shape.surface(radii * bodies.radius), {}, {}, {}};
  made.normals = corner_normals(shape, made.surface);
  if (shape.is_bounded()) return made;
  const Vec3 middle = simulation.pose(id).to_frame(bodies.middle);
  const pliant::SignedDistance down = shape.distance(middle);
  made.surface.vertices.rowwise() += (middle - down.distance * down.normal).transpose();
  return made;
}

}  // namespace

void replay(pliant::Scene& scene, const std::vector<pliant::Real>& times,
            const std::function<void(std::int64_t)>& visit) {
  pliant::Simulation& simulation = scene.simulation;
  std::int64_t step = 0;
  pliant::Real time = 0;
  for (const pliant::Real frame_time : times) {
    // A frame is taken at the end of a step, before what is due at the next one.
    while (time + (1 - 1e-6) * simulation.settings().time_step <= frame_time) {
      scene.timeline.act_due(simulation, step++, time);
      move_colliders(simulation);
      time += simulation.settings().time_step;
    }
    visit(step);
  }
}

std::vector<AnimatedCollider> recorded_colliders(pliant::Scene scene, const std::vector<pliant::Real>& times) {
  const pliant::Simulation& simulation = scene.simulation;
  const Surroundings bodies = surroundings_of(simulation);
  std::map<ColliderId, AnimatedCollider> colliders;
  std::size_t frame = 0;
  replay(scene, times, [&](std::int64_t) {
    for (const auto& [id, record] : simulation.colliders()) {
      auto found = colliders.find(id);
      if (found == colliders.end()) found = colliders.emplace(id, make_collider(simulation, id, bodies)).first;
      found->second.times.push_back(times[frame]);
      found->second.poses.push_back(simulation.pose(id));
    }
    ++frame;
  });
  std::vector<AnimatedCollider> list;
  for (auto& [id, collider] : colliders) {
    if (!collider.surface.triangles.empty()) list.push_back(std::move(collider));
  }
  return list;
}

}  // namespace pliant_render
