#pragma once
// What a scene's first half second tells of how it moves, and what to change.
#include <nlohmann/json.hpp>

#include "pliant/simulation/step_error.h"
#include "pliant_io/scene/scene.h"

namespace pliant_cli {

/// "20 iterations", or "automatic iterations, at most 100".
std::string iterations_text(const pliant::SolverSettings& settings);

/// "2 substeps of 20 iterations each, BDF2".
std::string steps_text(const pliant::SolverSettings& settings);

/// How far from where it should a step ends.
std::string exact_text(const pliant::Simulation& simulation, const pliant::StepError& error);

/// Whether that shows, and what helps; empty where it does not. `when`: in which step, with a space before it.
std::string far_from_converged_text(const pliant::Simulation& simulation, const pliant::StepError& error,
                                    const std::string& when = "");

/// Takes the steps of the first half second, or all there are, and second_look more where their end is far from
/// converged, and describes them: how lively, how stretchy, how fast and how exact. Goes on to the events of the scene,
/// as far as that takes no long time, to see how exact the steps after them are. Its "text" has a line each, its
/// "warning" is far_from_converged_text() of the worst. Null for large scenes, whose steps take long, for those without
/// a step, and where one fails, which a run tells. `scene` has moved then.
nlohmann::ordered_json describe_motion(pliant::Scene& scene);

}  // namespace pliant_cli
