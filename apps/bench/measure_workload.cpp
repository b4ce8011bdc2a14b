#include <algorithm>
#include <cstring>

#include "bench/bandwidth.h"
#include "bench/baselines.h"
#include "bench/measure.h"
#include "bench/traffic.h"
#include "pliant/core/stopwatch.h"
#include "system/memory.h"

namespace pliant_bench {
namespace {

using namespace pliant;

constexpr double seconds_a_workload = 3;

/// Times of the phases of Pliant's steps, for one iteration but for the whole step.
struct PhaseSamples {
  Samples projections, gather, forward, backward, solve, iteration, step;

  void add(const StepReport& report) {
    const auto iterations = static_cast<double>(std::max<Index>(1, report.iterations));
    projections.add(report.seconds_projections / iterations);
    gather.add((report.seconds_local - report.seconds_projections) / iterations);
    forward.add(report.solves.forward / iterations);
    backward.add(report.solves.backward / iterations);
    solve.add((report.solves.forward + report.solves.backward) / iterations);
    iteration.add((report.seconds_local + report.seconds_global) / iterations);
    step.add(report.seconds_total);
  }

  std::vector<Phase> phases(const Traffic& traffic) const {
    return {{"projections", projections.spread(), traffic.projections},
            {"gather", gather.spread(), traffic.gather},
            {"forward substitution", forward.spread(), traffic.substitution},
            {"backward substitution", backward.spread(), traffic.backward},
            {"solve", solve.spread(), traffic.substitution + traffic.backward},
            {"iteration", iteration.spread(), traffic.iteration()},
            {"step", step.spread()}};
  }
};

/// A simulation with a number of threads.
struct Runner {
  Simulation simulation;
  Positions after_step;  // where the first step ended
  PhaseSamples samples;
};

SolverSettings with_threads(SolverSettings settings, int threads) {
  settings.threads = threads;
  return settings;
}

/// Builds and takes the first step; the simulation then stands at its start again.
Runner set_up(const Workload& workload, const SolverSettings& settings, SetUpResult& result) {
  const pliant_system::PeakMemory peak;
  Stopwatch watch;
  Mesh mesh = make_mesh(workload);
  result.mesh = watch.lap();
  Runner runner{make_simulation(workload, std::move(mesh), settings), {}, {}};
  result.constraints = watch.lap();
  const State start = runner.simulation.state();
  result.solver = runner.simulation.step().set_up;
  result.peak_bytes = peak.bytes();
  runner.after_step = runner.simulation.state().positions;
  runner.simulation.restore(start);
  return runner;
}

bool has_same_bits(const Positions& a, const Positions& b) {
  return a.rows() == b.rows() &&
         std::memcmp(a.data(), b.data(), static_cast<std::size_t>(a.size()) * sizeof(Real)) == 0;
}

std::vector<ConstraintCount> count_constraints(const Simulation& simulation) {
  std::vector<ConstraintCount> counts;
  for (const auto& [id, group] : simulation.groups()) counts.push_back({group.type, group.set.count});
  return counts;
}

void describe(Simulation& simulation, const Traffic& traffic, const SystemInfo& info, WorkloadResult& result) {
  result.vertices = simulation.state().vertex_count();
  result.constraints = count_constraints(simulation);
  result.backend = simulation.backend();
  result.factor_entries = info.factor_entries;
  result.panels = info.supernodes;
  result.working_set_bytes = traffic.working_set;
}

/// The textbook has no triangles, hinges and hard pins.
BenchOptions baselines_for(const Workload& workload, BenchOptions options) {
  if (workload.kind != Kind::cloth) return options;
  std::erase(options.baselines, BaselineKind::textbook);
  std::erase(options.baselines, BaselineKind::thesis);
  return options;
}

}  // namespace

WorkloadResult measure_workload(const Workload& workload, const BenchOptions& options) {
  WorkloadResult result;
  result.workload = workload;
  std::vector<Runner> runners;
  for (const int threads : options.threads) {
    SetUpResult set_up_result;
    runners.push_back(set_up(workload, with_threads(options.settings, threads), set_up_result));
    if (runners.size() == 1) result.set_up = set_up_result;
  }
  Simulation& first = runners.front().simulation;
  const SystemInfo info = first.system_info();
  const Traffic traffic = traffic_of(first, info);
  describe(first, traffic, info, result);

  std::vector<std::unique_ptr<Baseline>> baselines;
  if (!options.baselines.empty()) {
    baselines = make_baselines(baselines_for(workload, options),
                               {first, runners.front().after_step, system_matrix(first), info.contraction});
  }
  std::optional<ReadProbe> probe;
  if (options.bandwidth == Bandwidth::with) probe.emplace(traffic.working_set);
  Samples probe_samples;
  result.repeats = repeat(options.repeats, seconds_a_workload, [&] {
    for (const auto& baseline : baselines) baseline->samples.add(baseline->seconds());
    for (Runner& runner : runners) runner.samples.add(runner.simulation.step());
    if (probe) probe_samples.add(probe->seconds());
  });

  if (probe) {
    result.read_bytes_per_second = static_cast<double>(probe->bytes()) / probe_samples.spread().min;
  }
  result.phases = runners.front().samples.phases(traffic);
  for (const auto& baseline : baselines) {
    result.baselines.push_back(baseline->result);
    result.baselines.back().seconds = baseline->samples.spread();
  }
  for (const Runner& runner : runners) {
    result.threads.push_back({runner.simulation.settings().threads, runner.simulation.thread_count(),
                              runner.samples.iteration.spread(),
                              has_same_bits(runner.after_step, runners.front().after_step)});
  }
  return result;
}

}  // namespace pliant_bench
