#include "integrators/integrators.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "integrators/oscillator.h"
#include "integrators/whole_scenes.h"
#include "support/claims.h"

namespace pliant_experiments {
namespace {

using pliant_report::Chapter;
using pliant_report::Mark;
using pliant_report::Plot;
using pliant_report::Series;
using pliant_report::Table;

void measure_losses(const ExperimentContext& context, Chapter& chapter) {
  context.say("losses of the oscillator");
  Plot plot{
      .title = "Loss of amplitude in a period",
      .caption =
          "Two masses on a spring, undamped: by what share the amplitude falls in one period, over the time step.",
      .x = {.label = "hω", .is_logarithmic = true},
      .y = {.label = "loss of amplitude", .is_logarithmic = true},
      .series = {},
      .guides = {{0.3, "hω = 0.3", true}}};
  Table table{
      "Loss of amplitude in a period at hω = 0.3 (21 steps a period). Cost: iterations a step; energy projection costs "
      "two to three more.",
      {"integrator", "loss [%]", "of implicit Euler's", "cost"},
      {}};
  std::vector<double> at_03;
  const auto add_row = [&](const Method& method, double loss) {
    table.rows.push_back({method.name, fmt::format("{:.1f}", 100 * loss), fmt::format("{:.3f}", loss / at_03.front()),
                          fmt::format("{}{}", method.substeps, method.energy_projection > 0 ? " + 3" : "")});
  };
  for (const Method& method : methods()) {
    Series series{.name = method.name, .mark = Mark::line_and_points, .color = method.color};
    for (const double h_omega : {0.01, 0.02, 0.05, 0.1, 0.2, 0.3, 0.5, 1.0}) {
      const double loss = loss_a_period(context, method, h_omega);
      series.x.push_back(h_omega);
      series.y.push_back(loss);
      if (h_omega == 0.3) at_03.push_back(loss);
    }
    plot.series.push_back(std::move(series));
    add_row(method, at_03.back());
  }
  chapter.claims.push_back(claim(
      "BDF2 loses at most a tenth of the amplitude that implicit Euler loses, at hω = 0.3", "",
      at_03.back() <= 0.1 * at_03.front(),
      fmt::format(
          "{:.1f} % a period against {:.1f} %, at the same cost; four substeps, at four times the cost, lose {:.1f} %",
          100 * at_03.back(), 100 * at_03.front(), 100 * at_03[2])));
  double projected = 0;
  for (const Method& method : projected_methods()) {
    add_row(method, loss_a_period(context, method, 0.3));
    for (const double h_omega : {0.01, 0.1, 0.3, 1.0}) {
      projected = std::max(projected, std::abs(loss_a_period(context, method, h_omega)));
    }
  }
  chapter.claims.push_back(
      claim("With energy projection the oscillator loses nothing, up to hω = 1", "", projected < 1e-6,
            fmt::format("at most {:.1e} of the amplitude a period, in either integrator", projected)));
  chapter.blocks.emplace_back(std::move(plot));
  chapter.blocks.emplace_back(std::move(table));
}

void measure_order(const ExperimentContext& context, Chapter& chapter) {
  context.say("order of the integrators");
  Plot plot{.title = "Error of the oscillator",
            .caption =
                "Root mean square of the error over two periods, over the time step: implicit Euler is of first order, "
                "BDF2 of second.",
            .x = {.label = "h / period", .is_logarithmic = true},
            .y = {.label = "error [m]", .is_logarithmic = true},
            .series = {}};
  double least = 1e300;
  double most = 0;
  for (const Method& method : {methods().front(), methods().back()}) {
    Series series{.name = method.name, .mark = Mark::line_and_points, .color = method.color};
    double last = 0;
    for (const int steps : {100, 200, 400, 800, 1600}) {
      const double error = error_of(context, method, steps);
      series.x.push_back(1.0 / steps);
      series.y.push_back(error);
      if (method.integrator == pliant::Integrator::bdf2 && last > 0) {
        least = std::min(least, last / error);
        most = std::max(most, last / error);
      }
      last = error;
    }
    plot.series.push_back(std::move(series));
  }
  chapter.claims.push_back(claim(
      "BDF2 is of second order: halving the time step leaves a quarter of the error", "", least >= 3.6 && most <= 4.4,
      fmt::format("the error falls by {:.2f} to {:.2f} with each of four halvings", least, most)));
  chapter.blocks.emplace_back(std::move(plot));
}

void measure_stability(const ExperimentContext& context, Chapter& chapter) {
  context.say("large steps");
  const auto largest_of = [&](const std::vector<Method>& list) {
    double largest = 0;
    for (const Method& method : list) {
      for (const double h_omega : {0.1, 1.0, 3.0, 10.0, 30.0, 100.0}) {
        largest = std::max(largest, largest_extension(context, method, h_omega));
      }
    }
    return largest;
  };
  const double largest = largest_of(methods());
  const double projected = largest_of(projected_methods());
  chapter.claims.push_back(
      claim("The oscillator is stable at every time step up to hω = 100, in all integrators", "",
            largest <= 1 + 1e-9 && projected <= 1 + 1e-3,
            fmt::format("the largest extension in 2000 steps is {:.6f} of the first, with energy projection {:.6f}",
                        largest, projected)));
}

void measure_damping(const ExperimentContext& context, Chapter& chapter) {
  context.say("damping");
  Table table{
      "Decay of the oscillator's amplitude by the setting “damping”: the rate measured with it less the one without, ω "
      "= 2π/s, h = 0.01 s.",
      {"damping [1/s]", "integrator", "measured [1/s]", "difference [%]"},
      {}};
  double worst = 0;
  for (const double damping : {0.1, 0.5, 1.0}) {
    for (const Method& method : {methods().front(), methods().back()}) {
      const double rate = decay_rate(context, method, 0.01, damping) - decay_rate(context, method, 0.01, 0);
      const double difference = std::abs(rate / damping - 1);
      worst = std::max(worst, difference);
      table.rows.push_back({fmt::format("{}", damping), method.name, fmt::format("{:.5f}", rate),
                            fmt::format("{:.2f}", 100 * difference)});
    }
  }
  chapter.claims.push_back(claim("Damping c lets an oscillation decay as e^(−ct), besides what the integrator takes",
                                 "", worst < 0.01, fmt::format("the rate is met within {:.2f} %", 100 * worst)));
  const DampedFlight flight = measure_damped_flight(context);
  chapter.claims.push_back(claim(
      "Damping leaves momentum, angular momentum and free fall alone", "",
      std::max({flight.momentum, flight.angular_momentum, flight.fall}) < 1e-9,
      fmt::format(
          "a torus that falls, turns and vibrates, damped by 5/s, 60 steps: of the momentum {:.1e}, of the angular "
          "momentum {:.1e} is changed by the damping of a step, of the way it falls {:.1e} by that of all",
          flight.momentum, flight.angular_momentum, flight.fall)));
  chapter.blocks.emplace_back(std::move(table));
}

}  // namespace

Chapter run_integrators(const ExperimentContext& context) {
  Chapter chapter;
  chapter.question =
      "Implicit Euler damps, which more iterations cannot repair. BDF2 and substeps use the same factor of a constant "
      "matrix: how much less do they lose, on an oscillator whose motion is known and on the curtain of the damping "
      "experiment? Does energy projection, which gives back what a step has lost, stay calm, and move bodies as it "
      "should? And does the setting “damping”, for those who want more of it, do what it says?";
  measure_losses(context, chapter);
  measure_order(context, chapter);
  measure_stability(context, chapter);
  measure_curtain(context, chapter);
  measure_liveliness(context, chapter);
  measure_builtin_scenes(context, chapter);
  measure_energy_gains(context, chapter);
  measure_damping(context, chapter);
  return chapter;
}

}  // namespace pliant_experiments
