// Planes between surfaces: whatever the wishes, nothing meets on the way; and what is not in the way is left alone.
#include <doctest/doctest.h>

#include "pliant/collision/pairs/planes.h"
#include "soups.h"

namespace test_planes {

using namespace pliant;
using namespace pliant_tests;

namespace {

Shortened shorten(const Soup& soup, const Positions& q, Positions& y, int threads = 1) {
  ThreadPool pool(threads);
  Planes planes;
  return planes.shorten({.begin = q, .surface = soup.surface, .pairs = soup.pairs, .radii = soup.radii}, y, pool);
}

/// From a fraction of the distances to a hundred times the scene; each vertex by itself, pieces as a whole, or all
/// towards one point.
Positions random_wishes(Random& random, const Positions& q, Real size) {
  const Real length = size * std::pow(10, random.uniform(-3, 2));
  Positions y = q;
  const Index kind = random.index(3);
  Vec3 way = Vec3::Zero();
  for (Index i = 0; i < q.rows(); ++i) {
    if (kind == 0 || random.index(9) == 0) way = random.vector(length);
    y.row(i) += way.transpose();
    if (kind == 2) y.row(i) -= length / size * q.row(i);
  }
  return y;
}

/// Pairs that meet on the way, and crossings at ten shares of it.
struct Met {
  int pairs = 0;
  int shares = 0;
  Real nearest = 1e300;
};

Met count_met(const Soup& soup, const Positions& q, const Positions& y, Real tolerance) {
  Met met;
  std::vector<Real> ways(at(static_cast<Index>(q.rows())));
  for (Index i = 0; i < q.rows(); ++i) ways[at(i)] = (y.row(i) - q.row(i)).norm();
  for (const Pair& pair : soup.pairs) {
    Real way = 0;
    for (const Index v : pair.vertices) way = std::max(way, ways[at(v)]);
    if (2 * way < measure(q, pair).distance) continue;
    met.nearest = std::min(met.nearest, measure(y, pair).distance);
    if (pair.kind != PairKind::vertex_edge) met.pairs += meets_on_way(q, y, pair, tolerance) ? 1 : 0;
  }
  for (int i = 1; i <= 10; ++i) {
    met.shares += soup.is_crossing(q + static_cast<Real>(i) / 10 * (y - q)) ? 1 : 0;
  }
  return met;
}

/// A flat sheet of n × n vertices an edge of `edge` apart, from the corner on.
void add_sheet(Soup& soup, Index n, Real edge, const Vec3& corner, Real angle = 0) {
  Positions points(n * n, 3);
  std::vector<Triangle> triangles;
  const Mat3 rotation = Eigen::AngleAxis<Real>(angle, Vec3::UnitZ()).toRotationMatrix();
  for (Index i = 0; i < n * n; ++i) {
    points.row(i) = (corner + rotation * Vec3(edge * (i % n), edge * static_cast<Real>(i / n), 0)).transpose();
    if (i % n == n - 1 || i / n == n - 1) continue;
    triangles.push_back({i, i + 1, i + n + 1});
    triangles.push_back({i, i + n + 1, i + n});
  }
  soup.add(points, triangles, false);
}

/// Two sheets of 36 vertices a distance apart, the upper one turned.
Soup two_sheets(Real distance, Real angle) {
  Soup soup;
  soup.q.resize(0, 3);
  add_sheet(soup, 6, 0.1, Vec3::Zero());
  add_sheet(soup, 6, 0.1, {0.05, 0.03, distance}, angle);
  soup.finish(0.02);
  return soup;
}

}  // namespace

TEST_CASE("whatever the wishes, no pair meets on its way") {
  Random random(11);
  int blind_pairs = 0, blind_shares = 0, tried = 0;
  for (int run = 0; run < 120; ++run) {
    Soup soup = random_soup(random, 16);
    const Real size = std::array{1e-4, 1.0, 1e4}[at(run % 3)];
    const Vec3 shift = run % 5 == 0 ? random.vector(1000) : Vec3(Vec3::Zero());
    soup.q.rowwise() += shift.transpose();
    soup.q *= size;
    soup.finish(0.03 * size);
    Positions q = soup.q;
    for (int step = 0; step < 4; ++step) {
      const Positions wish = random_wishes(random, q, size);
      const Met blind = count_met(soup, q, wish, 1e-7 * size);
      blind_pairs += blind.pairs > 0 ? 1 : 0;
      blind_shares += blind.shares > 0 ? 1 : 0;
      Positions y = wish;
      const Shortened done = shorten(soup, q, y);
      const Met met = count_met(soup, q, y, 1e-11 * size);
      CHECK(y.allFinite());
      CHECK(met.pairs == 0);
      CHECK(met.shares == 0);
      CHECK(met.nearest > 0);
      CHECK(done.touching == 0);
      CHECK(done.passes < 30);
      CHECK((done.vertices > 0) == (y != wish));
      CHECK(((y - q).rowwise().norm().array() <= (wish - q).rowwise().norm().array() * (1 + 1e-12)).all());
      q = y;
      ++tried;
    }
  }
  CHECK(tried == 480);
  CHECK(blind_pairs > 240);
  CHECK(blind_shares > 120);
}

TEST_CASE("no vertex leaves the boxes that ways are to stay within, and no pair meets") {
  Random random(12);
  Index cut = 0, free_left = 0;
  for (int run = 0; run < 40; ++run) {
    Soup soup = random_soup(random, 16);
    soup.finish(0.03);
    Positions q = soup.q;
    for (int step = 0; step < 3; ++step) {
      const Positions wish = random_wishes(random, q, 1);
      Positions y = wish;
      ThreadPool pool(1);
      Planes planes;
      const WayBoxes boxes{q.cwiseMin(wish), q.cwiseMax(wish)};
      const auto has_left = [&](Index v) {
        return (boxes.low.row(v) - y.row(v)).maxCoeff() > 1e-12 || (y.row(v) - boxes.high.row(v)).maxCoeff() > 1e-12;
      };
      const PlanesInput free{.begin = q, .surface = soup.surface, .pairs = soup.pairs, .radii = soup.radii};
      planes.shorten(free, y, pool);
      for (Index v = 0; v < y.rows(); ++v) free_left += has_left(v) ? 1 : 0;
      y = wish;
      const PlanesInput input{
          .begin = q, .surface = soup.surface, .pairs = soup.pairs, .radii = soup.radii, .within = &boxes};
      cut += planes.shorten(input, y, pool).vertices;
      const Met met = count_met(soup, q, y, 1e-11);
      CHECK(met.pairs == 0);
      CHECK(met.shares == 0);
      for (Index v = 0; v < y.rows(); ++v) {
        CHECK(!has_left(v));
      }
      q = y;
    }
  }
  CHECK(cut > 100);
  CHECK(free_left > 100);
}

TEST_CASE("all vertices pulled to one point again and again, till triangles are slivers, cross nothing") {
  for (const std::uint64_t seed : std::array<std::uint64_t, 3>{1, 2, 20028}) {
    Random random(seed);
    Soup soup = random_soup(random, 16);
    soup.finish(0.01);
    Positions q = soup.q;
    const Eigen::RowVector3d center = q.colwise().mean();
    for (int step = 0; step < 40; ++step) {
      Positions y = q;
      y.rowwise() = center;
      CHECK(shorten(soup, q, y).touching == 0);
      for (const Real share : {0.3, 0.7, 1.0}) CHECK_FALSE(soup.is_crossing(q + share * (y - q)));
      q = y;
    }
    CHECK((q.rowwise() - center).rowwise().norm().mean() < 0.5 * (soup.q.rowwise() - center).rowwise().norm().mean());
  }
}

TEST_CASE("the same bits for every number of threads, and vertices that are free keep theirs") {
  Random random(12);
  for (int run = 0; run < 10; ++run) {
    Soup soup = random_soup(random, 24);
    soup.finish(0.03);
    const Positions wish = random_wishes(random, soup.q, 1);
    Positions one = wish;
    const Shortened done = shorten(soup, soup.q, one, 1);
    for (const int threads : {2, 3, 8}) {
      Positions other = wish;
      const Shortened found = shorten(soup, soup.q, other, threads);
      CHECK(other == one);
      CHECK(found.planes == done.planes);
      CHECK(found.passes == done.passes);
    }
    ThreadPool pool(1);
    Planes planes;
    for (int again = 0; again < 2; ++again) {  // what is left of the call before does not matter
      Positions y = wish;
      planes.shorten({.begin = soup.q, .surface = soup.surface, .pairs = soup.pairs, .radii = soup.radii}, y, pool);
      CHECK(y == one);
      for (Index i = 0; i < y.rows(); ++i) {
        if (planes.is_shortened()[at(i)] == 0) CHECK(y.row(i) == wish.row(i));
      }
    }
    std::vector<Real> distances;
    for (const Pair& pair : soup.pairs) distances.push_back(0.999 * measure(soup.q, pair).distance);
    Positions y = wish;
    planes.shorten({soup.q, soup.surface, soup.pairs, distances, soup.radii, {}}, y, pool);
    CHECK(y == one);
  }
}

TEST_CASE("sliding, parting and moving together are free") {
  for (const Real angle : {0.0, 0.3}) {
    for (const Real distance : {0.02, 0.011, 1e-4}) {
      const Soup soup = two_sheets(distance, angle);
      const auto moved = [&](const Vec3& lower, const Vec3& upper) {
        Positions wish = soup.q;
        wish.topRows(36).rowwise() += lower.transpose();
        wish.bottomRows(36).rowwise() += upper.transpose();
        Positions y = wish;
        shorten(soup, soup.q, y);
        return (y - wish).cwiseAbs().maxCoeff();
      };
      CHECK(moved({0, 0, 0}, {0.2, 0.13, 0}) <= 1e-12);
      CHECK(moved({-0.1, 0, 0}, {0.1, 0.05, 0}) <= 1e-12);
      CHECK(moved({0, 0, 0}, {0, 0, 0.5}) == 0);
      CHECK(moved({0, 0, -3}, {0.3, 0, 0.5}) == 0);
      CHECK(moved({1, 2, -3}, {1, 2, -3}) == 0);
      CHECK(moved({0, 0, 0}, {0, 0, -2 * distance}) > 0.5 * distance);
    }
  }
}

TEST_CASE("a vertex that comes down and runs ahead slides on a flat sheet, and is not lifted") {
  Soup soup;
  soup.q.resize(0, 3);
  add_sheet(soup, 12, 0.1, {-0.3, -0.3, 0});
  const Real height = 0.02;
  Positions points(3, 3);
  points << 0, 0.013, height, 0.11, 0.02, height + 0.3, 0, 0.1, height + 0.3;
  soup.add(points, {{0, 1, 2}}, false);
  soup.finish(0.02);
  for (const Vec3& way : {Vec3{0.2, 0.1, 0}, Vec3{0.2, 0.07, -0.008}, Vec3{0.3, 0.01, -0.05}}) {
    Positions wish = soup.q;
    wish.bottomRows(3).rowwise() += way.transpose();
    Positions y = wish;
    shorten(soup, soup.q, y);
    const Vec3 first = row(y, 144) - row(soup.q, 144);
    CHECK(std::abs(first.x() - way.x()) < 1e-12);
    CHECK(std::abs(first.y() - way.y()) < 1e-12);
    CHECK(first.z() == doctest::Approx(std::max(way.z(), -0.45 * height)).epsilon(1e-9));
    CHECK((y.topRows(144) - wish.topRows(144)).cwiseAbs().maxCoeff() == 0);
  }
}

TEST_CASE("half-spaces of a vertex hold as well") {
  Soup soup = two_sheets(0.01, 0.3);
  Random random(13);
  std::vector<HalfSpace> half_spaces;
  for (Index v = 0; v < 72; ++v) half_spaces.push_back({v, random.unit_vector(), random.uniform(0, 0.01)});
  half_spaces.push_back({5, Vec3::UnitX(), -1});
  for (int i = 0; i < 20; ++i) {
    Positions y = soup.q + random.positions(72, 0.1);
    ThreadPool pool(1);
    Planes planes;
    const PlanesInput input{soup.q, soup.surface, soup.pairs, {}, soup.radii, half_spaces};
    planes.shorten(input, y, pool);
    for (const HalfSpace& each : half_spaces) {
      CHECK(each.normal.dot(row(y, each.vertex) - row(soup.q, each.vertex)) >= -std::max(0.0, each.room) - 1e-15);
    }
    const Met met = count_met(soup, soup.q, y, 1e-12);
    CHECK(met.pairs + met.shares == 0);
  }
  Positions y = soup.q;
  y.row(40) << 0.5, 0.5, 5;
  const Positions wish = y;
  ThreadPool pool(1);
  const std::array<HalfSpace, 1> away{HalfSpace{40, Vec3::UnitX(), 0}};
  Planes planes;
  planes.shorten({soup.q, soup.surface, soup.pairs, {}, soup.radii, away}, y, pool);
  CHECK(y == wish);
}

TEST_CASE("pairs that touch are left out and named; nothing freezes and nothing is lost") {
  Soup soup;
  soup.q.resize(7, 3);
  for (const Real height : {0.0, 1e-300, 1e-17}) {
    soup.q << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.3, height, 0.3, 0.2, 1, 0.2, 0.5, 1, 5, 5, 5;
    soup.triangles = {{0, 1, 2}, {3, 4, 5}};
    soup.finish(0.02);
    Random random(14);
    Positions wish = soup.q + random.positions(7, 0.3);
    Positions y = wish;
    const Shortened done = shorten(soup, soup.q, y);
    CHECK(y.allFinite());
    CHECK(done.touching == 1);
    CHECK((y.row(3) - soup.q.row(3)).norm() > 0);
    wish = soup.q;
    wish.bottomRows(4).rowwise() += Eigen::RowVector3d(0, 0, 0.5);
    y = wish;
    CHECK(shorten(soup, soup.q, y).vertices == 0);
    CHECK(y == wish);
  }
}

TEST_CASE("pairs as near as rounding may part, and come no nearer") {
  Soup soup;
  soup.q.resize(6, 3);
  for (const Real size : {1e-4, 1.0, 1e4}) {
    for (const Real height : {3e-14, 1e-13}) {
      soup.q << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0.2, 0.3, height, 0.3, 0.2, 1, 0.2, 0.5, 1;
      soup.q *= size;
      soup.triangles = {{0, 1, 2}, {3, 4, 5}};
      soup.finish(0.02 * size);
      const auto moved = [&](const Vec3& way) {
        Positions y = soup.q;
        y.row(3) += size * way.transpose();
        CHECK(shorten(soup, soup.q, y).touching == 0);
        return Vec3((row(y, 3) - row(soup.q, 3)) / size);
      };
      CHECK(moved({0.01, 0, 0.1}) == Vec3((row(soup.q, 3) + size * Vec3{0.01, 0, 0.1} - row(soup.q, 3)) / size));
      CHECK(moved({0, 0, -0.1}).z() >= 0);
      CHECK(moved({0.1, 0, -0.1}).z() >= 0);
      CHECK(moved({0.1, 0, -0.1}).norm() <= 0.2);
    }
  }
  // Pressed again and again, a pair keeps its sides.
  Positions q = soup.q / 1e4;
  soup.finish(0.02);
  q(3, 2) = 0.01;
  for (int i = 0; i < 60; ++i) {
    Positions y = q;
    y(3, 2) -= 0.5;
    y.topRows(3).col(2).array() += 0.5;
    CHECK(shorten(soup, q, y).touching == 0);
    q = y;
    CHECK(measure(q, soup.pairs.front()).distance > 0);
  }
  CHECK_FALSE(soup.is_crossing(q));
  CHECK(q(3, 2) - q.topRows(3).col(2).minCoeff() < 1e-11);
  CHECK(q(3, 2) > std::max({q(0, 2), q(1, 2), q(2, 2)}));
}

}  // namespace test_planes
