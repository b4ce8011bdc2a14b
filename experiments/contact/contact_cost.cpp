#include "contact/contact_cost.h"

#include <algorithm>

#include <fmt/format.h>

#include "contact/sheet_on_plane.h"
#include "support/claims.h"
#include "support/statistics.h"

namespace pliant_experiments {
namespace {

using pliant::Acceleration;
using pliant::Index;
using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Table;

constexpr std::array<Index, 4> cloth_sides = {20, 40, 70, 100};
constexpr int fall = 14;  // steps until the cloth lies on the sphere
constexpr int repeats = 15;

struct Cost {
  double plain = 0, without = 0, with = 0;  // medians of a step [s]
  double ratio = 0, ratio_to_plain = 0;     // medians of the quotients within each round
  Index contacts = 0;
};

pliant::Scene draped_cloth(Acceleration acceleration, Index side, bool has_colliders) {
  pliant::SolverSettings settings = contact_settings(contact_methods().front());
  settings.acceleration = acceleration;
  pliant::Scene scene = sheet_scene(settings, {.side = side, .center = {0.02, 0.01, 0.32}});
  if (has_colliders) {
    scene.simulation.add(pliant::SphereCollider{.radius = 0.3});
    scene.simulation.add(pliant::PlaneCollider{.position = {0, 0, -0.4}});
  }
  return scene;
}

/// The same step in turn, with colliders and without, so that what else the machine does meets all alike.
Cost cost_of(const ExperimentContext& context, Index side) {
  pliant::Scene with = draped_cloth(Acceleration::lbfgs, side, true);
  pliant::Scene without = draped_cloth(Acceleration::lbfgs, side, false);
  pliant::Scene plain = draped_cloth(Acceleration::none, side, false);
  context.step(with, fall);
  context.step(without);
  context.step(plain);
  std::vector<double> seconds_with, seconds_without, seconds_plain, ratios, ratios_to_plain;
  Cost cost;
  for (int i = 0; i < repeats; ++i) {
    const pliant::State begin = with.simulation.state();
    const auto time = [&](pliant::Scene& scene) {
      scene.simulation.set_state(begin.positions, begin.velocities);
      return context.step(scene).seconds_total;
    };
    const pliant::StepReport report = context.step(with);
    cost.contacts = report.contact.contacts;
    seconds_with.push_back(report.seconds_total);
    seconds_without.push_back(time(without));
    seconds_plain.push_back(time(plain));
    ratios.push_back(seconds_with.back() / seconds_without.back());
    ratios_to_plain.push_back(seconds_with.back() / seconds_plain.back());
  }
  cost.with = median(std::move(seconds_with));
  cost.without = median(std::move(seconds_without));
  cost.plain = median(std::move(seconds_plain));
  cost.ratio = median(std::move(ratios));
  cost.ratio_to_plain = median(std::move(ratios_to_plain));
  return cost;
}

}  // namespace

void measure_contact_cost(const ExperimentContext& context, Chapter& chapter) {
  Table table{
      fmt::format("Milliseconds of a step of ten iterations on one thread, medians of {} rounds: a cloth that lies "
                  "on a sphere above a floor, the same step without colliders, and without L-BFGS either.",
                  repeats),
      {"vertices", "touching", "colliders", "none, lbfgs", "ratio", "none, plain", "ratio"},
      {}};
  Plot plot{.title = "What colliders cost",
            .caption = "Time of a step with colliders over that of the same step without, at equal iterations.",
            .x = {.label = "vertices", .is_logarithmic = true},
            .y = {.label = "ratio", .min = 1},
            .series = {},
            .guides = {{1.3, "1.3", false}}};
  pliant_report::Series to_lbfgs{.name = "against lbfgs without", .mark = pliant_report::Mark::line_and_points};
  pliant_report::Series to_plain{.name = "against plain without", .mark = pliant_report::Mark::line_and_points};
  Cost largest;
  for (const Index side : cloth_sides) {
    context.say(fmt::format("cost, {} vertices", side * side));
    const Cost cost = cost_of(context, side);
    table.rows.push_back({std::to_string(side * side), std::to_string(cost.contacts),
                          fmt::format("{:.2f}", 1e3 * cost.with), fmt::format("{:.2f}", 1e3 * cost.without),
                          fmt::format("{:.2f}", cost.ratio), fmt::format("{:.2f}", 1e3 * cost.plain),
                          fmt::format("{:.2f}", cost.ratio_to_plain)});
    for (pliant_report::Series* each : {&to_lbfgs, &to_plain}) each->x.push_back(static_cast<double>(side) * side);
    to_lbfgs.y.push_back(cost.ratio);
    to_plain.y.push_back(cost.ratio_to_plain);
    largest = cost;
  }
  plot.series = {std::move(to_lbfgs), std::move(to_plain)};
  chapter.claims.push_back(
      claim("At 10,000 vertices a step with colliders takes at most 1.3 times as long as one without", "",
            largest.ratio <= 1.3,
            fmt::format("{:.2f} times, L-BFGS in both; {:.2f} times a plain step without", largest.ratio,
                        largest.ratio_to_plain)));
  chapter.blocks.emplace_back(std::move(plot));
  chapter.blocks.emplace_back(std::move(table));
}

}  // namespace pliant_experiments
