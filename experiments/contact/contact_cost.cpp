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
constexpr int steps_before = 14;  // until a cloth above the sphere lies on it
constexpr int repeats = 15;

enum class Situation { draped, lying, far_away };

/// Of a step in some rounds: medians, and means of what was counted.
struct Cost {
  double with = 0, without = 0, plain = 0;  // [s]
  Spread ratio{}, ratio_to_plain{};         // of the quotients within a round
  Index contacts = 0;                       // at the end
  double backtracks = 0, refactorizations = 0;
  bool has_equal_iterations = true;
};

std::string name_of(Situation situation) {
  if (situation == Situation::draped) return "falls onto a sphere";
  return situation == Situation::lying ? "lies on a plane" : "flies far away";
}

pliant::Scene cloth_of_cost(Acceleration acceleration, Index side, Situation situation) {
  pliant::SolverSettings settings = contact_settings(contact_methods().front());
  settings.acceleration = acceleration;
  const bool is_lying = situation == Situation::lying;
  return sheet_scene(settings, {.side = side,
                                .center = is_lying ? pliant::Vec3(0, 0, 0) : pliant::Vec3(0.02, 0.01, 0.32),
                                .contact_distances = is_lying ? 1.0005 : 0});
}

void add_colliders(pliant::Simulation& simulation, Situation situation) {
  if (situation == Situation::lying) {
    simulation.add(pliant::PlaneCollider{});
    return;
  }
  const double depth = situation == Situation::draped ? 0 : 1000;
  simulation.add(pliant::SphereCollider{.center = {0, 0, -depth}, .radius = 0.3});
  simulation.add(pliant::PlaneCollider{.position = {0, 0, -depth - 0.4}});
}

/// The same step in turn, with colliders and without, so that what else the machine does meets all alike.
Cost cost_of(const ExperimentContext& context, Index side, Situation situation) {
  pliant::Scene with = cloth_of_cost(Acceleration::lbfgs, side, situation);
  pliant::Scene without = cloth_of_cost(Acceleration::lbfgs, side, situation);
  pliant::Scene plain = cloth_of_cost(Acceleration::none, side, situation);
  add_colliders(with.simulation, situation);
  context.step(with, steps_before);
  context.step(without);
  context.step(plain);
  std::array<std::vector<double>, 3> seconds;
  std::array<std::vector<double>, 2> ratios;
  Cost cost;
  for (int i = 0; i < repeats; ++i) {
    const pliant::State begin = with.simulation.state();
    const pliant::StepReport report = context.step(with);
    const auto repeat = [&](pliant::Scene& scene) {
      scene.simulation.set_state(begin.positions, begin.velocities);
      const pliant::StepReport again = context.step(scene);
      cost.has_equal_iterations &= again.iterations == report.iterations;
      return again.seconds_total;
    };
    const std::array<double, 3> now = {report.seconds_total, repeat(without), repeat(plain)};
    for (std::size_t k = 0; k < 3; ++k) seconds[k].push_back(now[k]);
    for (std::size_t k = 0; k < 2; ++k) ratios[k].push_back(now[0] / now[k + 1]);
    cost.contacts = report.contact.contacts;
    cost.backtracks += static_cast<double>(report.backtracks) / repeats;
    cost.refactorizations += static_cast<double>(report.contact.refactorizations) / repeats;
  }
  cost.with = median(seconds[0]);
  cost.without = median(seconds[1]);
  cost.plain = median(seconds[2]);
  cost.ratio = spread(ratios[0]);
  cost.ratio_to_plain = spread(ratios[1]);
  return cost;
}

void add_point(pliant_report::Series& series, const Spread& ratio) {
  series.y.push_back(ratio.middle);
  series.low.push_back(ratio.low);
  series.high.push_back(ratio.high);
}

std::vector<std::string> cost_row(Situation situation, Index side, const Cost& cost) {
  return {name_of(situation),
          std::to_string(side * side),
          std::to_string(cost.contacts),
          fmt::format("{:.1f}", cost.backtracks),
          fmt::format("{:.1f}", cost.refactorizations),
          fmt::format("{:.2f}", 1e3 * cost.with),
          fmt::format("{:.2f}", 1e3 * cost.without),
          fmt::format("{:.2f}", cost.ratio.middle),
          fmt::format("{:.2f}", 1e3 * cost.plain),
          fmt::format("{:.2f}", cost.ratio_to_plain.middle)};
}

}  // namespace

void measure_contact_cost(const ExperimentContext& context, Chapter& chapter) {
  Table table{
      fmt::format("Milliseconds of a step of ten iterations on one thread, medians of {} rounds of the same step "
                  "with colliders, without, and without L-BFGS either. Backtracks and refactorizations a step "
                  "are means.",
                  repeats),
      {"cloth", "vertices", "touching", "backtracks", "refactorizations", "colliders", "none, lbfgs", "ratio",
       "none, plain", "ratio"},
      {}};
  Plot plot{.title = "What colliders cost",
            .caption =
                "Time of a step of a cloth that falls onto a sphere over that of the same step without colliders, "
                "at equal iterations: medians of repeats, and bands from their first to their third quartile.",
            .x = {.label = "vertices", .is_logarithmic = true},
            .y = {.label = "ratio", .min = 0},
            .series = {},
            .guides = {{1.3, "1.3", false}}};
  pliant_report::Series to_lbfgs{.name = "against lbfgs without", .mark = pliant_report::Mark::line_and_points};
  pliant_report::Series to_plain{.name = "against plain without", .mark = pliant_report::Mark::line_and_points};
  bool has_equal_iterations = true;
  const auto measure = [&](Situation situation, Index side) {
    context.say(fmt::format("cost, {} vertices", side * side));
    const Cost cost = cost_of(context, side, situation);
    table.rows.push_back(cost_row(situation, side, cost));
    has_equal_iterations &= cost.has_equal_iterations;
    return cost;
  };
  const auto judge = [&](Situation situation, const Cost& cost) {
    chapter.claims.push_back(at_most(
        fmt::format("At 10,000 vertices a step with colliders takes at most 1.3 times as long as one without: a "
                    "cloth that {}",
                    name_of(situation)),
        cost.ratio, 1.3,
        fmt::format("{:.2f} times, L-BFGS in both, with {:.1f} backtracks and {:.1f} refactorizations a step{}",
                    cost.ratio.middle, cost.backtracks, cost.refactorizations,
                    has_equal_iterations ? "" : "; some steps with fewer iterations than the others")));
    if (!has_equal_iterations) chapter.claims.back().verdict = pliant_report::Verdict::fails;
  };
  for (const Index side : cloth_sides) {
    const Cost cost = measure(Situation::draped, side);
    for (pliant_report::Series* each : {&to_lbfgs, &to_plain}) each->x.push_back(static_cast<double>(side) * side);
    add_point(to_lbfgs, cost.ratio);
    add_point(to_plain, cost.ratio_to_plain);
    if (side == cloth_sides.back()) judge(Situation::draped, cost);
  }
  for (const Situation situation : {Situation::lying, Situation::far_away}) {
    judge(situation, measure(situation, cloth_sides.back()));
  }
  plot.series = {std::move(to_lbfgs), std::move(to_plain)};
  chapter.blocks.emplace_back(std::move(plot));
  chapter.blocks.emplace_back(std::move(table));
}

}  // namespace pliant_experiments
