#pragma once
// The experiments: chapter 6 of the thesis, the comparisons of the paper, and what goes beyond both.
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "experiment_context.h"

namespace pliant_experiments {

struct Experiment {
  std::string_view name;   ///< that of its folder: "damping"
  std::string_view title;  ///< "Damping by the number of iterations"
  /// Runs it: what was measured, the claims with their verdicts, the figures. Name, title and seconds are filled in by
  /// the caller.
  pliant_report::Chapter (*run)(const ExperimentContext& context);
};

/// What claims say who has made them, and what that is: "thesis", "Bouaziz et al. 2014".
std::vector<std::pair<std::string, std::string>> sources();

/// In the order of the report.
std::span<const Experiment> experiments();

}  // namespace pliant_experiments
