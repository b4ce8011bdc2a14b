#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "pliant/collision/pairs/gap.h"
#include "pliant/collision/pairs/local_motion.h"
#include "pliant/collision/pairs/pair_search.h"
#include "tests/collision/scenes_of_crossings.h"

namespace test_local_motion {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real r = 0.25;  // the unit is an edge
constexpr Index side = 20;

/// Two sheets, one above the other.
struct Sheets {
  Mesh mesh = whole_grid(side, side, 0, 1);
  Index count = mesh.vertex_count();
  std::array<SurfacePart, 2> parts{SurfacePart{0, count, mesh.triangles, mesh.edges, true, 0},
                                   SurfacePart{count, count, mesh.triangles, mesh.edges, true, 0}};
  Surface surface{parts, 2 * count, {}};
  std::vector<Real> radii = std::vector<Real>(2 * at(count), r);
  Positions rest{2 * count, 3};
  LocalMotion motion;

  explicit Sheets(Real apart) {
    rest.topRows(count) = mesh.vertices;
    rest.bottomRows(count) = mesh.vertices;
    rest.bottomRows(count).col(2).array() += apart;
    motion.set_surface(surface, rest, radii);
  }
  Positions moved(auto&& way) const {
    Positions q = rest;
    for (Index v = 0; v < q.rows(); ++v) q.row(v) += way(v).transpose();
    return q;
  }
  /// Whether all pairs that were 2 r apart are as far apart as that.
  bool are_apart(const Positions& q, Real distance) const {
    PairSearch search(surface);
    ThreadPool pool(1);
    return std::ranges::all_of(search.find(q, q, radii, pool), [&](const Pair& pair) {
      return measure(rest, pair).distance < 2 * r || measure(q, pair).distance >= distance;
    });
  }
};

LocalMotion::Kept kept(Sheets& sheets, const Positions& q) {
  return sheets.motion.kept(sheets.rest, q, std::sqrt((q - sheets.rest).rowwise().squaredNorm().maxCoeff()));
}

}  // namespace

TEST_CASE("Where regions of a sheet move alike, what was apart is known to stay so") {
  Sheets sheets(3);
  const Positions wave = sheets.moved([&](Index v) { return Vec3(0, 0, 0.3 * std::sin(0.03 * sheets.rest(v, 0))); });
  const LocalMotion::Kept kept_in_wave = kept(sheets, wave);
  CHECK(kept_in_wave.is_radius);
  CHECK(kept_in_wave.is_some);
  const Positions far = sheets.moved([&](Index) { return Vec3(100, 0, 0); });
  CHECK(!kept(sheets, far).is_some);  // apart from what all have gone that would be 0
  CHECK(sheets.motion.kept(sheets.rest, far, 0).is_radius);
}

TEST_CASE("What comes near is noticed, wherever it is") {
  for (const Real apart : {0.6, 1.0, 3.0}) {
    for (const Index v : {Index{0}, Index{side}, Index{217}, Index{399}}) {
      Sheets sheets(apart);
      const Positions q =
          sheets.moved([&](Index i) { return Vec3(0, 0, i == v ? apart - 0.9 * r : (i % 7) * 0.01 * r); });
      CAPTURE(apart);
      CAPTURE(v);
      CHECK(!sheets.are_apart(q, r));
      CHECK(!kept(sheets, q).is_radius);
    }
  }
}

TEST_CASE("Whatever the motion, what is said to be apart is") {
  Index known = 0;
  for (int seed = 0; seed < 60; ++seed) {
    Sheets sheets(0.55 + 0.02 * seed);
    const Real size = 0.05 * (1 + seed % 12) * r, length = 2 + seed % 9;
    const Positions q = sheets.moved([&](Index v) {
      const Real phase = sheets.rest(v, 0) / length + (v < sheets.count ? 0 : 0.1 * seed) + seed;
      return Vec3(size * std::cos(phase), size * std::sin(2 * phase), 2 * size * std::sin(phase));
    });
    const LocalMotion::Kept found = kept(sheets, q);
    if (found.is_radius) CHECK(sheets.are_apart(q, r));
    if (found.is_some) CHECK(sheets.are_apart(q, 0.2 * r));
    known += found.is_radius ? 1 : 0;
  }
  CHECK(known > 10);
  CHECK(known < 60);
}

TEST_CASE("After forget() what counts is how far things are apart at the new reference") {
  Sheets sheets(3);
  CHECK(kept(sheets, sheets.rest).is_radius);
  const Positions near = sheets.moved([&](Index v) { return Vec3(0, 0, v < sheets.count ? 3 - 2.2 * r : 0); });
  Positions nearer = near;
  nearer(217, 2) += 1.3 * r;
  CHECK(!sheets.are_apart(nearer, r));
  sheets.motion.forget();
  CHECK(sheets.motion.kept(near, near, 0).is_radius);
  CHECK(!sheets.motion.kept(near, nearer, 1.3 * r).is_radius);
  CHECK(sheets.motion.kept(near, nearer, 1.3 * r).is_some);
}

TEST_CASE("Of places that are no numbers nothing is known") {
  Sheets sheets(3);
  for (const Real bad : {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity()}) {
    Positions q = sheets.rest;
    q(7, 1) = bad;
    CHECK(!sheets.motion.kept(sheets.rest, q, 0).is_radius);
    CHECK(!sheets.motion.kept(sheets.rest, q, 0).is_some);
  }
}

}  // namespace test_local_motion
