#pragma once
// The same cloth at several resolutions, with its diagonals in several ways.
#include "experiment_context.h"

namespace pliant_experiments {

/// A sheet that hangs, and one that is pulled in every direction: springs of one constant, fibres of one cross-section
/// and triangles that resist strain. Which of them is the same cloth whatever its mesh?
pliant_report::Chapter run_resolution(const ExperimentContext& context);

}  // namespace pliant_experiments
