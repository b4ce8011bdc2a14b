#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/figures.h"
#include "bench/report.h"
#include "bench/time_to_error.h"
#include "pliant/core/version.h"

namespace pliant_bench {
namespace {

constexpr std::string_view how_to_read =
    R"(How to read: times are of one iteration (a step has several), on one thread unless said otherwise, minimum and median of
repeats in which everything takes turns. "x Eigen" is the median as a multiple of Eigen's solve of the same system with
three right-hand sides. MB is what a phase must read and write at least; GB/s comes from it and the minimum; "share" is
that of the speed at which one thread only reads as much memory as an iteration touches.
)";

using Out = std::back_insert_iterator<std::string>;

/// "%" of a share, or "-".
std::string percent(const std::optional<double>& share) {
  return share ? fmt::format("{:.0f} %", 100 * *share) : "-";
}

std::string number(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "-";
}

std::string megabytes(const std::optional<std::int64_t>& bytes, int digits) {
  return bytes ? fmt::format("{:.{}f}", 1e-6 * static_cast<double>(*bytes), digits) : "-";
}

std::string binary_size(std::int64_t bytes) {
  return fmt::format("{:.4g} MiB", static_cast<double>(bytes) / (1 << 20));
}

void print_machine(const BenchResult& result, Out out) {
  const Machine& machine = result.machine;
  fmt::format_to(out, "pliant {}, {} UTC\n{}, {} in use; {}; Eigen {}, {}; triangular solves for {}\n", pliant::version,
                 machine.date, machine.processor,
                 machine.processors == 1 ? "1 processor" : fmt::format("{} processors", machine.processors),
                 machine.compiler, machine.eigen, machine.cholmod.empty() ? "no CHOLMOD" : "CHOLMOD " + machine.cholmod,
                 machine.instruction_set);
  for (const Level& level : result.levels) {
    const std::string size = level.bytes > 0 ? " of " + binary_size(level.bytes) : "";
    fmt::format_to(out, "one thread reads {}{} at {:.1f} GB/s (over and over {})\n", level.name, size,
                   1e-9 * level.bytes_per_second, binary_size(level.buffer_bytes));
  }
}

void print_head(const BenchResult& result, const WorkloadResult& w, Out out) {
  std::vector<std::string> constraints;
  for (const ConstraintCount& each : w.constraints) constraints.push_back(fmt::format("{} {}", each.count, each.type));
  const Level* level = result.level_of(w.working_set_bytes);
  fmt::format_to(out, "\n{}: {} vertices; {}; {} iterations a step; {} repeats\n", w.workload.name, w.vertices,
                 fmt::join(constraints, ", "), w.workload.iterations, w.repeats);
  fmt::format_to(out, "  factor by {}: {} entries in {} panels; an iteration touches {} MB{}\n", w.backend,
                 w.factor_entries, w.panels, megabytes(w.working_set_bytes, 1),
                 level != nullptr ? " (" + level->name + ")" : "");
  if (w.read_bytes_per_second) {
    fmt::format_to(out, "  one thread reads as much at {:.1f} GB/s\n", 1e-9 * *w.read_bytes_per_second);
  }
}

void print_phases(const WorkloadResult& w, Out out) {
  fmt::format_to(out, "  {:<32} {:>9} {:>9} {:>8} {:>8} {:>7} {:>6}\n", "", "min ms", "median", "x Eigen", "MB", "GB/s",
                 "share");
  for (const Phase& phase : w.phases) {
    const std::optional<double> bytes_per_second = speed(phase);
    const bool is_sum = phase.name == "solve" || phase.name == "iteration" || phase.name == "step";
    fmt::format_to(out, "  {:<32} {:>9.4f} {:>9.4f} {:>8} {:>8} {:>7} {:>6}\n",
                   is_sum ? fmt::format("Pliant, whole {}", phase.name) : "  " + phase.name, 1e3 * phase.seconds.min,
                   1e3 * phase.seconds.median, number(times_eigen(w, phase.seconds), 3), megabytes(phase.bytes, 2),
                   number(bytes_per_second ? std::optional(1e-9 * *bytes_per_second) : std::nullopt, 1),
                   percent(share(w, phase)));
  }
  for (const BaselineResult& each : w.baselines) {
    fmt::format_to(out, "  {:<32} {:>9.4f} {:>9.4f} {:>8}\n", fmt::format("{}, {}", each.name, each.what),
                   1e3 * each.seconds.min, 1e3 * each.seconds.median, number(times_eigen(w, each.seconds), 3));
  }
}

void print_threads(const WorkloadResult& w, Out out) {
  for (std::size_t i = 1; i < w.threads.size(); ++i) {
    const ThreadsResult& each = w.threads[i];
    fmt::format_to(out, "  {} threads{}: iteration {:.4f} ms (min {:.4f}), {:.2f} times as fast as {}; {}\n",
                   each.threads, each.used < each.threads ? fmt::format(", of which {} used", each.used) : "",
                   1e3 * each.iteration.median, 1e3 * each.iteration.min, ratio(w.threads[0].iteration, each.iteration),
                   w.threads[0].threads, each.has_same_bits ? "the same bits" : "OTHER BITS: report this");
  }
}

void print_set_up(const WorkloadResult& w, Out out) {
  const SetUpResult& s = w.set_up;
  fmt::format_to(
      out,
      "  set-up {:.1f} ms: mesh {:.1f}, constraints {:.1f}, layout {:.1f}, assembly {:.1f}, symbolic {:.1f}, "
      "numeric {:.1f}, repack {:.1f}, estimate {:.1f}; peak {} MB\n",
      1e3 * s.total(), 1e3 * s.mesh, 1e3 * s.constraints, 1e3 * s.solver.layout, 1e3 * s.solver.assembly,
      1e3 * s.solver.symbolic, 1e3 * s.solver.numeric, 1e3 * s.solver.repack, 1e3 * s.solver.estimate,
      megabytes(s.peak_bytes, 1));
  for (const BaselineResult& each : w.baselines) {
    fmt::format_to(out, "    {}: {:.1f} ms, peak {} MB; differs by {:.0e}\n", each.name, 1e3 * each.set_up_seconds,
                   megabytes(each.peak_bytes, 1), each.difference);
  }
}

/// Pliant against the others, a line a workload.
void print_summary(const BenchResult& result, Out out) {
  fmt::format_to(out,
                 "\nSummary: iteration as a multiple of Eigen's solve, and how many times as fast Pliant is\n"
                 "  {:<10} {:>8} {:>10} {:>10} | solve: {:>8} {:>8}\n",
                 "", "x Eigen", "textbook", "thesis", "Eigen", "CHOLMOD");
  for (const WorkloadResult& w : result.workloads) {
    const auto faster = [&w](std::string_view baseline, std::string_view phase) -> std::optional<double> {
      const BaselineResult* other = w.baseline(baseline);
      if (other == nullptr) return std::nullopt;
      return ratio(other->seconds, w.phase(phase).seconds);
    };
    const std::optional<Seconds> cholmod = best_cholmod(w);
    fmt::format_to(out, "  {:<10} {:>8} {:>10} {:>10} |        {:>8} {:>8}\n", w.workload.name,
                   number(times_eigen(w, w.phase("iteration").seconds), 3), number(faster("textbook", "iteration"), 1),
                   number(faster("thesis 3m x 3m", "iteration"), 1), number(faster("Eigen", "solve"), 1),
                   number(cholmod ? std::optional(ratio(*cholmod, w.phase("solve").seconds)) : std::nullopt, 1));
  }
}

void print_contact(const BenchResult& result, Out out) {
  fmt::format_to(out,
                 "\nContact: a cloth falls onto a sphere above a floor; medians over steps 30 to 120, taken in turns. "
                 "Phases in ms; contact is in\nthe others. Plain: the same cloth swings from two corners, since a step "
                 "of free fall has nothing to do; without L-BFGS\n");
  for (const ContactResult& each : result.contact) {
    fmt::format_to(out,
                   "\n{}: {} vertices; each step the fastest of {}\n  {:<16} {:>9} {:>8} {:>8} {:>8} {:>8} {:>8} {:>8} "
                   "{:>6} {:>6}\n",
                   each.workload.name, each.vertices, each.rounds, "", "step ms", "x plain", "local", "global",
                   "factor", "rest", "contact", "iter.", "undone");
    for (const ContactRun& run : each.runs) {
      fmt::format_to(out, "  {:<16} {:>9.4f} {:>8.2f}", run.name, 1e3 * run.step.median,
                     ratio(run.step, each.runs.front().step));
      for (const Phase& phase : run.phases) fmt::format_to(out, " {:>8.4f}", 1e3 * phase.seconds.median);
      fmt::format_to(out, " {:>6.1f} {:>6.1f}\n", run.iterations, run.backtracks);
    }
  }
}

void print_projections(const BenchResult& result, Out out) {
  fmt::format_to(
      out,
      "\nProjections by themselves, one thread, gathering of z included\n  {:<24} {:>7} {:>9} {:>9} {:>13} {:>7}\n", "",
      "count", "min ms", "median", "million/s", "ns each");
  for (const ProjectionsResult& each : result.projections) {
    const double nanoseconds = 1e9 * each.seconds.median / static_cast<double>(each.count);
    fmt::format_to(out, "  {:<24} {:>7} {:>9.4f} {:>9.4f} {:>13.1f} {:>7.1f}\n", each.type, each.count,
                   1e3 * each.seconds.min, 1e3 * each.seconds.median, 1e3 / nanoseconds, nanoseconds);
  }
}

/// "12", or "-".
std::string iterations_cell(const ErrorLevel& level) {
  return level.iterations ? fmt::format("{}", *level.iterations) : "-";
}

void print_method(const TimeToErrorResult& result, const MethodResult& method, Out out) {
  fmt::format_to(out, "  {:<10}", method.name);
  for (const ErrorLevel& level : method.levels) {
    const char* none = level.error > 2 * result.uncertainty ? "not reached" : "not known";
    fmt::format_to(out, " {:>8} {:>11}", iterations_cell(level),
                   level.iterations ? fmt::format("{:.4g} ms", 1e3 * level.seconds.median) : none);
  }
  if (method.last_error) fmt::format_to(out, "  {:.1e} left", *method.last_error);
  out = '\n';
}

/// The other program has the same plain iterations, each at its own time.
void print_other_program(const BenchResult& result, const TimeToErrorResult& each, Out out) {
  const auto other = std::ranges::find(result.against, each.name, &AgainstResult::name);
  if (other == result.against.end()) return;
  const double iteration = other->other_step.median / static_cast<double>(other->iterations);
  fmt::format_to(out, "  {:<10}", "the other");
  for (const ErrorLevel& level : each.methods.front().levels) {
    const std::string time =
        level.iterations ? fmt::format("{:.4g} ms", 1e3 * iteration * static_cast<double>(*level.iterations)) : "";
    fmt::format_to(out, " {:>8} {:>11}", iterations_cell(level), time);
  }
  out = '\n';
}

void print_times_to_error(const BenchResult& result, Out out) {
  fmt::format_to(
      out,
      "\nTime to error: iterations and milliseconds (median) of a step until it is so near to its end, as a share "
      "of\nhow far the prediction q + h v + h^2 f/m is from it, root mean square over the mass; usual: what the "
      "{}\niterations of L-BFGS leave that scenes of materials have; left: what {} iterations leave.\n"
      "xpbd: Gauss-Seidel sweeps, one multiplier a constraint; xpbd rows: one for each number of z - p\n",
      usual_iterations, most_iterations);
  for (const TimeToErrorResult& each : result.times_to_error) {
    fmt::format_to(out, "\n{}: {}; {} vertices; the end is known to {:.0e}\n  {:<10}", each.name, each.description,
                   each.vertices, each.uncertainty, "");
    for (const ErrorLevel& level : each.methods.front().levels) {
      const bool is_usual = level.error == each.usual_error;
      fmt::format_to(out, " {:>20}",
                     is_usual ? fmt::format("{:.1e}, usual", level.error) : fmt::format("{:.0e}", level.error));
    }
    out = '\n';
    for (const MethodResult& method : each.methods) print_method(each, method, out);
    print_other_program(result, each, out);
  }
}

void print_against(const BenchResult& result, Out out) {
  fmt::format_to(
      out,
      "\nAgainst the other program: a plain step by whole runs in turns, and how many times as fast this one is\n"
      "  {:<10} {:>7} {:>12} {:>12} {:>14}\n",
      "", "threads", "own ms", "other ms", "times as fast");
  for (const AgainstResult& each : result.against) {
    fmt::format_to(out, "  {:<10} {:>7} {:>12.4f} {:>12.4f} {:>14.2f}\n", each.name, each.threads,
                   1e3 * each.own_step.median, 1e3 * each.other_step.median, each.times_as_fast);
  }
}

}  // namespace

std::string text_report(const BenchResult& result) {
  std::string text;
  const Out out(text);
  print_machine(result, out);
  if (!result.workloads.empty()) text += how_to_read;
  for (const WorkloadResult& workload : result.workloads) {
    print_head(result, workload, out);
    print_phases(workload, out);
    print_threads(workload, out);
    print_set_up(workload, out);
  }
  if (!result.workloads.empty()) print_summary(result, out);
  if (!result.contact.empty()) print_contact(result, out);
  if (!result.projections.empty()) print_projections(result, out);
  if (!result.against.empty()) print_against(result, out);
  if (!result.times_to_error.empty()) print_times_to_error(result, out);
  return text;
}

}  // namespace pliant_bench
