#include <cmath>
#include <limits>

#include <doctest/doctest.h>

#include "pliant/collision/pairs/pair_list.h"
#include "tests/collision/scenes_of_crossings.h"

namespace test_flat_sheets {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real r = 0.25;  // the unit is an edge

/// A body, its surface, and all that may be asked of it.
struct Rig {
  Mesh mesh;
  std::array<SurfacePart, 1> parts;
  Surface surface;
  FlatSheets sheets;
  ThreadPool pool{1};

  explicit Rig(Mesh of)
      : mesh(std::move(of)),
        parts{SurfacePart{0, mesh.vertex_count(), mesh.triangles, mesh.edges, true, 0}},
        surface(parts, mesh.vertex_count(), {}) {
    sheets.set_surface(surface, mesh.vertices);
    if (sheets.is_empty()) return;
    std::vector<Real> nearest(at(mesh.vertex_count()), 4 * r);
    const Positions flat = sheets.flattened(mesh.vertices, 1);
    for (const Pair& pair : all_pairs(flat, flat, 2 * r)) {
      for (const Index v : pair.vertices) nearest[at(v)] = std::min(nearest[at(v)], measure(flat, pair).distance);
    }
    sheets.set_nearest(nearest);
  }
  std::vector<Pair> all_pairs(const Positions& begin, const Positions& end, Real pad,
                              const FlatSheets* without = nullptr) {
    PairSearch search(surface);
    const std::vector<Real> pads(at(mesh.vertex_count()), pad);
    const std::span<const Pair> found = search.find(begin, end, pads, pool, nullptr, without);
    return {found.begin(), found.end()};
  }
  /// Those that are not found since they are known to be apart.
  std::vector<Pair> left_out(const Positions& begin, const Positions& end, Real pad) {
    const std::vector<Pair> all = all_pairs(begin, end, pad), found = all_pairs(begin, end, pad, &sheets);
    std::vector<Pair> out;
    std::ranges::set_difference(all, found, std::back_inserter(out));
    CHECK(out.size() + found.size() == all.size());
    return out;
  }
};

Positions positions_of(const Mesh& mesh, auto&& place) {
  Positions q(mesh.vertex_count(), 3);
  for (Index v = 0; v < q.rows(); ++v) q.row(v) = place(row(mesh.vertices, v)).transpose();
  return q;
}

/// Of a grid in the plane of x and y: smooth and torn, spread out and in one spot.
std::vector<Positions> shapes(const Mesh& mesh, Random& random) {
  std::vector<Positions> all{mesh.vertices};
  const auto add = [&](auto&& place) { all.push_back(positions_of(mesh, place)); };
  for (const Real radius : {0.2, 1.0, 3.0, 20.0}) {
    add([&](const Vec3& x) {
      return Vec3(radius * std::sin(x.x() / radius), x.y(), radius * std::cos(x.x() / radius) + 0.02 * x.y());
    });
  }
  for (const Real width : {1.0, 4.0, 9.0}) {
    add([&](const Vec3& x) { return Vec3(0.3 * x.x(), x.y(), std::abs(std::fmod(x.x() + x.y(), 2 * width) - width)); });
  }
  for (const Real stretch : {0.0, 0.3, 0.6, 0.8, 1.2, 3.0, 100.0}) {
    add([&](const Vec3& x) { return Vec3(stretch * x.x(), stretch * x.y(), 0.1 * x.x()); });
    add([&](const Vec3& x) { return Vec3(stretch * x.x(), x.y(), x.z()); });
    add([&](const Vec3& x) { return Vec3(x.x() + stretch * x.y(), x.y(), 7); });
  }
  for (const Real noise : {0.05, 0.1, 0.2, 0.5, 3.0})
    all.push_back(mesh.vertices + random.positions(all[0].rows(), noise));
  add([](const Vec3&) { return Vec3(0.1, 0.2, 0.3); });
  add([](const Vec3& x) { return Vec3(1e6 + x.x(), x.y(), 1e6 * x.y()); });
  Positions doubled = mesh.vertices;
  for (Index v = 0; v + 1 < doubled.rows(); v += 7) doubled.row(v) = doubled.row(v + 1);
  all.push_back(doubled);
  return all;
}

Mesh slanted(Mesh mesh) {
  return turned(std::move(mesh), Eigen::AngleAxis<Real>(0.8, Vec3(1, 2, -0.5).normalized()).toRotationMatrix());
}

/// A grid whose inner vertices do not lie in rows.
Mesh uneven_grid(Random& random) {
  Mesh mesh = whole_grid(16, 11, 0, 1);
  for (Index v = 0; v < mesh.vertex_count(); ++v) {
    const Vec3 x = row(mesh.vertices, v);
    if (x.x() > 0 && x.x() < 16 && x.y() > 0 && x.y() < 11)
      mesh.vertices.row(v).head<2>() += random.positions(1, 0.2).row(0).head<2>();
  }
  return mesh;
}

}  // namespace

