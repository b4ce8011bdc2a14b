// The energy of a pair: smooth where its stages meet, and forces that are minus its gradient through the gap.
#include <doctest/doctest.h>

#include "../core/random.h"
#include "pliant/collision/pairs/gap.h"
#include "pliant/collision/pairs/pair_potential.h"

namespace test_pair_potential {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real stiffness = 700;
constexpr Real radius = 0.2;

Pair pair_of(PairKind kind) {
  if (kind == PairKind::vertex_edge) return {kind, 3, {}, {0, 1, 2, 2}};
  return {kind, 63, {}, {0, 1, 2, 3}};
}

/// Energy of a pair at q, and its forces.
Real add_pair(const Positions& q, const Pair& pair, Positions& forces) {
  const Gap gap = measure(q, pair);
  const Potential pushed = pair_potential(stiffness, radius, gap.distance);
  forces.setZero(q.rows(), 3);
  for (std::size_t j = 0; j < 4; ++j) {
    forces.row(pair.vertices[j]) += gap.weights[j] * pushed.force * gap.normal.transpose();
  }
  return pushed.energy;
}

/// The largest difference between forces and central differences of the energy, as a share of the force.
Real error_of_forces(const Positions& q, const Pair& pair) {
  const Real step = 1e-5 * radius;
  Positions forces, unused;
  add_pair(q, pair, forces);
  Real largest = 0;
  for (Index i = 0; i < 4; ++i) {
    for (int a = 0; a < 3; ++a) {
      Positions up = q, down = q;
      up(i, a) += step;
      down(i, a) -= step;
      const Real slope = (add_pair(up, pair, unused) - add_pair(down, pair, unused)) / (2 * step);
      largest = std::max(largest, std::abs(slope + forces(i, a)));
    }
  }
  return largest / forces.norm();
}

/// Puts the features of a random pair at the distance, over the place asked for.
Positions at_distance(Random& random, const Pair& pair, Real distance) {
  Positions q = random.positions(4, 1);
  const Gap gap = measure(q, pair);
  for (std::size_t j = 0; j < 4; ++j) {
    if (static_cast<int>(j) < pair.first_side()) {
      q.row(pair.vertices[j]) += (distance - gap.distance) * gap.normal.transpose();
    }
  }
  return q;
}

}  // namespace

TEST_CASE("the energy of a pair is smooth where its stages meet") {
  for (const Real r : {1e-4, 0.2, 1e4}) {
    for (const Real at : {r, r / 2, r / 1000}) {
      const Real step = 1e-9 * at;
      const Potential up = pair_potential(stiffness, r, at + step);
      const Potential down = pair_potential(stiffness, r, at - step);
      CHECK(up.energy == doctest::Approx(down.energy).epsilon(1e-7));
      CHECK(std::abs(up.force - down.force) <= 1e-7 * (up.force + stiffness * r));
      if (at < r) CHECK(up.curvature == doctest::Approx(down.curvature).epsilon(1e-7));
    }
    CHECK(pair_potential(stiffness, r, r).energy == 0);
    CHECK(pair_potential(stiffness, r, r).force == 0);
    CHECK(pair_potential(stiffness, r, r / 2).energy == doctest::Approx(stiffness * r * r / 8));
    CHECK(pair_potential(stiffness, r, r / 4).energy == doctest::Approx(stiffness * r * r / 4 * (0.5 + std::log(2.0))));
    CHECK(pair_potential(stiffness, r, 0.75 * r).curvature == stiffness);
    CHECK(std::isfinite(pair_potential(stiffness, r, 0).energy));
    CHECK(pair_potential(stiffness, r, 0).force == doctest::Approx(500 * stiffness * r));
    CHECK(pair_potential(stiffness, r, 1e-300).energy == doctest::Approx(pair_potential(stiffness, r, 0).energy));
  }
}

TEST_CASE("slope and curvature are those of the energy, which grows the nearer") {
  for (Real share = 1.05; share > 0; share -= 7e-4) {
    const Real d = share * radius;
    const Real step = 1e-4 * std::min(d, radius / 1000);
    if (std::abs(share - 1) < 1e-3 || d <= step) continue;
    const Potential up = pair_potential(stiffness, radius, d + step);
    const Potential here = pair_potential(stiffness, radius, d);
    const Potential down = pair_potential(stiffness, radius, d - step);
    CHECK((down.energy - up.energy) / (2 * step) ==
          doctest::Approx(here.force).epsilon(1e-5).scale(stiffness * radius));
    CHECK((down.force - up.force) / (2 * step) == doctest::Approx(here.curvature).epsilon(1e-4));
    CHECK(up.energy <= down.energy);
  }
}

