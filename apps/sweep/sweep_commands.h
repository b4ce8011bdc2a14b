#pragma once
// The runs of a sweep as command lines, for programs that start them on one machine or many.
#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "sweep/sweep_plan.h"

namespace pliant_sweep {

/// What the command lines of a sweep have in common.
struct CommandFrame {
  std::string program;              ///< the path of this program
  std::filesystem::path directory;  ///< absolute; where relative paths begin
  std::filesystem::path folder;     ///< of the sweep, as given
  std::int64_t threads = 1;         ///< of each run; below 0: as the scene has them
};

/// A text as a word of a POSIX shell. @throws pliant::Error (input): a line break, which no line can hold
std::string shell_word(std::string_view text);

/// A line for a POSIX shell, to be started in any directory. It waits until nobody else writes in the folder of the
/// run. A run that has ended by itself is left alone then; any other is run from its start. Its log has what it
/// printed, and a last line "exit code N" where that is not 0. The line ends with that exit code.
/// @throws pliant::Error (input): as shell_word
std::string run_command(const CommandFrame& frame, const SweepSetup& setup, const SweepRun& run);

/// The lines of all runs, in the order of the plan. @throws pliant::Error (input): as shell_word
std::vector<std::string> run_commands(const CommandFrame& frame, const SweepPlan& plan);

/// Lets command lines run again what they would take for ended although its files are not whole.
/// @throws pliant::Error (output)
void forget_cut_runs(const std::filesystem::path& folder, const SweepPlan& plan);

/// Gives runs that failed by their command lines this result, and removes logs that are empty, or of an attempt beside
/// the one that ended the run.
void collect_results(const std::filesystem::path& folder, SweepPlan& plan);

}  // namespace pliant_sweep
