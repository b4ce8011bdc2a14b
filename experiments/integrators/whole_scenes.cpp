#include "integrators/whole_scenes.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "integrators/energy_ledger.h"
#include "integrators/oscillator.h"
#include "pliant/core/error.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "support/claims.h"
#include "support/statistics.h"
#include "support/trace.h"

namespace pliant_experiments {
namespace {

using pliant::Index;
using pliant::Integrator;
using pliant::Vec3;
using pliant_report::Chapter;
using pliant_report::Plot;
using pliant_report::Table;

struct Variant {
  Method method;
  Index iterations = 20;  // of a substep
  Index cost() const { return iterations * method.substeps; }
  std::string name() const { return fmt::format("{}, {} iterations", method.name, iterations); }
};

struct Loss {
  Variant variant;
  Trace trace;
  Spread milliseconds{};  // a frame

  /// Energy above that of the equilibrium [J].
  double energy(std::size_t frame) const { return trace.total[frame] - trace.total[0]; }
  /// Share of the energy at release that is left.
  double left(std::size_t frame) const { return energy(frame) / energy(30); }
};

Sets settings_of(const Method& method) {
  const auto integrator = choice_names(method.integrator)[static_cast<std::size_t>(method.integrator)];
  return {fmt::format("settings.integrator={}", integrator), fmt::format("settings.substeps={}", method.substeps),
          fmt::format("settings.energy_projection={}", method.energy_projection), "settings.acceleration=none"};
}

Loss swing(const ExperimentContext& context, const pliant::State& begin, const Variant& variant) {
  context.say(variant.name());
  Sets sets = settings_of(variant.method);
  sets.push_back(fmt::format("settings.iterations={}", variant.iterations));
  pliant::Scene scene = context.scene("damping/curtain", sets);
  scene.simulation.restore(begin);
  context.disturb(scene);
  Loss loss{variant, {}, {}};
  loss.trace.add(measure(scene.simulation, {}));
  std::vector<double> seconds;
  for (int frame = 0; frame < 900; ++frame) {
    const pliant::StepReport report = context.step(scene);
    seconds.push_back(report.seconds_total);
    loss.trace.add(measure(scene.simulation, report));
  }
  for (double& each : seconds) each *= 1e3;
  loss.milliseconds = spread(std::move(seconds));
  return loss;
}

std::vector<Variant> variants() {
  const std::vector<Method>& all = methods();
  const Method two_bdf2{"BDF2, 2 substeps", Integrator::bdf2, 2, 4};
  const std::vector<Method>& projected = projected_methods();
  return {{all[0], 20}, {all[3], 20}, {all[1], 10},       {all[2], 5},       {two_bdf2, 10},  // at equal cost
          {all[1], 20}, {all[2], 20}, {projected[0], 20}, {projected[1], 20}};  // at equal iterations a substep
}

void judge_curtain(Chapter& chapter, const std::vector<Loss>& losses) {
  const Loss& euler = losses[0];
  const Loss& bdf2 = losses[1];
  chapter.claims.push_back(claim(
      "BDF2 and substeps lose less on the curtain than implicit Euler with the same iterations a step", "",
      bdf2.left(330) > euler.left(330) && losses[5].left(330) > euler.left(330) &&
          losses[6].left(330) > euler.left(330),
      fmt::format("of the energy at release is left 300 frames later: implicit Euler {:.0f} %, BDF2 {:.0f} %, two "
                  "substeps {:.0f} %, four {:.0f} %, each with 20 iterations",
                  100 * euler.left(330), 100 * bdf2.left(330), 100 * losses[5].left(330), 100 * losses[6].left(330))));
  chapter.claims.push_back(
      claim("With energy projection the curtain keeps what the force has put into it", "",
            std::min(losses[7].left(900), losses[8].left(900)) > 0.9 &&
                std::max(losses[7].left(900), losses[8].left(900)) < 1.1,
            fmt::format("of the energy at release is left 870 frames later: implicit Euler {:.1f} %, BDF2 {:.1f} %; a "
                        "frame takes {}",
                        100 * losses[7].left(900), 100 * losses[8].left(900),
                        times_text(losses[7].milliseconds, losses[0].milliseconds, "ms"))));
  const auto best = std::max_element(losses.begin(), losses.begin() + 5,
                                     [](const Loss& a, const Loss& b) { return a.left(330) < b.left(330); });
  chapter.claims.push_back(
      reported("At equal cost, 20 iterations a frame", "",
               fmt::format("left 300 frames after release: implicit Euler {:.0f} %, in 2 substeps of 10 {:.0f} %, in 4 "
                           "of 5 {:.0f} %, BDF2 {:.0f} %, BDF2 in 2 substeps of 10 {:.0f} %; most: {}",
                           100 * euler.left(330), 100 * losses[2].left(330), 100 * losses[3].left(330),
                           100 * bdf2.left(330), 100 * losses[4].left(330), best->variant.name())));
}

/// What a scene was like with a method.
struct Outcome {
  bool has_ended = true;  // as it should, and not by diverging
  double most = 0;        // of the kinetic energy [J]
  double mean = 0;        // the same
  std::string text() const { return has_ended ? fmt::format("{:.3g}", most) : "diverged"; }
};

Outcome run_scene(const ExperimentContext& context, std::string_view name, const Method& method, std::int64_t steps) {
  context.say(fmt::format("{} with {}", name, method.name));
  pliant::Scene scene = context.builtin_scene_without_contact(name, Winds::kept, settings_of(method));
  context.disturb(scene);
  Outcome outcome;
  try {
    for (std::int64_t step = 0; step < steps; ++step) {
      context.step(scene);
      const double energy = kinetic_energy(scene.simulation.state());
      outcome.most = std::max(outcome.most, energy);
      outcome.mean += energy / static_cast<double>(steps);
    }
  } catch (const pliant::Error& error) {
    if (error.kind() != pliant::ErrorKind::diverged) throw;
    outcome.has_ended = false;
  }
  return outcome;
}

/// Of scenes without winds; gain and surplus are shares of the largest kinetic energy.
struct Gains {
  double gain = 0;
  double surplus = 0;
  double mean = 0;  // kinetic energy [J]
  std::string scene, gaining, owing;