TEST_CASE("flat sheets: what is left out is farther apart than asked for") {
  Random random;
  for (const Mesh& mesh : {whole_grid(14, 14, 0, 1), whole_grid(40, 3, 0, 1), uneven_grid(random)}) {
    Rig rig(mesh);
    REQUIRE(!rig.sheets.is_empty());
    for (const Positions& q : shapes(mesh, random)) {
      for (const Real distance : {0.2, 0.5, 0.65}) {
        rig.sheets.find_spread(q, distance, rig.pool);
        Real nearest = std::numeric_limits<Real>::infinity();
        for (const Pair& pair : rig.left_out(q, q, distance / 2))
          nearest = std::min(nearest, measure(q, pair).distance);
        CHECK(nearest > distance);
      }
    }
  }
}

TEST_CASE("flat sheets: nothing is near that is left out, anywhere on a way of all at once") {
  Random random;
  const Mesh mesh = whole_grid(14, 14, 0, 1);
  Rig rig(mesh);
  const std::vector<Positions> all = shapes(mesh, random);
  std::size_t count = 0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Positions& begin = all[i];
    for (const Positions& end : {all[(i + 1) % all.size()], Positions(begin + random.positions(begin.rows(), 0.1)),
                                 Positions(begin.rowwise() + Eigen::RowVector3<Real>(3, 1, 2))}) {
      rig.sheets.find_spread(begin, end, r, rig.pool);
      const std::vector<Pair> out = rig.left_out(begin, end, 0.1 * r);
      count += out.size();
      Real nearest = std::numeric_limits<Real>::infinity();
      for (int k = 0; k <= 10; ++k) {
        const Positions q = begin + 0.1 * k * (end - begin);
        for (const Pair& pair : out) nearest = std::min(nearest, measure(q, pair).distance);
      }
      CHECK(nearest > r);
    }
  }
  CHECK(count > 1000);
}

TEST_CASE("flat sheets: a sheet that is spread out has nothing to search for, however it lies and bends") {
  const Mesh grid = whole_grid(30, 30, 0, 1);
  for (const Mesh& mesh : {grid, slanted(grid)}) {
    Rig rig(mesh);
    REQUIRE(!rig.sheets.is_empty());
    rig.sheets.find_spread(mesh.vertices, 2 * r, rig.pool);
    const std::size_t all = rig.all_pairs(mesh.vertices, mesh.vertices, r).size();
    CHECK(all > 3000);
    CHECK(rig.left_out(mesh.vertices, mesh.vertices, r).size() > all * 9 / 10);
  }
  Rig rig(grid);
  const Positions bent = positions_of(
      grid, [](const Vec3& x) { return Vec3(20 * std::sin(x.x() / 20), x.y(), 20 * std::cos(x.x() / 20)); });
  rig.sheets.find_spread(bent, 2 * r, rig.pool);
  CHECK(rig.left_out(bent, bent, r).size() > rig.all_pairs(bent, bent, r).size() / 2);
}

