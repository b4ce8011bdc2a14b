// What a pinned body that moves takes along: it does not lag for what goes with it, however fast it turns.
#include <cmath>
#include <cstring>

#include <doctest/doctest.h>

#include "pliant/collision/pairs/common_motion.h"
#include "tests/core/random.h"
#include "tests/pairs/figure_scenes.h"
#include "tests/pairs/parts.h"
#include "tests/scene/whole_scenes.h"

namespace test_common_motion {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// Triangles of 0.1 m at some heights over each other, each a body of its own.
struct Layers {
  std::vector<SurfacePart> parts;
  Surface surface;
  Positions begin;
  std::vector<char> is_pinned;
  std::vector<Real> radii;

  explicit Layers(const std::vector<Vec3>& places) : begin(3 * places.size(), 3) {
    static const std::vector<Triangle> triangle{{0, 1, 2}};
    for (std::size_t i = 0; i < places.size(); ++i) {
      parts.push_back({.first_vertex = static_cast<Index>(3 * i), .vertex_count = 3, .triangles = triangle});
      for (Index k = 0; k < 3; ++k) {
        const Vec3 corner(k == 1 ? 0.1 : 0, k == 2 ? 0.1 : 0, 0);
        begin.row(static_cast<Index>(3 * i) + k) = (places[i] + corner).transpose();
      }
    }
    surface = Surface(parts, static_cast<Index>(begin.rows()), {});
    is_pinned.assign(3 * places.size(), 0);
    radii.assign(3 * places.size(), 0.01);
  }

  void pin(Index body) {
    for (Index k = 0; k < 3; ++k) is_pinned[at(3 * body + k)] = 1;
  }
  /// Where the ways begin if these are to end at `end`.
  Positions start(const Positions& end) const {
    std::vector<Index> pinned;
    for (Index v = 0; v < static_cast<Index>(begin.rows()); ++v) {
      if (is_pinned[at(v)] != 0) pinned.push_back(v);
    }
    CommonMotions common;
    common.set_surface(surface);
    Positions start = begin;
    const CommonMotions::Input input{begin, end, pinned, is_pinned, radii};
    if (!common.may_help(input)) return start;
    PairList list;
    list.set_surface(surface, begin, radii);
    const LetGo nothing;
    const ReducedDistances whole;
    list.begin(is_pinned, nothing, whole);
    ThreadPool pool(1);
    list.update(begin, pool);
    common.find(input, list.near(), start);
    return start;
  }
};

void move(Positions& end, Index body, const RigidMove& move) {
  for (Index k = 3 * body; k < 3 * body + 3; ++k) end.row(k) = move(row(end, k)).transpose();
}

RigidMove turn(Real angle, const Vec3& way) {
  return {Eigen::AngleAxis<Real>(angle, Vec3::UnitZ()).toRotationMatrix(), Vec3::Zero(), way};
}

bool rests(const Layers& layers, const Positions& start, Index body) {
  return layers.begin.middleRows(3 * body, 3) == start.middleRows(3 * body, 3);
}

Real error(const Positions& a, const Positions& b, Index body) {
  return (a.middleRows(3 * body, 3) - b.middleRows(3 * body, 3)).cwiseAbs().maxCoeff();
}

}  // namespace

TEST_CASE("common motion: that of most vertices is found to the last digits, whatever the others do") {
  Random random(3);
  for (int run = 0; run < 20; ++run) {
    const Index count = 60;
    Positions begin(count, 3), end(count, 3);
    std::vector<Index> vertices;
    const RigidMove move{random.rotation(), random.vector(1), random.vector(1)};
    for (Index i = 0; i < count; ++i) {
      vertices.push_back(i);
      begin.row(i) = random.vector(1).transpose();
      end.row(i) = (move(row(begin, i)) + (i % 4 == 0 ? random.vector(0.3) : Vec3::Zero())).transpose();
    }
    const RigidMove found = RigidMove::fit(vertices, begin, end);
    CHECK((found.turn.transpose() * found.turn - Mat3::Identity()).norm() < 1e-14);
    CHECK(found.turn.determinant() > 0);
    Real largest = 0;
    for (Index i = 0; i < count; ++i) {
      if (i % 4 != 0) largest = std::max(largest, (found(row(begin, i)) - row(end, i)).norm());
    }
    CHECK(largest < 1e-3);
  }
}

TEST_CASE("common motion: what lies on a line does not turn about it") {
  Positions begin(2, 3), end(2, 3);
  begin << 0, 0, 0, 1, 0, 0;
  end << 0, 0, 1, 0, 1, 1;
  const RigidMove found = RigidMove::fit(std::vector<Index>{0, 1}, begin, end);
  CHECK((found(row(begin, 1)) - row(end, 1)).norm() < 1e-6);
  CHECK((found.turn * Vec3::UnitZ() - Vec3::UnitZ()).norm() < 1e-6);
}

