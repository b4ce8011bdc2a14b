// Fibres of a cloth: what they resist, and which way they run.
#include <doctest/doctest.h>

#include "../core/random.h"
#include "elastic.h"
#include "pliant/constraints/fibre_strain.h"
#include "pliant/constraints/triangle_strain.h"
#include "pliant/core/error.h"
#include "pliant/mesh/shapes.h"

namespace test_grain {

using namespace pliant;
using namespace pliant_tests;

namespace {

/// Two by three, in the plane z = 0 unless another is asked for.
Mesh sheet(Plane plane = Plane::xy) {
  return grid({.columns = 5, .rows = 4, .size = {2, 3}, .plane = plane});
}

Mesh without_texture(Mesh mesh) {
  mesh.texture_coordinates.resize(0, 2);
  mesh.faces.texture_coordinates.clear();
  return mesh;
}

/// The energy of fibres of stiffness 2 where the body is deformed by A: that of the square of the stretch's excess.
Real energy(const Mesh& mesh, FibreStrain options, const Mat3& A) {
  options.stiffness = 2;
  return Elastic(mesh, options).energy(mesh.vertices * A.transpose());
}

/// The same, of a sheet of area 6 with fibres along d.
Real exact(const Vec3& d, const Mat3& A) {
  return 6 * std::pow((A * d.normalized()).norm() - 1, 2);
}

doctest::Approx approx(Real x) {
  return doctest::Approx(x).epsilon(1e-12);
}

/// Any linear map, some way from a rotation.
Mat3 random_map(Random& random) {
  Mat3 A = Mat3::Identity();
  for (Real& x : A.reshaped()) x += random.uniform(-0.3, 0.3);
  return A;
}

std::string refusal(const Mesh& mesh, const FibreStrain& options) {
  try {
    build(BodyView{mesh, mesh.vertices, 0, "sheet"}, options);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

void check_says(const std::string& message, std::string_view part) {
  CAPTURE(message);
  CHECK(message.find(part) != std::string::npos);
}

}  // namespace

TEST_CASE("a fibre resists stretching along it, and nothing else") {
  const Mat3 wider = Vec3(1.3, 1, 1).asDiagonal();
  CHECK(energy(sheet(), {.direction = Vec3(1, 0, 0)}, wider) == approx(6 * 0.09));
  CHECK(energy(sheet(), {.direction = Vec3(0, 1, 0)}, wider) == approx(0));
  CHECK(energy(sheet(), {.direction = Vec3(1, 0, 0), .max_stretch = 1.2}, wider) == approx(6 * 0.01));
  CHECK(energy(sheet(), {.direction = Vec3(1, 0, 0), .max_stretch = 1.3}, wider) == approx(0));
  // Threads that keep their length turn against each other at no cost.
  Mat3 sheared = Mat3::Identity();
  sheared.col(1) << std::sin(0.4), std::cos(0.4), 0;
  for (const Real angle : {0.0, 90.0}) {
    CHECK(energy(sheet(), {.direction = Vec3(0, 1, 0), .angle = angle}, sheared) < 1e-28);
  }
  CHECK(energy(sheet(), {.direction = Vec3(0, 1, 0), .angle = 45}, sheared) > 0.1);
}

TEST_CASE("a direction is laid into each triangle, in any position of the sheet") {
  Random random;
  for (int i = 0; i < 20; ++i) {
    const Mat3 R = random.rotation(), A = random_map(random);
    Mesh mesh = sheet();
    mesh.vertices = moved(mesh.vertices, R, Vec3::Zero());
    const Vec3 within = R * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), 0);
    const Vec3 given = 3 * within + 2 * R.col(2);
    CHECK(energy(mesh, {.direction = given}, A) == approx(exact(within, A)));
    const Real angle = random.uniform(-180, 180);
    const Vec3 turned = Eigen::AngleAxis<Real>(angle * std::numbers::pi / 180, R.col(2)) * within;
    CHECK(energy(mesh, {.direction = given, .angle = angle}, A) == approx(exact(turned, A)));
  }
}

TEST_CASE("warp, weft and shear are what a woven cloth is made of") {
  // Along its threads it is as stiff as fibre and triangle together, in shear as the triangle alone.
  const Mesh cloth = sheet();
  const Mat3 longer = Vec3(1, 1.01, 1).asDiagonal();
  const Real along = energy(cloth, {}, longer) +
                     Elastic(cloth, TriangleStrain{.stiffness = 0.1}).energy(cloth.vertices * longer.transpose());
  CHECK(along == approx((2 + 0.1) / 2 * 6 * 1e-4));
}

TEST_CASE("texture coordinates say which way the warp runs") {
  Random random;
  for (int i = 0; i < 20; ++i) {
    Mesh mesh = sheet();
    const Mat3 A = random_map(random);
    // Rows are (u, v); they are turned, stretched and, half the time, seen from behind.
    Eigen::Matrix<Real, 2, 2> to_uv;
    to_uv << random.uniform(0.5, 2), random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5), random.uniform(0.5, 2);
    if (i % 2 == 0) to_uv.row(0) *= -1;
    mesh.texture_coordinates = mesh.vertices.leftCols<2>() * to_uv.transpose();
    const Vec2 v = to_uv.inverse().col(1);
    for (const Grain grain : {Grain::automatic, Grain::uv}) {
      CHECK(energy(mesh, {.grain = grain}, A) == approx(exact(Vec3(v[0], v[1], 0), A)));
    }
    const Vec3 given(1, 2, 0);
    CHECK(energy(mesh, {.direction = given}, A) == approx(exact(given, A)));
  }
}

