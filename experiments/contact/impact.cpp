#include "contact/impact.h"

#include <algorithm>
#include <cmath>
#include <functional>

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

constexpr std::array<double, 4> throws = {5, 10, 20, 30};        // [m/s]
constexpr std::array<double, 5> rates = {240, 120, 60, 30, 15};  // 1/h [1/s]
constexpr double flight = 0.3;                                   // from the sheet to the top of the collider [m]
constexpr double after_impact = 0.3;                             // [s], for which it is watched

/// What a sheet is thrown at. Its top is at z = 0.
struct Obstacle {
  std::string name;
  pliant::PlacedShape placed;
  double core = 0;  // how deep no way of a vertex may lead: half of its inner radius [m]
  std::function<void(pliant::Simulation&)> add;
};

template <class Options>
Obstacle make_obstacle(const Options& options, double core) {
  return {std::string(Options::info.name), build(options), core,
          [options](pliant::Simulation& simulation) { simulation.add(options); }};
}

const std::vector<Obstacle>& obstacles() {
  static const std::vector<Obstacle> list = {
      make_obstacle(pliant::PlaneCollider{}, 0),
      make_obstacle(pliant::SphereCollider{.center = {0, 0, -0.3}, .radius = 0.3}, 0.15),
      make_obstacle(pliant::CapsuleCollider{.from = {-1, 0, -0.05}, .to = {1, 0, -0.05}, .radius = 0.05}, 0.025),
      make_obstacle(pliant::BoxCollider{.center = {0, 0, -0.3}, .size = {0.6, 0.6, 0.6}}, 0.15),
  };
  return list;
}

/// Least signed distance on a straight way, at most 0: of a convex shape it has one minimum, found by thirds.
double least_distance(const pliant::PlacedShape& placed, const Vec3& from, const Vec3& to) {
  const auto distance = [&](double share) {
    const Vec3 x = from + share * (to - from);
    return placed.shape->distance(placed.pose.to_frame(x)).distance;
  };
  const double a = distance(0);
  const double b = distance(1);
  if (a + b >= (to - from).norm()) return 0;  // all of it is outside
  double low = 0;
  double high = 1;
  for (int i = 0; i < 40; ++i) {
    const double left = low + (high - low) / 3;
    const double right = high - (high - low) / 3;
    if (distance(left) < distance(right)) {
      high = right;
    } else {
      low = left;
    }
  }
  return std::min({0.0, a, b, distance((low + high) / 2)});
}

struct Impact {
  double depth = -1e300;  // greatest r − d of a vertex after a step, over r
  double least = 1e300;   // least distance that a way of a vertex has from the surface [m]
  bool touches = false;
  bool passes(const Obstacle& obstacle) const { return least < -obstacle.core; }
};

pliant::Scene thrown_sheet(const Obstacle& obstacle, double speed, double rate) {
  pliant::SolverSettings settings = contact_settings(contact_methods().front());
  settings.time_step = 1 / rate;
  pliant::Scene scene =
      sheet_scene(settings, {.side = 21, .center = {0.012, 0.007, flight}, .velocity = {0, 0, -speed}});
  obstacle.add(scene.simulation);
  return scene;
}

Impact throw_at(const ExperimentContext& context, const Obstacle& obstacle, double speed, double rate) {
  pliant::Scene scene = thrown_sheet(obstacle, speed, rate);
  const double r = scene.simulation.contact_distance(pliant::BodyId{0});
  const auto steps = static_cast<int>(std::ceil((flight / speed + after_impact) * rate)) + 1;
  Impact impact;
  for (int i = 0; i < steps; ++i) {
    const pliant::Positions before = scene.simulation.state().positions;
    const pliant::StepReport report = context.step(scene);
    if (report.contact.contacts == 0 && !impact.touches) continue;
    impact.touches = true;
    const pliant::Positions& now = scene.simulation.state().positions;
    for (Index v = 0; v < before.rows(); ++v) {
      const Vec3 to = pliant::row(now, v);
      const double end = obstacle.placed.shape->distance(obstacle.placed.pose.to_frame(to)).distance;
      impact.depth = std::max(impact.depth, (r - end) / r);
      impact.least = std::min(impact.least, least_distance(obstacle.placed, pliant::row(before, v), to));
    }
  }
  return impact;
}

void show_throws(const ExperimentContext& context, Chapter& chapter) {
  std::vector<pliant_render::Image> pictures;
  for (std::size_t i = 1; i < obstacles().size(); ++i) {
    pliant::Scene scene = thrown_sheet(obstacles()[i], 10, 120);
    scene.view.size = {400, 400};
    scene.view.camera.position = Vec3(1.1, -1.65, 0.75);
    scene.view.camera.target = Vec3(0, 0, -0.2);
    scene.view.ground = false;
    context.step(scene, 12);
    pictures.push_back(context.picture(scene));
  }
  context.show(chapter, pictures, 3,
               "Sheets thrown at 10 m/s at a sphere, a capsule and a box, 0.1 s after they began.");
}

}  // namespace

