#include "contact/sheet_on_plane.h"

#include <algorithm>

namespace pliant_experiments {

using pliant::Index;
using pliant::Vec3;

const std::vector<ContactMethod>& contact_methods() {
  static const std::vector<ContactMethod> list = {
      {.name = "implicit Euler"},
      {.name = "implicit Euler, 4 substeps", .substeps = 4, .color = 1},
      {.name = "BDF2", .integrator = pliant::Integrator::bdf2, .color = 2},
  };
  return list;
}

pliant::SolverSettings contact_settings(const ContactMethod& method) {
  pliant::SolverSettings settings;
  settings.integrator = method.integrator;
  settings.substeps = method.substeps;
  settings.iterations = method.iterations;
  settings.acceleration = pliant::Acceleration::automatic;  // L-BFGS where something is touched
  settings.threads = 1;
  return settings;
}

pliant::Scene sheet_scene(const pliant::SolverSettings& settings, const SheetPlace& place) {
  pliant::Mesh mesh = pliant::grid(
      {.columns = place.side, .rows = place.side, .size = {place.size, place.size}, .plane = pliant::Plane::xy});
  const auto turn = Eigen::Quaternion<double>::FromTwoVectors(Vec3(Vec3::UnitZ()), place.normal);
  const Vec3 middle = mesh.vertices.colwise().mean().transpose();
  pliant::Simulation flat(settings);
  const double lift =
      place.contact_distances * flat.contact_distance(flat.add_body(mesh, pliant::Mass::area_density(0.2)));
  pliant::Positions velocities(mesh.vertex_count(), 3);
  for (Index i = 0; i < mesh.vertex_count(); ++i) {
    const Vec3 x = place.center + lift * place.normal + turn * (pliant::row(mesh.vertices, i) - middle);
    mesh.vertices.row(i) = x.transpose();
    velocities.row(i) = (place.velocity + place.angular_velocity.cross(x)).transpose();
  }
  pliant::Scene scene;
  scene.name = "contact";
  scene.simulation = pliant::Simulation(settings);
  const pliant::BodyId sheet =
      scene.simulation.add_body(mesh, pliant::Mass::area_density(0.2), {.velocities = velocities});
  scene.simulation.add(sheet, pliant::TriangleStrain{.stiffness = 1e3});
  scene.simulation.add(sheet, pliant::Bending{.stiffness = 1e-5});
  scene.simulation.add(pliant::Gravity{});
  return scene;
}

Vec3 mean_position(const pliant::Simulation& simulation) {
  return simulation.state().positions.colwise().mean().transpose();
}

Vec3 mean_velocity(const pliant::Simulation& simulation) {
  return simulation.state().velocities.colwise().mean().transpose();
}

SlidingPoint::SlidingPoint(const ContactMethod& method, Options options)
    : method_(method),
      options_(options),
      h_(pliant::SolverSettings{}.time_step / static_cast<double>(method.substeps)),
      speed_(options.speed) {}

void SlidingPoint::step() {
  for (Index i = 0; i < method_.substeps; ++i) substep();
}

/// q = a + η b + η² f, as integrator.h has it; friction takes it as near to where the ground has gone as it can.
void SlidingPoint::substep() {
  const bool is_bdf2 = method_.integrator == pliant::Integrator::bdf2 && !is_first_;
  const double eta = is_bdf2 ? 2 * h_ / 3 : h_;
  const double a = is_bdf2 ? (4 * way_ - way_before_) / 3 : way_;
  const double b = is_bdf2 ? (4 * speed_ - speed_before_) / 3 : speed_;
  const double anchor = way_ + h_ * options_.ground_speed;
  const double free = a + eta * b + eta * eta * options_.pull;
  const double most = eta * eta * options_.friction;
  way_before_ = way_;
  speed_before_ = speed_;
  way_ = free - std::clamp(free - anchor, -most, most);
  speed_ = (way_ - a) / eta;
  is_first_ = false;
}

}  // namespace pliant_experiments
