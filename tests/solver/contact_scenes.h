#pragma once
// Sheets and blocks that meet colliders, and what exact friction makes of them.
#include <cmath>
#include <numbers>

#include "pliant/pliant.h"

namespace pliant_tests {

/// A plane tilted by an angle [°] about y: what slides goes along `down`.
struct Slope {
  explicit Slope(pliant::Real degrees) {
    const pliant::Real angle = degrees * std::numbers::pi / 180;
    normal = {std::sin(angle), 0, std::cos(angle)};
    down = {std::cos(angle), 0, -std::sin(angle)};
  }
  pliant::Vec3 normal, down;
  pliant::Real gravity = 9.81;
  /// Of what slides with friction μ [m/s²].
  pliant::Real acceleration(pliant::Real friction) const { return gravity * (-down.z() - friction * normal.z()); }
};

/// A sheet of 1 × 1 m and 0.2 kg/m² with so many vertices a side, flat on the plane z = 0 of `frame`, a hair more than
/// a contact distance above it.
struct Sheet {
  pliant::Index vertices = 16;
  pliant::Real size = 1;
  pliant::Vec3 velocity = pliant::Vec3::Zero();
  pliant::Vec3 center = pliant::Vec3::Zero();  ///< in the frame
};

inline pliant::BodyId add_sheet(pliant::Simulation& simulation, const Sheet& sheet, const pliant::Vec3& normal) {
  using namespace pliant;
  Mesh mesh =
      grid({.columns = sheet.vertices, .rows = sheet.vertices, .size = {sheet.size, sheet.size}, .plane = Plane::xy});
  Simulation probe;
  const Real distance = probe.contact_distance(probe.add_body(mesh, Mass::area_density(0.2)));
  const Eigen::Quaternion<Real> turn = Eigen::Quaternion<Real>::FromTwoVectors(Vec3(Vec3::UnitZ()), normal);
  const Vec3 corner(-sheet.size / 2, -sheet.size / 2, 1.0005 * distance);
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    mesh.vertices.row(i) = (turn * (row(mesh.vertices, i) + corner + sheet.center)).transpose();
  }
  const Positions velocities = sheet.velocity.transpose().replicate(mesh.vertex_count(), 1);
  const BodyId body = simulation.add_body(std::move(mesh), Mass::area_density(0.2), {.velocities = velocities});
  simulation.add(body, TriangleStrain{.stiffness = 1e3});
  simulation.add(body, Bending{.stiffness = 1e-5});
  return body;
}

inline pliant::Vec3 mean(const pliant::Positions& x) {
  return x.colwise().mean().transpose();
}

}  // namespace pliant_tests
