// Keyframes: closed forms of what linear interpolation misses.
#include <cmath>
#include <numbers>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"
#include "pliant_io/export/keyframes.h"

namespace test_keyframes {

namespace {

using namespace pliant;
using Frames = std::vector<std::size_t>;

/// A sheet of diagonal `size` that is moved to `place(i)` in frame i, the frames a second apart.
template <typename Place>
Animation moved(std::size_t count, Real size, const Place& place) {
  Mesh mesh = grid({.columns = 3, .rows = 3, .size = {0.6 * size, 0.8 * size}});
  std::vector<Positions> frames;
  std::vector<Real> times;
  for (std::size_t i = 0; i < count; ++i) {
    frames.push_back(mesh.vertices.rowwise() + place(i).transpose());
    times.push_back(static_cast<Real>(i));
  }
  return animate(std::move(mesh), "sheet", PointCache::from_frames(frames, times));
}

TEST_CASE("sizes of bodies: their diagonals, the way of a point, 1 where nothing is") {
  CHECK(std::abs(body_sizes(moved(3, 5, [](std::size_t) { return Vec3(0, 0, 0); }))[0] - 5) < 1e-12);
  const auto point = [](const Vec3& end) {
    Mesh mesh;
    mesh.vertices = Positions::Zero(1, 3);
    const std::vector<Positions> frames = {mesh.vertices, Positions(end.transpose())};
    return animate(mesh, "point", PointCache::from_frames(frames, {0, 1}));
  };
  CHECK(body_sizes(point({0, 3, 4}))[0] == 5);
  CHECK(body_sizes(point({0, 0, 0}))[0] == 1);
}

TEST_CASE("motion that is straight needs its ends, and a kink its own keyframe") {
  const auto straight = moved(50, 1, [](std::size_t i) { return Vec3(static_cast<Real>(i), 0, 2); });
  CHECK(choose_keyframes(straight, 1e-12, 100).frames == Frames{0, 49});
  const auto kinked = moved(50, 1, [](std::size_t i) { return Vec3(std::abs(static_cast<Real>(i) - 17), 0, 0); });
  CHECK(choose_keyframes(kinked, 1e-12, 100).frames == Frames{0, 17, 49});
  CHECK(choose_keyframes(kinked, 0, 100).largest_error == 0);
  CHECK(choose_keyframes(moved(1, 1, [](std::size_t) { return Vec3(1, 2, 3); }), 0, 2).frames == Frames{0});
  CHECK(choose_keyframes(moved(2, 1, [](std::size_t) { return Vec3(1, 2, 3); }), 0, 2).frames == Frames{0, 1});
}

TEST_CASE("a parabola: n frames between are off by n²/8 of its second difference") {
  constexpr Real second_difference = 0.01;
  for (const Real size : {1.0, 100.0}) {
    const auto parabola = moved(
        101, size, [&](std::size_t i) { return Vec3(0, 0, size * second_difference / 2 * static_cast<Real>(i * i)); });
    for (const std::size_t distance : {2U, 4U, 10U}) {
      const auto n = static_cast<Real>(distance);
      const Real error = second_difference * n * n / 8;
      const Keyframes chosen = choose_keyframes(parabola, error * (1 + 1e-9), 1000);
      Frames expected;
      for (std::size_t frame = 0; frame < 100; frame += distance) expected.push_back(frame);
      expected.push_back(100);
      CHECK(chosen.frames == expected);
      CHECK(std::abs(chosen.largest_error - error) < 1e-12);
      // And a little less takes every frame closer.
      CHECK(choose_keyframes(parabola, error * (1 - 1e-9), 1000).frames[1] == distance - 1);
    }
  }
}

TEST_CASE("times that are not even") {
  Animation animation = moved(4, 1, [](std::size_t i) { return Vec3(static_cast<Real>(i * i), 0, 0); });
  animation.cache.set_times({0, 1, 4, 9});  // then it is straight
  animation.times = {0, 1, 4, 9};
  CHECK(choose_keyframes(animation, 1e-12, 10).frames == Frames{0, 3});
}

TEST_CASE("a small body is held to its own size beside a large one") {
  Mesh large = grid({.columns = 2, .rows = 2, .size = {60, 80}});
  Mesh small = grid({.columns = 2, .rows = 2, .size = {0.06, 0.08}});
  Positions all(8, 3);
  all << large.vertices, small.vertices;
  std::vector<Positions> frames(3, all);
  frames[1].bottomRows(4).col(2).array() += 0.001;  // a hundredth of the small one
  const std::vector<Body> bodies = {{"large", large, 0}, {"small", small, 4}};
  const Animation animation = {"both", bodies, PointCache::from_frames(frames, {0, 1, 2}), {0, 1, 2}};
  CHECK(choose_keyframes(animation, 0.011, 10).frames == Frames{0, 2});
  CHECK(choose_keyframes(animation, 0.009, 10).frames == Frames{0, 1, 2});
}

TEST_CASE("no more keyframes than allowed, and the error that this takes") {
  const auto circle = moved(201, 1, [](std::size_t i) {
    const Real angle = static_cast<Real>(i) * std::numbers::pi / 100;
    return Vec3(std::cos(angle), std::sin(angle), 0);
  });
  for (const std::int64_t count : {2, 3, 5, 9, 21, 200, 201}) {
    const Keyframes chosen = choose_keyframes(circle, 0, count);
    CAPTURE(count);
    CHECK(std::ssize(chosen.frames) <= count);
    CHECK(chosen.frames.front() == 0);
    CHECK(chosen.frames.back() == 200);
    // The sagitta of count - 1 equal chords, but for frames not being in their middles, and little more.
    const Real best = count == 2 ? 2 : 1 - std::cos(std::numbers::pi / static_cast<Real>(count - 1));
    if (count <= 21) CHECK(chosen.largest_error >= 0.99 * best);
    CHECK(chosen.largest_error <= 1.3 * best + 1e-3);
  }
  CHECK(choose_keyframes(circle, 0, 201).largest_error == 0);
  CHECK(choose_keyframes(circle, 2, 100).frames == Frames{0, 200});
}

TEST_CASE("tolerances and counts out of range") {
  const auto animation = moved(3, 1, [](std::size_t) { return Vec3(0, 0, 0); });
  CHECK_THROWS_AS(choose_keyframes(animation, -1, 10), Error);
  CHECK_THROWS_AS(choose_keyframes(animation, std::nan(""), 10), Error);
  CHECK_THROWS_AS(choose_keyframes(animation, 0, 1), Error);
}

}  // namespace

}  // namespace test_keyframes
