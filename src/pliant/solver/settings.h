#pragma once
// Everything about the solver that a user chooses. All of it may be changed between steps.
#include <algorithm>
#include <array>

#include "pliant/core/options.h"

namespace pliant {

/// What a step is made of. `implicit_euler`: first order, damps what vibrates faster than the step. `bdf2`: second
/// order (Gear's two-step formula), damps far less; its first step, and the one after a change of the time step, is one
/// of implicit Euler.
enum class Integrator { implicit_euler, bdf2 };
constexpr std::array<std::string_view, 2> choice_names(Integrator) {
  return {"implicit_euler", "bdf2"};
}

/// Where the iterations of a step begin. `prediction`: at s. `positions`: at qₙ. `adaptive`: at s with as much of the
/// forces as the last step's acceleration shows, so that what rests or hangs goes on from its balance
/// (solver/balanced_guess.h).
enum class Start { prediction, positions, adaptive };
constexpr std::array<std::string_view, 3> choice_names(Start) {
  return {"prediction", "positions", "adaptive"};
}

/// How a global solve becomes the next iterate. `none`: the plain algorithm. `lbfgs`: L-BFGS, with the factor as its
/// first guess of the inverse Hessian. `anderson`: Anderson acceleration. `chebyshev`: Chebyshev semi-iteration.
/// `automatic`: L-BFGS where there are colliders or surfaces that touch, since friction is wrong after a few iterations
/// without it, and where constraints have energies of their own, as elastic materials and taut fibres do; else none.
enum class Acceleration { automatic, none, lbfgs, anderson, chebyshev };
constexpr std::array<std::string_view, 5> choice_names(Acceleration) {
  return {"automatic", "none", "lbfgs", "anderson", "chebyshev"};
}

/// Which library factorizes the system matrix. `automatic`: CHOLMOD where this build has it, else Eigen.
enum class Backend { automatic, eigen, cholmod };
constexpr std::array<std::string_view, 3> choice_names(Backend) {
  return {"automatic", "eigen", "cholmod"};
}

/// In which order the vertices are eliminated. `nested_dissection` takes longer to find, and leaves a smaller factor of
/// a large mesh of cloth. `automatic`: minimum degree, but with CHOLMOD, where its factor has 64 entries a vertex or
/// more, whichever leaves fewer.
enum class Ordering { automatic, minimum_degree, nested_dissection };
constexpr std::array<std::string_view, 3> choice_names(Ordering) {
  return {"automatic", "minimum_degree", "nested_dissection"};
}

/// Precision of the factor; state, differences and sums are double in either. `mixed`: single, where that does.
enum class Precision { double_, mixed };
constexpr std::array<std::string_view, 2> choice_names(Precision) {
  return {"double", "mixed"};
}

/// In place of a number of iterations: as many as a step needs, see SolverSettings::step_error.
inline constexpr Index automatic_iterations = -1;
/// How many of those are taken before any have been found.
inline constexpr Index first_iterations = 20;

struct SolverSettings {
  /// h [s], > 0: a larger one is as stable, with more damping.
  Real time_step = 1.0 / 60;
  /// Implicit Euler, which damps, or BDF2, of second order, which damps far less.
  Integrator integrator = Integrator::implicit_euler;
  /// 1 to 1e6: a step is taken in so many parts, each with its iterations; more damp less, at their cost.
  Index substeps = 1;
  /// 1 to 1e9: local and global steps in each (sub)step; more are stiffer and livelier. `automatic_iterations`: as many
  /// as bring steps nearer to their end than `step_error`, found anew every now and then (simulation/step_error.h).
  Index iterations = 10;
  /// > 0: how far automatic iterations may leave a step from its end, as StepError::share.
  Real step_error = 0.25;
  /// 5 to 1e6: of automatic iterations no more than so many.
  Index most_iterations = 100;
  /// All but `none` are mostly far nearer to convergence after as many iterations, each 1 to 2.4 times as slow.
  Acceleration acceleration = Acceleration::automatic;
  /// c [1/s], ≥ 0: the amplitude of vibrations decays as e^(−ct); flight and turning of a body are left alone.
  Real damping = 0;
  /// 0 to 1: share of the energy that a step would lose, by itself, that each connected body is given back.
  Real energy_projection = 0;
  /// [N], ≥ 0: no further iteration once no vertex has a larger residual force; 0: only at exact rest.
  Real tolerance = 0;
  /// Where iterations begin: at the prediction s, at the positions of the last step, or between s with and without f.
  Start start = Start::prediction;
  /// Which library factorizes; results differ by rounding.
  Backend backend = Backend::automatic;
  /// Of the elimination: nested dissection takes longer to find and makes the steps of a large mesh faster.
  Ordering ordering = Ordering::automatic;
  /// Of the factor: `mixed` has it in single precision, where that does; what is converged to is the same.
  Precision precision = Precision::mixed;
  /// 0 to 1024: at most so many, fewer in small scenes; 0: as many as pay, found while running. Results do not depend
  /// on it.
  Index threads = 0;

