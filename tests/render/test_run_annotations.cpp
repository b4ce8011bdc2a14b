// Pins, test forces and wind in the frames of a recorded run: those of the scene while it is simulated.
#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "render/clip.h"

namespace test_run_annotations {

using namespace pliant;
using namespace pliant_render;

namespace {

Scene eventful_scene() {
  return parse_scene(R"({"pliant": 1, "steps": 30, "settings": {"time_step": 0.02, "iterations": 2},
    "bodies": [{"name": "cloth", "mesh": {"shape": "grid", "columns": 4, "rows": 3}, "mass": {"total": 1},
      "constraints": [{"type": "edge_spring", "stiffness": 100}, {"type": "position", "name": "pins", "on": [0, 3]}]}],
    "forces": [{"type": "wind", "velocity": [0, 3, 0]},
               {"type": "test_force", "body": "cloth", "vertices": [7], "force": [1, 0, 0], "frames": [4, 9]}],
    "events": [{"step": 6, "change": "wind", "velocity": [0, 0, 0]},
               {"time": 0.2, "release": "pins", "vertices": [3]},
               {"step": 20, "change": "wind", "velocity": [5, 0, 0]},
               {"step": 25, "remove": "pins"}]})",
                     {}, "s.json");
}

Animation animation_of(const Clip& clip, const Scene& scene, std::size_t every) {
  std::vector<Positions> frames;
  std::vector<Real> times;
  for (std::size_t i = 0; i < clip.frames.size(); i += every) {
    frames.push_back(scene.simulation.state().positions);
    times.push_back(clip.frames[i].time);
  }
  return animate(scene.simulation.body(BodyId{0}).mesh, "run", PointCache::from_frames(frames, times));
}

}  // namespace

TEST_CASE("pins and wind of a recorded run are those of the scene, also when events change them") {
  Scene live = eventful_scene();
  const Clip clip = clip_from_scene(live, 1, [](std::int64_t) { return true; });
  REQUIRE(clip.frames.size() == 31);
  CHECK(clip.frames[0].content.markers == std::vector<std::uint32_t>{0, 3});
  CHECK(clip.frames[30].content.markers.empty());
  for (const std::size_t every : {std::size_t{1}, std::size_t{3}}) {
    CAPTURE(every);
    const Animation animation = animation_of(clip, live, every);
    const RunFrames frames(animation, annotate_run(eventful_scene(), animation));
    for (std::size_t i = 0; i < frames.count(); ++i) {
      CAPTURE(i);
      const ClipFrame& wanted = clip.frames[every * i];
      const ClipFrame found = frames.frame(i, ColorBy::none);
      CHECK(found.content.markers == wanted.content.markers);
      REQUIRE(found.wind.has_value() == wanted.wind.has_value());
      if (found.wind) CHECK(found.wind->text == wanted.wind->text);
    }
  }
}

TEST_CASE("a scene of another mesh says nothing of a run") {
  Scene live = eventful_scene();
  const Clip clip = clip_from_scene(live, 1, [](std::int64_t) { return true; });
  Scene other =
      parse_scene(R"({"pliant": 1, "bodies": [{"mesh": {"shape": "chain"}, "mass": {"total": 1}}]})", {}, "o");
  CHECK_THROWS_WITH_AS(annotate_run(std::move(other), animation_of(clip, live, 1)),
                       doctest::Contains("vertices, and the run 12"), Error);
  const RunFrames plain(animation_of(clip, live, 1));
  CHECK(plain.frame(0, ColorBy::none).content.markers.empty());
}

}  // namespace test_run_annotations
