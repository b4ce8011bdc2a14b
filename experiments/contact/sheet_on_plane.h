#pragma once
// A sheet of cloth, and a point that slides as it should.
#include "experiment_context.h"
#include "pliant/pliant.h"

namespace pliant_experiments {

/// How steps are taken; all else is as the library has it, on one thread.
struct ContactMethod {
  std::string name{};
  pliant::Integrator integrator = pliant::Integrator::implicit_euler;
  pliant::Index substeps = 1;
  pliant::Index iterations = 10;
  int color = 0;
};

/// Implicit Euler, the same in four substeps, BDF2.
const std::vector<ContactMethod>& contact_methods();

pliant::SolverSettings contact_settings(const ContactMethod& method);

/// Where a sheet of n x n vertices lies and how it moves: turned from the plane z = 0, with its middle at `center`.
struct SheetPlace {
  pliant::Index side = 16;
  double size = 1;  ///< [m]
  pliant::Vec3 center = pliant::Vec3::Zero();
  pliant::Vec3 normal = pliant::Vec3::UnitZ();
  double contact_distances = 0;  ///< besides, along the normal
  pliant::Vec3 velocity = pliant::Vec3::Zero();
  pliant::Vec3 angular_velocity = pliant::Vec3::Zero();  ///< [rad/s], about the origin
};

/// A scene with gravity and such a sheet; its collider is up to the caller.
pliant::Scene sheet_scene(const pliant::SolverSettings& settings, const SheetPlace& place);

pliant::Vec3 mean_position(const pliant::Simulation& simulation);
pliant::Vec3 mean_velocity(const pliant::Simulation& simulation);

/// A point on a rigid plane with Coulomb friction, in the same steps: what a sheet should do, but for its depth.
class SlidingPoint {
 public:
  struct Options {
    double pull = 0;          ///< along the plane [m/s²]
    double friction = 0;      ///< μ times what presses the point to the plane [m/s²]
    double speed = 0;         ///< at first [m/s]
    double ground_speed = 0;  ///< of the plane's surface [m/s]
  };
  SlidingPoint(const ContactMethod& method, Options options);
  void step();
  double way() const { return way_; }
  double speed() const { return speed_; }

 private:
  void substep();

  ContactMethod method_;
  Options options_;
  double h_ = 0;
  double way_ = 0, speed_ = 0, way_before_ = 0, speed_before_ = 0;
  bool is_first_ = true;
};

}  // namespace pliant_experiments
