#pragma once
// How fast the two methods come down to the minimum of one and the same step.
#include <optional>
#include <vector>

#include "experiment_context.h"
#include "support/newton.h"

namespace pliant_experiments {

/// A step that is about to be taken, and its minimum.
struct Problem {
  pliant::Scene scene;
  pliant::State start;  ///< of the simulation, before the step
  MassSpring model;
  EulerStep step;
  pliant::Positions minimum{};  ///< q*, by Newton's method
  double first_objective = 0;   ///< E(s): both methods begin at s
  double least_objective = 0;   ///< E(q*)
  double first_distance = 0;    ///< ‖s − q*‖_M
  double largest_gradient = 0;  ///< at q*, of a vertex [N]
  int newton_iterations = 0;    ///< to q*

  /// (E(q) − E*)/(E(s) − E*)
  double objective_error(const pliant::Positions& q) const;
  /// ‖q − q*‖_M/‖s − q*‖_M
  double position_error(const pliant::Positions& q) const;
};

/// Takes the scene as far as it is asked to, and finds the minimum of the step after.
Problem problem_after(const ExperimentContext& context, pliant::Scene scene, int steps);

/// Errors after some numbers of iterations, ascending, and the time that these took.
struct Descent {
  std::vector<int> iterations;
  std::vector<double> seconds;       ///< the least of the repeats
  std::vector<double> most_seconds;  ///< the longest of them
  std::vector<double> objective_errors;
  std::vector<double> position_errors;

  /// Where the objective's error is under `error` first: the place in the lists.
  std::optional<std::size_t> first_under(double error) const;
  /// The objective's error after that time, between two entries along a line in a plot with logarithmic axes; 1 before
  /// the first one, the last one's behind it. `times` is one of the two lists above.
  double objective_error_at(double time, const std::vector<double>& times) const;
  double objective_error_at(double time) const { return objective_error_at(time, seconds); }
};

/// By Pliant: a step with each of these numbers of iterations, at most so many times, long ones once; times are without
/// the set-up.
Descent descend(const ExperimentContext& context, Problem& problem, const std::vector<int>& iterations, int repeats);

/// By Newton's method, until the objective falls no further; every iteration, with all its parts but the analysis.
Descent descend_by_newton(const Problem& problem, int repeats);

}  // namespace pliant_experiments
