#include "contact/surface_cost.h"

#include <ctime>

#include <fmt/format.h>

#include "contact/sheet_on_plane.h"
#include "support/claims.h"
#include "support/statistics.h"

namespace pliant_experiments {
namespace {

using pliant::Acceleration;
using pliant::Index;
using pliant_report::Chapter;
using pliant_report::Table;

constexpr std::array<Index, 3> sides_of_cloth = {32, 63, 100};
constexpr int steps_to_the_ball = 14;
constexpr int rounds = 9;
constexpr int steps_of_round = 2;

/// Milliseconds of the processor a step, medians.
struct CostOfSurfaces {
  double surfaces = 0, colliders = 0, plain = 0;
  Spread to_colliders{}, to_plain{};  // of the quotients within a round
  Index pairs = 0;                    // nearer than twice the distance, at the end
};

pliant::Scene cloth_above_ball(Index side, Acceleration acceleration, bool has_ball, bool touches) {
  pliant::SolverSettings settings = contact_settings(contact_methods().front());
  settings.acceleration = acceleration;
  pliant::Scene scene = sheet_scene(settings, {.side = side, .center = {0.02, 0.01, 0.32}});
  if (has_ball) {
    scene.simulation.add(pliant::SphereCollider{.radius = 0.3});
    scene.simulation.add(pliant::PlaneCollider{.position = {0, 0, -0.4}});
  }
  if (touches) scene.simulation.set_contact({.friction = 0.3, .surfaces = true});
  return scene;
}

/// The same steps in turn, so that what else the machine does meets all alike.
CostOfSurfaces surface_cost_of(const ExperimentContext& context, Index side) {
  pliant::Scene surfaces = cloth_above_ball(side, Acceleration::automatic, true, true);
  pliant::Scene colliders = cloth_above_ball(side, Acceleration::automatic, true, false);
  pliant::Scene plain = cloth_above_ball(side, Acceleration::none, false, false);
  context.step(surfaces, steps_to_the_ball);
  context.step(colliders);
  context.step(plain);
  std::array<std::vector<double>, 3> times;
  std::array<std::vector<double>, 2> ratios;
  CostOfSurfaces cost;
  const auto milliseconds = [&](pliant::Scene& scene) {
    const std::clock_t begin = std::clock();
    for (int i = 0; i < steps_of_round; ++i) cost.pairs = std::max(cost.pairs, context.step(scene).contact.pairs);
    return 1e3 * static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC / steps_of_round;
  };
  for (int i = 0; i < rounds; ++i) {
    const pliant::State begin = surfaces.simulation.state();
    std::array<double, 3> now = {milliseconds(surfaces), 0, 0};
    colliders.simulation.set_state(begin.positions, begin.velocities);
    now[1] = milliseconds(colliders);
    plain.simulation.set_state(begin.positions, begin.velocities);
    now[2] = milliseconds(plain);
    for (std::size_t k = 0; k < 3; ++k) times[k].push_back(now[k]);
    for (std::size_t k = 0; k < 2; ++k) ratios[k].push_back(now[0] / now[k + 1]);
  }
  cost.surfaces = median(times[0]);
  cost.colliders = median(times[1]);
  cost.plain = median(times[2]);
  cost.to_colliders = spread(ratios[0]);
  cost.to_plain = spread(ratios[1]);
  return cost;
}

}  // namespace

void measure_surface_cost(const ExperimentContext& context, Chapter& chapter) {
  Table table{
      fmt::format("A cloth that falls onto a sphere and may touch itself: milliseconds of the processor a step of ten "
                  "iterations, on one thread, medians of {} rounds of {} steps from the same state; with surfaces and "
                  "colliders, with colliders alone, and plain steps without either.",
                  rounds, steps_of_round),
      {"vertices", "pairs", "surfaces", "colliders", "plain", "over colliders", "over plain"},
      {}};
  Spread at_last;
  for (const Index side : sides_of_cloth) {
    context.say(fmt::format("cost of surfaces, {} vertices", side * side));
    const CostOfSurfaces cost = surface_cost_of(context, side);
    table.rows.push_back({std::to_string(side * side), std::to_string(cost.pairs), fmt::format("{:.2f}", cost.surfaces),
                          fmt::format("{:.2f}", cost.colliders), fmt::format("{:.2f}", cost.plain),
                          fmt::format("{:.2f}", cost.to_colliders.middle),
                          fmt::format("{:.2f}", cost.to_plain.middle)});
    at_last = cost.to_plain;
  }
  chapter.claims.push_back(
      at_most("At 10,000 vertices a step with contact between surfaces takes at most 3 times as long as a plain one",
              at_last, 3, fmt::format("{:.2f} times, of a cloth that falls onto a sphere", at_last.middle)));
  chapter.blocks.emplace_back(std::move(table));
}

}  // namespace pliant_experiments
