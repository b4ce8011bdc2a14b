#include "convergence/convergence.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "convergence/descent.h"

namespace pliant_experiments {
namespace {

using namespace pliant;
using namespace pliant_report;

constexpr int steps_before = 36;           // six after the sheet is let go
constexpr double pull_per_stiffness = .1;  // [m]: as far as that the softer and the stiffer sheet are pulled alike
constexpr double soft_springs = 1e3;       // [N/m]
constexpr double stiff_springs = 1e5;
constexpr int small = 31;  // vertices a side
constexpr int large = 81;
constexpr int timing_repeats = 7;
constexpr double reached_objective_error = 1e-10;
constexpr double reached_position_error = 1e-5;  // its square is the share of a quadratic objective

constexpr int projective_color = 0;
constexpr int newton_color = 1;

/// One step of one sheet, and how both methods fare in it.
struct Case {
  int size;
  double stiffness;
  Problem problem;
  Descent projective{};
  Descent newton{};
  StepReport set_up{};         ///< of Pliant's first step
  NewtonTimes newton_times{};  ///< of all its iterations
  std::int64_t newton_factor = 0;
  double rise = 0;          ///< largest rise of the objective from one iterate to the next, of the objective
  std::size_t watched = 0;  ///< iterations in which it was looked for

  std::string sheet() const { return fmt::format("{0} × {0}, k = {1:g} N/m", size, stiffness); }
  bool is_stiff() const { return stiffness == stiff_springs; }
  double seconds_per_iteration() const { return projective.seconds.back() / projective.iterations.back(); }
};

std::vector<int> counts_up_to(int most) {
  std::vector<int> counts;
  for (int decade = 1; decade <= most; decade *= 10) {
    for (const int digit : {1, 2, 5}) {
      if (digit * decade <= most) counts.push_back(digit * decade);
    }
  }
  return counts;
}

double largest_rise(std::span<const Real> history) {
  double rise = 0;
  for (std::size_t i = 1; i < history.size(); ++i) {
    rise = std::max(rise, (history[i] - history[i - 1]) / history[i - 1]);
  }
  return rise;
}

Case measure(const ExperimentContext& context, int size, double stiffness, int most_iterations) {
  context.say(fmt::format("{0} × {0} vertices, k = {1:g} N/m", size, stiffness));
  Scene scene = context.scene(
      "convergence/trampoline",
      {fmt::format("bodies[sheet].mesh.columns={}", size), fmt::format("bodies[sheet].mesh.rows={}", size),
       fmt::format("bodies[sheet].constraints[springs].stiffness={}", stiffness),
       fmt::format("forces[0].force=[0,0,{}]", -pull_per_stiffness * stiffness)});
  context.disturb(scene);
  const StepReport set_up = context.step(scene);
  Case result{size, stiffness, problem_after(context, std::move(scene), steps_before - 1)};
  result.set_up = set_up;
  result.projective = descend(context, result.problem, counts_up_to(most_iterations), timing_repeats);
  result.rise = largest_rise(result.problem.scene.simulation.objective_history());
  result.watched = result.problem.scene.simulation.objective_history().size();
  result.newton = descend_by_newton(result.problem, timing_repeats);
  Newton newton(result.problem.model);
  Positions q = result.problem.step.predicted;
  newton.minimize(result.problem.step, q, result.problem.newton_iterations);
  result.newton_times = newton.times();
  result.newton_factor = newton.factor_entries();
  return result;
}

/// Where Newton's method is ahead first: the place in its lists.
std::optional<std::size_t> overtaking(const Case& of) {
  for (std::size_t i = 0; i < of.newton.seconds.size(); ++i) {
    if (of.newton.objective_errors[i] < of.projective.objective_error_at(of.newton.seconds[i])) return i;
  }
  return std::nullopt;
}

// ---- plots

Series series(const Case& of, bool is_newton, std::vector<double> x, std::vector<double> y) {
  return {.name = fmt::format("{}, k = {:g} N/m", is_newton ? "Newton" : "Projective Dynamics", of.stiffness),
          .x = std::move(x),
          .y = std::move(y),
          .mark = is_newton ? Mark::line_and_points : Mark::line,
          .is_dashed = of.is_stiff(),
          .color = is_newton ? newton_color : projective_color};
}

Plot over_iterations(const std::vector<const Case*>& cases, std::vector<double> Descent::*errors, std::string label) {
  Plot plot{.x = {.label = "iterations", .is_logarithmic = true},
            .y = {.label = std::move(label), .is_logarithmic = true, .min = 1e-14, .max = 2.},
            .series = {}};
  for (const Case* of : cases) {
    for (const bool is_newton : {false, true}) {
      const Descent& descent = is_newton ? of->newton : of->projective;
      plot.series.push_back(
          series(*of, is_newton, {descent.iterations.begin(), descent.iterations.end()}, descent.*errors));
    }
  }
  return plot;
}

/// The curve of Newton's method goes down in stairs: what is not yet finished is of no use.
Series stairs(const Case& of, double first_time) {
  std::vector<double> x = {first_time * 1e3};
  std::vector<double> y = {1};
  for (std::size_t i = 0; i < of.newton.seconds.size(); ++i) {
    x.insert(x.end(), 2, of.newton.seconds[i] * 1e3);
    y.insert(y.end(), {y.back(), of.newton.objective_errors[i]});
  }
  Series found = series(of, true, std::move(x), std::move(y));
  found.mark = Mark::line;
  return found;
}

Plot over_time(const std::vector<const Case*>& cases) {
  Plot plot{.x = {.label = "time [ms]", .is_logarithmic = true},
            .y = {.label = "objective above its minimum, of that at the start",
                  .is_logarithmic = true,
                  .min = 1e-12,
                  .max = 2.},
            .series = {}};
  for (const Case* of : cases) {
    std::vector<double> milliseconds;
    for (const double seconds : of->projective.seconds) milliseconds.push_back(seconds * 1e3);
    plot.series.push_back(series(*of, false, std::move(milliseconds), of->projective.objective_errors));
    plot.series.push_back(stairs(*of, of->projective.seconds.front()));
  }
  return plot;
}

// ---- tables

Table costs(const std::vector<const Case*>& cases) {
  Table table{
      "What is paid once, and what in each iteration, on one thread, the least of repeats. Projective Dynamics "
      "factorizes an m × m matrix "
      "once; Newton's method one of 3m × 3m in each iteration (sparse Cholesky of Eigen).",
      {"sheet", "PD: set-up [ms]", "PD: iteration [ms]", "Newton: analysis [ms]", "Newton: iteration [ms]",
       "of it factorization", "PD iterations in one of Newton's", "entries of Newton's factor"}};
  for (const Case* of : cases) {
    const NewtonTimes& times = of->newton_times;
    const double newton = of->newton.seconds.back() / of->newton.iterations.back();
    table.rows.push_back(
        {of->sheet(), fmt::format("{:.2f}", of->set_up.seconds_factor * 1e3),
         fmt::format("{:.3f}", of->seconds_per_iteration() * 1e3), fmt::format("{:.2f}", times.analysis * 1e3),
         fmt::format("{:.2f}", newton * 1e3), fmt::format("{:.0f} %", 100 * times.factorization / times.iterations()),
         fmt::format("{:.0f}", newton / of->seconds_per_iteration()), fmt::format("{}", of->newton_factor)});
  }
  return table;
}

std::string iterations_under(const Descent& descent, double error) {
  const std::optional<std::size_t> place = descent.first_under(error);
  return place ? fmt::format("{}", descent.iterations[*place]) : "–";
}

std::string milliseconds_under(const Descent& descent, double error) {
  const std::optional<std::size_t> place = descent.first_under(error);
  return place ? fmt::format("{:.2f}", descent.seconds[*place] * 1e3) : "–";
}

Table efforts(const std::vector<const Case*>& cases) {
  Table table{
      "Iterations and time, the least of repeats, until the objective's error is under a bound for the first time, "
      "among "
      "the numbers of iterations that were tried. –: not reached.",
      {"sheet", "error under", "PD: iterations", "Newton: iterations", "PD [ms]", "Newton [ms]"}};
  for (const Case* of : cases) {
    for (const double error : {1e-1, 1e-2, 1e-3, 1e-6, 1e-9}) {
      table.rows.push_back({of->sheet(), fmt::format("{:.0e}", error), iterations_under(of->projective, error),
                            iterations_under(of->newton, error), milliseconds_under(of->projective, error),
                            milliseconds_under(of->newton, error)});
    }
  }
  return table;
}

// ---- claims

Claim reaches_minimum(const std::vector<const Case*>& cases) {
  Claim claim{"Projective Dynamics converges to the minimum that Newton's method finds", "Bouaziz et al. 2014",
              Verdict::holds};
  for (const Case* of : cases) {
    const double objective_error = std::abs(of->projective.objective_errors.back());
    const double position_error = of->projective.position_errors.back();
    if (!(objective_error <= reached_objective_error && position_error <= reached_position_error)) {
      claim.verdict = Verdict::fails;
    }
    claim.evidence += fmt::format(
        "{}: after {} iterations {:.1e} of the objective's first error is left, and {:.1e} of the positions'. ",
        of->sheet(), of->projective.iterations.back(), objective_error, position_error);
  }
  claim.evidence += fmt::format("Asked for: {:.0e} and {:.0e}.", reached_objective_error, reached_position_error);
  return claim;
}

Claim never_rises(const std::vector<const Case*>& cases) {
  Claim claim{"No iteration raises the objective", "Bouaziz et al. 2014", Verdict::holds};
  double rise = 0;
  std::size_t watched = 0;
  for (const Case* of : cases) {
    rise = std::max(rise, of->rise);
    watched = std::max(watched, of->watched);
  }
  constexpr double rounding = 1e-12;
  if (rise > rounding) claim.verdict = Verdict::fails;
  claim.evidence = fmt::format(
      "The largest rise from one iterate to the next, in the first {} iterations of each run, is {:.1g} of the "
      "objective.",
      watched, rise);
  return claim;
}

Claim needs_fewer(const std::vector<const Case*>& cases) {
  Claim claim{"Newton's method needs far fewer iterations", "Bouaziz et al. 2014", Verdict::holds};
  constexpr double error = 1e-6;
  for (const Case* of : cases) {
    const std::optional<std::size_t> projective = of->projective.first_under(error);
    const std::optional<std::size_t> newton = of->newton.first_under(error);
    if (!newton || (projective && of->projective.iterations[*projective] < 10 * of->newton.iterations[*newton])) {
      claim.verdict = Verdict::fails;
    }
    claim.evidence += fmt::format("{}: {} against {} to an error of {:.0e}. ", of->sheet(),
                                  iterations_under(of->newton, error), iterations_under(of->projective, error), error);
  }
  return claim;
}

std::string overtaking_text(const Case& of) {
  const std::optional<std::size_t> place = overtaking(of);
  if (!place) return fmt::format("{}: it is not overtaken in the time that was measured. ", of.sheet());
  const double seconds = of.newton.seconds[*place];
  return fmt::format("{}: overtaken by Newton's iterate {} after {:.1f} ms, at an error of {:.1e}, then {:.1e}. ",
                     of.sheet(), *place + 1, seconds * 1e3, of.projective.objective_error_at(seconds),
                     of.newton.objective_errors[*place]);
}

/// The small sheet's times are too close to each other to judge by.
Claim ahead_at_first(const std::vector<const Case*>& cases) {
  Claim claim{
      "On a large sheet, Projective Dynamics gets further than Newton's first iteration does while that one is under "
      "way",
      "Bouaziz et al. 2014", Verdict::holds};
  for (const Case* of : cases) {
    const double projective = of->projective.objective_error_at(of->newton.seconds.front());
    const double newton = of->newton.objective_errors.front();
    // The slowest of its repeats against Newton's quickest, and the other way round.
    const double late = of->projective.objective_error_at(of->newton.seconds.front(), of->projective.most_seconds);
    const double early = of->projective.objective_error_at(of->newton.most_seconds.front());
    const bool is_in_noise = (late < newton) != (early < newton);
    if (of->size == large && is_in_noise && claim.verdict == Verdict::holds) claim.verdict = Verdict::reported;
    if (of->size == large && !is_in_noise && early > newton) claim.verdict = Verdict::fails;
    claim.evidence += fmt::format("{}: {:.1e} against {:.1e} after {:.1f} ms{}. ", of->sheet(), projective, newton,
                                  of->newton.seconds.front() * 1e3, is_in_noise ? ", within the noise of repeats" : "");
  }
  return claim;
}

Claim overtaken(const std::vector<const Case*>& cases) {
  Claim claim{"Projective Dynamics is ahead until the error is small, then Newton's method is", "Bouaziz et al. 2014",
              Verdict::reported};
  for (const Case* of : cases) claim.evidence += overtaking_text(*of);
  return claim;
}

void add_plots(Chapter& chapter, const std::vector<const Case*>& small_sheets,
               const std::vector<const Case*>& large_sheets) {
  Plot plot =
      over_iterations(small_sheets, &Descent::objective_errors, "objective above its minimum, of that at the start");
  plot.title = "Error of the objective over iterations";
  plot.caption =
      "31 × 31 vertices. Newton's method doubles its correct digits with each of its last iterations. Projective "
      "Dynamics gains them at its own pace, which is the slower, the stiffer the springs are against the inertia M/h².";
  chapter.blocks.emplace_back(std::move(plot));
  plot = over_iterations(small_sheets, &Descent::position_errors, "distance from the minimum, of that at the start");
  plot.title = "Error of the positions over iterations";
  plot.caption =
      "The same iterates, their distance weighted by the masses. The first iterations of Projective Dynamics bring the "
      "sheet no nearer to its place: they correct lengths, where most of the energy is.";
  chapter.blocks.emplace_back(std::move(plot));
  plot = over_time(small_sheets);
  plot.title = "Error of the objective over time, 31 × 31 vertices";
  plot.caption = "The least of repeats, on one thread. A step of the stairs is one iteration of Newton's method.";
  chapter.blocks.emplace_back(std::move(plot));
  plot = over_time(large_sheets);
  plot.title = "Error of the objective over time, 81 × 81 vertices";
  plot.caption =
      "The finer the sheet, the more iterations Projective Dynamics makes while Newton's method factorizes once.";
  chapter.blocks.emplace_back(std::move(plot));
}

}  // namespace

Chapter run_convergence(const ExperimentContext& context) {
  const Case soft_small = measure(context, small, soft_springs, 20000);
  const Case stiff_small = measure(context, small, stiff_springs, 200000);
  const Case soft_large = measure(context, large, soft_springs, 2000);
  const Case stiff_large = measure(context, large, stiff_springs, 2000);
  const std::vector<const Case*> small_sheets = {&soft_small, &stiff_small};
  const std::vector<const Case*> large_sheets = {&soft_large, &stiff_large};
  const std::vector<const Case*> all = {&soft_small, &stiff_small, &soft_large, &stiff_large};

  Chapter chapter;
  chapter.question =
      "Projective Dynamics and Newton's method minimize the same objective, one step of implicit Euler of a sheet of "
      "springs that was pulled down and let go. Both begin at the prediction. What is left of the error after so many "
      "iterations, and after so much time? Errors are those of the objective, and of the positions, against a minimum "
      "at which Newton's method finds no force beyond rounding.";
  for (const Claim& claim : {reaches_minimum(small_sheets), never_rises(all), needs_fewer(small_sheets),
                             ahead_at_first(all), overtaken(all)}) {
    chapter.claims.push_back(claim);
  }
  add_plots(chapter, small_sheets, large_sheets);
  chapter.blocks.emplace_back(costs(all));
  chapter.blocks.emplace_back(efforts(all));
  double gradient = 0;
  for (const Case* of : all) gradient = std::max(gradient, of->problem.largest_gradient / of->stiffness);
  chapter.blocks.emplace_back(Paragraph{
      fmt::format("At the minima that Newton's method ends at, the largest force left on a vertex is {:.0e} of k · 1 "
                  "m. Its times are those of a plain implementation with the sparse Cholesky factorization of Eigen.",
                  gradient)});
  return chapter;
}

}  // namespace pliant_experiments
