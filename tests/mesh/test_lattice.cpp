// Solids from surfaces: the lattice covers the inside, carries the surface, and weighs what the body does.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/mesh/closed_surface.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/lattice.h"
#include "pliant/mesh/loose.h"
#include "pliant/mesh/mass.h"
#include "pliant/mesh/shapes.h"
#include "pliant/mesh/topology.h"

namespace test_lattice {

using namespace pliant;

namespace {

/// The surface of a box, each of its sides cut n × n times.
Mesh box(const Vec3& size, Index n) {
  Mesh mesh = bar({.cells = {n, n, n}, .size = {size[0], size[1], size[2]}});
  mesh.triangles = boundary_triangles(mesh.tetrahedra);
  mesh.tetrahedra.clear();
  drop_loose_vertices(mesh);
  return mesh;
}

/// Two surfaces as one mesh.
Mesh both(Mesh a, const Mesh& b, const Vec3& offset) {
  const Index first = a.vertex_count();
  a.vertices.conservativeResize(first + b.vertex_count(), 3);
  a.vertices.bottomRows(b.vertex_count()) = b.vertices.rowwise() + offset.transpose();
  for (const auto& [i, j, k] : b.triangles) a.triangles.push_back({first + i, first + j, first + k});
  return a;
}

Mesh turned(Mesh mesh) {
  for (Triangle& triangle : mesh.triangles) std::swap(triangle[0], triangle[1]);
  return mesh;
}

Real volume_of(const Mesh& mesh) {
  Real volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    volume += tetrahedron_volume(Vec3::Zero(), row(mesh.vertices, a), row(mesh.vertices, b), row(mesh.vertices, c));
  }
  return volume;
}

Real sum(const std::vector<Real>& values) {
  return std::accumulate(values.begin(), values.end(), Real{0});
}

Vec3 center_of_mass(const Mesh& solid) {
  Vec3 center = Vec3::Zero();
  for (Index v = 0; v < solid.vertex_count(); ++v) center += solid.embedding.volumes[at(v)] * row(solid.vertices, v);
  return center / sum(solid.embedding.volumes);
}

Real volume_of_filled(const Mesh& solid) {
  const std::vector<Real> volumes = tetrahedron_volumes(solid.vertices, solid.tetrahedra);
  return std::inner_product(volumes.begin(), volumes.end(), solid.embedding.filled.begin(), Real{0});
}

std::string refusal(Mesh mesh, Real spacing) {
  try {
    lattice_solid(std::move(mesh), {.spacing = spacing}, "body 'x'");
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_CASE("each vertex of the surface is in its tetrahedron, at its place") {
  for (const Mesh& surface : {torus({}), sphere({}), box({1, 0.3, 0.2}, 5)}) {
    for (const Real spacing : {0.17, 0.1, 0.06}) {
      const Mesh solid = lattice_solid(surface, {.spacing = spacing}, "it");
      check_mesh(solid, "it");
      const Embedding& embedding = solid.embedding;
      REQUIRE(embedding.carried_count() == surface.vertex_count());
      CHECK(solid.vertices.topRows(surface.vertex_count()) == surface.vertices);
      Real farthest = 0, least = 1, error_of_sum = 0;
      for (Index v = 0; v < surface.vertex_count(); ++v) {
        const std::array<Real, 4>& weights = embedding.weights[at(v)];
        Vec3 place = Vec3::Zero();
        for (std::size_t i = 0; i < 4; ++i) {
          const Index corner = solid.tetrahedra[at(embedding.tetrahedra[at(v)])][i];
          CHECK_UNARY(corner >= surface.vertex_count());
          place += weights[i] * row(solid.vertices, corner);
          least = std::min(least, weights[i]);
        }
        farthest = std::max(farthest, (place - row(surface.vertices, v)).norm());
        error_of_sum = std::max(error_of_sum, std::abs(weights[0] + weights[1] + weights[2] + weights[3] - 1));
      }
      CHECK(least >= 0);
      CHECK(farthest < 1e-14);
      CHECK(error_of_sum < 1e-15);
    }
  }
}

TEST_CASE("all tetrahedra are alike, and their edges go evenly in the directions of the cubic lattice") {
  const Real a = 0.097;
  const Mesh solid = lattice_solid(box({1, 1, 1}, 4), {.spacing = a}, "it");
  for (const Real volume : tetrahedron_volumes(solid.vertices, solid.tetrahedra)) {
    CHECK(volume == doctest::Approx(a * a * a / 12).epsilon(1e-10));
  }
  // The sum of d dᵀ over the edges d of a cube's lattice is a multiple of the identity, and so is each kind's.
  for (const bool is_long : {true, false}) {
    Mat3 spread = Mat3::Zero();
    for (const Tetrahedron& corners : solid.tetrahedra) {
      int count = 0;
      for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < i; ++j) {
          const Vec3 edge = (row(solid.vertices, corners[i]) - row(solid.vertices, corners[j])) / a;
          const bool is_of_kind = std::abs(edge.norm() - (is_long ? 1 : std::sqrt(0.75))) < 1e-9;
          count += is_of_kind ? 1 : 0;
          if (is_of_kind) spread += edge * edge.transpose();
        }
      }
      CHECK(count == (is_long ? 2 : 4));
    }
    const Mat3 rest = spread / (spread.trace() / 3) - Mat3::Identity();
    CHECK(rest.cwiseAbs().maxCoeff() < 1e-9);
  }
}

TEST_CASE("it weighs what the surface encloses, about the same center, and no tetrahedron counts twice") {
  const Vec3 offset(0.31, -0.17, 0.05);
  for (Mesh surface : {torus({}), sphere({.subdivisions = 4}), box({1, 0.3, 0.2}, 4), capsule({})}) {
    surface.vertices.rowwise() += offset.transpose();
    const Real volume = volume_of(surface);
    for (const Real spacing : {0.11, 0.05}) {
      const Mesh solid = lattice_solid(surface, {.spacing = spacing}, "it");
      CHECK(sum(solid.embedding.volumes) == doctest::Approx(volume).epsilon(1e-9));
      CHECK(*std::ranges::min_element(solid.embedding.volumes) > 0);
      CHECK(volume_of_filled(solid) == doctest::Approx(volume).epsilon(2e-3));
      const Mesh fine = lattice_solid(surface, {.spacing = spacing / 3}, "it");
      CHECK((center_of_mass(solid) - center_of_mass(fine)).norm() < 0.002 * spacing);
      const std::vector<Real> masses = vertex_masses(solid, Mass::density(1000), "it");
      CHECK(sum(masses) == doctest::Approx(1000 * volume).epsilon(1e-9));
    }
  }
}

TEST_CASE("the lattice covers what is inside") {
  const Mesh surface = torus({});
  const Mesh solid = lattice_solid(surface, {.spacing = 0.15}, "it");
  Index inside = 0;
  for (int i = 0; i < 4000; ++i) {  // a low-discrepancy sequence of places in the box
    const Vec3 share(std::fmod(0.5 + i * 0.8191725134, 1), std::fmod(0.5 + i * 0.6710436067, 1),
                     std::fmod(0.5 + i * 0.5497004779, 1));
    const Vec3 place = Vec3(-0.7, -0.7, -0.2) + share.cwiseProduct(Vec3(1.4, 1.4, 0.4));
    if (std::hypot(std::hypot(place[0], place[1]) - 0.5, place[2]) > 0.18) continue;
    ++inside;
    const bool is_covered = std::ranges::any_of(solid.tetrahedra, [&](const Tetrahedron& t) {
      const auto x = [&](std::size_t k) { return row(solid.vertices, t[k]); };
      return tetrahedron_volume(place, x(1), x(2), x(3)) >= -1e-15 &&
             tetrahedron_volume(x(0), place, x(2), x(3)) >= -1e-15 &&
             tetrahedron_volume(x(0), x(1), place, x(3)) >= -1e-15 &&
             tetrahedron_volume(x(0), x(1), x(2), place) >= -1e-15;
    });
    CHECK(is_covered);
  }
  CHECK(inside > 500);
}

TEST_CASE("inside by the winding number: parts that overlap, cavities, surfaces turned inside out") {
  const Mesh ball = sphere({.subdivisions = 3, .radius = 0.5});
  const Mesh small = sphere({.subdivisions = 3, .radius = 0.3});
  const auto enclosed = [](const Mesh& mesh) {
    return sum(lattice_solid(mesh, {.spacing = 0.1}, "it").embedding.volumes);
  };
  const Real full = volume_of(ball), hole = volume_of(small);
  CHECK(enclosed(turned(ball)) == doctest::Approx(full).epsilon(1e-9));
  CHECK(volume_of(lattice_solid(turned(ball), {.spacing = 0.1}, "it")) == doctest::Approx(full));
  CHECK(enclosed(both(ball, turned(small), Vec3::Zero())) == doctest::Approx(full - hole).epsilon(1e-9));
  CHECK(enclosed(both(turned(ball), small, Vec3::Zero())) == doctest::Approx(full - hole).epsilon(1e-9));
  CHECK(enclosed(both(ball, small, Vec3::Zero())) == doctest::Approx(full).epsilon(2e-3));
  CHECK(enclosed(both(ball, small, Vec3(2, 0, 0))) == doctest::Approx(full + hole).epsilon(1e-9));
  CHECK(enclosed(both(ball, turned(small), Vec3(2, 0, 0))) == doctest::Approx(full + hole).epsilon(1e-9));
  // Two balls of the same radius r whose middles are r apart have 5/16 of a ball in common.
  CHECK(enclosed(both(ball, ball, Vec3(0.5, 0, 0))) == doctest::Approx(full * (2 - 5.0 / 16)).epsilon(0.005));
  Mesh mixed = ball;
  for (std::size_t t = 1; t < mixed.triangles.size(); t += 3) std::swap(mixed.triangles[t][0], mixed.triangles[t][1]);
  CHECK(closed_surface(mixed, "it").turned_count > 0);
  CHECK(enclosed(mixed) == doctest::Approx(full).epsilon(1e-9));
}

TEST_CASE("what has no inside, and spacings that cannot be, are refused with the place and the remedy") {
  Mesh open = sphere({});
  open.triangles.erase(open.triangles.begin() + 7);
  const std::string loop = refusal(open, 0.1);
  CHECK(says(loop, "body 'x': the surface is open: a loop of 3 edges, "));
  CHECK(says(loop, " m long, about ("));
  CHECK(says(loop, "close it"));
  CHECK(says(refusal(cylinder({}), 0.1), "and 1 more such"));
  Mesh fin = sphere({});
  fin.vertices.conservativeResize(fin.vertex_count() + 1, 3);
  fin.vertices.bottomRows(1) << 2, 0, 0;
  fin.triangles.push_back({fin.triangles[0][0], fin.triangles[0][1], fin.vertex_count() - 1});
  CHECK(says(refusal(fin, 0.1), "has 3 triangles"));
  Mesh flat = sphere({});
  flat.vertices.col(2).setZero();
  CHECK(says(refusal(flat, 0.1), "encloses no volume"));
  CHECK(says(refusal(bar({}), 0.1), "tetrahedra already"));
  CHECK(says(refusal(chain({}), 0.1), "no triangles"));
  const std::string fine = refusal(sphere({}), 1e-5);
  CHECK(says(fine, "asks for 1e+15 cubes"));
  CHECK(says(fine, "2e+06 are allowed; give 0.0082 m or more"));
  CHECK(refusal(sphere({.subdivisions = 0}), 0.05) == "nothing");
  CHECK(says(refusal(sphere({}), 1.5), "more than the body's largest side"));
  for (const Real spacing : {0.0, -1.0, std::nan(""), std::numeric_limits<Real>::infinity()}) {
    CHECK(says(refusal(sphere({}), spacing), "is out of range"));
  }
  CHECK(says(refusal(box({1, 1, 0.0005}, 8), 0.2), "too thin"));
}

TEST_CASE("polygons turn with their triangles, and maps go on to the lattice") {
  Mesh mesh = turned(box({1, 1, 1}, 1));
  mesh.faces.offsets.push_back(0);
  for (const Triangle& triangle : mesh.triangles) {
    mesh.faces.vertices.insert(mesh.faces.vertices.end(), triangle.begin(), triangle.end());
    mesh.faces.offsets.push_back(count_of(mesh.faces.vertices));
  }
  mesh.maps.push_back({"height", {}});
  for (Index v = 0; v < mesh.vertex_count(); ++v) mesh.maps[0].values.push_back(mesh.vertices(v, 2));
  const Mesh solid = lattice_solid(mesh, {.spacing = 0.4}, "it");
  Mesh polygons = solid;
  for (std::size_t t = 0; t < solid.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) polygons.triangles[t][i] = solid.faces.vertices[3 * t + i];
  }
  CHECK(volume_of(polygons) == doctest::Approx(1));
  REQUIRE(solid.maps[0].values.size() == at(solid.vertex_count()));
  for (Index v = 0; v < solid.vertex_count(); ++v) {
    if (std::abs(solid.vertices(v, 2) - 0.5) < 0.01) continue;
    CHECK(solid.maps[0].values[at(v)] == (solid.vertices(v, 2) > 0.5 ? 1 : 0));
  }
}

}  // namespace test_lattice
