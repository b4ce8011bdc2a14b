#include <algorithm>
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "pliant/collision/pairs/pair_search.h"
#include "pliant/mesh/shapes.h"
#include "tests/collision/scenes_of_crossings.h"

namespace test_pair_search {

using namespace pliant;
using namespace pliant_tests;

namespace {

struct Bodies {
  std::vector<Mesh> meshes;
  std::vector<SurfacePart> parts;
  Positions positions = Positions(0, 3);

  explicit Bodies(std::vector<Mesh> all) : meshes(std::move(all)) {
    for (const Mesh& mesh : meshes) {
      const auto first = static_cast<Index>(positions.rows());
      parts.push_back({first, mesh.vertex_count(), mesh.triangles, mesh.edges, true, 0});
      positions.conservativeResize(first + mesh.vertex_count(), 3);
      positions.bottomRows(mesh.vertex_count()) = mesh.vertices;
    }
  }
  Index count() const { return static_cast<Index>(positions.rows()); }
  Surface surface(std::span<const Index> places = {}) const { return {parts, count(), places}; }
  std::vector<Real> pads(Real pad) const { return std::vector<Real>(at(count()), pad); }
};

Mesh rope(Index links, const Vec3& first, const Vec3& link) {
  Mesh mesh;
  mesh.vertices.resize(links + 1, 3);
  for (Index v = 0; v <= links; ++v) mesh.vertices.row(v) = (first + v * link).transpose();
  for (Index v = 0; v < links; ++v) mesh.edges.push_back({v, v + 1});
  return mesh;
}

/// Folded like an accordion, the layers about an edge apart; the unit is an edge.
Mesh folded_cloth(Index side) {
  Mesh mesh = whole_grid(side, side, 0, 1);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Real fold = std::abs(std::fmod(mesh.vertices(v, 0), 10.0) - 5);
    mesh.vertices.row(v) << 0.25 * mesh.vertices(v, 0), mesh.vertices(v, 1), fold + 0.3 * std::sin(mesh.vertices(v, 1));
  }
  return mesh;
}

/// The box of a vertex as it is documented, by other means.
struct RoundedBox {
  std::array<float, 3> low, high;

  RoundedBox(const Positions& begin, const Positions& end, Index v, Real pad) {
    constexpr float least = -std::numeric_limits<float>::max(), most = std::numeric_limits<float>::max();
    for (Index a = 0; a < 3; ++a) {
      const Real from = std::min(begin(v, a), end(v, a)) - pad, to = std::max(begin(v, a), end(v, a)) + pad;
      float& below = low[at(a)] = static_cast<float>(std::clamp<Real>(from, least, most));
      float& above = high[at(a)] = static_cast<float>(std::clamp<Real>(to, least, most));
      while (below > from && below > least) below = std::nextafter(below, least);
      while (above < to && above < most) above = std::nextafter(above, most);
    }
  }
  void add(const RoundedBox& other) {
    for (std::size_t a = 0; a < 3; ++a) {
      low[a] = std::min(low[a], other.low[a]), high[a] = std::max(high[a], other.high[a]);
    }
  }
  bool meets(const RoundedBox& other) const {
    for (std::size_t a = 0; a < 3; ++a) {
      if (low[a] > other.high[a] || other.low[a] > high[a]) return false;
    }
    return true;
  }
};

/// Every feature against every other.
class BruteForce {
 public:
  BruteForce(const Surface& surface, const Positions& begin, const Positions& end, std::span<const Real> pads,
             std::span<const char> is_held = {})
      : surface_(surface), is_held_(is_held) {
    for (Index v = 0; v < begin.rows(); ++v) boxes_.emplace_back(begin, end, v, pads[at(v)]);
    for (Index v = 0; v < count_of(surface.vertices); ++v) {
      const Index vertex = surface.vertices[at(v)];
      for (Index t = 0; t < count_of(surface.triangles); ++t) {
        const auto [a, b, c] = surface.triangles[at(t)];
        add({PairKind::vertex_triangle, surface.owned_by_triangle[at(t)], {v, t}, {vertex, a, b, c}});
      }
      for (Index e = surface.loose_begin; e < count_of(surface.edges); ++e) {
        const auto [a, b] = surface.edges[at(e)];
        add({PairKind::vertex_edge, surface.owned_by_edge[at(e - surface.loose_begin)], {v, e}, {vertex, a, b, b}});
      }
    }
    for (Index e = 0; e < count_of(surface.edges); ++e) {
      for (Index f = e + 1; f < count_of(surface.edges); ++f) {
        const auto [a, b] = surface.edges[at(e)];
        const auto [c, d] = surface.edges[at(f)];
        add({PairKind::edge_edge, 0, {e, f}, {a, b, c, d}});
      }
    }
    std::ranges::sort(pairs);
  }
  std::vector<Pair> pairs;

