// How right friction between surfaces is: how far what slides has come after a second, beside what implicit Euler makes
// of Coulomb's law.
//
//     pair_slopes --side 12 --side 40 --iterations 20
//     pair_slopes --scene rails --integrator bdf2
#include <cstdio>
#include <exception>
#include <map>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "tests/pairs/cloth_scenes.h"

namespace {

using namespace pliant;
using namespace pliant_tests;

struct Arguments {
  std::string scene = "sheet";
  std::vector<Index> sides{12};
  std::vector<Real> angles{16, 17, 30};
  std::string integrator = "implicit_euler";
  Index every = 0;
  PairOptions options;
};

/// BDF2 with its first step of implicit Euler under a constant acceleration a, from rest: x after n steps, over a.
Real bdf2_way(Index steps, Real h) {
  Real x = 0, v = 0, x_before = 0, v_before = 0;
  for (Index i = 0; i < steps; ++i) {
    Real v_next = v + h, x_next = x + h * v_next;
    if (i > 0) {
      v_next = (4 * v - v_before + 2 * h) / 3;
      x_next = (4 * x - x_before + 2 * h * v_next) / 3;
    }
    x_before = std::exchange(x, x_next);
    v_before = std::exchange(v, v_next);
  }
  return x;
}

/// A sheet of n × n, or rails of n links.
SlopeScene make(const Arguments& arguments, Index side, Real angle) {
  PairOptions options = arguments.options;
  if (arguments.scene == "rails") {
    options.vertices = 2 * side;
    return rails(options, angle);
  }
  if (arguments.scene == "ridges") {
    options.vertices = 6 * side;
    return ridges(options, angle);
  }
  options.vertices = 7 * side * side;
  return slope2(options, angle);
}

void run(const Arguments& arguments, Index side, Real angle) {
  SlopeScene slope = make(arguments, side, angle);
  const Index frames = slope.scene.frames();
  Index shortened = 0;
  for (Index i = 0; i < frames; ++i) {
    const StepReport report = slope.scene.step();
    shortened += report.contact.shortened;
    if (arguments.every > 0 && (i + 1) % arguments.every == 0) {
      fmt::print("  {:4} {:.6f} m, exact {:.6f} m, shortened {}, backtracks {}, residual {:.1e} N\n", i + 1,
                 slope.way(), slope.exact_way(i + 1), report.contact.shortened, report.backtracks, report.residual);
    }
  }
  Real exact = slope.exact_way(frames);
  if (arguments.options.settings.integrator == Integrator::bdf2) {
    const Real h = arguments.options.settings.time_step / static_cast<Real>(arguments.options.settings.substeps);
    const Index steps = frames * arguments.options.settings.substeps;
    exact *= bdf2_way(steps, h) / (h * h * static_cast<Real>(steps) * static_cast<Real>(steps + 1) / 2);
  }
  const std::string error = exact > 0 ? fmt::format("{:+.2f} %", 100 * (slope.way() / exact - 1)) : "";
  fmt::print("{:6} {:4} {:4.0f} degrees: {:.5f} m, exact {:.5f} m {:>9} shortened {} crossings {}\n", arguments.scene,
             side, angle, slope.way(), exact, error, shortened, count_crossings(slope.scene.simulation));
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Friction between surfaces, beside Coulomb's law.");
  Arguments arguments;
  SolverSettings& settings = arguments.options.settings;
  app.add_option("--scene", arguments.scene, "a sheet on a sheet; edges alone: a frame on rails, a solid on ridges")
      ->check(CLI::IsMember({"sheet", "rails", "ridges"}));
  app.add_option("--side", arguments.sides, "vertices of a side of the sheet, links of a rail")
      ->check(CLI::Range(1, 1000));
  app.add_option("--angle", arguments.angles, "of the slope [degrees]");
  app.add_option("--iterations", settings.iterations, "in each step")->check(CLI::Range(1, 1'000'000));
  app.add_option("--substeps", settings.substeps, "of each step")->check(CLI::Range(1, 1000));
  app.add_option("--threads", settings.threads, "at most")->check(CLI::Range(0, 1024));
  app.add_option("--integrator", arguments.integrator, "how a step is made")
      ->check(CLI::IsMember({"implicit_euler", "bdf2"}));
  app.add_option("--every", arguments.every, "print where it is each so many steps; 0: not")
      ->check(CLI::Range(0, 1'000'000));
  try {
    app.parse(argc, argv);
    if (arguments.integrator == "bdf2") settings.integrator = Integrator::bdf2;
    for (const Index side : arguments.sides) {
      for (const Real angle : arguments.angles) run(arguments, side, angle);
    }
    return 0;
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "pair_slopes: {}\n", error.what());
    return 2;
  }
}
