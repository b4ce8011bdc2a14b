// What is exported of a run, against what pictures of it show.
#include <algorithm>

#include <doctest/doctest.h>

#include "render/clip.h"
#include "render/run_values.h"
#include "render/scalar_fields.h"
#include "tests/mesh/meshes.h"

namespace test_run_values {

using namespace pliant;
using namespace pliant_render;
using namespace pliant_tests;

namespace {

/// A cloth beside a solid, and a ring whose bends have a sign; soft pins that move, springs that become stiffer, and a
/// group that goes.
constexpr std::string_view text = R"({
  "pliant": 1, "steps": 24, "settings": {"time_step": 0.01},
  "bodies": [
    {"name": "cloth", "mesh": {"shape": "grid", "columns": 5, "rows": 4}, "mass": {"total": 1},
     "constraints": [{"type": "edge_spring", "name": "springs", "stiffness": 300},
                     {"type": "bending", "name": "bend", "stiffness": 0.01},
                     {"type": "position", "name": "pins", "on": [0, 4], "stiffness": 400}]},
    {"name": "bar", "mesh": {"shape": "bar", "cells": [2, 1, 1]}, "mass": {"density": 100},
     "constraints": [{"type": "tetrahedron_strain", "stiffness": 3000},
                     {"type": "position", "on": [0, 1]}]},
    {"name": "ring", "mesh": {"shape": "torus", "major_segments": 8, "minor_segments": 6}, "mass": {"total": 1},
     "constraints": [{"type": "edge_spring", "stiffness": 100},
                     {"type": "bending", "stiffness": 0.3, "orientation": "signed"},
                     {"type": "position", "on": [0]}]}],
  "events": [
    {"time": 0.05, "move": "pins", "offset": [0, 0, 0.3], "over": 0.1},
    {"step": 8, "change": "springs", "stiffness": 900, "over": 0.07},
    {"step": 15, "remove": "bend"}]
})";

Scene scene() {
  return parse_scene(text, ".", "values");
}

struct RecordedRun {
  Animation animation;
  std::vector<std::vector<float>> energies;  // of each frame, as a picture of the scene has them
};

RecordedRun record() {
  Scene running = scene();
  std::vector<Positions> frames;
  std::vector<Real> times;
  std::vector<std::vector<float>> energies;
  const RenderMesh mesh = make_render_mesh(running.simulation);
  for (std::int64_t step = 0;; ++step) {
    frames.push_back(running.simulation.state().positions);
    times.push_back(running.simulation.state().time);
    energies.push_back(capture_frame(running.simulation, mesh, ColorBy::energy).content.values);
    if (step == running.steps) break;
    running.step();
  }
  PointCache cache = PointCache::from_frames(frames, times);
  return {{"values", running.simulation.bodies(), std::move(cache), times}, std::move(energies)};
}

const std::vector<float>& numbers(const std::vector<VertexValues>& values, std::string_view name) {
  const auto found = std::ranges::find(values, name, &VertexValues::name);
  REQUIRE(found != values.end());
  return found->numbers;
}

}  // namespace

TEST_CASE("exported energies and stretches are those of pictures, to the bit, with all that events change") {
  const RecordedRun run = record();
  RunValues values(run.animation, scene());
  const RunFrames pictures(run.animation);
  for (std::size_t i = 0; i < run.animation.times.size(); ++i) {
    CAPTURE(i);
    const std::vector<VertexValues> at = values.at(i);
    CHECK(numbers(at, "energy") == run.energies[i]);
    CHECK(numbers(at, "stretch") == pictures.frame(i, ColorBy::stretch).content.values);
    const std::vector<float> speeds = pictures.frame(i, ColorBy::speed).content.values;
    const std::vector<float>& velocities = numbers(at, "velocity");
    REQUIRE(velocities.size() == 3 * speeds.size());
    for (std::size_t v = 0; v < speeds.size(); ++v) {
      const Eigen::Vector3f velocity(velocities[3 * v], velocities[3 * v + 1], velocities[3 * v + 2]);
      CHECK(velocity.norm() == doctest::Approx(speeds[v]).epsilon(1e-5));
    }
  }
}

TEST_CASE("one body has the values that it has among others, and every second frame those of that frame") {
  RecordedRun run = record();
  const std::size_t first = 5 * 4;
  keep_body(run.animation, "bar");
  keep_frames(run.animation, {.first = 2, .step = 2});
  RunValues values(run.animation, scene());
  for (std::size_t i = 0; i < run.animation.times.size(); ++i) {
    const std::vector<float>& whole = run.energies[2 * i + 2];
    CHECK(numbers(values.at(i), "energy") == std::vector<float>(whole.begin() + first, whole.begin() + first + 12));
  }
}

TEST_CASE("a scene of other bodies is refused") {
  RecordedRun run = record();
  run.animation.bodies[1].name = "rod";
  CHECK(contains(error_of([&] { take_tetrahedra(run.animation, scene().simulation); }),
                 "the scene has no body 'rod' of 12 vertices"));
}

}  // namespace test_run_values