void measure_thrown_sheets(const ExperimentContext& context, Chapter& chapter) {
  Table table{
      "The vertex that is deepest after any step, from the impact on for 0.3 s, of a sheet of 21 x 21 vertices thrown "
      "at "
      "5, 10, 20 and 30 m/s: how much nearer it is than the contact distance, in contact distances. At 1 it would be "
      "at "
      "the surface.",
      {"collider", "1/h [1/s]", "5 m/s", "10 m/s", "20 m/s", "30 m/s", "passed through"},
      {}};
  int passed = 0;
  int missed = 0;
  double deepest = -1e300;
  for (const Obstacle& obstacle : obstacles()) {
    for (const double rate : rates) {
      context.say(fmt::format("sheets thrown at a {}, h = 1/{:.0f} s", obstacle.name, rate));
      std::vector<std::string> row = {obstacle.name, fmt::format("{:.0f}", rate)};
      int passed_here = 0;
      for (const double speed : throws) {
        const Impact impact = throw_at(context, obstacle, speed, rate);
        row.push_back(fmt::format("{:.3f}", impact.depth));
        deepest = std::max(deepest, impact.depth);
        passed_here += impact.passes(obstacle) ? 1 : 0;
        missed += impact.touches ? 0 : 1;
      }
      row.push_back(std::to_string(passed_here));
      passed += passed_here;
      table.rows.push_back(std::move(row));
    }
  }
  const auto runs = obstacles().size() * rates.size() * throws.size();
  chapter.claims.push_back(claim(
      "No vertex passes through a collider, at 5 to 30 m/s and h = 1/240 to 1/15 s", "", passed == 0 && missed == 0,
      fmt::format("{} of {} runs have a way that leads through a plane, or half as deep into a sphere, a capsule or "
                  "a box as its middle is; {} have no impact",
                  passed, runs, missed)));
  chapter.claims.push_back(claim("After no step is a vertex below the surface", "", deepest < 1,
                                 fmt::format("at most {:.3f} contact distances nearer than one", deepest)));
  show_throws(context, chapter);
  chapter.blocks.emplace_back(std::move(table));
}

void measure_dropped_block(const ExperimentContext& context, Chapter& chapter) {
  context.say("a soft block falls");
  pliant::Scene scene;
  scene.name = "block";
  scene.simulation = pliant::Simulation(contact_settings(contact_methods().front()));
  pliant::Simulation& simulation = scene.simulation;
  pliant::Mesh mesh = pliant::bar({.cells = {6, 6, 6}, .size = {0.2, 0.2, 0.2}});
  const double bottom = mesh.vertices.col(2).minCoeff();
  pliant::Simulation probe;
  const double r = probe.contact_distance(probe.add_body(mesh, pliant::Mass::density(1100)));
  for (Index i = 0; i < mesh.vertex_count(); ++i) mesh.vertices(i, 2) += 0.5 + r - bottom;
  const pliant::BodyId block = simulation.add_body(mesh, pliant::Mass::density(1100));
  simulation.add(block, pliant::TetrahedronStrain{.stiffness = 1e5});
  simulation.add(pliant::Gravity{});
  simulation.add(pliant::PlaneCollider{});
  Plot depth_plot{.title = "A soft block falls onto a plane",
                  .caption =
                      "8.8 kg of 1e5 Pa, 6 x 6 x 6 cells, from 0.5 m: how much nearer to the plane than the "
                      "contact distance its deepest vertex is, after each step.",
                  .x = {.label = "time [s]"},
                  .y = {.label = "depth [contact distances]", .min = 0},
                  .series = {},
                  .guides = {{1, "the surface", false}}};
  Plot speed_plot{.title = "The same block comes to rest",
                  .caption = "Root mean square of the speeds of its vertices.",
                  .x = {.label = "time [s]"},
                  .y = {.label = "speed [m/s]", .is_logarithmic = true},
                  .series = {}};
  pliant_report::Series depths{.name = "deepest vertex"};
  pliant_report::Series speeds{.name = "root mean square"};
  double deepest = 0;
  for (int i = 1; i <= 180; ++i) {
    const pliant::StepReport report = context.step(scene);
    const double depth = report.contact.contacts > 0 ? report.contact.deepest / r : 0;
    deepest = std::max(deepest, depth);
    depths.x.push_back(i / 60.0);
    depths.y.push_back(depth);
    speeds.x.push_back(i / 60.0);
    speeds.y.push_back(std::sqrt(simulation.state().velocities.rowwise().squaredNorm().mean()));
  }
  const double last_speed = speeds.y.back();
  chapter.claims.push_back(claim(
      "A soft block that falls 0.5 m never goes below the surface and comes to rest", "",
      deepest < 1 && last_speed < 1e-6,
      fmt::format("at most {:.2f} contact distances nearer than one; {:.1e} m/s after 3 s", deepest, last_speed)));
  depth_plot.series.push_back(std::move(depths));
  speed_plot.series.push_back(std::move(speeds));
  chapter.blocks.emplace_back(std::move(depth_plot));
  chapter.blocks.emplace_back(std::move(speed_plot));
}

}  // namespace pliant_experiments
