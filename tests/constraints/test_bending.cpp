// Bending energies against closed forms: ½ κ ∫ (2H)² dA of smooth surfaces.
#include <numbers>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "elastic.h"
#include "pliant/constraints/hinge.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"

namespace test_bending {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real kappa = 0.7;
constexpr Real roll_radius = 0.8;

template <class Shape>
Positions shaped(const Positions& flat, Shape&& shape) {
  Positions x = flat;
  for (Index i = 0; i < x.rows(); ++i) x.row(i) = shape(row(flat, i)).transpose();
  return x;
}

/// Rolls the plane z = 0, turned by an angle about z first, around a cylinder.
Positions rolled(const Positions& flat, Real angle = 0) {
  return shaped(flat, [&](const Vec3& at) -> Vec3 {
    const Vec3 x = Eigen::AngleAxis<Real>(angle, Vec3::UnitZ()) * at;
    const Real around = x[0] / roll_radius;
    return {roll_radius * std::sin(around), x[1], roll_radius * (1 - std::cos(around))};
  });
}

Mesh sheet(Index cells, Diagonals diagonals) {
  return grid({.columns = cells + 1, .rows = cells + 1, .plane = Plane::xy, .diagonals = diagonals});
}

/// A parallelogram of equilateral triangles with sides of 1/cells.
Mesh equilateral_sheet(Index cells) {
  Mesh mesh = sheet(cells, Diagonals::backward);
  mesh.vertices = shaped(mesh.vertices, [](const Vec3& x) -> Vec3 {
    return {x[0] + x[1] / 2, std::sqrt(3.0) / 2 * x[1], 0};
  });
  return mesh;
}

Real area_of(const Mesh& mesh) {
  Real sum = 0;
  for (const Real area : triangle_areas(mesh.vertices, mesh.triangles)) sum += area;
  return sum;
}

/// Share of the smooth sheet's energy, ½ κ/R² an area, that a rolled sheet has.
template <class Constraint>
Real factor(const Mesh& mesh, Real area, Real angle = 0) {
  const Real smooth = kappa / 2 / (roll_radius * roll_radius) * area;
  return Elastic(mesh, Constraint{.stiffness = kappa}).energy(rolled(mesh.vertices, angle)) / smooth;
}

/// The same for the vertex form, which bends the share of the area that belongs to interior vertices.
Real vertex_factor(const Mesh& mesh, Index cells, Real angle = 0) {
  const Real interior = static_cast<Real>((cells - 1) * (cells - 1)) / static_cast<Real>(cells * cells);
  return factor<Bending>(mesh, area_of(mesh) * interior, angle);
}

/// Energy of a body crushed to a point: every vector v is zero, so the sum is ½ κ Σ a ‖v_g‖² of the rest shape.
Real energy_of_rest_curvature(const Mesh& mesh) {
  return Elastic(mesh, Bending{.stiffness = kappa}).energy(Positions::Zero(mesh.vertex_count(), 3));
}

/// A cap of the sphere of radius 1 over the square [0, 1]², seen from its middle; interior vertices are bent.
Mesh cap(Index cells) {
  Mesh mesh = sheet(cells, Diagonals::forward);
  mesh.vertices = shaped(mesh.vertices, [](const Vec3& x) -> Vec3 {
    const Real a = x[0] - 0.5;
    const Real b = x[1] - 0.5;
    return {a, b, std::sqrt(1 - a * a - b * b)};
  });
  return mesh;
}

Positions mirrored(Positions x) {
  x.col(2) *= -1;
  return x;
}

}  // namespace

TEST_CASE("a flat sheet rolled up: the vertex form has the factor 1.000, whatever the mesh and the direction") {
  for (const Diagonals diagonals : {Diagonals::forward, Diagonals::backward}) {
    for (const Real angle : {0.0, 0.4, std::numbers::pi / 4, 2.0}) {
      Real last_error = 0.1;
      for (const Index cells : {8, 16, 32}) {
        const Real error = std::abs(vertex_factor(sheet(cells, diagonals), cells, angle) - 1);
        CHECK(error < 0.3 * last_error);  // of second order
        last_error = error;
      }
      CHECK(last_error < 5e-4);
    }
  }
  for (const Real angle : {0.0, 0.4, 2.0}) {
    CHECK(vertex_factor(equilateral_sheet(32), 32, angle) == doctest::Approx(1).epsilon(5e-4));
  }
}

TEST_CASE("curvature of closed surfaces, from the vertex form") {
  for (const Real radius : {0.1, 3.0}) {
    const Real sphere_energy = energy_of_rest_curvature(sphere({.subdivisions = 4, .radius = radius}));
    CHECK(sphere_energy == doctest::Approx(8 * std::numbers::pi * kappa).epsilon(2e-3));
  }
  constexpr Real R = 0.5;
  constexpr Real r = 0.2;
  const Real willmore = std::numbers::pi * std::numbers::pi * R * R / (r * std::sqrt(R * R - r * r));
  Real last_error = 1;
  for (const Index segments : {24, 48, 96}) {
    const Mesh mesh = torus({.major_segments = 2 * segments, .minor_segments = segments});
    const Real error = std::abs(energy_of_rest_curvature(mesh) / (2 * kappa * willmore) - 1);
    CHECK(error < 0.3 * last_error);
    last_error = error;
  }
  CHECK(last_error < 2e-3);
}

TEST_CASE("the hinge's factor is 1 on equilateral meshes and strips, 3/4 to 3 by direction on grids with diagonals") {
  constexpr Index cells = 64;
  constexpr Real border = 1.5 / cells;  // free borders have half their hinges
  const Mesh strip = grid({.columns = cells + 1, .rows = 2, .plane = Plane::xy});
  CHECK(factor<HingeBending>(strip, 1) == doctest::Approx(1).epsilon(border));
  const Mesh regular = equilateral_sheet(cells);
  const Mesh square = sheet(cells, Diagonals::forward);
  for (int i = -8; i < 8; ++i) {
    const Real angle = i * std::numbers::pi / 16;
    CHECK(factor<HingeBending>(regular, area_of(regular), angle) == doctest::Approx(1).epsilon(border));
    // 1 across an axis or along the diagonals, 3 when the diagonals are what folds.
    const Real s = std::sin(2 * angle);
    CHECK(factor<HingeBending>(square, 1, angle) == doctest::Approx(1 - s + s * s).epsilon(border));
  }
}

TEST_CASE("absolute bending does not see a mirrored bump, signed bending does") {
  const Mesh mesh = cap(8);
  const Positions dent = mirrored(mesh.vertices);
  const auto energy_of_dent = [&](const auto& options) {
    Elastic elastic(mesh, options);
    elastic.begin_step(dent);
    return elastic.energy(dent) / energy_of_rest_curvature(mesh);
  };
  CHECK(energy_of_dent(Bending{.stiffness = kappa}) < 1e-25);
  CHECK(energy_of_dent(HingeBending{.stiffness = kappa}) < 1e-25);
  // From the rim of the half-sphere to the other pole: √2 times as far as from the origin, so about twice the energy.
  CHECK(energy_of_dent(Bending{.stiffness = kappa, .orientation = Orientation::signed_}) ==
        doctest::Approx(2).epsilon(0.05));
  CHECK(energy_of_dent(HingeBending{.stiffness = kappa, .orientation = Orientation::signed_}) > 1);
}

}  // namespace test_bending
