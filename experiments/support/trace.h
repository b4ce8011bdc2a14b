#pragma once
// What is measured of a scene step by step.
#include "experiment_context.h"
#include "pliant_io/recorder/measurements.h"

namespace pliant_experiments {

/// One value a step, the start first.
struct Trace {
  std::vector<double> frames;  ///< 0, 1, 2, ...
  std::vector<double> time;    ///< [s]
  std::vector<double> speed_sum;
  std::vector<double> momentum;
  std::vector<double> kinetic;
  std::vector<double> elastic;  ///< all groups together
  std::vector<double> gravitational;
  std::vector<double> total;

  void add(const pliant::Measurements& row);
  std::size_t size() const { return frames.size(); }
};

/// Takes so many steps and measures each, and the start.
Trace record(const ExperimentContext& context, pliant::Scene& scene, std::int64_t steps);

/// Mean of the values [begin, end).
double mean(const std::vector<double>& values, std::size_t begin, std::size_t end);

/// Brings the scene to its static equilibrium: large steps with many iterations, in double precision, until no vertex
/// has a larger force than `tolerance` [N], then small ones, which take what rounding has left; it stands still at step
/// 0 in the end. The scene has no forces that end. Throws Error(diverged) where it does not come to rest.
void settle(const ExperimentContext& context, pliant::Scene& scene, double tolerance);

/// Largest share by which an edge of the simulation's bodies is longer than at rest.
double largest_stretch(const pliant::Simulation& simulation);

}  // namespace pliant_experiments