TEST_CASE("forces of a pair are minus the gradient of its energy, over every feature") {
  Random random(3);
  std::array<int, 8> seen{};
  for (const PairKind kind : {PairKind::vertex_triangle, PairKind::edge_edge, PairKind::vertex_edge}) {
    const Pair pair = pair_of(kind);
    for (int i = 0; i < 400; ++i) {
      const Positions q = at_distance(random, pair, random.uniform(0.02, 0.98) * radius);
      const Gap gap = measure(q, pair);
      if (kind == PairKind::vertex_triangle) ++seen[gap.place];
      if (kind == PairKind::edge_edge && gap.counts) ++seen[7];
      if (kind == PairKind::edge_edge && !gap.counts) continue;  // two ends may be as near
      CHECK(error_of_forces(q, pair) < 1e-5);
      Positions forces;
      add_pair(q, pair, forces);
      CHECK(forces.colwise().sum().norm() <= 1e-12 * forces.norm());
      Vec3 torque = Vec3::Zero();
      for (Index v = 0; v < 4; ++v) torque += row(q, v).cross(row(forces, v));
      CHECK(torque.norm() <= 1e-12 * forces.norm());
    }
  }
  for (const int count : seen) CHECK(count > 10);
}

TEST_CASE("forces are right at the borders between features") {
  const Pair pair = pair_of(PairKind::vertex_triangle);
  Positions q(4, 3);
  q << 0, 0, 0, 0, 0, 0, 1, 0, 0, 0, 1, 0;
  const Pair edges = pair_of(PairKind::edge_edge);
  for (const Real beside : {-1e-4, -1e-7, -1e-12, 0.0, 1e-12, 1e-7, 1e-4}) {
    for (const Real height : {0.3 * radius, 0.7 * radius}) {
      q.row(0) << 0.3, beside, height;  // over an edge
      CHECK(error_of_forces(q, pair) < 1e-4);
      q.row(0) << 0.5 + beside, 0.5, height;  // over the slanted one
      CHECK(error_of_forces(q, pair) < 1e-4);
      q.row(0) << beside, 2 * beside, height;  // over a corner
      CHECK(error_of_forces(q, pair) < 1e-4);
      Positions ends(4, 3);
      ends << -1, 0, height, 1, 0, height, 0, beside, 0, 0.1, 1, 0;
      CHECK(error_of_forces(ends, edges) < 1e-4);
    }
  }
}

TEST_CASE("forces of friction are minus the gradient of its energy, while load, weights and normal are frozen") {
  Random random(4);
  int sliding = 0;
  for (int i = 0; i < 300; ++i) {
    const Pair pair = pair_of(i % 2 == 0 ? PairKind::vertex_triangle : PairKind::edge_edge);
    const Positions begin = at_distance(random, pair, 0.6 * radius);
    const Gap gap = measure(begin, pair);
    const Real limit = 0.3 * pair_potential(stiffness, radius, gap.distance).force;
    const Vec3 memory = random.vector(0.01);
    const auto rub = [&](const Positions& q) {
      Vec3 way = memory;
      for (std::size_t j = 0; j < 4; ++j)
        way += gap.weights[j] * (row(q, pair.vertices[j]) - row(begin, pair.vertices[j]));
      return friction_potential(stiffness, limit, way - way.dot(gap.normal) * gap.normal);
    };
    const Positions q = begin + random.positions(4, random.uniform(0.001, 0.1));
    const Friction rubbed = rub(q);
    sliding += rubbed.force.norm() >= limit * (1 - 1e-9) ? 1 : 0;
    CHECK(std::abs(rubbed.force.dot(gap.normal)) <= 1e-12 * limit);
    constexpr Real step = 1e-6;
    for (std::size_t j = 0; j < 4; ++j) {
      for (int a = 0; a < 3; ++a) {
        Positions up = q, down = q;
        up(pair.vertices[j], a) += step;
        down(pair.vertices[j], a) -= step;
        const Real slope = (rub(up).energy - rub(down).energy) / (2 * step);
        CHECK(std::abs(slope + gap.weights[j] * rubbed.force[a]) <= 1e-4 * limit);
      }
    }
  }
  CHECK(sliding > 50);
  CHECK(sliding < 250);
}

}  // namespace test_pair_potential
