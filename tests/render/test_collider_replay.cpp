// Colliders of a recorded run, found again from its scene: where a step had them, frame by frame.
#include <doctest/doctest.h>

#include "pliant_io/checkpoint/checkpoint.h"
#include "render/clip.h"
#include "render/run_replay.h"
#include "tests/support/temporary_folder.h"

namespace test_collider_replay {

using namespace pliant_render;
using pliant::AnimatedCollider;
using pliant::ColliderId;
using pliant::Pose;
using pliant::Real;

namespace {

/// A falling sheet, and colliders that events move in every way there is.
constexpr std::string_view eventful = R"({"pliant": 1, "steps": 60, "settings": {"time_step": 0.03, "iterations": 3},
  "bodies": [{"name": "sheet", "mesh": {"shape": "grid", "columns": 4, "rows": 3}, "mass": {"total": 1},
    "transform": {"translate": [0, 0, 2]}, "constraints": [{"type": "edge_spring", "stiffness": 100}]}],
  "colliders": [
    {"type": "sphere", "name": "ball", "center": [9, 0, 0], "radius": 0.2, "velocity": [0, 0.3, 0]},
    {"type": "box", "name": "box", "center": [0, 9, 0], "angular_velocity": [0, 1, 0.5]},
    {"type": "capsule", "name": "arm", "from": [0, 0, 4], "to": [1, 0, 4]},
    {"type": "plane", "name": "floor"}],
  "events": [
    {"time": 0.1, "move": "ball", "offset": [0.5, 0, 0.25], "over": 0.4, "ease": "smooth"},
    {"step": 4, "move": "box", "keyframes": [{"time": 0.2, "translate": [0, 0, 1]},
      {"time": 0.7, "translate": [1, 0, 1], "rotate": {"axis": [1, 1, 0], "degrees": 200}}]},
    {"step": 5, "move": "floor", "offset": [0, 0, 0.1], "over": 0.2},
    {"step": 6, "follow": "arm", "body": "sheet", "vertices": 5},
    {"step": 12, "settings": {"time_step": 0.005}},
    {"time": 0.44, "move": "box", "target": [3, 2, 1]},
    {"step": 30, "settings": {"time_step": 0.04}},
    {"time": 0.7, "change": "ball", "radius": 0.4},
    {"time": 0.75, "change": "ball", "friction": 0.9},
    {"time": 0.9, "stop": "arm"},
    {"time": 1, "add": {"type": "box", "name": "late", "velocity": [1, 0, 0]}},
    {"time": 1.1, "move": "late", "rotate": {"axis": [0, 0, 1], "degrees": 90}, "over": 0.3},
    {"time": 1.3, "remove": "arm"}]})";

pliant::Scene scene_of(std::string_view text) {
  return pliant::parse_scene(text, {}, "s.json");
}

/// What was seen of a run while it was simulated, at every n-th step.
struct LiveRun {
  std::vector<Real> times;
  std::vector<pliant::Positions> positions;
  std::vector<std::map<ColliderId, Pose>> poses;
  pliant::Mesh mesh;

  void keep(const pliant::Scene& scene) {
    times.push_back(scene.simulation.state().time);
    positions.push_back(scene.simulation.state().positions);
    auto& frame = poses.emplace_back();
    for (const auto& [id, record] : scene.simulation.colliders()) frame[id] = scene.simulation.pose(id);
    mesh = scene.simulation.bodies().front().mesh;
  }
  void simulate(pliant::Scene& scene, std::int64_t every, std::int64_t steps) {
    while (scene.simulation.state().step < steps) {
      scene.step();
      if (scene.simulation.state().step % every == 0) keep(scene);
    }
  }
  pliant::Animation animation() const {
    return pliant::animate(mesh, "run", pliant::PointCache::from_frames(positions, times));
  }
};

LiveRun simulate(std::int64_t every) {
  pliant::Scene scene = scene_of(eventful);
  LiveRun run;
  run.keep(scene);
  run.simulate(scene, every, scene.steps);
  return run;
}

void check_poses(const LiveRun& live, const pliant::Animation& animation, const RunAnnotations& annotations,
                 std::optional<ColliderId> inexact = {}) {
  const RunFrames run(animation, annotations);
  REQUIRE(run.count() == live.poses.size());
  for (std::size_t i = 0; i < run.count(); ++i) {
    CAPTURE(i);
    const auto found = run.frame(i, pliant::ColorBy::none).content.colliders;
    REQUIRE(found.size() == live.poses[i].size());
    for (const DrawnCollider& each : found) {
      CAPTURE(each.number);
      const ColliderId id{each.number};
      if (id == inexact) continue;
      CHECK(each.pose == live.poses[i].at(id));
    }
  }
}

const AnimatedCollider& named(const std::vector<AnimatedCollider>& colliders, std::string_view name, int which = 0) {
  for (const AnimatedCollider& each : colliders) {
    if (each.name == name && which-- == 0) return each;
  }
  throw std::runtime_error("no such collider");
}

}  // namespace

