#pragma once
// The runs of a sweep and their folders, as DIR/sweep.json remembers them from start to start.
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "sweep/run_result.h"
#include "sweep/sweep_setup.h"

namespace pliant_sweep {

struct SweepRun {
  Combination values;
  std::string name;  ///< of its folder in runs/: "0007", given once and for all
  RunResult result{};
};

struct SweepPlan {
  SweepSetup setup;                                    ///< what was asked for
  std::vector<SweepRun> runs;                          ///< in the order of the product
  std::vector<SweepRun> others;                        ///< of earlier starts, and not asked for now: they are kept
  std::vector<std::string> removed;                    ///< names of runs of earlier starts that begin_sweep() removes
  std::map<std::string, std::uint32_t> other_files{};  ///< that only `others` may have read, as setup.files
};

std::size_t count_of(const SweepPlan& plan, RunOutcome outcome);

/// How many runs have which outcome, for people: "6 ok, 1 diverged".
std::string outcomes_text(const SweepPlan& plan);

/// Whether a sweep was begun in a folder. Does not throw.
bool has_sweep(const std::filesystem::path& folder);

/// What becomes of the runs of an earlier start.
enum class Earlier { keep, remove };

/// The runs of a sweep in a folder, which need not be there. Those that an earlier start has ended have their results.
/// @throws pliant::Error (input): the runs that are there cannot be compared with these; (output): what is there is
///   of no sweep
SweepPlan plan_sweep(const std::filesystem::path& folder, SweepSetup setup, Earlier earlier);

/// Makes the folder ready, and writes its sweep.json. @throws pliant::Error (output)
void begin_sweep(const std::filesystem::path& folder, const SweepPlan& plan);

/// runs/NAME, and runs/NAME.log
std::filesystem::path run_folder(const std::filesystem::path& folder, const std::string& name);
std::filesystem::path run_log(const std::filesystem::path& folder, const std::string& name);

}  // namespace pliant_sweep