 private:
  void add(const Pair& pair) {
    const std::span all(pair.vertices);
    const std::span first = all.first(static_cast<std::size_t>(pair.first_side()));
    const std::span second = all.subspan(first.size());
    const auto hull = [&](std::span<const Index> side) {
      RoundedBox box = boxes_[at(side.front())];
      for (const Index v : side) box.add(boxes_[at(v)]);
      return box;
    };
    const auto is_held = [&](Index v) { return !is_held_.empty() && is_held_[at(v)] != 0; };
    if (!hull(first).meets(hull(second)) || std::ranges::find_first_of(first, second) != first.end()) return;
    const Index body_a = surface_.body[at(first.front())], body_b = surface_.body[at(second.front())];
    if (surface_.may_meet(body_a, body_b) && !std::ranges::all_of(all, is_held)) pairs.push_back(pair);
  }

  const Surface& surface_;
  std::span<const char> is_held_;
  std::vector<RoundedBox> boxes_;
};

/// Also what == of pairs does not look at.
bool are_the_same(std::span<const Pair> a, std::span<const Pair> b) {
  return std::ranges::equal(
      a, b, [](const Pair& x, const Pair& y) { return x == y && x.owned == y.owned && x.vertices == y.vertices; });
}

std::size_t count_of_kind(std::span<const Pair> pairs, PairKind kind) {
  return static_cast<std::size_t>(std::ranges::count(pairs, kind, &Pair::kind));
}

/// The pairs, which are checked against brute force. A search of its own unless one is given.
std::vector<Pair> checked_pairs(const Surface& surface, const Positions& begin, const Positions& end,
                                std::span<const Real> pads, PairSearch* search = nullptr) {
  ThreadPool pool(1);
  PairSearch own(surface);
  const std::span<const Pair> found = (search != nullptr ? *search : own).find(begin, end, pads, pool);
  const BruteForce expected(surface, begin, end, pads);
  CHECK(found.size() == expected.pairs.size());
  CHECK(are_the_same(found, expected.pairs));
  return {found.begin(), found.end()};
}

}  // namespace

TEST_CASE("pair search: random soups") {
  Random random;
  for (const Index count : {1, 2, 7, 9, 64, 65, 200}) {
    for (const Real pad : {0.0, 0.01, 0.3}) {
      const Bodies bodies({soup(random, count, 0.1), soup(random, count / 2 + 1, 0.2)});
      const Positions end = bodies.positions + random.positions(bodies.count(), 0.1);
      std::vector<Real> pads = bodies.pads(pad);
      for (Real& each : pads) each *= random.uniform(0, 1);
      checked_pairs(bodies.surface(), bodies.positions, end, pads);
    }
  }
}

TEST_CASE("pair search: a folded cloth, with ropes") {
  const Bodies bodies({folded_cloth(14), rope(9, {0, 0, 0.4}, {0.3, 1, 0.1}), rope(20, {0.1, 3, 0.4}, {0.2, 0, 0})});
  const Surface surface = bodies.surface();
  const std::vector<Pair> pairs = checked_pairs(surface, bodies.positions, bodies.positions, bodies.pads(0.2));
  CHECK(count_of_kind(pairs, PairKind::vertex_triangle) > 500);
  CHECK(count_of_kind(pairs, PairKind::edge_edge) > 2000);
  CHECK(count_of_kind(pairs, PairKind::vertex_edge) > 50);
}

