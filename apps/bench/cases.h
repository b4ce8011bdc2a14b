#pragma once
// Single steps of what people simulate, whose way to convergence is measured: cloth that hangs, swings and falls onto
// something, a dress, a soft bar; and of any scene.
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "pliant_io/scene/scene.h"

namespace pliant_bench {

struct StepCase {
  std::string name;  ///< of scenes that are no cases of the bench: a built-in scene's, or a file
  std::string description{};
  std::string scene{};             ///< JSON
  std::filesystem::path folder{};  ///< where the paths in it start
  bool is_file = false;            ///< whose name another program is given
  bool is_plain = true;            ///< whether a step has a fixed number of plain iterations, without contact
  bool is_old = false;             ///< whether another build is timed with it, as 0.1.0 reads it
  std::int64_t steps = 0;          ///< before the one that is measured
  bool settles = false;            ///< these are damped, so that it comes to rest, and then it is pushed
  pliant::Index iterations = 10;   ///< of a step when it is timed against another program
};

/// All of them. `size`: vertices along a side of the cloth, a tenth of it cells across the bar; default: 100.
std::vector<StepCase> step_cases(std::optional<pliant::Index> size = {});

/// Those of these names, or all of them for `all`; the names may also be those of built-in scenes and scene files, of
/// which `steps` are taken before the one that is measured; a name of both is the bench's. Throws Error(input) on
/// another name, on a file that cannot be read, and on steps where there is no such scene.
std::vector<StepCase> choose_cases(const std::vector<std::string>& names, std::optional<pliant::Index> size,
                                   std::optional<std::int64_t> steps = {});

/// At the beginning of the step that is measured.
pliant::Scene begin_of(const StepCase& step_case, int threads);

}  // namespace pliant_bench