TEST_CASE("polygons have texture coordinates at their corners, and those may differ where they meet") {
  // Two squares side by side, the second with its texture turned by a right angle.
  Mesh mesh;
  mesh.vertices.resize(6, 3);
  mesh.vertices << 0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 2, 1, 0;
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 5}, {1, 5, 2}};
  mesh.faces.offsets = {0, 4, 8};
  mesh.faces.vertices = {0, 1, 2, 3, 1, 4, 5, 2};
  mesh.texture_coordinates.resize(8, 2);
  mesh.texture_coordinates << 0, 0, 1, 0, 1, 1, 0, 1, 0, 0, 0, 1, -1, 1, -1, 0;
  mesh.faces.texture_coordinates = {0, 1, 2, 3, 4, 5, 6, 7};
  const Mat3 higher = Vec3(1, 1.2, 1).asDiagonal();
  CHECK(energy(mesh, {.on = {0, 1, 2, 3}}, higher) == approx(0.04));
  CHECK(energy(mesh, {.on = {1, 2, 4, 5}}, higher) == approx(0));
  CHECK(energy(mesh, {.on = {1, 2, 4, 5}, .angle = 90}, higher) == approx(0.04));
  // A corner without any leaves its face to the axis.
  mesh.faces.texture_coordinates[3] = -1;
  CHECK(energy(mesh, {}, higher) == approx(0.02));
  check_says(refusal(mesh, {.grain = Grain::uv}), "texture coordinates of triangle 1 are missing or have no area");
}

TEST_CASE("without texture coordinates the warp hangs down where it can") {
  const std::array<Vec3, 3> axes = {Vec3::UnitX(), Vec3::UnitY(), Vec3::UnitZ()};
  const auto warp = [&axes](const Mesh& mesh) {
    for (const Vec3& axis : axes) {
      const Mat3 longer = Mat3::Identity() + 0.1 * axis * axis.transpose();
      const FibreStrain options{.direction = axis};
      if (refusal(mesh, options) == "nothing" && energy(mesh, {}, longer) == approx(energy(mesh, options, longer))) {
        return axis;
      }
    }
    return Vec3(0, 0, 0);
  };
  CHECK(warp(without_texture(sheet(Plane::xy))) == Vec3::UnitX());
  CHECK(warp(without_texture(sheet(Plane::yz))) == Vec3::UnitZ());
  CHECK(warp(without_texture(sheet(Plane::xz))) == Vec3::UnitZ());
  // Every triangle of a closed surface has one, those across the axis too.
  const Mesh ball = sphere({.subdivisions = 2});
  CHECK(Elastic(ball, FibreStrain{}).set().count == static_cast<Index>(ball.triangles.size()));
}

TEST_CASE("grain that there is not is refused") {
  const Mesh cloth = sheet();
  check_says(refusal(cloth, {.direction = Vec3(0, 0, 2)}),
             "fibre_strain on body 'sheet': the direction is normal to triangle 0; give one that lies in the cloth");
  check_says(refusal(cloth, {.direction = Vec3(0, 0, 0)}), "direction 0 is the zero vector");
  check_says(refusal(cloth, {.direction = std::vector<Vec3>(3, Vec3::UnitX())}), "direction has 3 entries for 24");
  check_says(refusal(without_texture(cloth), {.grain = Grain::uv}), "no texture coordinates");
  Mesh flat = cloth;
  flat.texture_coordinates.col(1).setConstant(0.5);
  check_says(refusal(flat, {.grain = Grain::uv}), "triangle 0 are missing or have no area");
  CHECK(refusal(flat, {}) == "nothing");
  check_says(refusal(cloth, {.min_stretch = 2}), "min_stretch 2 is above max_stretch 1");
}

}  // namespace test_grain
