#include "render/run_replay.h"

#include <map>

#include "pliant/collision/colliders/surface.h"

namespace pliant_render {
namespace {

using pliant::AnimatedCollider;
using pliant::ColliderId;
using pliant::Real;
using pliant::Vec3;

/// Where a run is that is gone through again.
class ReplayedRun {
 public:
  ReplayedRun(pliant::Scene& scene, const pliant::PointCache& frames) : scene_(scene), frames_(frames) {}

  std::int64_t step() const { return clock_.step; }
  /// Goes on as far as to this time [s], which ends a step.
  void go_to(Real time) {
    constexpr Real rounding = 1e-6;  // of a step
    while (clock_.time < time - rounding * time_step()) take_step();
  }

 private:
  Real time_step() const { return scene_.simulation.settings().time_step; }
  bool has_colliders() const { return !scene_.collider_names.empty() || !scene_.simulation.colliders().empty(); }

  void take_step() {
    if (has_colliders()) place_bodies();
    scene_.timeline.act_due(scene_.simulation, clock_.step, clock_.time);
    if (!scene_.simulation.colliders().empty()) move_colliders();
    clock_.advance_time(time_step());
  }

  /// Motions that begin look at the time, and those that follow a body at its vertices.
  void place_bodies() {
    pliant::State state = scene_.simulation.state();
    state.step = clock_.step;
    state.time = clock_.time;
    if (frames_.vertex_count() == state.vertex_count()) frames_.sample(clock_.time, state.positions);
    scene_.simulation.restore(state);
  }

  /// Takes the colliders where a step would.
  void move_colliders() {
    pliant::Simulation& simulation = scene_.simulation;
    scene_.timeline.move_colliders(simulation);
    pliant::State state = simulation.state();
    for (pliant::ColliderState& each : state.contact.colliders) {
      const pliant::ColliderMotion& motion = simulation.collider(ColliderId{each.collider}).motion;
      each.pose =
          each.target ? *each.target : moved_on(each.pose, motion.velocity, motion.angular_velocity, time_step());
      each.target.reset();
    }
    simulation.restore(state);
  }

  pliant::Scene& scene_;
  const pliant::PointCache& frames_;
  pliant::State clock_;  // step and time alone
};

/// The ball around all bodies where they are.
struct Surroundings {
  Vec3 middle = Vec3::Zero();
  Real radius = 0.5;
};

Surroundings surroundings_of(const pliant::Simulation& simulation) {
  const pliant::Positions& x = simulation.state().positions;
  if (x.rows() == 0) return {};
  const Vec3 low = x.colwise().minCoeff().transpose(), high = x.colwise().maxCoeff().transpose();
  return {(low + high) / 2, std::max<Real>((high - low).norm() / 2, 1e-3)};
}

/// Follows colliders from frame to frame.
class ColliderTracks {
 public:
  explicit ColliderTracks(const Surroundings& bodies) : bodies_(bodies) {}

  void add_frame(const pliant::Simulation& simulation, Real time) {
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

  /// Those that have a surface.
  std::vector<AnimatedCollider> take() {
    std::erase_if(list_, [](const AnimatedCollider& each) { return each.surface.triangles.empty(); });
    return std::move(list_);
  }

 private:
  struct Open {
    std::shared_ptr<const pliant::ColliderShape> shape;
    std::size_t place;  // in the list
  };

  /// From the middle of a shape without end to its edges [m].
  Real reach() const { return 6 * bodies_.radius; }

  bool looks_alike(const pliant::ColliderShape& a, const pliant::ColliderShape& b) const {
    if (&a == &b) return true;
    const pliant::Mesh one = a.surface(reach()), other = b.surface(reach());
    return one.triangles == other.triangles && one.vertices.rows() == other.vertices.rows() &&
           one.vertices == other.vertices;
  }

  void end_what_went(const pliant::Simulation& simulation, Real time) {
    for (auto open = open_.begin(); open != open_.end();) {
      auto& [shape, place] = open->second;
      const auto found = simulation.colliders().find(open->first);
      if (found != simulation.colliders().end() && looks_alike(*shape, *found->second.shape)) {
        shape = found->second.shape;
        ++open;
      } else {
        list_[place].until = time;
        open = open_.erase(open);
      }
    }
  }

  AnimatedCollider make(const pliant::Simulation& simulation, ColliderId id) const {
    const pliant::ColliderShape& shape = *simulation.collider(id).shape;
    AnimatedCollider made{simulation.name(id), shape.surface(reach()), {}, {}, {}};
    made.normals = corner_normals(shape, made.surface);
    if (shape.is_bounded()) return made;
    const Vec3 middle = simulation.pose(id).to_frame(bodies_.middle);
    const pliant::SignedDistance down = shape.distance(middle);
    made.surface.vertices.rowwise() += (middle - down.distance * down.normal).transpose();
    return made;
  }

  Surroundings bodies_;
  std::map<ColliderId, Open> open_;
  std::vector<AnimatedCollider> list_;
  bool has_frames_ = false;
};

}  // namespace

void replay(pliant::Scene& scene, const pliant::PointCache& frames, const std::function<void(std::int64_t)>& visit) {
  ReplayedRun run(scene, frames);
  for (std::int64_t frame = 0; frame < frames.frame_count(); ++frame) {
    // A frame is taken at the end of a step, before what is due at the next one.
    run.go_to(frames.time(frame));
    visit(run.step());
  }
}

std::vector<AnimatedCollider> recorded_colliders(pliant::Scene scene, const pliant::PointCache& frames) {
  ColliderTracks tracks(surroundings_of(scene.simulation));
  std::int64_t frame = 0;
  replay(scene, frames, [&](std::int64_t) { tracks.add_frame(scene.simulation, frames.time(frame++)); });
  return tracks.take();
}

}  // namespace pliant_render
