#include "contact/friction.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "contact/sheet_on_plane.h"
#include "support/claims.h"

namespace pliant_experiments {
namespace {

using pliant::Index;
using pliant::Vec3;
using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Table;

constexpr double gravity = 9.81;
constexpr double friction = 0.3;
constexpr double just_touching = 1.0005;  // contact distances at which a sheet begins

struct Slope {
  pliant::Scene scene;
  Vec3 down = Vec3::UnitX();
  Vec3 begin = Vec3::Zero();
  double way() const { return down.dot(mean_position(scene.simulation) - begin); }
};

Slope make_slope(const pliant::SolverSettings& settings, Index side, double degrees, double speed = 0) {
  const double angle = degrees * std::numbers::pi / 180;
  const Vec3 normal(std::sin(angle), 0, std::cos(angle));
  const Vec3 down(std::cos(angle), 0, -std::sin(angle));
  Slope slope{
      sheet_scene(settings,
                  {.side = side, .normal = normal, .contact_distances = just_touching, .velocity = speed * down}),
      down};
  slope.scene.simulation.add(pliant::PlaneCollider{.normal = normal, .friction = friction});
  slope.begin = mean_position(slope.scene.simulation);
  return slope;
}

SlidingPoint::Options point_on(double degrees, double speed = 0) {
  const double angle = degrees * std::numbers::pi / 180;
  return {.pull = gravity * std::sin(angle), .friction = friction * gravity * std::cos(angle), .speed = speed};
}

/// Ways of a sheet and of a point, after so many steps.
struct Ways {
  double sheet = 0;
  double point = 0;
  double error() const { return std::abs(sheet / point - 1); }
};

Ways slide(const ExperimentContext& context, const ContactMethod& method, pliant::Acceleration acceleration, Index side,
           double degrees, double speed, int steps) {
  pliant::SolverSettings settings = contact_settings(method);
  settings.acceleration = acceleration;
  Slope slope = make_slope(settings, side, degrees, speed);
  SlidingPoint point(method, point_on(degrees, speed));
  for (int i = 0; i < steps; ++i) {
    context.step(slope.scene);
    point.step();
  }
  return {slope.way(), point.way()};
}

/// At 16, 17 and 30 degrees.
using ThreeWays = std::array<Ways, 3>;

std::vector<std::string> row_of(const std::string& name, Index side, const ThreeWays& ways) {
  return {name,
          fmt::format("{0} x {0}", side),
          fmt::format("{:.2g}", 1e3 * ways[0].sheet),
          fmt::format("{:.6f}", ways[1].sheet),
          fmt::format("{:.6f}", ways[1].point),
          fmt::format("{:.1e}", ways[1].error()),
          fmt::format("{:.5f}", ways[2].sheet),
          fmt::format("{:.5f}", ways[2].point),
          fmt::format("{:.1e}", ways[2].error())};
}

ThreeWays slides(const ExperimentContext& context, const ContactMethod& method, pliant::Acceleration acceleration,
                 Index side) {
  context.say(fmt::format("slope, {}, {} x {} vertices", method.name, side, side));
  const std::array<double, 3> angles = {16, 17, 30};
  ThreeWays ways;
  for (std::size_t i = 0; i < 3; ++i) ways[i] = slide(context, method, acceleration, side, angles[i], 0, 60);
  return ways;
}

pliant_report::Claim claim_of(const std::string& name, const ThreeWays& ways) {
  return claim(fmt::format("A sheet slides down a slope as far as Coulomb's law says, within a thousandth: {}", name),
               "", ways[1].error() < 1e-3 && ways[2].error() < 1e-3,
               fmt::format("off by {:.1e} at 17° and {:.1e} at 30°", ways[1].error(), ways[2].error()));
}

}  // namespace

void measure_slope(const ExperimentContext& context, Chapter& chapter) {
  Table table{
      "Way of a sheet down a slope in 1 s, friction 0.3 (limit 16.7°), and of a point that slides in the same steps: "
      "for "
      "implicit Euler h² n(n+1)/2 g (sin θ − μ cos θ). That the sheet sinks into its contact by 0.06 mm at first makes "
      "its way longer by 0.018 mm, which is 7e-4 of the way at 17°.",
      {"integrator", "vertices", "16° [mm]", "17° [m]", "point [m]", "error", "30° [m]", "point [m]", "error"},
      {}};
  const ContactMethod& euler = contact_methods().front();
  double drift = 0;
  const auto add = [&](const ContactMethod& method, Index side) {
    const ThreeWays ways = slides(context, method, pliant::Acceleration::automatic, side);
    const std::string name = side == 16 ? method.name : fmt::format("{0}, {1} x {1} vertices", method.name, side);
    table.rows.push_back(row_of(method.name, side, ways));
    chapter.claims.push_back(claim_of(name, ways));
    drift = std::max(drift, std::abs(ways[0].sheet));
  };
  for (const ContactMethod& method : contact_methods()) add(method, 16);
  add({.name = "BDF2, 20 iterations", .integrator = pliant::Integrator::bdf2, .iterations = 20}, 16);
  add(euler, 40);
  const ThreeWays plain = slides(context, euler, pliant::Acceleration::none, 16);
  table.rows.push_back(row_of("implicit Euler, acceleration none", 16, plain));
  context.say("slope, one minute");
  const Ways minute = slide(context, euler, pliant::Acceleration::automatic, 16, 16, 0, 3600);
  chapter.claims.push_back(
      claim("Below the angle of friction it sticks: less than 0.1 mm in 1 s and in 60 s", "",
            drift < 1e-4 && std::abs(minute.sheet) < 1e-4,
            fmt::format("at 16° {:.2g} mm at most in 1 s, all of these; {:.2g} mm in 60 s with implicit Euler",
                        1e3 * drift, 1e3 * minute.sheet)));
  chapter.claims.push_back(
      claim("Without acceleration ten iterations do for a sheet on a slope too: it slides as far, and sticks", "",
            plain[1].error() < 1e-3 && plain[2].error() < 1e-3 && std::abs(plain[0].sheet) < 1e-4,
            fmt::format("acceleration none: off by {:.1e} at 17° and {:.1e} at 30°, {:.2g} mm at 16°", plain[1].error(),
                        plain[2].error(), 1e3 * plain[0].sheet)));
  chapter.blocks.emplace_back(std::move(table));
}

void measure_stop(const ExperimentContext& context, Chapter& chapter) {
  constexpr double speed = 2;
  constexpr int steps = 60;
  Plot plot{.title = "Sliding to a stop",
            .caption =
                "Speed of a sheet that slides at 2 m/s on a level plane, friction 0.3, and of a point in the "
                "same steps (dashed, below the lines of the sheet).",
            .x = {.label = "time [s]"},
            .y = {.label = "speed [m/s]", .min = 0},
            .series = {}};
  Table table{"Way until it stops. In continuous time it is v²/2μg = 0.67958 m.",
              {"integrator", "sheet [m]", "point [m]", "error"},
              {}};
  double error = 0;
  for (const ContactMethod& method : contact_methods()) {
    context.say(fmt::format("stop, {}", method.name));
    Slope ground = make_slope(contact_settings(method), 16, 0, speed);
    SlidingPoint point(method, point_on(0, speed));
    pliant_report::Series sheet_speed{.name = method.name, .color = method.color};
    pliant_report::Series point_speed{.name = method.name + ", a point", .is_dashed = true, .color = method.color};
    for (int i = 0; i <= steps; ++i) {
      for (pliant_report::Series* each : {&sheet_speed, &point_speed}) each->x.push_back(i / 60.0);
      sheet_speed.y.push_back(mean_velocity(ground.scene.simulation).x());
      point_speed.y.push_back(point.speed());
      if (i == steps) break;
      context.step(ground.scene);
      point.step();
    }
    const Ways ways{ground.way(), point.way()};
    error = std::max(error, ways.error());
    table.rows.push_back({method.name, fmt::format("{:.5f}", ways.sheet), fmt::format("{:.5f}", ways.point),
                          fmt::format("{:.1e}", ways.error())});
    plot.series.push_back(std::move(sheet_speed));
    plot.series.push_back(std::move(point_speed));
  }
  chapter.claims.push_back(claim("A sheet that slides at 2 m/s stops where it should, within a thousandth", "",
                                 error < 1e-3, fmt::format("in three integrators {:.1e} at most", error)));
  chapter.blocks.emplace_back(std::move(plot));
  chapter.blocks.emplace_back(std::move(table));
}

}  // namespace pliant_experiments
