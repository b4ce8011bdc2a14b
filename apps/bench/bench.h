#pragma once
// The bench: what is to be measured, and the run of it.
#include <array>
#include <functional>
#include <optional>
#include <string_view>
#include <vector>

#include "bench/cases.h"
#include "bench/results.h"
#include "pliant/solver/settings.h"

namespace pliant_bench {

/// What Pliant is compared with, in the same process.
enum class BaselineKind {
  eigen,     ///< Eigen::SimplicialLLT's solve, the unit of all comparisons
  cholmod,   ///< CHOLMOD's solve, simplicial and supernodal
  textbook,  ///< an iteration of the textbook, m × m
  thesis     ///< the same with one system of 3m × 3m
};
constexpr std::array<std::string_view, 4> choice_names(BaselineKind) {
  return {"eigen", "cholmod", "textbook", "thesis"};
}

/// Whether the projections are measured by themselves: with the workloads, not at all, or without the workloads.
enum class Projections { with, without, only };
constexpr std::array<std::string_view, 3> choice_names(Projections) {
  return {"with", "without", "only"};
}

/// Whether the machine's bandwidth is measured first.
enum class Bandwidth { with, without };
constexpr std::array<std::string_view, 2> choice_names(Bandwidth) {
  return {"with", "without"};
}

struct BenchOptions {
  std::vector<Workload> workloads;      ///< what is measured, in turn
  std::vector<BaselineKind> baselines;  ///< other libraries to measure beside it
  std::vector<int> threads = {1, 2};    ///< the phases are those of the first
  std::optional<int> repeats;           ///< default: as many as fit into a few seconds a workload, at least five
  pliant::SolverSettings settings;      ///< of every workload, but for the threads
  Projections projections = Projections::with;  ///< whether each type of projection is measured by itself
  Bandwidth bandwidth = Bandwidth::with;        ///< whether the memory's bandwidth is measured

  std::vector<StepCase> cases;  ///< whose time to error is measured
  std::string against;  ///< another build of the program, timed beside this one on these and the workloads; empty: none
  bool phases = true;   ///< whether the workloads are measured phase by phase

  bool has(BaselineKind kind) const;
};

/// Told what is measured next.
using Progress = std::function<void(std::string_view)>;

/// What this program runs on, and what it was built with.
Machine this_machine();

/// Throws Error(input) on settings that the solver refuses, and when a baseline does not give what Pliant gives.
BenchResult run_bench(const BenchOptions& options, const Progress& progress);

}  // namespace pliant_bench
