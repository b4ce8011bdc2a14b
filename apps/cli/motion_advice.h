#pragma once
// What a scene's first half second tells of how it moves, and what to change.
#include <nlohmann/json.hpp>

#include "pliant/simulation/step_error.h"
#include "pliant_io/scene/scene.h"

namespace pliant_cli {

/// So many steps after one that is far from converged another is looked at, and the better one counts: a single step of
/// an impact can be far from converged without being seen.
inline constexpr std::int64_t second_look = 5;

/// "20 iterations", or "automatic iterations, at most 100".
std::string iterations_text(const pliant::SolverSettings& settings);

/// "2 substeps of 20 iterations each, BDF2".
std::string steps_text(const pliant::SolverSettings& settings);

/// Whether it shows that a step ends so far from where it should, and what helps; empty where it does not.
std::string far_from_converged_text(const pliant::Simulation& simulation, const pliant::StepError& error);

/// Takes the steps of the first half second, or all there are, and second_look more where their end is far from
/// converged, and describes them: how lively, how stretchy, how fast and how exact. Its "text" has a line each, its
/// "warning" is far_from_converged_text(). Null for large scenes, whose steps take long, for those without a step, and
/// where one fails, which a run tells. `scene` has moved then.
nlohmann::ordered_json describe_motion(pliant::Scene& scene);

}  // namespace pliant_cli
