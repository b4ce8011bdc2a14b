#pragma once
// Single steps of what people simulate, whose way to convergence is measured: cloth that hangs, swings and falls onto
// something, a dress, a soft bar.
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/scene/scene.h"

namespace pliant_bench {

struct StepCase {
  std::string name;
  std::string description;
  std::string scene;              ///< JSON; that of a built-in scene, or one that 0.1.0 reads as well
  bool is_old = false;            ///< whether 0.1.0 reads it
  std::int64_t steps = 0;         ///< before the one that is measured
  bool settles = false;           ///< these are damped, so that it comes to rest, and then it is pushed
  pliant::Index iterations = 10;  ///< of a step when it is timed against another program
};

/// All of them. `size`: vertices along a side of the cloth, a tenth of it cells across the bar; default: 100.
std::vector<StepCase> step_cases(std::optional<pliant::Index> size = {});

/// Those of these names, or all of them for `all`. Throws Error(input) on another name.
std::vector<StepCase> choose_cases(const std::vector<std::string>& names, std::optional<pliant::Index> size);

/// At the beginning of the step that is measured.
pliant::Scene begin_of(const StepCase& step_case, int threads);

}  // namespace pliant_bench
