#include "resting.h"

#include <algorithm>

#include "pliant/forces/gravity.h"

namespace pliant_cli {
namespace {

using pliant::Index;
using pliant::Real;
using pliant::Simulation;
using pliant::Vec3;

/// Of all gravity that acts on a vertex [m/s²].
Vec3 gravity_on(const Simulation& simulation, Index vertex) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [id, force] : simulation.forces()) {
    const auto* gravity = simulation.options<pliant::Gravity>(id);
    if (gravity == nullptr) continue;
    const std::vector<pliant::ForceBody> bodies = simulation.scope(id).bodies;
    const bool acts = std::ranges::any_of(bodies, [vertex](const pliant::ForceBody& body) {
      return vertex >= body.first_vertex && vertex < body.first_vertex + body.rest.vertex_count();
    });
    if (acts) sum += gravity->acceleration;
  }
  return sum;
}

/// Whether a ray meets a shape, both in its frame: in steps as long as the distance, until that no longer falls, which
/// it never does again on a ray beside a convex shape.
bool meets(const pliant::ColliderShape& shape, Vec3 point, const Vec3& direction) {
  constexpr int most_steps = 200;  // as many only where a ray almost grazes
  constexpr Real nearly = 1e-6;    // [m]
  for (int i = 0; i < most_steps; ++i) {
    const pliant::SignedDistance here = shape.distance(point);
    if (here.distance < nearly) return true;
    if (!(here.normal.dot(direction) < 0)) return false;
    point += here.distance * direction;
  }
  return false;
}

}  // namespace

bool falls_onto_collider(const Simulation& simulation, std::span<const Index> vertices) {
  if (vertices.empty() || simulation.colliders().empty()) return false;
  const Vec3 gravity = gravity_on(simulation, vertices.front());
  if (!(gravity.norm() > 0)) return false;
  for (const auto& [id, collider] : simulation.colliders()) {
    const pliant::ColliderShape& shape = *collider.shape;
    const pliant::Pose& pose = simulation.pose(id);
    const Vec3 down = pose.rotation.conjugate() * gravity.normalized();
    const bool catches = std::ranges::any_of(vertices, [&](Index vertex) {
      const Vec3 point = simulation.state().positions.row(vertex).transpose();
      return meets(shape, pose.to_frame(point), down);
    });
    if (catches) return true;
  }
  return false;
}

}  // namespace pliant_cli