  /// The worse of both.
  void take(const Gains& other) {
    if (other.gain >= gain) gaining = other.scene;
    if (other.surplus >= surplus) owing = other.scene;
    gain = std::max(gain, other.gain);
    surplus = std::max(surplus, other.surplus);
  }
};

/// The scene without its winds, to its end.
Gains balance_scene(const ExperimentContext& context, std::string_view name, const Method& method) {
  context.say(fmt::format("energies of {} with {}", name, method.name));
  pliant::Scene scene = context.builtin_scene_without_contact(name, Winds::left_out, settings_of(method));
  context.disturb(scene);
  EnergyLedger ledger(scene.simulation);
  for (std::int64_t step = 0; step < scene.steps; ++step) {
    ledger.before_step();
    context.step(scene);
    ledger.after_step();
  }
  const double scale = ledger.largest_kinetic();
  return {.gain = ledger.gain() / scale,
          .surplus = ledger.surplus() / scale,
          .mean = ledger.mean_kinetic(),
          .scene = std::string(name),
          .gaining = {},
          .owing = {}};
}

/// Linear and angular momentum.
std::pair<Vec3, Vec3> momenta(const pliant::State& state) {
  Vec3 linear = Vec3::Zero();
  Vec3 angular = Vec3::Zero();
  for (Index i = 0; i < state.vertex_count(); ++i) {
    const Vec3 p = state.masses[static_cast<std::size_t>(i)] * pliant::row(state.velocities, i);
    linear += p;
    angular += pliant::row(state.positions, i).cross(p);
  }
  return {linear, angular};
}

pliant::Scene flying_torus(const ExperimentContext& context, double damping) {
  pliant::Scene scene =
      context.scene("torus/torus", {"gravity=[0,0,-9.81]", "settings.precision=double", "settings.iterations=200",
                                    fmt::format("settings.damping={}", damping)});
  scene.simulation.remove(scene.simulation.find_group("hands").value());
  const pliant::Positions& x = scene.simulation.state().positions;
  pliant::Positions v(x.rows(), 3);
  for (Index i = 0; i < static_cast<Index>(x.rows()); ++i) {
    const Vec3 shake = 0.3 * Vec3(std::sin(9.0 * i), std::cos(7.0 * i), std::sin(5.0 * i + 1));
    v.row(i) = (Vec3(1, 2, 3) + Vec3(1, -2, 3).cross(pliant::row(x, i)) + shake).transpose();
  }
  scene.simulation.set_state(pliant::Positions(x), v);
  return scene;
}

Vec3 center(const pliant::State& state) {
  Vec3 sum = Vec3::Zero();
  double mass = 0;
  for (Index i = 0; i < state.vertex_count(); ++i) {
    sum += state.masses[static_cast<std::size_t>(i)] * pliant::row(state.positions, i);
    mass += state.masses[static_cast<std::size_t>(i)];
  }
  return sum / mass;
}

}  // namespace

void measure_curtain(const ExperimentContext& context, Chapter& chapter) {
  pliant::Scene resting = context.scene("damping/curtain");
  resting.simulation.remove(resting.simulation.find_force("pull").value());
  context.say("equilibrium");
  settle(context, resting, 1e-8);
  std::vector<Loss> losses;
  for (const Variant& variant : variants()) losses.push_back(swing(context, resting.simulation.state(), variant));
  judge_curtain(chapter, losses);
  Plot plot{
      .title = "Energy of the curtain at equal cost",
      .caption =
          "Energy above that of the equilibrium, with 20 iterations a frame in all; the force ends at frame 30. Energy "
          "projection comes on top of these.",
      .x = {.label = "frame"},
      .y = {.label = "energy [J]", .min = 0},
      .series = {},
      .guides = {{30, "force ends", true}}};
  Table table{
      "The curtain of the damping experiment, 1e4 N/m. Above at equal cost, 20 iterations a frame, below with 20 "
      "iterations a substep. Time is the median of a frame.",
      {"integrator", "iterations a frame", "Σ‖v‖, frames 30 to 330 [m/s]", "600 to 900 [m/s]",
       "energy left at frame 330 [%]", "at 900 [%]", "ms a frame"},
      {}};
  for (std::size_t i = 0; i < losses.size(); ++i) {
    const Loss& loss = losses[i];
    table.rows.push_back({loss.variant.name(), std::to_string(loss.variant.cost()),
                          fmt::format("{:.0f}", mean(loss.trace.speed_sum, 30, 330)),
                          fmt::format("{:.0f}", mean(loss.trace.speed_sum, 600, 900)),
                          fmt::format("{:.0f}", 100 * loss.left(330)), fmt::format("{:.1f}", 100 * loss.left(900)),
                          fmt::format("{:.2f}", loss.milliseconds.middle)});
    if (i >= 5 && i != 7) continue;
    pliant_report::Series series{
        .name = loss.variant.name(), .x = loss.trace.frames, .y = loss.trace.total, .color = loss.variant.method.color};
    for (double& energy : series.y) energy -= loss.trace.total[0];
    plot.series.push_back(std::move(series));
  }
  chapter.blocks.emplace_back(std::move(plot));
  chapter.blocks.emplace_back(std::move(table));
}

void measure_liveliness(const ExperimentContext& context, Chapter& chapter) {
  const Method fine{"BDF2, 25 substeps", Integrator::bdf2, 25};
  constexpr std::int64_t steps = 240;
  Table table{
      "Mean kinetic energy in the first 240 frames of three built-in scenes: in fine steps [J], and the share of that.",
      {"scene", fine.name},
      {}};
  std::vector<Method> compared = {methods()[0], methods()[3]};
  compared.insert(compared.end(), projected_methods().begin(), projected_methods().end());
  for (const Method& method : compared) table.columns.push_back(method.name);
  std::vector<double> farthest(compared.size(), 0);
  for (const char* name : {"curtain", "chain", "bar"}) {
    const double reference = run_scene(context, name, fine, steps).mean;
    table.rows.push_back({name, fmt::format("{:.3g}", reference)});
    for (std::size_t i = 0; i < compared.size(); ++i) {
      const double share = run_scene(context, name, compared[i], steps).mean / reference;
      farthest[i] = std::max(farthest[i], std::abs(share - 1));
      table.rows.back().push_back(fmt::format("{:.0f} %", 100 * share));
    }
  }
  chapter.claims.push_back(claim(
      "With energy projection bodies are as lively as in fine steps", "",
      std::max(farthest[2], farthest[3]) < 0.15 && farthest[0] > 0.3,
      fmt::format("the mean kinetic energy of three scenes is off by at most {:.0f} % with implicit Euler, {:.0f} % "
                  "with BDF2; without projection by {:.0f} and {:.0f} %",
                  100 * farthest[2], 100 * farthest[3], 100 * farthest[0], 100 * farthest[1])));
  chapter.blocks.emplace_back(std::move(table));
}

void measure_builtin_scenes(const ExperimentContext& context, Chapter& chapter) {
  constexpr double most_times = 10;  // kinetic energies past what less damping explains
  std::vector<Method> tried = {methods()[0], methods()[3]};
  tried.insert(tried.end(), projected_methods().begin(), projected_methods().end());
  Table table{"Largest kinetic energy [J] of all built-in scenes, those with contact without it, run to their ends.",
              {"scene", "steps"},
              {}};
  for (const Method& method : tried) table.columns.push_back(method.name);
  int stable = 0;
  int projected = 0;
  int count = 0;
  for (const pliant::BuiltinScene& builtin : pliant::builtin_scenes()) {
    const std::string_view name = builtin.name;
    const std::int64_t steps = context.builtin_scene(name).steps;
    table.rows.push_back({std::string(name), std::to_string(steps)});
    std::vector<Outcome> outcomes;
    for (const Method& method : tried) {
      outcomes.push_back(run_scene(context, name, method, steps));
      table.rows.back().push_back(outcomes.back().text());
    }
    stable += outcomes[1].has_ended && outcomes[1].most <= most_times * outcomes[0].most ? 1 : 0;
    projected += outcomes[2].has_ended && outcomes[3].has_ended ? 1 : 0;
    ++count;
  }
  chapter.claims.push_back(claim(
      "BDF2 is stable on every built-in scene; those with contact run without it", "", stable == count,
      fmt::format("{} of {} scenes run to their ends with at most {:.0f} times the kinetic energy of implicit Euler",
                  stable, count, most_times)));
  chapter.claims.push_back(claim(
      "With energy projection no built-in scene diverges, in either integrator; those with contact run without it", "",
      projected == count, fmt::format("{} of {} scenes run to their ends", projected, count)));
  chapter.blocks.emplace_back(std::move(table));
}

void measure_energy_gains(const ExperimentContext& context, Chapter& chapter) {
  Table table{
      "All built-in scenes, without their winds, those with contact without it. Gain: by what T + V + P − ΣF·Δx "
      "exceeds its value "
      "at the start, or "
      "since pins last moved, beyond the noted surplus, which later steps are not given back; both in percent of the "
      "largest "
      "kinetic energy. Mean kinetic energy [J], to the end of each scene.",
      {"scene"},
      {}};
  for (const Method& method : projected_methods()) {
    for (const char* what : {"mean", "gain [%]", "surplus [%]"}) {
      table.columns.push_back(fmt::format("{}: {}", method.name, what));
    }
  }
  Gains worst;
  for (const pliant::BuiltinScene& builtin : pliant::builtin_scenes()) {
    const std::string_view name = builtin.name;
    table.rows.push_back({std::string(name)});
    for (const Method& method : projected_methods()) {
      const Gains found = balance_scene(context, name, method);
      for (const std::string& cell : {fmt::format("{:.3g}", found.mean), fmt::format("{:.2f}", 100 * found.gain),
                                      fmt::format("{:.1f}", 100 * found.surplus)}) {
        table.rows.back().push_back(cell);
      }
      worst.take(found);
    }
  }
  chapter.claims.push_back(claim(
      "Energy projection gives no built-in scene more energy than it had and forces have done work on it; those with "
      "contact run without it, whose work the projection does not know",
      "", worst.gain < 0.01,
      fmt::format(
          "at most {:.2f} % of the largest kinetic energy too much that is not noted, in {}, in either integrator",
          100 * worst.gain, worst.gaining)));
  chapter.claims.push_back(claim(
      "What it lets bodies have for a while and takes back later stays below a fifth of the largest kinetic energy", "",
      worst.surplus < 0.2, fmt::format("at most {:.0f} %, in {}", 100 * worst.surplus, worst.owing)));
  chapter.blocks.emplace_back(std::move(table));
}

DampedFlight measure_damped_flight(const ExperimentContext& context) {
  pliant::Scene damped = flying_torus(context, 5);
  pliant::Scene step_without = flying_torus(context, 0);
  pliant::Scene free = flying_torus(context, 0);
  const Vec3 begin = center(free.simulation.state());
  DampedFlight flight;
  for (int i = 0; i < 60; ++i) {
    step_without.simulation.restore(damped.simulation.state());
    for (pliant::Scene* scene : {&damped, &step_without, &free}) context.step(*scene);
    const auto with = momenta(damped.simulation.state());
    const auto without = momenta(step_without.simulation.state());
    flight.momentum = std::max(flight.momentum, (with.first - without.first).norm() / without.first.norm());
    flight.angular_momentum =
        std::max(flight.angular_momentum, (with.second - without.second).norm() / without.second.norm());
  }
  const Vec3 way = center(free.simulation.state()) - begin;
  flight.fall = (center(damped.simulation.state()) - center(free.simulation.state())).norm() / way.norm();
  return flight;
}

}  // namespace pliant_experiments
