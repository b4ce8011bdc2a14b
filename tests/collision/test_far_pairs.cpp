// What is left out as far apart is so, whatever the shapes, and little else is left in.
#include <algorithm>
#include <functional>

#include <doctest/doctest.h>

#include "pliant/collision/pairs/far_pairs.h"
#include "tests/collision/soups.h"

namespace test_far_pairs {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// Two triangles, and two edges without one, of which all pairs are asked about.
Soup two_of_each(const Positions& q, Real reach) {
  Soup soup;
  soup.q = q;
  soup.triangles = {{0, 1, 2}, {3, 4, 5}};
  soup.edges = {{6, 7}, {8, 9}};
  soup.finish(reach);
  return soup;
}

Real size_of(const Positions& q, const Pair& pair) {
  Real size = 0;
  for (const Index v : pair.vertices) size = std::max(size, (q.row(v) - q.row(pair.vertices[0])).norm());
  return size;
}

struct Counts {
  std::size_t far = 0, dropped = 0;
};

/// Asks about all pairs; none that is near may be dropped. Counts those that are clearly far.
void check(const Soup& soup, Counts& counts) {
  const FarPairs far(soup.surface, soup.q, soup.radii);
  for (const PairKind kind : {PairKind::vertex_triangle, PairKind::edge_edge, PairKind::vertex_edge}) {
    std::vector<FarPairs::Items> items;
    std::vector<Pair> pairs;
    for (const Pair& pair : soup.pairs) {
      if (pair.kind != kind) continue;
      const Index loose_begin = kind == PairKind::vertex_edge ? soup.surface.loose_begin : 0;
      items.push_back({pair.features[0], pair.features[1] - loose_begin});
      pairs.push_back(pair);
    }
    const std::vector<FarPairs::Items> asked = items;
    items.resize(far.drop(kind, items));
    auto kept = items.begin();
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const bool is_kept = kept != items.end() && kept->first == asked[i].first && kept->second == asked[i].second;
      if (is_kept) ++kept;
      const Real distance = measure(soup.q, pairs[i]).distance;
      const Real reach = 2 * soup.radii[0];
      if (!is_kept) CHECK(distance > reach);
      if (!(distance > 1.02 * reach + 0.02 * size_of(soup.q, pairs[i]))) continue;
      ++counts.far;
      counts.dropped += is_kept ? 0 : 1;
    }
    CHECK(kept == items.end());
  }
}

void check_shapes(const std::function<void(Random&, Positions&)>& change) {
  Random random;
  Counts counts;
  for (int i = 0; i < 300; ++i) {
    for (const Real size : {1e-6, 1.0, 1e5}) {
      Positions q = random.positions(10, 1);
      change(random, q);
      const Vec3 place = random.vector(100);
      q = (size * (q.rowwise() + place.transpose())).eval();
      check(two_of_each(q, size * random.uniform(0, 0.7)), counts);
    }
  }
  CHECK(counts.far > 1000);
  CHECK(counts.dropped == counts.far);
}

}  // namespace

TEST_CASE("far pairs: of any shape") {
  check_shapes([](Random&, Positions&) {});
}

TEST_CASE("far pairs: flat ones, as in a sheet") {
  check_shapes([](Random& random, Positions& q) {
    for (Index v = 0; v < q.rows(); ++v) q(v, 2) = random.uniform(-1e-7, 1e-7);
  });
}

TEST_CASE("far pairs: almost parallel edges and thin triangles") {
  for (const Real angle : {0.0, 1e-12, 1e-7, 1e-5, 1e-4, 1e-3, 1e-2}) {
    check_shapes([&](Random& random, Positions& q) {
      const Vec3 direction = random.unit_vector();
      for (Index v = 0; v < q.rows(); ++v) {
        const Real along = random.uniform(-1, 1);
        const Vec3 across = (v % 2 == 0 ? 0.3 : -0.3) * direction.unitOrthogonal();
        const Vec3 apart = v < 3 || v > 7 ? across : Vec3(Vec3::Zero());
        q.row(v) = (along * direction + apart + random.vector(angle)).transpose();
      }
    });
  }
}

TEST_CASE("far pairs: no size, and numbers past the range of floats, leave nothing out that is near") {
  Random random;
  Counts counts;
  for (const Real size : {0.0, 1e-300, 1e-42, 1e-25, 1e-18, 1e15, 1e19, 1e25, 1e300}) {
    for (const Real reach : {0.0, 0.1, 3.0}) {
      for (int i = 0; i < 20; ++i) check(two_of_each(random.positions(10, size), reach * size), counts);
      Positions q = random.positions(10, size);
      q.row(1) = q.row(0);
      q.row(2) = q.row(0);
      q.row(7) = q.row(6);
      check(two_of_each(q, reach * size), counts);
    }
  }
}

}  // namespace test_far_pairs
