// The bending of triangles against ½ κ ∫ ‖∇²x‖² of quadratic and of smooth surfaces.
#include <numbers>

#include <doctest/doctest.h>

#include "../core/random.h"
#include "elastic.h"
#include "pliant/constraints/curvature.h"
#include "pliant/constraints/triangle_bending.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"

namespace test_triangle_bending {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real kappa = 0.7;

struct NamedSheet {
  std::string name;
  Mesh mesh;
};

/// Squares of side 1 in the plane z = 0; those that are irregular have their inner vertices moved by up to 0.22 cells.
std::vector<NamedSheet> sheets(Index cells) {
  std::vector<NamedSheet> all;
  for (const Diagonals diagonals :
       {Diagonals::forward, Diagonals::backward, Diagonals::alternating, Diagonals::crossed}) {
    const Mesh regular = grid({.columns = cells + 1, .rows = cells + 1, .plane = Plane::xy, .diagonals = diagonals});
    const std::string name(choice_names(diagonals)[static_cast<std::size_t>(diagonals)]);
    all.push_back({name, regular});
    Random random;
    Mesh irregular = regular;
    for (Index i = 0; i < irregular.vertex_count(); ++i) {
      const Vec3 x = row(regular.vertices, i);
      const bool is_inner = std::min({x[0], x[1], 1 - x[0], 1 - x[1]}) > 1e-9;
      const Real size = (diagonals == Diagonals::crossed ? 0.15 : 0.22) / static_cast<Real>(cells);
      for (int axis = 0; axis < 2 && is_inner; ++axis) irregular.vertices(i, axis) += random.uniform(-size, size);
    }
    all.push_back({name + ", irregular", irregular});
  }
  return all;
}

/// z = ½ (x, y)ᵀ H (x, y) laid over a flat sheet, H = (xx, xy, yy).
Positions bent(const Mesh& sheet, const Vec3& H) {
  Positions x = sheet.vertices;
  for (Index i = 0; i < x.rows(); ++i) {
    x(i, 2) = H[0] / 2 * x(i, 0) * x(i, 0) + H[1] * x(i, 0) * x(i, 1) + H[2] / 2 * x(i, 1) * x(i, 1);
  }
  return x;
}

Mesh turned(Mesh mesh, Random& random) {
  mesh.vertices = moved(mesh.vertices, random.rotation(), random.vector(1));
  return mesh;
}

/// Energy of a body crushed to a point: every z is zero, so the sum is ½ κ Σ A ‖z_g‖² of the rest shape.
Real energy_of_rest_curvature(const Mesh& mesh) {
  return Elastic(mesh, TriangleBending{.stiffness = kappa}).energy(Positions::Zero(mesh.vertex_count(), 3));
}

}  // namespace

TEST_CASE("a twisted sheet has the energy of the plate, borders included, on any mesh") {
  for (const auto& [name, mesh] : sheets(7)) {
    const std::string mesh_name = name;  // clang 14 captures no structured binding
    CAPTURE(mesh_name);
    Elastic elastic(mesh, TriangleBending{.stiffness = kappa});
    CHECK(elastic.energy(bent(mesh, {0, 0.3, 0})) == doctest::Approx(kappa / 2 * 2 * 0.3 * 0.3).epsilon(1e-4));
  }
}

TEST_CASE("a sheet bent in any direction has the energy of the plate but for half a row of cells across the bend") {
  constexpr Index cells = 24;
  for (const auto& [name, mesh] : sheets(cells)) {
    const std::string mesh_name = name;
    CAPTURE(mesh_name);
    Elastic elastic(mesh, TriangleBending{.stiffness = kappa});
    for (int i = 0; i < 8; ++i) {
      const Real c = std::cos(i * std::numbers::pi / 8);
      const Real s = std::sin(i * std::numbers::pi / 8);
      const Real factor = elastic.energy(bent(mesh, {c * c, c * s, s * s})) / (kappa / 2);
      CHECK(factor < 1 + 1e-10);
      CHECK(factor > 1 - 1.05 / cells);  // half a row at each of two borders
    }
  }
}

TEST_CASE("moments of a constant curvature are in balance at every vertex inside, on any mesh") {
  constexpr Index cells = 12;
  for (const auto& [name, mesh] : sheets(cells)) {
    const std::string mesh_name = name;
    CAPTURE(mesh_name);
    Elastic elastic(mesh, TriangleBending{.stiffness = kappa});
    for (const Vec3& H : {Vec3(1, 0, 0), Vec3(0.3, -0.8, 0.5), Vec3(0, 1, 0)}) {
      const Positions forces = elastic.forces(bent(mesh, H));
      const Real at_borders = forces.cwiseAbs().maxCoeff();
      CHECK(at_borders > 1e-3);
      for (Index i = 0; i < mesh.vertex_count(); ++i) {
        const Real x = mesh.vertices(i, 0) * cells;
        const Real y = mesh.vertices(i, 1) * cells;
        if (std::min({x, y, cells - x, cells - y}) > 3.5) CHECK(forces.row(i).norm() < 1e-4 * at_borders);
      }
    }
  }
}

