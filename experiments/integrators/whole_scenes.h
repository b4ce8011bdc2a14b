#pragma once
// The integrators on whole scenes.
#include "experiment_context.h"

namespace pliant_experiments {

/// The curtain of the damping experiment, at equal iterations and at equal cost.
void measure_curtain(const ExperimentContext& context, pliant_report::Chapter& chapter);

/// How large the kinetic energy of some scenes is, against fine substeps.
void measure_liveliness(const ExperimentContext& context, pliant_report::Chapter& chapter);

/// Every built-in scene without contact, with BDF2, and with energy projection, to its end.
void measure_builtin_scenes(const ExperimentContext& context, pliant_report::Chapter& chapter);

/// Every built-in scene without contact and winds: whether energy projection brings in energy of its own.
void measure_energy_gains(const ExperimentContext& context, pliant_report::Chapter& chapter);

/// By what shares damping changes what it should leave alone.
struct DampedFlight {
  double momentum = 0;          ///< largest of a step, against the same step without damping
  double angular_momentum = 0;  ///< the same
  double fall = 0;              ///< of the center's way in all steps
};
DampedFlight measure_damped_flight(const ExperimentContext& context);

}  // namespace pliant_experiments
