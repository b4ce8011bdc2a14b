#pragma once
// Another build of this program, 0.1.0 say, timed in turns with this one on scene files that both read.
#include <string>

#include "bench/bench.h"

namespace pliant_bench {

/// What a program is given to run, with a fixed number of plain iterations.
struct AgainstTask {
  std::string name;
  std::string scene;             ///< JSON
  std::filesystem::path folder;  ///< where the paths in it start
  bool is_file;                  ///< the name is that of the scene's file, which both programs read
  pliant::Index iterations = 10;
};

/// Those of the workloads, and of the cases and scenes that another build may read.
std::vector<AgainstTask> tasks_of(const BenchOptions& options);

/// Time of a step by `pliant run`: a long run minus a short one, over the steps between; each round runs both
/// programs, both ways. Throws Error(input) where the other cannot be started or refuses the scene.
AgainstResult measure_against(const AgainstTask& task, const std::string& other, int threads,
                              std::optional<int> repeats);

}  // namespace pliant_bench
