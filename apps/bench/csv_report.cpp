#include <fmt/format.h>

#include "bench/figures.h"
#include "bench/report.h"

namespace pliant_bench {
namespace {

using Out = std::back_insert_iterator<std::string>;

/// A number with all its digits, or nothing.
template <class Value>
std::string field(const std::optional<Value>& value) {
  return value ? fmt::format("{}", *value) : std::string();
}

/// The name of a kernel may have a comma in it.
std::string quoted(const std::string& text) {
  return text.find(',') == std::string::npos ? text : '"' + text + '"';
}

struct Row {
  std::string workload;
  std::string table;
  std::string name;
  int threads = 1;
  std::optional<double> min{};
  std::optional<double> median{};
  std::optional<double> times_eigen{};
  std::optional<std::int64_t> bytes{};
  std::optional<double> bytes_per_second{};
  std::optional<double> share{};
};

void print(const Row& row, Out out) {
  fmt::format_to(out, "{},{},{},{},{},{},{},{},{},{}\n", row.workload, row.table, quoted(row.name), row.threads,
                 field(row.min), field(row.median), field(row.times_eigen), field(row.bytes),
                 field(row.bytes_per_second), field(row.share));
}

void csv_set_up(const WorkloadResult& w, Out out) {
  const SetUpResult& s = w.set_up;
  const std::pair<const char*, double> parts[] = {{"mesh", s.mesh},
                                                  {"constraints", s.constraints},
                                                  {"layout", s.solver.layout},
                                                  {"assembly", s.solver.assembly},
                                                  {"symbolic", s.solver.symbolic},
                                                  {"numeric", s.solver.numeric},
                                                  {"repack", s.solver.repack},
                                                  {"estimate", s.solver.estimate}};
  const int threads = w.threads.front().threads;
  for (const auto& [name, seconds] : parts) {
    print({w.workload.name, "set_up", name, threads, seconds, seconds}, out);
  }
  Row all{w.workload.name, "set_up", "total", threads, s.total(), s.total()};
  all.bytes = s.peak_bytes;
  print(all, out);
  for (const BaselineResult& each : w.baselines) {
    Row row{w.workload.name, "baseline_set_up", each.name, 1, each.set_up_seconds, each.set_up_seconds};
    row.bytes = each.peak_bytes;
    print(row, out);
  }
}

void print_workload(const WorkloadResult& w, Out out) {
  for (const Phase& phase : w.phases) {
    print({w.workload.name, "phase", phase.name, w.threads.front().threads, phase.seconds.min, phase.seconds.median,
           times_eigen(w, phase.seconds), phase.bytes, speed(phase), share(w, phase)},
          out);
  }
  for (const BaselineResult& each : w.baselines) {
    print({w.workload.name, "baseline_" + each.what, each.name, 1, each.seconds.min, each.seconds.median,
           times_eigen(w, each.seconds)},
          out);
  }
  for (const ThreadsResult& each : w.threads) {
    print({w.workload.name, "threads", each.has_same_bits ? "iteration" : "iteration with other bits", each.threads,
           each.iteration.min, each.iteration.median, times_eigen(w, each.iteration)},
          out);
  }
  csv_set_up(w, out);
}

}  // namespace

std::string csv_report(const BenchResult& result) {
  std::string text =
      "workload,table,name,threads,min_s,median_s,times_eigen,bytes,bytes_per_second,share_of_bandwidth\n";
  const Out out(text);
  for (const Level& level : result.levels) {
    Row row{"", "bandwidth", level.name};
    row.bytes = level.buffer_bytes;
    row.bytes_per_second = level.bytes_per_second;
    print(row, out);
  }
  for (const WorkloadResult& workload : result.workloads) print_workload(workload, out);
  for (const ContactResult& each : result.contact) {
    for (const ContactRun& run : each.runs) {
      print({each.workload.name, "contact", run.name + ": step", each.threads, run.step.min, run.step.median}, out);
      for (const Phase& phase : run.phases) {
        const std::string name = fmt::format("{}: {}", run.name, phase.name);
        print({each.workload.name, "contact", name, each.threads, phase.seconds.min, phase.seconds.median}, out);
      }
    }
  }
  for (const ProjectionsResult& each : result.projections) {
    print({"", "projections", each.type, 1, each.seconds.min, each.seconds.median}, out);
  }
  for (const AgainstResult& each : result.against) {
    print({each.name, "against", "own step", each.threads, each.own_step.min, each.own_step.median}, out);
    print({each.name, "against", "other step", each.threads, each.other_step.min, each.other_step.median}, out);
  }
  for (const TimeToErrorResult& each : result.times_to_error) {
    for (const MethodResult& method : each.methods) {
      for (const ErrorLevel& level : method.levels) {
        if (!level.iterations) continue;
        const std::string name = fmt::format("{} {:.0e} in {}", method.name, level.error, *level.iterations);
        print({each.name, "time_to_error", name, 1, level.seconds.min, level.seconds.median}, out);
      }
    }
  }
  return text;
}

}  // namespace pliant_bench
