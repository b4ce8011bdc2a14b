#include <algorithm>
#include <array>
#include <memory>

#include "bench/measure.h"
#include "bench/timing.h"
#include "pliant/pliant.h"

namespace pliant_bench {
namespace {

using namespace pliant;

constexpr std::size_t steps_before = 30, steps_in_all = 120;
constexpr int usual_rounds = 3;

enum class Touches { nothing, colliders, surfaces };
constexpr std::array<std::pair<Touches, const char*>, 3> all_runs = {
    {{Touches::nothing, "plain"}, {Touches::colliders, "colliders alone"}, {Touches::surfaces, "surfaces too"}}};

/// In free fall a step converges at once, whatever its iterations. So what touches nothing hangs from two corners.
Simulation simulation_of(const Workload& workload, SolverSettings settings, Touches touches) {
  settings.iterations = workload.iterations;
  if (touches == Touches::nothing) settings.acceleration = Acceleration::none;
  Simulation simulation(settings);
  Mesh mesh = make_mesh(workload);
  const std::vector<Index> corners = pinned_vertices(workload, mesh);
  Positions start = mesh.vertices;
  start.rowwise() += Eigen::RowVector3d(-0.48, -0.49, 0.75);
  const BodyId body = simulation.add_body(std::move(mesh), Mass::area_density(0.2), {.start = std::move(start)});
  simulation.add(Gravity{});
  simulation.add(body, TriangleStrain{.stiffness = 1e3});
  simulation.add(body, HingeBending{.stiffness = 1e-5});
  if (touches == Touches::nothing) {
    simulation.add(body, Position{.on = corners});
    return simulation;
  }
  simulation.add(SphereCollider{.center = {0, 0, 0.4}, .radius = 0.3});
  simulation.add(PlaneCollider{});
  simulation.set_contact({.friction = 0.3, .surfaces = touches == Touches::surfaces});
  return simulation;
}

/// Times of steps, and what they report besides.
struct ContactSamples {
  Samples step, local, global, factor, rest, contact;
  double iterations = 0, backtracks = 0, contacts = 0, pairs = 0;  // sums
  int steps = 0;

  void add(const StepReport& report) {
    const double parts = report.seconds_local + report.seconds_global + report.seconds_factor;
    step.add(report.seconds_total);
    local.add(report.seconds_local);
    global.add(report.seconds_global);
    factor.add(report.seconds_factor);
    rest.add(std::max(0.0, report.seconds_total - parts));
    contact.add(report.contact.seconds);
    iterations += report.iterations;
    backtracks += report.backtracks;
    contacts += report.contact.contacts;
    pairs += report.contact.active;
    ++steps;
  }
  ContactRun run(const char* name) const {
    const auto mean = [this](double sum) { return sum / std::max(1, steps); };
    return {name,
            step.spread(),
            {{"local steps", local.spread()},
             {"global steps", global.spread()},
             {"factor", factor.spread()},
             {"rest", rest.spread()},
             {"contact, in these", contact.spread()}},
            mean(iterations),
            mean(backtracks),
            mean(contacts),
            mean(pairs)};
  }
};

/// Every round takes the same steps to the bit; what else runs on the machine only makes them slower.
void keep_fastest(const StepReport& report, std::size_t step, std::vector<StepReport>& fastest) {
  if (step == fastest.size()) fastest.push_back(report);
  if (report.seconds_total < fastest[step].seconds_total) fastest[step] = report;
}

}  // namespace

ContactResult measure_contact(const Workload& workload, const BenchOptions& options) {
  SolverSettings settings = options.settings;
  settings.threads = options.threads.front();
  ContactResult result{workload, 0, settings.threads, {}, 0};
  std::array<std::vector<StepReport>, all_runs.size()> fastest;
  result.rounds = repeat(options.repeats.value_or(usual_rounds), 0, [&] {
    std::vector<Simulation> simulations;
    simulations.reserve(all_runs.size());
    for (const auto& run : all_runs) simulations.push_back(simulation_of(workload, settings, run.first));
    result.vertices = simulations.front().state().vertex_count();
    for (std::size_t step = 0; step < steps_in_all; ++step) {
      for (std::size_t i = 0; i < simulations.size(); ++i) keep_fastest(simulations[i].step(), step, fastest[i]);
    }
  });
  for (std::size_t i = 0; i < fastest.size(); ++i) {
    ContactSamples samples;
    for (std::size_t step = steps_before; step < steps_in_all; ++step) samples.add(fastest[i][step]);
    result.runs.push_back(samples.run(all_runs[i].second));
  }
  return result;
}

}  // namespace pliant_bench