TEST_CASE("pair search: in the order of the solver the same features are found") {
  const Bodies bodies({folded_cloth(8), rope(9, {0, 0, 0.4}, {0.3, 1, 0.1})});
  const std::vector<Pair> pairs = checked_pairs(bodies.surface(), bodies.positions, bodies.positions, bodies.pads(0.2));
  std::vector<Index> places;
  for (Index v = 0; v < bodies.count(); ++v) places.push_back((v * 10 + 3) % bodies.count());
  Positions moved(bodies.count(), 3);
  for (Index v = 0; v < bodies.count(); ++v) moved.row(places[at(v)]) = bodies.positions.row(v);
  const std::vector<Pair> same = checked_pairs(bodies.surface(places), moved, moved, bodies.pads(0.2));
  CHECK(std::ranges::equal(pairs, same));
  REQUIRE(!pairs.empty());
  CHECK(same.front().vertices[0] == places[at(pairs.front().vertices[0])]);
}

TEST_CASE("pair search: after refits, and after trees were put in order anew") {
  Random random;
  const Bodies bodies({whole_grid(20, 20, 0, 1), rope(100, {0, 0, 1}, {0.2, 0.2, 0})});
  const Surface surface = bodies.surface();
  PairSearch search(surface);
  Positions x = bodies.positions;
  const std::vector<Real> pads = bodies.pads(0.1);
  for (int step = 0; step < 6; ++step) {
    const Positions end = x + random.positions(bodies.count(), 0.2);
    checked_pairs(surface, x, end, pads, &search);
    x = end;
  }
  CHECK(search.build_count() == 4);  // one for each tree
  x = random.positions(bodies.count(), 5);
  const std::vector<Pair> pairs = checked_pairs(surface, x, x, pads, &search);
  CHECK(!pairs.empty());
  CHECK(search.build_count() == 8);
  checked_pairs(surface, x, x, pads, &search);
  CHECK(search.build_count() == 8);
}

TEST_CASE("pair search: huge steps") {
  Random random;
  const Bodies bodies({folded_cloth(12), soup(random, 40, 0.3)});
  const Surface surface = bodies.surface();
  PairSearch search(surface);
  Positions end = bodies.positions;
  end.row(17) << 1e6, -1e6, 1e6;
  checked_pairs(surface, bodies.positions, end, bodies.pads(0.2), &search);
  end = bodies.positions + random.positions(bodies.count(), 1e6);
  checked_pairs(surface, bodies.positions, end, bodies.pads(0.2), &search);
}

TEST_CASE("pair search: one spot, no size, enormous coordinates") {
  Random random;
  const Bodies bodies({whole_grid(5, 5, 0, 1), rope(5, {1, 1, 1}, {1, 0, 0})});
  const Surface surface = bodies.surface();
  PairSearch search(surface);
  const std::vector<Real> none = bodies.pads(0);
  const Positions spot = Positions::Constant(bodies.count(), 3, 0.1);
  const std::vector<Pair> all = checked_pairs(surface, spot, spot, none, &search);
  const std::size_t edges = surface.edges.size();
  CHECK(count_of_kind(all, PairKind::edge_edge) < edges * (edges - 1) / 2);
  CHECK(count_of_kind(all, PairKind::edge_edge) > edges * (edges - 1) / 3);
  for (const Real size : {1e15, 1e30, 1e300, 1e-40, 1e-300}) {
    const Positions begin = random.positions(bodies.count(), size);
    const Positions end = random.positions(bodies.count(), size);
    checked_pairs(surface, begin, end, bodies.pads(size / 100), &search);
    checked_pairs(surface, begin * 0.001, begin * 0.001, none, &search);
  }
  checked_pairs(surface, spot, spot, none, &search);
}

TEST_CASE("pair search: bodies that take no notice of themselves or of others, and held vertices") {
  Random random;
  Bodies bodies({folded_cloth(9), rope(20, {0, 0, 0.4}, {0.3, 0.4, 0.1}), soup(random, 30, 0.4)});
  bodies.parts[1].meets_itself = false;
  bodies.parts[1].group = 1;
  bodies.parts[2].group = 2;
  Surface surface = bodies.surface();
  const std::vector<Real> pads = bodies.pads(0.4);
  const std::size_t count = checked_pairs(surface, bodies.positions, bodies.positions, pads).size();
  surface.ignored = {0, 0, 1, 0, 0, 0, 1, 0, 0};
  CHECK(checked_pairs(surface, bodies.positions, bodies.positions, pads).size() < count);

  ThreadPool pool(2);
  PairSearch search(surface);
  std::vector<char> is_held(at(bodies.count()), 0);
  for (const Index held_every : {1, 2, 3, 40}) {
    for (Index v = 0; v < bodies.count(); ++v) is_held[at(v)] = v / 8 % held_every == 0 ? 1 : 0;
    search.set_held(is_held);
    const std::span<const Pair> found = search.find(bodies.positions, bodies.positions, pads, pool);
    const BruteForce expected(surface, bodies.positions, bodies.positions, pads, is_held);
    CHECK(expected.pairs.empty() == (held_every == 1));
    CHECK(are_the_same(found, expected.pairs));
  }
  // Trees that are built anew know their owners.
  const std::int64_t builds = search.build_count();
  const Positions scattered = random.positions(bodies.count(), 3);
  const std::span<const Pair> found = search.find(scattered, scattered, pads, pool);
  CHECK(search.build_count() > builds);
  CHECK(are_the_same(found, BruteForce(surface, scattered, scattered, pads, is_held).pairs));

  search.set_held({});
  const BruteForce expected(surface, bodies.positions, bodies.positions, pads);
  CHECK(are_the_same(search.find(bodies.positions, bodies.positions, pads, pool), expected.pairs));
}

