#pragma once
// What the bench measures. Times are seconds, sizes bytes.
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/workload.h"
#include "pliant/solver/state.h"

namespace pliant_bench {

/// Of repeats that take turns with everything else that is measured.
struct Seconds {
  double min = 0;
  double median = 0;
};

/// One level of the memory hierarchy, and how fast one thread reads what just fits into half of it.
struct Level {
  std::string name;               ///< "L2", "L3" or "memory"
  std::int64_t bytes = 0;         ///< its size; 0 for memory
  std::int64_t buffer_bytes = 0;  ///< what was read, over and over
  double bytes_per_second = 0;
};

/// A part of a step, on one thread.
struct Phase {
  std::string name;
  Seconds seconds;
  std::optional<std::int64_t> bytes{};  ///< what it must read and write at least
};

/// What other programs take for the same system.
struct BaselineResult {
  std::string name;
  std::string what;  ///< "solve" or "iteration"
  Seconds seconds;
  double difference = 0;  ///< of its result from Pliant's, relative
  double set_up_seconds = 0;
  std::optional<std::int64_t> peak_bytes{};
};

struct ThreadsResult {
  int threads = 1;  ///< asked for
  int used = 1;     ///< a small system takes fewer
  Seconds iteration;
  bool has_same_bits = true;  ///< as the first number of threads
};

/// From nothing to the first iteration.
struct SetUpResult {
  double mesh = 0;
  double constraints = 0;  ///< rest data, and all checks
  pliant::SetUpTimes solver;
  std::optional<std::int64_t> peak_bytes{};

  double total() const {
    return mesh + constraints + solver.layout + solver.assembly + solver.symbolic + solver.numeric + solver.repack +
           solver.estimate;
  }
};

struct ConstraintCount {
  std::string type;
  std::int64_t count = 0;
};

struct WorkloadResult {
  Workload workload;
  std::int64_t vertices = 0;
  std::vector<ConstraintCount> constraints;
  std::string backend;
  std::int64_t factor_entries = 0;
  std::int64_t panels = 0;
  std::int64_t working_set_bytes = 0;  ///< of one iteration
  /// How fast one thread that only reads goes over as many bytes, in turns with the rest [bytes/s].
  std::optional<double> read_bytes_per_second{};
  std::int64_t repeats = 0;
  SetUpResult set_up;
  std::vector<Phase> phases;
  std::vector<BaselineResult> baselines;
  std::vector<ThreadsResult> threads;

  const Phase& phase(std::string_view name) const;
  /// Nothing when it was not measured.
  const BaselineResult* baseline(std::string_view name) const;
};

/// Steps of a cloth that touches nothing, or colliders alone, or itself as well.
struct ContactRun {
  std::string name;
  Seconds step;
  std::vector<Phase> phases;  ///< of a step; the last is time for contact that the others have in them
  double iterations = 0;      ///< of a step, in the mean, as all that follows
  double backtracks = 0;      ///< moves taken back or shortened
  double contacts = 0;        ///< vertices that touch a collider
  double pairs = 0;           ///< of features of surfaces that push each other
};

struct ContactResult {
  Workload workload;
  std::int64_t vertices = 0;
  int threads = 1;               ///< asked for
  std::vector<ContactRun> runs;  ///< the first is plain
  std::int64_t rounds = 0;       ///< each step is the fastest of so many
};

/// The projections of one type of constraint, on one thread.
struct ProjectionsResult {
  std::string type;
  std::int64_t count = 0;
  Seconds seconds;  ///< for all of them once
};

/// How many iterations, and how long, until a step is so near to its end.
struct ErrorLevel {
  double error = 0;
  std::optional<pliant::Index> iterations{};  ///< none: not with the most that are tried, or more exact than is known
  Seconds seconds;
};

struct MethodResult {
  std::string name;  ///< of the acceleration; "plain" for none; "xpbd", "xpbd rows" (xpbd.h)
  std::vector<ErrorLevel> levels;
  std::optional<double> last_error{};  ///< with the most iterations, where fewer do not do
};

struct TimeToErrorResult {
  std::string name;
  std::string description;
  std::int64_t vertices = 0;
  double uncertainty = 0;  ///< of the end that the step is held against, in the unit of the errors
  double usual_error = 0;  ///< that the usual iterations leave
  std::vector<MethodResult> methods;
};

/// A step of this program and of another build of it, by whole runs.
struct AgainstResult {
  std::string name;  ///< of the workload
  int threads = 1;
  pliant::Index iterations = 10;
  Seconds own_step;
  Seconds other_step;
  double times_as_fast = 1;  ///< median of the ratios of the rounds
};

struct Machine {
  std::string processor;
  unsigned processors = 1;
  std::string compiler;
  std::string eigen;
  std::string cholmod;  ///< empty: not in this build
  std::string instruction_set;
  std::string date;  ///< UTC, "2026-01-31 12:00"
};

struct BenchResult {
  Machine machine;
  std::vector<Level> levels;
  std::vector<WorkloadResult> workloads;
  std::vector<ContactResult> contact;
  std::vector<ProjectionsResult> projections;
  std::vector<TimeToErrorResult> times_to_error;
  std::vector<AgainstResult> against;

  /// The fastest level that holds these bytes; nothing when no bandwidth was measured.
  const Level* level_of(std::int64_t bytes) const;
};

}  // namespace pliant_bench
