#pragma once
// The runs of a sweep, as processes beside each other.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>

#include "sweep/sweep_plan.h"

namespace pliant_sweep {

/// How the processors are shared out. Results do not depend on it.
struct Sharing {
  std::int64_t jobs = 1;      ///< runs at a time
  std::int64_t threads = -1;  ///< of each; below 0: as the scene has them
};

/// As many runs at a time as there are processors, with a thread each, or fewer with more; what is asked for counts
/// first. Where threads are varied, one at a time.
Sharing share_processors(std::int64_t processors, const SweepPlan& plan, std::optional<std::int64_t> jobs,
                         std::optional<std::int64_t> threads);

/// How far a sweep has come.
struct SweepState {
  std::size_t total = 0;
  std::size_t ended = 0;  ///< with those that were there
  std::size_t failed = 0;
  std::size_t diverged = 0;
  std::size_t running = 0;
  std::optional<double> seconds_left{};  ///< none before the first run has ended
};

/// What a sweep tells and asks while it runs; each may be empty.
struct SweepHooks {
  std::function<bool()> stop;                             ///< asked several times a second
  std::function<void(const SweepState&)> show;            ///< several times a second
  std::function<void(const SweepRun& run)> tell_ended{};  ///< after each run
};

/// Runs what is waiting, or failed before, by `program run ...`, and keeps FOLDER/sweep.csv up to date: a row a run, in
/// the order of the plan. After a stop the runs under way are ended and wait again. begin_sweep() comes first.
/// @throws pliant::Error (output); (input): the scene, a mesh or a map was changed meanwhile. Runs under way
///   are ended then, and wait again.
void run_sweep(const std::filesystem::path& folder, const std::string& program, const Sharing& sharing, SweepPlan& plan,
               const SweepHooks& hooks);

/// 4 if a run could not write its files, else 2 if one failed otherwise, else 3 if one diverged, else 0.
int exit_code_of(std::span<const SweepRun> runs);

/// The contents of sweep.csv.
std::string sweep_csv(const SweepPlan& plan);

}  // namespace pliant_sweep
