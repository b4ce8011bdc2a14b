#include "motion_advice.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <fmt/format.h>

#include "pliant/core/printable.h"
#include "pliant/core/stopwatch.h"
#include "pliant/simulation/held.h"
#include "pliant/solver/integration/integrator.h"
#include "pliant_io/recorder/measurements.h"
#include "step_looks.h"

namespace pliant_cli {
namespace {

using pliant::Real;
using pliant::Scene;
using pliant::Simulation;
using pliant::SolverSettings;

constexpr Real watched_time = 0.5;          // [s]
constexpr std::int64_t most_work = 800000;  // steps times vertices
constexpr std::int64_t most_work_to_events = 200000;

/// Whether another acceleration would not do better. Against colliders those but L-BFGS do next to nothing.
bool is_accelerated(const Simulation& simulation) {
  const pliant::Acceleration chosen = simulation.settings().acceleration;
  const bool has_colliders = !simulation.colliders().empty();
  if (chosen == pliant::Acceleration::automatic) return simulation.contact().surfaces || has_colliders;
  return chosen == pliant::Acceleration::lbfgs || (chosen != pliant::Acceleration::none && !has_colliders);
}

/// Shares of its height that a swing of a second keeps in that time.
struct Kept {
  Real by_integrator = 1;
  Real by_damping = 1;
};

Kept kept_in_second(const SolverSettings& settings) {
  const Real h = settings.time_step / static_cast<Real>(settings.substeps);
  const Real in_step = amplification(settings.integrator, 2 * std::numbers::pi * h);
  return {std::pow(in_step, 1 / h), std::exp(-settings.damping)};
}

std::string lively_text(const SolverSettings& settings) {
  const Kept kept = kept_in_second(settings);
  const bool is_euler = settings.integrator == pliant::Integrator::implicit_euler;
  std::string text = fmt::format("a swing that takes a second comes back to {:.0f} % of its height: {} takes {:.0f} %",
                                 100 * kept.by_integrator * kept.by_damping, is_euler ? "implicit Euler" : "BDF2",
                                 100 * (1 - kept.by_integrator));
  if (settings.damping > 0) text += fmt::format(", `damping` {:.0f} %", 100 * (1 - kept.by_damping));
  if (settings.energy_projection > 0) {
    text +=
        fmt::format("; `energy_projection` gives back {:.0f} % of what steps take", 100 * settings.energy_projection);
  } else if (is_euler) {
    text += "; livelier: `integrator` `bdf2`";
  } else if (settings.damping > 1) {
    text += "; livelier: less `damping`";
  }
  return text;
}

std::string stretchy_text(const Simulation& simulation, Real stretch) {
  constexpr Real visible = 0.03;
  std::string text = fmt::format("what is stretched most is {:.2g} % past its limits", 100 * stretch);
  if (!(stretch > visible)) return text;
  const bool has_pins = std::ranges::any_of(held_vertices(simulation), [](char held) { return held != 0; });
  text += has_pins ? "; less: more stiffness, or pins that share the load" : "; less: more stiffness";
  return text;
}

std::string fast_text(Real seconds, const SolverSettings& settings) {
  return fmt::format("a step takes {:.3g} ms here, {:.2g} times as fast as what it shows", 1e3 * seconds,
                     settings.time_step / seconds);
}

}  // namespace

std::string iterations_text(const SolverSettings& settings) {
  if (settings.iterations == pliant::automatic_iterations) {
    return fmt::format("automatic iterations, at most {}", settings.most_iterations);
  }
  return settings.iterations == 1 ? "1 iteration" : fmt::format("{} iterations", settings.iterations);
}

std::string steps_text(const SolverSettings& settings) {
  const std::string iterations = iterations_text(settings) + (settings.iterations > 0 ? " each" : "");
  const std::string substeps =
      settings.substeps > 1 ? fmt::format("{} substeps of ", settings.substeps) : std::string();
  const std::string integrator = settings.integrator == pliant::Integrator::bdf2 ? ", BDF2" : "";
  return substeps + iterations + integrator;
}

std::string exact_text(const Simulation& simulation, const pliant::StepError& error) {
  const bool is_pushed_harder = error.acceleration > error.share * pliant::standard_gravity * (1 + 1e-9);
  return fmt::format("{} {} '{}' {:.2g} mm from where a step ends, {:.0f} % of how far {} in a step",
                     iterations_text(simulation.settings()), simulation.settings().iterations == 1 ? "leaves" : "leave",
                     pliant::printable(simulation.body(error.body).name), 1e3 * error.distance, 100 * error.share,
                     is_pushed_harder ? "all forces take it" : "gravity takes it");
}

std::string far_from_converged_text(const Simulation& simulation, const pliant::StepError& error,
                                    const std::string& when) {
  if (!(error.share > pliant::far_from_converged)) return "";
  const SolverSettings& settings = simulation.settings();
  const std::string body = pliant::printable(simulation.body(error.body).name);
  std::string text = fmt::format("far from converged{}: {}, so that it moves too little and its folds stand", when,
                                 exact_text(simulation, error));
  if (!is_accelerated(simulation)) return text + "; give --set settings.acceleration=lbfgs";
  if (settings.iterations == pliant::automatic_iterations) {
    return text + fmt::format("; give '{}' less stiffness, or more `most_iterations`", body);
  }
  return text +
         fmt::format("; give '{}' less stiffness, or more iterations: --iterations {}", body, 2 * settings.iterations);
}

namespace {

/// Takes a step, and looks at the next one where something has changed before.
void step_and_look(Scene& scene, StepLooks& looks) {
  scene.step();
  if (looks.is_due_after_change(scene.simulation.state())) looks.look(scene.simulation);
}

/// How exact the next step is; where that is far from converged, the better one of it and one a few steps later.
std::optional<StepLook> find_exactness(Scene& scene, StepLooks& after_events) {
  StepLooks looks(scene.simulation.state(), scene.steps);
  looks.look(scene.simulation);
  try {
    if (looks.is_undecided()) {
      for (std::int64_t i = 0; i < second_look; ++i) step_and_look(scene, after_events);
      looks.look(scene.simulation);
    }
  } catch (const pliant::Error&) {  // which a run tells
  }
  looks.end();
  return looks.worst();
}

/// Goes on from event to event, to that step at most, and looks at the steps after them.
void go_on_to_events(Scene& scene, StepLooks& looks, std::int64_t last_step) {
  const Simulation& simulation = scene.simulation;
  const auto has_event = [&] {
    const std::optional<std::int64_t> next = scene.timeline.next_due(simulation);
    return next && *next + pliant::look_after_change + second_look < last_step;
  };
  try {
    while (simulation.state().step < last_step && (looks.is_waiting(simulation.state()) || has_event())) {
      step_and_look(scene, looks);
    }
  } catch (const pliant::Error&) {  // which a run tells
  }
  looks.end();
}

nlohmann::ordered_json error_json(const Simulation& simulation, const pliant::StepError& error) {
  return {{"body", simulation.body(error.body).name}, {"distance", error.distance}, {"share", error.share}};
}

}  // namespace

nlohmann::ordered_json describe_motion(Scene& scene) {
  Simulation& simulation = scene.simulation;
  const SolverSettings& settings = simulation.settings();
  const auto steps =
      std::min(scene.steps, static_cast<std::int64_t>(std::ceil(std::min(watched_time / settings.time_step, 1e9))));
  const std::int64_t work = settings.substeps * simulation.state().vertex_count();  // of a step
  if (steps == 0 || steps * work > most_work) return nullptr;
  std::vector<Real> seconds;
  Real stretch = 0;
  StepLooks after_events(simulation.state(), scene.steps);
  std::optional<StepLook> exactness;
  try {
    for (std::int64_t i = 0; i < steps; ++i) {
      const pliant::Stopwatch watch;
      scene.step();
      seconds.push_back(watch.seconds());
      if (after_events.is_due_after_change(simulation.state())) after_events.look(simulation);
      if (i % 5 == 4) stretch = std::max(stretch, pliant::stretch_past_limits(simulation));
    }
    exactness = find_exactness(scene, after_events);
  } catch (const pliant::Error&) {
    return nullptr;
  }
  std::ranges::nth_element(seconds, seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2));
  const Real median = seconds[seconds.size() / 2];
  const Kept kept = kept_in_second(settings);
  nlohmann::ordered_json json = {{"steps", steps},
                                 {"kept_in_a_second", kept.by_integrator * kept.by_damping},
                                 {"past_limits", stretch},
                                 {"seconds_per_step", median}};
  std::vector<std::string> lines = {"how lively: " + lively_text(settings),
                                    "how stretchy: " + stretchy_text(simulation, stretch),
                                    "how fast: " + fast_text(median, settings)};
  if (exactness) {
    json["step_error"] = error_json(simulation, exactness->error);
    lines.push_back("how exact: " + exactness->text);
    json["warning"] = exactness->warning;
  }
  go_on_to_events(scene, after_events, std::min(scene.steps, most_work_to_events / work));
  if (const std::optional<StepLook>& worst = after_events.worst()) {
    json["after_event"] = error_json(simulation, worst->error);
    json["after_event"]["step"] = worst->step;
    lines.push_back(fmt::format("how exact after events, in step {}: {}", worst->step, worst->text));
    const bool is_worse = !exactness || worst->error.share > exactness->error.share;
    if (is_worse) json["warning"] = worst->warning;
  }
  json["text"] = lines;
  return json;
}

}  // namespace pliant_cli
