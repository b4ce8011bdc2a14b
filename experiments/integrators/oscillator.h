#pragma once
// The two-mass oscillator, ω = 2π/s: what each integrator makes of a motion that is known exactly.
#include "experiment_context.h"

namespace pliant_experiments {

constexpr double oscillator_omega = 6.283185307179586;  // [rad/s]
constexpr double oscillator_amplitude = 0.01;           // [m]

/// One way to integrate.
struct Method {
  std::string name;
  pliant::Integrator integrator = pliant::Integrator::implicit_euler;
  pliant::Index substeps = 1;
  int color = 0;
  double energy_projection = 0;
};

/// Implicit Euler, in 2 and 4 substeps, and BDF2.
const std::vector<Method>& methods();

/// Implicit Euler and BDF2 with energy projection.
const std::vector<Method>& projected_methods();

/// The scene with that method, in steps of `time_step` [s].
pliant::Scene oscillator(const ExperimentContext& context, const Method& method, double time_step, double damping = 0);

/// How much longer than at rest the spring is [m].
double extension(const pliant::Simulation& simulation);

/// By what share the amplitude falls in a period, from the energy of many.
double loss_a_period(const ExperimentContext& context, const Method& method, double h_omega);

/// Root mean square of the error of the extension over two periods of `steps` steps each [m].
double error_of(const ExperimentContext& context, const Method& method, int steps);

/// Largest extension in 2000 steps, over the first.
double largest_extension(const ExperimentContext& context, const Method& method, double h_omega);

/// Rate at which the amplitude decays [1/s], from the energy in the first period, of 1 s, and in the fourth.
double decay_rate(const ExperimentContext& context, const Method& method, double time_step, double damping);

}  // namespace pliant_experiments
