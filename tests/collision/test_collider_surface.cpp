// Meshes of colliders, against the distances that contact goes by.
#include <cmath>
#include <map>
#include <numbers>

#include <doctest/doctest.h>

#include "pliant/collision/colliders/builtin.h"
#include "pliant/collision/colliders/surface.h"

namespace test_collider_surface {

using namespace pliant;

namespace {

/// Each edge belongs to two triangles that run along it in opposite directions.
bool is_closed(const Mesh& mesh) {
  std::map<std::pair<Index, Index>, int> edges;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t i = 0; i < 3; ++i) ++edges[{t[i], t[(i + 1) % 3]}];
  }
  return std::ranges::all_of(edges, [&](const auto& entry) {
    const auto other = edges.find({entry.first.second, entry.first.first});
    return entry.second == 1 && other != edges.end();
  });
}

Real volume(const Mesh& mesh) {
  Real sum = 0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]), c = mesh.vertices.row(t[2]);
    sum += a.dot(b.cross(c)) / 6;
  }
  return sum;
}

void check_on_surface(const ColliderShape& shape, const Mesh& mesh) {
  REQUIRE(!mesh.triangles.empty());
  for (Eigen::Index i = 0; i < mesh.vertices.rows(); ++i) {
    CHECK(std::abs(shape.distance(mesh.vertices.row(i).transpose()).distance) < 1e-9);
  }
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.vertices.row(t[0]), b = mesh.vertices.row(t[1]), c = mesh.vertices.row(t[2]);
    const Vec3 normal = (b - a).cross(c - a);
    CHECK(normal.norm() > 0);
    CHECK(normal.dot(shape.distance((a + b + c) / 3).normal) > 0.9 * normal.norm());
  }
}

}  // namespace

TEST_CASE("surfaces of colliders lie on them, closed and outward, with their volume") {
  constexpr Real pi = std::numbers::pi;
  BoxCollider box{.size = {0.4, 0.6, 1}};
  BoxCollider round_box{.size = {0.4, 0.6, 1}, .rounding = 0.1, .rotation = {10, 20, 30}};
  BoxCollider ball_box{.size = {0.4, 0.6, 0.4}, .rounding = 0.2};  // a capsule along y
  const Vec3 inner(0.2, 0.4, 0.8);
  const Real round_volume = inner.prod() +
                            2 * 0.1 * (inner.x() * inner.y() + inner.y() * inner.z() + inner.z() * inner.x()) +
                            pi * 0.01 * inner.sum() + 4 * pi / 3 * 0.001;
  struct Case {
    PlacedShape placed;
    Real volume;
  };
  const std::vector<Case> cases = {
      {build(SphereCollider{.radius = 0.3}), 4 * pi / 3 * 0.027},
      {build(CapsuleCollider{.from = {0, 0, 0}, .to = {0, 1, 0}, .radius = 0.2}), pi * 0.04 + 4 * pi / 3 * 0.008},
      {build(CapsuleCollider{.from = {1, 0, 0}, .to = {1, 0, 0}, .radius = 0.2}), 4 * pi / 3 * 0.008},
      {build(box), 0.24},
      {build(round_box), round_volume},
      {build(ball_box), pi * 0.04 * 0.2 + 4 * pi / 3 * 0.008},
  };
  for (const Case& each : cases) {
    CAPTURE(each.placed.shape->type());
    CAPTURE(each.volume);
    const Mesh mesh = each.placed.shape->surface(1);
    check_on_surface(*each.placed.shape, mesh);
    CHECK(is_closed(mesh));
    CHECK(volume(mesh) == doctest::Approx(each.volume).epsilon(0.01));
    CHECK(volume(mesh) <= each.volume * (1 + 1e-12));  // of a convex shape the mesh lies inside
    CHECK(each.placed.shape->is_bounded());
  }
  CHECK(build(box).shape->surface(1).triangles.size() == 12);
}

TEST_CASE("a plane shows a square of the size that is asked for; its normal is its own") {
  const PlacedShape plane = build(PlaneCollider{.normal = {0, 0, 2}});
  const Mesh mesh = plane.shape->surface(3);
  check_on_surface(*plane.shape, mesh);
  CHECK_FALSE(is_closed(mesh));
  CHECK_FALSE(plane.shape->is_bounded());
  CHECK(mesh.vertices.cwiseAbs().maxCoeff() == 3);
  CHECK(mesh.vertices.colwise().minCoeff().head<2>().maxCoeff() == -3);
}

TEST_CASE("normals are smooth where a shape is round, and those of the faces where it is sharp") {
  const PlacedShape sphere = build(SphereCollider{.radius = 0.3});
  const Mesh ball = sphere.shape->surface(1);
  const Positions round = corner_normals(*sphere.shape, ball);
  REQUIRE(round.rows() == static_cast<Eigen::Index>(3 * ball.triangles.size()));
  for (std::size_t t = 0; t < ball.triangles.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Vec3 outward = ball.vertices.row(ball.triangles[t][i]).transpose() / 0.3;
      CHECK((round.row(static_cast<Eigen::Index>(3 * t + i)).transpose() - outward).norm() < 2e-4);
    }
  }
  const PlacedShape box = build(BoxCollider{.size = {1, 2, 3}});
  const Mesh crate = box.shape->surface(1);
  const Positions sharp = corner_normals(*box.shape, crate);
  for (std::size_t t = 0; t < crate.triangles.size(); ++t) {
    const Vec3 a = crate.vertices.row(crate.triangles[t][0]), b = crate.vertices.row(crate.triangles[t][1]),
               c = crate.vertices.row(crate.triangles[t][2]);
    const Vec3 face = (b - a).cross(c - a).normalized();
    for (std::size_t i = 0; i < 3; ++i) {
      CHECK((sharp.row(static_cast<Eigen::Index>(3 * t + i)).transpose() - face).norm() < 1e-12);
    }
  }
}

TEST_CASE("a shape of a user's own has no surface unless it says so") {
  class Mine final : public ColliderShape {
   public:
    std::string_view type() const override { return "mine"; }
    SignedDistance distance(const Vec3& point) const override { return {point.z(), Vec3::UnitZ()}; }
  };
  CHECK(Mine().surface(1).triangles.empty());
  CHECK(Mine().is_bounded());
}

}  // namespace test_collider_surface
