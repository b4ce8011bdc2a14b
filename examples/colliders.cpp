// A cloth falls onto a ball that is then pulled away below it: docs/contact.md and docs/cpp.md quote the parts between
// the markers.
#include <cstdio>

#include <pliant/pliant.h>

//! [own_shape]
/// A ball that is cut off at its top, z ≤ height. Shapes must be convex.
class FlatBall final : public pliant::ColliderShape {
 public:
  FlatBall(double radius, double height) : radius_(radius), height_(height) {}

  std::string_view type() const override { return "flat_ball"; }
  pliant::SignedDistance distance(const pliant::Vec3& point) const override {
    const double length = point.norm();
    const double to_ball = length - radius_;
    const double to_top = point.z() - height_;
    if (to_top > to_ball) return {to_top, pliant::Vec3::UnitZ()};
    return {to_ball, length > 0 ? pliant::Vec3(point / length) : pliant::Vec3(pliant::Vec3::UnitZ())};
  }

 private:
  double radius_, height_;  // [m]
};
//! [own_shape]

int main() {
  pliant::Simulation simulation;
  const pliant::Mesh sheet = pliant::grid({.columns = 31, .rows = 31, .plane = pliant::Plane::xy});
  pliant::Positions start = sheet.vertices;
  start.rowwise() += pliant::Vec3(-0.5, -0.5, 0.35).transpose();
  const auto cloth = simulation.add_body(sheet, pliant::Mass::area_density(0.2), {.start = start});
  simulation.add(cloth, pliant::TriangleStrain{.stiffness = 1000});
  simulation.add(cloth, pliant::Bending{.stiffness = 1e-5});
  simulation.add(pliant::Gravity{});

  //! [colliders]
  const auto ball = simulation.add(pliant::SphereCollider{.radius = 0.3, .friction = 0.4});
  simulation.add(pliant::PlaneCollider{.position = {0, 0, -0.4}, .surface_velocity = {0.1, 0, 0}}, "belt");
  simulation.set_contact({.distance = 0.01, .friction = 0.3});  // m, μ; the cloth touches itself as well then
  //! [colliders]
  for (int i = 0; i < 60; ++i) simulation.step();

  //! [contacts]
  pliant::Vec3 on_cloth = pliant::Vec3::Zero();  // N
  for (const pliant::ContactPoint& each : simulation.contacts()) {
    if (each.collider == static_cast<pliant::Index>(ball)) on_cloth += each.force;
  }
  const pliant::Wrench wrench = simulation.wrench(ball);  // what the ball feels: the opposite
  //! [contacts]
  std::printf("the cloth weighs %.2f N, %.2f N of it on the ball\n", 9.81 * 0.2, -wrench.force.z());
  if (!((on_cloth + wrench.force).norm() < 1e-9)) return 1;

  //! [moves]
  for (int i = 1; i <= 60; ++i) {
    pliant::Pose pose = simulation.pose(ball);
    pose.position.x() += 0.01;  // m in this step: 0.6 m/s, with which friction takes the cloth along
    simulation.set_target(ball, pose);
    simulation.step();
  }
  simulation.replace(ball, pliant::SphereCollider{.center = {0.6, 0, 0}, .radius = 0.25});  // smaller from now on
  //! [moves]

  simulation.step();
  simulation.remove(ball);
  //! [own_collider]
  simulation.add_collider(std::make_shared<FlatBall>(0.2, 0.1), {.position = {0.6, 0, -0.3}}, {.friction = 0.5});
  //! [own_collider]
  for (int i = 0; i < 60; ++i) simulation.step();
  std::printf("the lowest vertex is at %.3f m\n", simulation.state().positions.col(2).minCoeff());
  return simulation.state().positions.col(2).minCoeff() > -0.4 ? 0 : 1;
}
