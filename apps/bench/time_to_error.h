#pragma once
// How long a step takes until it is so near to where it converges: the measure of a solver, of which the time of an
// iteration is only a part.
#include "bench/bench.h"
#include "bench/cases.h"
#include "pliant/materials/material_groups.h"

namespace pliant_bench {

/// Distances from the converged end of the step, root mean square over the mass, as shares of that of the prediction,
/// q + h v + h² g.
inline constexpr std::array<double, 3> error_levels = {1e-2, 1e-4, 1e-6};
/// Iterations of L-BFGS that scenes of materials have: what these leave is one more distance.
inline const pliant::Index usual_iterations = pliant::settings_for_materials().iterations;
/// No more are tried.
inline constexpr pliant::Index most_iterations = 20'000;

/// Finds the iterations that each acceleration needs, and the sweeps of XPBD where nothing touches; then times so many
/// in turns. Throws Error(diverged) where a step does.
TimeToErrorResult measure_time_to_error(const StepCase& step_case, const BenchOptions& options);

}  // namespace pliant_bench
