#include "render/collider_tracks.h"

#include <algorithm>
#include <utility>

#include "pliant/collision/colliders/surface.h"

namespace pliant_render {

using pliant::AnimatedCollider;
using pliant::ColliderId;
using pliant::Real;
using pliant::Vec3;

ColliderTracks::ColliderTracks(const pliant::Simulation& simulation) {
  const pliant::Positions& x = simulation.state().positions;
  if (x.rows() == 0) return;
  const Vec3 low = x.colwise().minCoeff().transpose(), high = x.colwise().maxCoeff().transpose();
  middle_ = (low + high) / 2;
  reach_ = 6 * std::max<Real>((high - low).norm() / 2, 1e-3);
}

void ColliderTracks::add_frame(const pliant::Simulation& simulation, Real time) {
  end_what_went(simulation, time);
  for (const auto& [id, record] : simulation.colliders()) {
    auto open = open_.find(id);
    if (open == open_.end()) {
      open = open_.emplace(id, Open{record.shape, list_.size()}).first;
      list_.push_back(make(simulation, id));
      if (has_frames_) list_.back().from = time;
    }
    AnimatedCollider& track = list_[open->second.place];
    track.times.push_back(time);
    track.poses.push_back(simulation.pose(id));
  }
  has_frames_ = true;
}

std::vector<AnimatedCollider> ColliderTracks::take() {
  std::erase_if(list_, [](const AnimatedCollider& each) { return each.surface.triangles.empty(); });
  return std::move(list_);
}

bool ColliderTracks::looks_alike(const pliant::ColliderShape& a, const pliant::ColliderShape& b) const {
  if (&a == &b) return true;
  const pliant::Mesh one = a.surface(reach_), other = b.surface(reach_);
  return one.triangles == other.triangles && one.vertices.rows() == other.vertices.rows() &&
         one.vertices == other.vertices;
}

void ColliderTracks::end_what_went(const pliant::Simulation& simulation, Real time) {
  for (auto open = open_.begin(); open != open_.end();) {
    auto& [shape, place] = open->second;
    const auto found = simulation.colliders().find(open->first);
    if (found != simulation.colliders().end() && simulation.name(open->first) == list_[place].name &&
        looks_alike(*shape, *found->second.shape)) {
      shape = found->second.shape;
      ++open;
    } else {
      list_[place].until = time;
      open = open_.erase(open);
    }
  }
}

AnimatedCollider ColliderTracks::make(const pliant::Simulation& simulation, ColliderId id) const {
  const pliant::ColliderShape& shape = *simulation.collider(id).shape;
  AnimatedCollider made{simulation.name(id), shape.surface(reach_), {}, {}, {}};
  made.normals = corner_normals(shape, made.surface);
  if (shape.is_bounded()) return made;
  const Vec3 middle = simulation.pose(id).to_frame(middle_);
  const pliant::SignedDistance down = shape.distance(middle);
  made.surface.vertices.rowwise() += (middle - down.distance * down.normal).transpose();
  return made;
}

}  // namespace pliant_render