TEST_CASE("flat sheets: numbers that are none are nowhere spread out") {
  const Mesh mesh = whole_grid(10, 10, 0, 1);
  Rig rig(mesh);
  for (const Real bad : {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity(), 1e300}) {
    Positions q = mesh.vertices;
    q(60, 1) = bad;
    rig.sheets.find_spread(q, 0.1, rig.pool);
    const FlatSheets::Box there = rig.sheets.box_of(60);
    CHECK(!rig.sheets.are_apart(there, there));
    rig.sheets.find_spread(mesh.vertices, q, 0.1, rig.pool);
    CHECK(!rig.sheets.are_apart(there, there));
    rig.sheets.find_spread(mesh.vertices, 0.1, rig.pool);
    CHECK(rig.sheets.are_apart(there, there));
  }
}

TEST_CASE("flat sheets: what is none") {
  const auto is_sheet = [](const Mesh& mesh) { return !Rig(mesh).sheets.is_empty(); };
  const Mesh grid = whole_grid(6, 6, 0, 1);
  CHECK(is_sheet(grid));
  CHECK(is_sheet(slanted(grid)));
  Mesh without_corner = grid;
  without_corner.triangles.erase(without_corner.triangles.end() - 2, without_corner.triangles.end());
  CHECK(!is_sheet(without_corner));
  Mesh with_hole = grid;
  with_hole.triangles.erase(with_hole.triangles.begin() + 30);
  CHECK(!is_sheet(with_hole));
  Mesh with_slit = grid;  // two triangles no longer share the vertex in the middle with the others
  with_slit.vertices.conservativeResize(grid.vertex_count() + 1, 3);
  with_slit.vertices.row(grid.vertex_count()) = grid.vertices.row(24);
  for (std::size_t t = 0; t < 42; ++t) std::ranges::replace(with_slit.triangles[t], Index{24}, grid.vertex_count());
  CHECK(!is_sheet(with_slit));
  Mesh turned_over = grid;
  std::swap(turned_over.triangles[20][0], turned_over.triangles[20][1]);
  CHECK(!is_sheet(turned_over));
  Mesh with_rope = grid;
  with_rope.edges.push_back({0, 48});
  CHECK(!is_sheet(with_rope));
  CHECK(!is_sheet(tetrahedron_surface({Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})));
  Mesh twice = grid;  // the same again, as a piece of its own in the same body
  for (const auto& [a, b, c] : grid.triangles) twice.triangles.push_back({a + 49, b + 49, c + 49});
  twice.vertices.resize(98, 3);
  twice.vertices << grid.vertices, grid.vertices;
  CHECK(!is_sheet(twice));
  Mesh spot = grid;
  spot.vertices.setZero();
  CHECK(!is_sheet(spot));
}

TEST_CASE("flat sheets: the list of near pairs is the same as that of every pair measured") {
  Random random;
  const Mesh mesh = whole_grid(14, 14, 0, 1);
  Rig rig(mesh);
  const std::vector<Real> radii(at(mesh.vertex_count()), r);
  const std::vector<char> is_pinned(at(mesh.vertex_count()), 0);
  const LetGo none;
  const ReducedDistances whole;
  PairList list;
  list.set_surface(rig.surface, mesh.vertices, radii);
  list.begin(is_pinned, none, whole);
  for (const Positions& q : shapes(mesh, random)) {
    list.list_anew();
    list.update(q, rig.pool);
    std::vector<Pair> near, expected;
    for (const PairList::Near& each : list.near()) near.push_back(each.pair);
    std::ranges::copy_if(rig.all_pairs(q, q, r), std::back_inserter(expected),
                         [&](const Pair& pair) { return measure(q, pair).distance < 2 * r; });
    CHECK(near == expected);
  }
}

}  // namespace test_flat_sheets