TEST_CASE("strips of a single row of cells are bent as wide ones") {
  for (const Diagonals diagonals : {Diagonals::forward, Diagonals::alternating, Diagonals::crossed}) {
    constexpr Index cells = 40;
    const Mesh strip =
        grid({.columns = cells + 1, .rows = 2, .size = {1, 0.03}, .plane = Plane::xy, .diagonals = diagonals});
    Elastic elastic(strip, TriangleBending{.stiffness = kappa});
    const Real share = elastic.energy(bent(strip, {1, 0, 0})) / (kappa / 2 * 0.03);
    CHECK(share == doctest::Approx(1).epsilon(1.05 / cells));
  }
}

TEST_CASE("closed surfaces converge to the integral of both curvatures squared") {
  const Mesh ball = sphere({.subdivisions = 3, .radius = 0.3});  // κ/2 (1/R² + 1/R²) 4πR²
  CHECK(energy_of_rest_curvature(ball) == doctest::Approx(kappa * 4 * std::numbers::pi).epsilon(1e-4));
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

TEST_CASE("a flat mesh is flat to the bending of triangles, however it lies in space") {
  Random random;
  for (const auto& [name, mesh] : sheets(6)) {
    const std::string mesh_name = name;
    CAPTURE(mesh_name);
    const Elastic elastic(turned(mesh, random), TriangleBending{.orientation = Orientation::signed_});
    CHECK(elastic.set().count == count_of(mesh.triangles));
    for (const auto& batch : elastic.set().batches) {
      CHECK(dynamic_cast<const Batch<FlatCurvature>*>(batch.get()) != nullptr);
      CHECK(batch->type() == "triangle_bending");
    }
  }
}

TEST_CASE("meshes of few digits keep the short stencils of the lattice that they are") {
  Mesh mesh = grid({.columns = 9, .rows = 9, .plane = Plane::xy});
  mesh.vertices = mesh.vertices.cast<float>().cast<Real>() / 3;
  mesh.vertices = (mesh.vertices * 1e6).array().round().matrix() / 1e6;
  const Elastic elastic(mesh, TriangleBending{});
  for (const auto& batch : elastic.set().batches) CHECK(batch->shape().vertices <= 6);
}

TEST_CASE("of a part of a sheet, only the part is bent, with borders of its own") {
  const Mesh mesh = grid({.columns = 7, .rows = 5, .plane = Plane::xy});
  std::vector<Index> left;
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    if (mesh.vertices(i, 0) < 0.51) left.push_back(i);
  }
  const Mesh half = grid({.columns = 4, .rows = 5, .size = {0.5, 1}, .plane = Plane::xy});
  Elastic part(mesh, TriangleBending{.on = left});
  Elastic whole(half, TriangleBending{});
  CHECK(part.set().count == whole.set().count);
  for (const Vec3& H : {Vec3(1, 0, 0), Vec3(0.3, -0.8, 0.5)}) {
    CHECK(part.energy(bent(mesh, H)) == doctest::Approx(whole.energy(bent(half, H))).epsilon(1e-12));
  }
}

TEST_CASE("absolute bending of triangles does not see a mirrored bump, signed bending does") {
  Mesh mesh = grid({.columns = 9, .rows = 9, .plane = Plane::xy});
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    const Real a = mesh.vertices(i, 0) - 0.5;
    const Real b = mesh.vertices(i, 1) - 0.5;
    mesh.vertices(i, 2) = std::sqrt(1 - a * a - b * b);
  }
  Positions dent = mesh.vertices;
  dent.col(2) *= -1;
  const auto energy_of_dent = [&](Orientation orientation) {
    Elastic elastic(mesh, TriangleBending{.stiffness = kappa, .orientation = orientation});
    elastic.begin_step(dent);
    return elastic.energy(dent) / energy_of_rest_curvature(mesh);
  };
  CHECK(energy_of_dent(Orientation::absolute) < 1e-20);
  CHECK(energy_of_dent(Orientation::signed_) == doctest::Approx(2).epsilon(0.1));
}

TEST_CASE("a curved sheet is unrolled against the energy of its curvature, and resists bending the other way fully") {
  constexpr Index cells = 32;
  constexpr Real radius = 0.8;
  Mesh mesh = grid({.columns = cells + 1, .rows = cells + 1, .plane = Plane::xy, .diagonals = Diagonals::alternating});
  const Positions flat = mesh.vertices;
  const auto rolled = [&](int axis) {
    Positions x = flat;
    for (Index i = 0; i < x.rows(); ++i) {
      const Real around = flat(i, axis) / radius;
      x(i, axis) = radius * std::sin(around);
      x(i, 2) = radius * (1 - std::cos(around));
    }
    return x;
  };
  mesh.vertices = rolled(0);
  Elastic elastic(mesh, TriangleBending{.stiffness = kappa});
  const Real smooth = kappa / 2 / (radius * radius);
  CHECK(elastic.energy(flat) == doctest::Approx(smooth).epsilon(1.5 / cells));
  CHECK(elastic.energy(rolled(1)) == doctest::Approx(2 * smooth).epsilon(2.0 / cells));
}

TEST_CASE("triangles without neighbors and edges of three triangles bend freely") {
  Mesh fan;
  fan.vertices.resize(5, 3);
  fan.vertices << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0.2, 0, 0, 1;
  fan.triangles = {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}};
  const Elastic elastic(fan, TriangleBending{});
  CHECK(elastic.set().count == 0);
  CHECK(elastic.set().skipped == 1);
}

}  // namespace test_triangle_bending
