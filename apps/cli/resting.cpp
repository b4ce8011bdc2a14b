#include "resting.h"

#include <algorithm>
#include <array>

#include "pliant/collision/crossings.h"
#include "pliant/forces/gravity.h"
#include "pliant/simulation/held.h"

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

/// Whether a ray from the point in the direction `down` meets a triangle.
bool is_over(const Vec3& point, const Vec3& down, const std::array<Vec3, 3>& corners) {
  const Vec3 a = corners[0] - point, b = corners[1] - point, c = corners[2] - point;
  const std::array<Real, 3> sides{down.dot(a.cross(b)), down.dot(b.cross(c)), down.dot(c.cross(a))};
  const auto [low, high] = std::ranges::minmax(sides);
  if (low * high < 0 || (low == 0 && high == 0)) return false;
  const Vec3 normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  return normal.dot(a) * normal.dot(down) > 0;
}

/// Whether a triangle whose vertices are pinned is straight below one of the vertices.
bool falls_onto_held(const Simulation& simulation, std::span<const Index> vertices, const Vec3& down) {
  constexpr std::size_t most_points = 64;
  if (!simulation.contact().surfaces) return false;
  const std::vector<char> held = pliant::held_vertices(simulation);
  const pliant::Positions& x = simulation.state().positions;
  const std::size_t stride = (vertices.size() + most_points - 1) / most_points;
  for (const pliant::Body& body : simulation.bodies()) {
    for (pliant::Triangle triangle : surface_triangles(body.mesh)) {
      for (Index& corner : triangle) corner += body.first_vertex;
      if (!std::ranges::all_of(triangle, [&](Index v) { return held[pliant::at(v)] != 0; })) continue;
      const std::array corners{pliant::row(x, triangle[0]), pliant::row(x, triangle[1]), pliant::row(x, triangle[2])};
      for (std::size_t i = 0; i < vertices.size(); i += stride) {
        if (is_over(pliant::row(x, vertices[i]), down, corners)) return true;
      }
    }
  }
  return false;
}

}  // namespace

bool is_caught(const Simulation& simulation, std::span<const Index> vertices) {
  if (vertices.empty()) return false;
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
  return falls_onto_held(simulation, vertices, gravity.normalized());
}

}  // namespace pliant_cli
