#include "render/run_replay.h"

#include "render/collider_tracks.h"

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
  ColliderTracks tracks(scene.simulation);
  std::int64_t frame = 0;
  replay(scene, frames, [&](std::int64_t) { tracks.add_frame(scene.simulation, frames.time(frame++)); });
  return tracks.take();
}

}  // namespace pliant_render
