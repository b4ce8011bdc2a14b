#include "bench/bench.h"

#include <algorithm>
#include <ctime>
#include <thread>

#include <fmt/chrono.h>
#include <fmt/format.h>

#include "bench/against.h"
#include "bench/bandwidth.h"
#include "bench/measure.h"
#include "bench/solves.h"
#include "bench/time_to_error.h"
#include "pliant/core/version.h"
#include "pliant/solver/global/factorization/triangular_solve.h"
#include "system/machine.h"

namespace pliant_bench {
Machine this_machine() {
  return {pliant_system::processor_name(),
          std::max(1U, std::thread::hardware_concurrency()),
          std::string(pliant::compiler),
          eigen_version(),
          cholmod_version(),
          pliant::fastest_triangular_solve<float>().instruction_set,
          fmt::format("{:%Y-%m-%d %H:%M}", fmt::gmtime(std::time(nullptr)))};  // UTC
}

bool BenchOptions::has(BaselineKind kind) const {
  return std::ranges::find(baselines, kind) != baselines.end();
}

BenchResult run_bench(const BenchOptions& options, const Progress& progress) {
  BenchResult result;
  result.machine = this_machine();
  if (options.bandwidth == Bandwidth::with) {
    progress("bandwidth");
    result.levels = measure_levels();
  }
  if (options.projections != Projections::only && options.phases) {
    for (const Workload& workload : options.workloads) {
      progress(workload.name);
      if (workload.kind == Kind::falling) {
        result.contact.push_back(measure_contact(workload, options));
      } else {
        result.workloads.push_back(measure_workload(workload, options));
      }
    }
  }
  if (!options.against.empty()) {
    for (const AgainstTask& task : tasks_of(options)) {
      for (const int threads : options.threads) {
        progress(fmt::format("{} against {}", task.name, options.against));
        result.against.push_back(measure_against(task, options.against, threads, options.repeats));
      }
    }
  }
  for (const StepCase& step_case : options.cases) {
    progress(step_case.name);
    result.times_to_error.push_back(measure_time_to_error(step_case, options));
  }
  if (options.projections != Projections::without) {
    progress("projections");
    result.projections = measure_projections(options.repeats);
  }
  return result;
}

}  // namespace pliant_bench
