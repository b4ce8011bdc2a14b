// The tree of vertices finds what looking at all of them finds.
#include <random>

#include <doctest/doctest.h>

#include "pliant/mesh/nearest_vertex.h"

namespace test_nearest_vertex {

namespace {

using namespace pliant;

/// Points with many equal coordinates and distances: on a lattice, some twice.
Positions lattice_points(Index count, unsigned seed) {
  std::mt19937 random(seed);
  Positions x(count, 3);
  for (Index i = 0; i < count; ++i) {
    for (Index j = 0; j < 3; ++j) x(i, j) = static_cast<Real>(random() % 7);
  }
  return x;
}

Index nearest_of_all(const Positions& x, const Vec3& place, Index end, Real distance,
                     const std::vector<char>& left_out) {
  Index best = -1;
  Real least = distance * distance;
  for (Index i = 0; i < std::min(end, static_cast<Index>(x.rows())); ++i) {
    const Real squared = (row(x, i) - place).squaredNorm();
    if (left_out[static_cast<std::size_t>(i)] != 0 || squared > least || (best >= 0 && squared == least)) continue;
    best = i;
    least = squared;
  }
  return best;
}

TEST_CASE("the nearest vertex, of several the first") {
  for (const Index count : {1, 8, 9, 100, 500}) {
    const Positions x = lattice_points(count, 1);
    const NearestVertex tree(x);
    std::vector<char> left_out(static_cast<std::size_t>(count), 0);
    for (std::size_t i = 0; i < left_out.size(); i += 3) left_out[i] = 1;
    const std::vector<char> none(left_out.size(), 0);
    for (unsigned i = 0; i < 200; ++i) {
      const Vec3 place = row(lattice_points(1, 100 + i), 0) + Vec3::Constant(i % 2 == 0 ? 0 : 0.5);
      CHECK(tree(place) == nearest_of_all(x, place, count, 100, none));
      for (const Real distance : {0.0, 1.0, 2.5}) {
        const Index end = count * static_cast<Index>(i % 5) / 4;
        const NearestVertex::Found found = tree.find(place, end, distance, left_out);
        CHECK(found.vertex == nearest_of_all(x, place, end, distance, left_out));
        if (found.vertex >= 0) CHECK(found.squared == (row(x, found.vertex) - place).squaredNorm());
      }
    }
  }
}

TEST_CASE("the vertices in a box, its faces included") {
  const Positions x = lattice_points(500, 2);
  const NearestVertex tree(x);
  CHECK(tree.bounds().min() == Vec3(0, 0, 0));
  CHECK(tree.bounds().max() == Vec3(6, 6, 6));
  for (unsigned i = 0; i < 100; ++i) {
    const Vec3 min = row(lattice_points(1, 300 + i), 0);
    const Vec3 max = min + Vec3(i % 4, (i + 1) % 3, i % 2);
    std::vector<Index> expected;
    for (Index v = 0; v < x.rows(); ++v) {
      if ((row(x, v).array() >= min.array()).all() && (row(x, v).array() <= max.array()).all()) expected.push_back(v);
    }
    CHECK(tree.inside(min, max) == expected);
  }
}

TEST_CASE("no vertices") {
  const NearestVertex tree(Positions(0, 3));
  CHECK(tree.find({0, 0, 0}, 10, 10, {}).vertex == -1);
  CHECK(tree.inside({-1, -1, -1}, {1, 1, 1}).empty());
}

}  // namespace

}  // namespace test_nearest_vertex