TEST_CASE("each frame of a run has each collider where its step had it, bit for bit, whatever events moved it") {
  const LiveRun live = simulate(1);
  // The events did what they are here for.
  CHECK_FALSE(live.poses[2].at(ColliderId{0}) == live.poses[8].at(ColliderId{0}));
  CHECK(live.poses[20].at(ColliderId{1}).position != live.poses[59].at(ColliderId{1}).position);
  CHECK(live.poses[60].size() == 4);
  CHECK(live.poses[30].size() == 4);
  CHECK(live.times[12] == doctest::Approx(0.36));
  CHECK(live.times[30] == doctest::Approx(0.45));
  CHECK(live.times[31] == doctest::Approx(0.49));
  check_poses(live, live.animation(), annotate_run(scene_of(eventful), live.animation()));
}

TEST_CASE("the same with every third step recorded; what follows a body is as exact as its frames") {
  const LiveRun live = simulate(3);
  const ColliderId arm{2};
  const RunAnnotations annotations = annotate_run(scene_of(eventful), live.animation());
  check_poses(live, live.animation(), annotations, arm);
  const RunFrames run(live.animation(), annotations);
  for (std::size_t i = 0; i < live.poses.size(); ++i) {
    if (!live.poses[i].contains(arm)) continue;
    const auto found = run.frame(i, pliant::ColorBy::none).content.colliders;
    // Half of the largest change of a speed of some m/s that falls between two frames, 0.12 s apart at most.
    CHECK((found[2].pose.position - live.poses[i].at(arm).position).norm() < 0.06);
  }
}

TEST_CASE("the same for a run that was resumed") {
  const pliant_tests::TemporaryFolder folder;
  pliant::Scene scene = scene_of(eventful);
  LiveRun live;
  live.keep(scene);
  live.simulate(scene, 1, 17);
  write_checkpoint(folder.path() / "c", scene);
  pliant::Scene resumed = pliant::read_checkpoint(folder.path() / "c");
  live.simulate(resumed, 1, 60);
  const pliant::Scene again = pliant::read_checkpoint(folder.path() / "c");
  check_poses(live, live.animation(), annotate_run(pliant::parse_scene(again.source), live.animation()));
}

TEST_CASE("between two recorded frames a collider is on its way, as the bodies are") {
  const LiveRun live = simulate(5);
  pliant::Animation animation = live.animation();
  std::vector<Real> halves;
  for (std::size_t i = 0; i + 1 < live.times.size(); ++i) halves.push_back((live.times[i] + live.times[i + 1]) / 2);
  animation.times = halves;
  const RunFrames run(animation, annotate_run(scene_of(eventful), animation));
  for (std::size_t i = 0; i < run.count(); ++i) {
    CAPTURE(i);
    const auto found = run.frame(i, pliant::ColorBy::none).content.colliders;
    REQUIRE(found.size() == live.poses[i].size());
    for (const DrawnCollider& each : found) {
      const Pose& before = live.poses[i].at(ColliderId{each.number});
      const auto after = live.poses[i + 1].find(ColliderId{each.number});
      if (each.number == 2) continue;  // follows the sheet, whose frames are few
      const Pose wanted = after == live.poses[i + 1].end() ? before : interpolate(before, after->second, 0.5);
      CHECK((each.pose.position - wanted.position).norm() < 1e-9);
      CHECK(each.pose.rotation.angularDistance(wanted.rotation) < 1e-7);
    }
  }
}

TEST_CASE("exports have the same poses, and know when a collider comes, goes or changes its shape") {
  const LiveRun live = simulate(1);
  const pliant::Animation animation = live.animation();
  const std::vector<AnimatedCollider> colliders = recorded_colliders(scene_of(eventful), animation.cache);
  REQUIRE(colliders.size() == 6);  // ball twice
  const auto first_frame_with = [&](auto&& is_so) {
    for (std::size_t i = 0; i < live.poses.size(); ++i) {
      if (is_so(live.poses[i])) return live.times[i];
    }
    return Real(-1);
  };
  const Real comes = first_frame_with([](const auto& poses) { return poses.contains(ColliderId{4}); });
  const Real goes = first_frame_with([](const auto& poses) { return !poses.contains(ColliderId{2}); });
  CHECK(named(colliders, "late").from == comes);
  CHECK(named(colliders, "arm").until == goes);
  CHECK(named(colliders, "floor").is_there(live.times.front()));
  CHECK(named(colliders, "floor").is_there(live.times.back()));
  // The radius changes in the first step that begins at 0.7 s or later; another friction is no other shape.
  const AnimatedCollider &small = named(colliders, "ball"), &large = named(colliders, "ball", 1);
  CHECK(small.until == large.from);
  CHECK(large.from > 0.7);
  CHECK(large.from < 0.7 + 2 * 0.04 + 1e-9);
  CHECK(large.surface.vertices.rowwise().norm().maxCoeff() == doctest::Approx(0.4));
  const std::map<std::string, ColliderId> ids = {{"ball", ColliderId{0}},
                                                 {"box", ColliderId{1}},
                                                 {"arm", ColliderId{2}},
                                                 {"floor", ColliderId{3}},
                                                 {"late", ColliderId{4}}};
  std::size_t compared = 0;
  for (const AnimatedCollider& each : colliders) {
    CAPTURE(each.name);
    for (std::size_t i = 0; i < live.times.size(); ++i) {
      if (!each.is_there(live.times[i])) continue;
      CHECK(each.pose_at(live.times[i]) == live.poses[i].at(ids.at(each.name)));
      ++compared;
    }
  }
  std::size_t seen = 0;
  for (const auto& poses : live.poses) seen += poses.size();
  CHECK(compared == seen);
}

}  // namespace test_collider_replay