  friend bool operator==(const SolverSettings&, const SolverSettings&) = default;

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"time_step", "s", "h; a larger one is as stable, with more damping", positive}, self.time_step);
    field(
        OptionInfo{"integrator", "", "`implicit_euler`, which damps, or `bdf2`, of second order, which damps far less"},
        self.integrator);
    field(OptionInfo{"substeps", "",
                     "a step is taken in so many parts, each with its iterations; more damp less, at their cost",
                     Range{1, 1e6}},
          self.substeps);
    field(OptionInfo{"iterations", "",
                     "local and global steps in each step; more are stiffer and livelier; `automatic`: as many as "
                     "`step_error` needs",
                     Range{1, 1e9}, "automatic", automatic_iterations},
          self.iterations);
    field(OptionInfo{"step_error", "",
                     "how far automatic iterations may leave a step from its end: as far as so much of the gravity of "
                     "the earth moves a body in a step",
                     positive},
          self.step_error);
    field(OptionInfo{"most_iterations", "", "of automatic iterations no more than so many", Range{5, 1e6}},
          self.most_iterations);
    field(
        OptionInfo{
            "acceleration", "",
            "`none`: the plain algorithm; `lbfgs`: L-BFGS, which is far nearer to convergence after the "
            "same number of iterations, each of them 1.1 to 2.1 times as slow; `chebyshev`: Chebyshev semi-iteration, "
            "as near for less time in most cloth without colliders; `anderson`: Anderson acceleration, the same in "
            "bars and chains; `automatic`: `lbfgs` where there are colliders, surfaces touch, or constraints have "
            "energies of their own, as elastic materials and taut fibres do"},
        self.acceleration);
    field(
        OptionInfo{
            "damping", "1/s",
            "of vibrations, whose amplitude it lets decay as e^(-damping t); the flight and turning of a body as a "
            "whole are left alone",
            not_negative},
        self.damping);
    field(
        OptionInfo{"energy_projection", "",
                   "share of the energy that a step would lose, by itself, that each connected body is given back; 0: "
                   "none, 1: all, so that undamped bodies swing on",
                   Range{0, 1}},
        self.energy_projection);
    field(OptionInfo{"tolerance", "N",
                     "iterate no further once no vertex has a larger residual force; 0: only at exact rest",
                     not_negative},
          self.tolerance);
    field(OptionInfo{"start", "",
                     "iterations begin at the `prediction` s, at the `positions` of the last step, or, `adaptive`, at "
                     "the prediction with as much of the forces as the last step's acceleration shows: what rests or "
                     "hangs stays in balance then"},
          self.start);
    visit_factorization(self, field);
  }

 private:
  template <class Self, class Visitor>
  static void visit_factorization(Self& self, Visitor&& field) {
    field(OptionInfo{"backend", "", "library that factorizes: `automatic`, `eigen` or `cholmod`"}, self.backend);
    field(OptionInfo{"ordering", "",
                     "of the elimination: `automatic`, `minimum_degree`, or `nested_dissection`, which takes longer to "
                     "find and makes the steps of a large mesh faster; with `cholmod`"},
          self.ordering);
    field(
        OptionInfo{
            "precision", "",
            "of the factor: `mixed` has it in single precision, where that does; what is converged to is the same"},
        self.precision);
    field(
        OptionInfo{
            "threads", "",
            "at most, fewer in small scenes; 0: as many as pay, found while running; results do not depend on it",
            Range{0, 1024}},
        self.threads);
  }
};

/// Whether a step leaves velocities and positions before it to the next one.
inline bool keeps_history(const SolverSettings& settings) {
  return settings.integrator == Integrator::bdf2 || settings.start == Start::adaptive;
}

/// Those of a step: as given, or as they have been found (0: not yet).
inline Index iterations_of(const SolverSettings& settings, Index found) {
  if (settings.iterations != automatic_iterations) return settings.iterations;
  return std::min(found > 0 ? found : first_iterations, settings.most_iterations);
}

}  // namespace pliant
