#include "contact/moving_ground.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "contact/sheet_on_plane.h"
#include "support/claims.h"

namespace pliant_experiments {
namespace {

using pliant::Vec3;
using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Table;

constexpr double grip = 0.3 * 9.81;  // μ g [m/s²]
constexpr double table_radius = 1;   // at which the sheet lies [m]

/// Of a small sheet on a turntable, relative to it.
struct Slip {
  double share = 0;  // ω² R / μ g at which it began to slip; 0: never
  double drift = 0;  // way over the table from the first half second until 0.98 of the limit [m]
  pliant_report::Series speeds{};
};

/// Where the middle of the sheet is on a table that has turned by an angle.
Vec3 on_table(const pliant::Simulation& simulation, double angle) {
  return Eigen::AngleAxis<double>(-angle, Vec3::UnitZ()) * mean_position(simulation);
}

/// Speeds up by 0.5 % of ω² R every half second and looks whether the sheet still lies where it lay.
Slip spin_up(const ExperimentContext& context, const ContactMethod& method) {
  constexpr int hold = 30;
  constexpr double slipping = 1e-3;  // [m/s]
  const auto omega_at = [](double share) { return std::sqrt(share * grip / table_radius); };
  const pliant::SolverSettings settings = contact_settings(method);
  pliant::Scene scene = sheet_scene(settings, {.side = 6,
                                               .size = 0.2,
                                               .center = {table_radius, 0, 0},
                                               .contact_distances = 1.0005,
                                               .angular_velocity = {0, 0, omega_at(0.9)}});
  const pliant::ColliderId table = scene.simulation.add(pliant::PlaneCollider{.friction = 0.3});
  Vec3 begin = Vec3::Zero();
  Slip slip{.speeds = {.name = method.name, .mark = pliant_report::Mark::line_and_points, .color = method.color}};
  double angle = 0;
  for (int level = 0; level <= 30 && slip.share == 0; ++level) {
    const double share = 0.9 + 0.005 * level;
    scene.simulation.replace(table,
                             pliant::PlaneCollider{.angular_velocity = {0, 0, omega_at(share)}, .friction = 0.3});
    Vec3 before = Vec3::Zero();
    for (int i = 0; i < hold; ++i) {
      before = on_table(scene.simulation, angle);
      context.step(scene);
      angle += omega_at(share) * settings.time_step;
    }
    const Vec3 now = on_table(scene.simulation, angle);
    const double speed = (now - before).norm() / settings.time_step;
    slip.speeds.x.push_back(share);
    slip.speeds.y.push_back(std::max(speed, 1e-12));
    if (speed > slipping) slip.share = share;
    if (level == 0) begin = now;  // it had to find its hold
    if (share < 0.9801) slip.drift = std::max(slip.drift, (now - begin).norm());
  }
  return slip;
}

std::string verdict_of(const Slip& slip) {
  if (slip.share == 0) return fmt::format("never slips, and drifts by {:.2g} mm", 1e3 * slip.drift);
  if (slip.drift == 0) return fmt::format("slips from the start, at {:.3f}", slip.share);
  return fmt::format("slips at {:.3f} and drifts by {:.2g} mm before", slip.share, 1e3 * slip.drift);
}

}  // namespace

void measure_conveyor(const ExperimentContext& context, Chapter& chapter) {
  constexpr double belt = 1;  // [m/s]
  Table table{
      "A sheet is laid on a conveyor belt that runs at 1 m/s, friction 0.3: its way in 1 s, that of a point in the "
      "same "
      "steps, and how its speed differs from the belt's at the end.",
      {"integrator", "sheet [m]", "point [m]", "error", "speed against the belt's [m/s]"},
      {}};
  double error = 0;
  double difference = 0;
  for (const ContactMethod& method : contact_methods()) {
    context.say(fmt::format("conveyor, {}", method.name));
    pliant::Scene scene = sheet_scene(contact_settings(method), {.contact_distances = 1.0005});
    scene.simulation.add(pliant::PlaneCollider{.surface_velocity = {belt, 0, 0}, .friction = 0.3});
    SlidingPoint point(method, {.friction = grip, .ground_speed = belt});
    const double begin = mean_position(scene.simulation).x();
    for (int i = 0; i < 60; ++i) {
      context.step(scene);
      point.step();
    }
    const double way = mean_position(scene.simulation).x() - begin;
    const double slower = mean_velocity(scene.simulation).x() - belt;
    error = std::max(error, std::abs(way / point.way() - 1));
    difference = std::max(difference, std::abs(slower));
    table.rows.push_back({method.name, fmt::format("{:.5f}", way), fmt::format("{:.5f}", point.way()),
                          fmt::format("{:.1e}", std::abs(way / point.way() - 1)), fmt::format("{:.1e}", slower)});
  }
  chapter.claims.push_back(
      claim("A conveyor takes a sheet along: to its own speed, and as far as Coulomb's law says within a thousandth",
            "", error < 1e-3 && difference < 1e-4,
            fmt::format("ways within {:.1e}, speeds within {:.1e} m/s after 1 s", error, difference)));
  chapter.blocks.emplace_back(std::move(table));
}

void measure_turntable(const ExperimentContext& context, Chapter& chapter) {
  Plot plot{.title = "A sheet on a turntable",
            .caption =
                "Speed at which a sheet of 0.2 m, one meter from the axis, slips over a turntable, over ω² R / μ "
                "g. The table is made faster every half second; the speed is that at its end. Dashed: ten "
                "iterations, else 20.",
            .x = {.label = "ω² R / μ g"},
            .y = {.label = "speed over the table [m/s]", .is_logarithmic = true},
            .series = {},
            .guides = {{1, "Coulomb's law", true}}};
  for (const pliant::Index iterations : {10, 20}) {
    bool holds = true;
    std::string evidence;
    for (ContactMethod method : contact_methods()) {
      context.say(fmt::format("turntable, {}, {} iterations", method.name, iterations));
      method.iterations = iterations;
      Slip slip = spin_up(context, method);
      holds &= std::abs(slip.share - 1) <= 0.01 + 1e-9 && slip.drift < 1e-3;
      evidence += fmt::format("{}{} {}", evidence.empty() ? "" : "; ", method.name, verdict_of(slip));
      slip.speeds.is_dashed = iterations == 10;
      slip.speeds.name += fmt::format(", {} iterations", iterations);
      plot.series.push_back(std::move(slip.speeds));
    }
    chapter.claims.push_back(
        claim(fmt::format("A sheet lies still, to a millimeter, on a turntable up to ω² R = μ g and "
                          "slips there, within 1 %: {} iterations",
                          iterations),
              "", holds, evidence));
  }
  chapter.blocks.emplace_back(std::move(plot));
}

}  // namespace pliant_experiments
