// Fibres that are stiffer once they are taut: their energy, a strip that hangs, and what the factor has of them.
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "../mesh/meshes.h"
#include "elastic.h"
#include "pliant/constraints/fibre_strain.h"
#include "pliant/constraints/position.h"
#include "pliant/core/error.h"
#include "pliant/forces/builtin.h"
#include "pliant/mesh/shapes.h"
#include "pliant/simulation/simulation.h"

namespace test_taut_fibres {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real stiffness = 50, taut_factor = 6, taut_stretch = 1.02, slack_factor = 0.1;

/// All at once, or from `onset` on, and slack at rest.
FibreStrain taut_fibres(std::optional<Real> onset = std::nullopt) {
  return {.direction = Vec3(0, 0, 1),
          .stiffness = stiffness,
          .taut_factor = taut_factor,
          .taut_stretch = taut_stretch,
          .slack_factor = onset ? slack_factor : 1,
          .taut_onset = onset};
}

Mesh strip() {
  return grid({.columns = 3, .rows = 7, .size = {0.2, 0.6}, .plane = Plane::xz});
}

std::string refusal(const FibreStrain& options) {
  const Mesh mesh = strip();
  try {
    build(BodyView{mesh, mesh.vertices, 0, "strip"}, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

/// At which triangles of so much area pull a vertical edge together with `load`: at once, k (s − 1), and (t − 1) k
/// (s − taut) more beyond; from an onset of 1 on, r k b + (t − r) k b²/2w with b = s − 1 up to w, t k a meter beyond.
Real stretch_under(Real load, Real length, Real area, bool rises) {
  const Real units = load * length / (stiffness * area);
  if (!rises) {
    if (1 + units <= taut_stretch) return 1 + units;
    return (units + 1 + (taut_factor - 1) * taut_stretch) / taut_factor;
  }
  constexpr Real r = slack_factor, w = taut_stretch - 1, slope = (taut_factor - r) / w;
  const Real b = (std::sqrt(r * r + 2 * slope * units) - r) / slope;
  return b <= w ? 1 + b : taut_stretch + (units - (taut_factor + r) * w / 2) / taut_factor;
}

}  // namespace

TEST_CASE("beyond its limit a taut fibre is so many times as stiff") {
  const Mesh mesh = strip();
  Elastic elastic(mesh, taut_fibres());
  for (const Real s : {0.9, 1.0, 1.01, 1.02, 1.03, 1.2}) {
    CAPTURE(s);
    const Mat3 stretched = Vec3(1, 1, s).asDiagonal();
    const Real beyond = std::max(Real{0}, s - taut_stretch);
    const Real expected = 0.12 * stiffness / 2 * ((s - 1) * (s - 1) + (taut_factor - 1) * beyond * beyond);
    CHECK(elastic.energy(mesh.vertices * stretched) == doctest::Approx(expected).epsilon(1e-9));
  }
}

TEST_CASE("between onset and taut stretch the stiffness of a fibre rises evenly, and the energy is its integral") {
  constexpr Real onset = 1.005;
  const auto more_at = [](Real s) {
    return (taut_factor - slack_factor) * std::clamp((s - onset) / (taut_stretch - onset), 0., 1.);
  };
  const Mesh mesh = strip();
  Elastic elastic(mesh, taut_fibres(onset));
  for (const Real s : {0.9, 1.0, 1.005, 1.01, 1.015, 1.02, 1.03, 1.2}) {
    CAPTURE(s);
    // ∫ (s − x)(r + more(x)) dx from 1 to s, by the midpoint rule.
    constexpr int parts = 20000;
    Real expected = 0;
    for (int i = 0; i < parts; ++i) {
      const Real x = 1 + (s - 1) * (i + 0.5) / parts;
      expected += (s - x) * (slack_factor + (s > 1 ? more_at(x) : 0)) * (s - 1) / parts;
    }
    const Mat3 stretched = Vec3(1, 1, s).asDiagonal();
    CHECK(elastic.energy(mesh.vertices * stretched) ==
          doctest::Approx(0.12 * stiffness * expected).epsilon(1e-6).scale(1e-4));
  }
}

TEST_CASE("forces of taut fibres are minus the gradient of their energy") {
  for (const std::optional<Real> onset : {std::optional<Real>{}, std::optional<Real>{1.0}}) {
    const Mesh mesh = strip();
    FibreStrain options = taut_fibres(onset);
    options.taut_stretch = 1.15;  // in the middle of the stretches below
    Elastic elastic(mesh, options);
    Random random;
    Positions q = mesh.vertices;
    for (Real& x : q.reshaped()) x = 1.1 * x + random.uniform(-0.03, 0.03);
    const Positions forces = elastic.forces(q);
    constexpr Real step = 1e-7;
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      for (Index axis = 0; axis < 3; ++axis) {
        Positions there = q, here = q;
        there(i, axis) += step;
        here(i, axis) -= step;
        const Real slope = (elastic.energy(there) - elastic.energy(here)) / (2 * step);
        CHECK(forces(i, axis) == doctest::Approx(-slope).epsilon(1e-5).scale(1));
      }
    }
  }
}

TEST_CASE("a strip of taut fibres hangs as long as its weight asks, whatever the acceleration") {
  for (const int trial : {0, 1, 2, 3, 4, 5, 6, 7}) {
    const Acceleration acceleration = std::array{Acceleration::none, Acceleration::lbfgs, Acceleration::anderson,
                                                 Acceleration::chebyshev}[static_cast<std::size_t>(trial / 2)];
    const bool rises = trial % 2 == 1;
    CAPTURE(static_cast<int>(acceleration));
    CAPTURE(rises);
    SolverSettings settings;
    settings.acceleration = acceleration;
    settings.iterations = 200;
    Simulation simulation(settings);
    const Mesh mesh = strip();
    const BodyId body = simulation.add_body(mesh, Mass::area_density(rises ? 1 : 0.5));
    simulation.add(body, rises ? taut_fibres(1) : taut_fibres());
    std::vector<Index> top;
    std::map<Real, std::map<Real, Index>> columns;  // by x, then by height
    for (Index i = 0; i < mesh.vertex_count(); ++i) {
      columns[mesh.vertices(i, 0)][mesh.vertices(i, 2)] = i;
      if (mesh.vertices(i, 2) > 0.6 - 1e-9) top.push_back(i);
    }
    REQUIRE(top.size() == 3);
    simulation.add(body, Position{.on = top});
    simulation.add(Gravity{});
    for (int i = 0; i < 200; ++i) simulation.step();

    const State& state = simulation.state();
    int taut = 0, slack = 0;
    for (const auto& [x, column] : columns) {
      Real load = 0;
      for (auto lower = column.begin(), upper = std::next(lower); upper != column.end(); ++lower, ++upper) {
        load += 9.81 * state.masses[static_cast<std::size_t>(lower->second)];
        const Real length = upper->first - lower->first;
        const Real area = length * 0.1 / 2 * (x > 0.05 && x < 0.15 ? 2 : 1);
        const Real expected = stretch_under(load, length, area, rises);
        (expected > taut_stretch ? taut : slack) += 1;
        const Real found = (row(state.positions, upper->second) - row(state.positions, lower->second)).norm() / length;
        CHECK(found == doctest::Approx(expected).epsilon(1e-6));
      }
    }
    CHECK(taut > 3);
    CHECK(slack > 3);
  }
}

TEST_CASE("the factor has a part of what taut fibres add, also once they are numbered anew") {
  const Mesh mesh = strip();
  const ConstraintSet set = build(BodyView{mesh, mesh.vertices, 0, "strip"}, taut_fibres());
  CHECK(set.count == 24);
  REQUIRE(set.batches.size() == 1);
  ConstraintGroup& taut = *set.batches[0];
  CHECK_FALSE(taut.is_projective());
  constexpr Real share = 1 + 0.25 * (taut_factor - 1);
  CHECK(taut.factor_stiffness() == doctest::Approx(share * stiffness));
  taut.set_stiffness(80);
  CHECK(taut.factor_stiffness() == doctest::Approx(share * 80));
  taut.set_passing_stiffness(60);
  CHECK(taut.factor_stiffness() == doctest::Approx(share * 64));

  std::vector<Index> order(24), numbers(static_cast<std::size_t>(mesh.vertex_count()));
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = static_cast<Index>(order.size() - 1 - i);
  for (std::size_t i = 0; i < numbers.size(); ++i) numbers[i] = static_cast<Index>(i);
  const std::unique_ptr<ConstraintGroup> reordered = taut.reordered(order, numbers);
  CHECK_FALSE(reordered->is_projective());
  reordered->sync_parameters(taut, order);
  CHECK(reordered->factor_stiffness() == taut.factor_stiffness());
  CHECK(taut.copy()->factor_stiffness() == taut.factor_stiffness());
}

TEST_CASE("fibres that are as stiff when taut are those there were") {
  const Mesh mesh = strip();
  const ConstraintSet set = build(BodyView{mesh, mesh.vertices, 0, "strip"}, FibreStrain{});
  REQUIRE(set.batches.size() == 1);
  CHECK(set.batches[0]->is_projective());
  CHECK(set.batches[0]->factor_share() == 1);
}

TEST_CASE("a share of the stiffness in the factor that cannot be is refused, and the last one stays") {
  Batch<FibreStrainProjection> batch(3);
  batch.set_factor_share(0.2);
  for (const Real share : {0.0, -1.0, std::nan(""), std::numeric_limits<Real>::infinity()}) {
    CAPTURE(share);
    CHECK(contains(error_of([&] { batch.set_factor_share(share); }), "give a number above 0"));
    CHECK(batch.factor_share() == 0.2);
  }
}

TEST_CASE("taut fibres that cannot be are refused") {
  const std::string below = refusal({.max_stretch = 1.2, .taut_factor = 2, .taut_stretch = 1.1});
  CHECK(below == "fibre_strain: taut_stretch: 1.1 is below max_stretch 1.2; give at least as much");
  CHECK(refusal({.max_stretch = 1.2, .taut_stretch = 1.1}) == "nothing");  // nothing is taut
  CHECK(refusal({.max_stretch = 1.01, .taut_factor = 2, .taut_stretch = 1.1, .taut_onset = 1.0}) ==
        "fibre_strain: taut_onset: 1 is below max_stretch 1.01; give at least as much");
  CHECK(refusal({.taut_factor = 2, .taut_stretch = 1.1, .taut_onset = 1.2}) ==
        "fibre_strain: taut_onset: 1.2 is above taut_stretch 1.1; give at most as much");
  CHECK(refusal({.taut_factor = 2, .taut_stretch = 1.1, .taut_onset = 1.1}) == "nothing");  // all at once
  Simulation simulation;
  const BodyId body = simulation.add_body(strip(), Mass::area_density(0.2));
  for (const Real factor : {0.5, 1e7, 1e306}) {
    CAPTURE(factor);
    const std::string message = error_of([&] { simulation.add(body, FibreStrain{.taut_factor = factor}); });
    CHECK(contains(message, "taut_factor"));
  }
}

}  // namespace test_taut_fibres