TEST_CASE("common motion: a pinned body takes along what is near, and what is near to that") {
  Layers layers({{0, 0, 0}, {0, 0, 0.015}, {0, 0, 0.03}, {0, 0, 0.5}});
  layers.pin(0);
  Positions end = layers.begin;
  for (const Index body : {0, 1, 2}) move(end, body, turn(0.3, {0.1, 0, 0.05}));
  const Positions start = layers.start(end);
  for (const Index body : {0, 1, 2}) CHECK(error(start, end, body) < 1e-9);
  CHECK(rests(layers, start, 3));
}

TEST_CASE("common motion: two that move otherwise each take along their own") {
  Layers layers({{0, 0, 0}, {0, 0, 0.015}, {1, 0, 0}, {1, 0, 0.015}});
  layers.pin(0);
  layers.pin(2);
  Positions end = layers.begin;
  for (const Index body : {0, 1}) move(end, body, turn(0, {0, 0.2, 0}));
  for (const Index body : {2, 3}) move(end, body, turn(0, {0, -0.2, 0.1}));
  const Positions start = layers.start(end);
  for (const Index body : {0, 1, 2, 3}) CHECK(error(start, end, body) < 1e-9);
}

TEST_CASE("common motion: what is pinned and rests never moves, nor what lies on it or would meet what stays") {
  SUBCASE("the cloth lies on both") {
    Layers layers({{0, 0, 0}, {0, 0, 0.015}, {0, 0, 0.03}});
    layers.pin(0);
    layers.pin(2);
    Positions end = layers.begin;
    for (const Index body : {1, 2}) move(end, body, turn(0, {0.1, 0, 0}));
    const Positions start = layers.start(end);
    for (const Index body : {0, 1, 2}) CHECK(rests(layers, start, body));
  }
  SUBCASE("a sheet that is free is in the way") {
    Layers layers({{0, 0, 0}, {0, 0, 0.015}, {0, 0, 0.1}});
    layers.pin(0);
    Positions end = layers.begin;
    for (const Index body : {0, 1}) move(end, body, turn(0, {0, 0, 0.15}));
    const Positions start = layers.start(end);
    for (const Index body : {0, 1, 2}) CHECK(rests(layers, start, body));
    layers.begin.middleRows(6, 3).rowwise() += Eigen::RowVector3d(0.2, 0, 0);  // beside the way: it is not
    Positions beside = layers.begin;
    for (const Index body : {0, 1}) move(beside, body, turn(0, {0, 0, 0.15}));
    CHECK(error(layers.start(beside), beside, 1) < 1e-9);
  }
  SUBCASE("a pinned one is in the way of the cloth") {
    Layers layers({{0, 0, 0}, {0, 0, 0.015}, {0, 0, 0.1}});
    layers.pin(0);
    layers.pin(2);
    Positions end = layers.begin;
    for (const Index body : {0, 1}) move(end, body, turn(0, {0, 0, 0.15}));
    const Positions start = layers.start(end);
    for (const Index body : {0, 1, 2}) CHECK(rests(layers, start, body));
  }
}

TEST_CASE("common motion: small moves, and moves of which no common one takes most, are left to planes") {
  Layers layers({{0, 0, 0}, {0, 0, 0.015}});
  layers.pin(0);
  Positions end = layers.begin;
  for (const Index body : {0, 1}) move(end, body, turn(0, {0.004, 0, 0}));
  CHECK(layers.start(end) == layers.begin);
  end = layers.begin;
  end.row(0) += Eigen::RowVector3d(0.05, 0, 0);
  end.row(1) += Eigen::RowVector3d(-0.05, 0, 0);
  CHECK(layers.start(end) == layers.begin);
}

/// Without it the sleeve is held back by planes that stand still: the arm lags, and a step takes seconds.
TEST_CASE("common motion: an arm that turns twice a second carries its sleeve round, and does not lag") {
  PairScene scene = sleeve({.vertices = 400, .turn = 0.5});
  const Index frames = runs_whole_scenes ? 60 : 3;
  for (Index i = 0; i < frames; ++i) {
    CHECK(scene.step().contact.lag == 0);
    REQUIRE(count_crossings(scene.simulation) == 0);
  }
}

TEST_CASE("common motion: a shirt whirls with its figure, which does not lag") {
  PairScene scene = shirt({.vertices = 900, .turn = 0.5});
  REQUIRE(count_crossings(scene.simulation) == 0);
  const Index frames = runs_whole_scenes ? 240 : 2;  // it begins to whirl in frame 192
  for (Index i = 0; i < frames; ++i) {
    CHECK(scene.step().contact.lag == 0);
    REQUIRE(count_crossings(scene.simulation) == 0);
  }
}

TEST_CASE("common motion: a ball driven into a curtain at 8 m/s passes through nothing, and lags little") {
  PairScene scene = ball_and_curtain({.vertices = 600, .speed = 8});
  Real lag = 0;
  for (Index i = 0; i < (runs_whole_scenes ? 30 : 2); ++i) {
    lag = std::max(lag, scene.step().contact.lag);
    REQUIRE(count_crossings(scene.simulation) == 0);
  }
  CHECK(lag < 0.02);  // 0.24 m while it went all the way at once
}

}  // namespace test_common_motion