TEST_CASE("pair search: the same for any number of threads") {
  Random random;
  const Bodies bodies({folded_cloth(60), soup(random, 300, 0.5), rope(300, {0, 0, 0.4}, {0.03, 0.1, 0.01})});
  const Surface surface = bodies.surface();
  const std::vector<Real> pads = bodies.pads(0.3);
  const Positions end = bodies.positions + random.positions(bodies.count(), 0.3);
  PairSearch search(surface);
  ThreadPool one(1);
  const std::span<const Pair> pairs = search.find(bodies.positions, end, pads, one);
  CHECK(pairs.size() > 100000);
  CHECK(std::ranges::is_sorted(pairs));
  for (const int threads : {2, 3, 8}) {
    ThreadPool pool(threads);
    PairSearch other(surface);
    CHECK(are_the_same(pairs, other.find(bodies.positions, end, pads, pool)));
    CHECK(are_the_same(pairs, other.find(bodies.positions, end, pads, pool)));
  }
}

TEST_CASE("pair search: too many pairs end in a message, not in the memory") {
  const Bodies bodies({whole_grid(3, 3, 0, 1), whole_grid(120, 120, 0, 1)});
  const Surface surface = bodies.surface();
  Positions spot = Positions::Constant(bodies.count(), 3, 2.5);
  spot.topRows(16) = bodies.positions.topRows(16);
  spot.topRows(16).col(2).setConstant(7);
  const std::vector<Real> pads = bodies.pads(0);
  std::string first;
  for (const int threads : {1, 2, 8}) {
    ThreadPool pool(threads);
    PairSearch search(surface, 1000000);
    const std::string message = error_of([&] { search.find(spot, spot, pads, pool); });
    CHECK(message.find("more than 1000000 pairs") != std::string::npos);
    CHECK(message.find("of body 1, which goes to (2.5, 2.5, 2.5) m") != std::string::npos);
    CHECK(search.pairs().empty());
    if (first.empty()) first = message;
    CHECK(message == first);
    // It can be used again.
    CHECK(!search.find(bodies.positions, bodies.positions, pads, pool).empty());
  }
}

TEST_CASE("pair search: as many pairs as are allowed") {
  const Bodies bodies({folded_cloth(20), rope(20, {0, 0, 0.4}, {0.3, 0.4, 0.1})});
  const Surface surface = bodies.surface();
  ThreadPool pool(2);
  PairSearch search(surface);
  const auto count =
      static_cast<std::int64_t>(search.find(bodies.positions, bodies.positions, bodies.pads(0.2), pool).size());
  PairSearch enough(surface, count), too_few(surface, count - 1);
  CHECK(std::ssize(enough.find(bodies.positions, bodies.positions, bodies.pads(0.2), pool)) == count);
  CHECK_THROWS_AS(too_few.find(bodies.positions, bodies.positions, bodies.pads(0.2), pool), Error);
}

TEST_CASE("pair search: nothing to find") {
  ThreadPool pool(1);
  const Surface none({}, 0, {});
  PairSearch search(none);
  CHECK(search.find(Positions(0, 3), Positions(0, 3), {}, pool).empty());
  const Bodies bodies({mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}})});
  CHECK(checked_pairs(bodies.surface(), bodies.positions, bodies.positions, bodies.pads(0)).empty());
}

}  // namespace test_pair_search
