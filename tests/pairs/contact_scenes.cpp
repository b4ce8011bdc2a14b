// Runs the scenes by which contact between surfaces is judged, and counts crossings after every step.
//
//     contact_scenes --list
//     contact_scenes twist fold --vertices 1600 --iterations 3
//     contact_scenes all --vary --share 2/4
//     contact_scenes tower arch --vertices 1300 --friction 0.6 --every 600
//
// Exits with 1 when anything crossed.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "pliant/collision/crossings.h"
#include "tests/pairs/masonry_scenes.h"
#include "tests/pairs/pair_scene.h"

namespace {

using namespace pliant;
using namespace pliant_tests;

/// A scene with what is other than usual about it.
struct Run {
  std::string scene;
  std::string what;
  PairOptions options;
};

struct Arguments {
  std::vector<std::string> scenes;
  std::string integrator = "implicit_euler";
  std::string share = "1/1";
  std::string folder;
  Index frames = 0;
  Index every = 0;
  Index piles = 1;
  bool is_list = false;
  bool has_variations = false;
  PairOptions options;
};

/// What a run ended with.
struct Figures {
  Index frames = 0;
  std::int64_t crossings = 0;
  Index frames_crossed = 0;
  Real smallest_gap = std::numeric_limits<Real>::infinity();
  std::int64_t shortened = 0;
  Index pairs = 0;              // most of a step
  Real lag = 0;                 // largest of a step [m]
  Real momentum_lost = 0;       // sum over all steps [N s]
  Real energy = 0;              // kinetic, elastic and potential at the end, less that of the start [J]
  Real most_energy = 0;         // of a step
  std::vector<double> seconds;  // of the processor
};

/// How its bodies stand after so many frames, and what the last of them has done.
void print_standing(const Simulation& simulation, Index frames, Real energy, double seconds, const StepReport& report) {
  const Standing now = standing(simulation);
  fmt::print(
      "  frame {:5} highest {:.5f} m sag {:.5f} m sideways {:.6f} m fastest {:.1e} m/s rms {:.1e} m/s energy {:+.2e} J "
      "lag {:.1e} m {:5.0f} ms lost {:.1e} N s active {:4} shortened {:4} backtracks {:2} factors {} residual {:.1e} "
      "N\n",
      frames, now.highest, now.sag, now.sideways, now.fastest, rms_speed(simulation), energy, report.contact.lag,
      1e3 * seconds, report.contact.momentum_lost.norm(), report.contact.active, report.contact.shortened,
      report.backtracks, report.contact.refactorizations, report.residual);
  std::fflush(stdout);
}

/// Each body in a file of its own, body_frame.obj.
void write_bodies(const Simulation& simulation, const std::string& folder, Index frame) {
  for (std::size_t b = 0; b < simulation.bodies().size(); ++b) {
    const Body& body = simulation.bodies()[b];
    std::string text;
    for (Index i = 0; i < body.mesh.vertex_count(); ++i) {
      const Vec3 x = row(simulation.state().positions, body.first_vertex + i);
      text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", x.x(), x.y(), x.z());
    }
    for (const auto& [p, q, r] : surface_triangles(body.mesh)) text += fmt::format("f {} {} {}\n", p + 1, q + 1, r + 1);
    std::ofstream(fmt::format("{}/{}_{:04}.obj", folder, b, frame)) << text;
  }
}

Figures measure(PairScene& scene, Index frames, Index every, const std::string& folder) {
  Figures figures;
  const Real energy = total_energy(scene.simulation);
  for (Index i = 0; i < frames; ++i) {
    const std::clock_t begin = std::clock();
    const StepReport report = scene.step();
    const ContactReport& contact = report.contact;
    figures.seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    ++figures.frames;
    const std::int64_t crossings = count_crossings(scene.simulation);
    figures.crossings += crossings;
    figures.frames_crossed += crossings > 0 ? 1 : 0;
    figures.smallest_gap = std::min(figures.smallest_gap, contact.smallest_gap);
    figures.shortened += contact.shortened;
    figures.pairs = std::max(figures.pairs, contact.pairs);
    figures.lag = std::max(figures.lag, contact.lag);
    figures.energy = total_energy(scene.simulation) - energy;
    figures.most_energy = std::max(figures.most_energy, figures.energy);
    figures.momentum_lost += contact.momentum_lost.norm();
    if (!folder.empty() && (i + 1) % std::max<Index>(1, every) == 0) write_bodies(scene.simulation, folder, i + 1);
    if (every > 0 && (i + 1) % every == 0)
      print_standing(scene.simulation, i + 1, figures.energy, figures.seconds.back(), report);
  }
  return figures;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Runs it and prints its line. Returns whether nothing crossed.
bool run(const Run& each, Index frames, Index every, const std::string& folder) {
  const std::string title = each.what.empty() ? each.scene : each.scene + ", " + each.what;
  try {
    PairScene scene = make_pair_scene(each.scene, each.options);
    const bool begins_apart = count_crossings(scene.simulation) == 0;
    const Figures figures = measure(scene, frames > 0 ? frames : scene.frames(), every, folder);
    fmt::print(
        "{:36} {:6} vertices {:5} frames {:6} crossings in {:4} gap {:8.2e} m shortened {:8} pairs {:7} "
        "{:8.2f} ms, at most {:6.0f} lag {:.1e} m rms {:.1e} m/s lost {:.1e} N s energy {:+.1e} J, at most {:+.1e} "
        "J{}\n",
        title, scene.simulation.state().vertex_count(), figures.frames, figures.crossings, figures.frames_crossed,
        figures.smallest_gap, figures.shortened, figures.pairs, 1e3 * median(figures.seconds),
        1e3 * *std::max_element(figures.seconds.begin(), figures.seconds.end()), figures.lag,
        rms_speed(scene.simulation), figures.momentum_lost, figures.energy, figures.most_energy,
        begins_apart ? "" : " BEGINS CROSSED");
    std::fflush(stdout);
    return begins_apart && figures.crossings == 0;
  } catch (const std::exception& error) {
    fmt::print("{:36} FAILED: {}\n", title, error.what());
    std::fflush(stdout);
    return false;
  }
}

/// The run and, each by itself, what the scene must bear besides.
void add_variations(const Run& usual, std::vector<Run>& runs) {
  const auto vary = [&](const std::string& what, auto&& change) {
    runs.push_back(usual);
    runs.back().what = what;
    change(runs.back().options);
  };
  for (const Index iterations : {1, 3, 30}) {
    vary(fmt::format("{} iterations", iterations), [&](PairOptions& o) { o.settings.iterations = iterations; });
  }
  vary("h = 1/240", [](PairOptions& o) { o.settings.time_step = 1.0 / 240; });
  vary("h = 1/15", [](PairOptions& o) { o.settings.time_step = 1.0 / 15; });
  vary("bdf2", [](PairOptions& o) { o.settings.integrator = Integrator::bdf2; });
  vary("dragged", [](PairOptions& o) { o.drag = 1e6; });
  vary("distance halved", [](PairOptions& o) { o.distance_scale /= 2; });
  vary("distance doubled", [](PairOptions& o) { o.distance_scale *= 2; });
  if (usual.scene != "twist") {
    vary("thrown at 30 m/s", [](PairOptions& o) { o.speed = 30; });
  }
}

std::vector<Run> runs_of(const Arguments& arguments) {
  std::vector<Run> runs;
  for (const PairSceneEntry& entry : pair_scenes()) {
    const std::string name(entry.name);
    const auto& asked = arguments.scenes;
    const auto is_asked = [&](const std::string& other) {
      return std::find(asked.begin(), asked.end(), other) != asked.end();
    };
    if (!is_asked("all") && !is_asked(name)) continue;
    const Run usual{name, "", arguments.options};
    runs.push_back(usual);
    if (arguments.has_variations) add_variations(usual, runs);
    for (Index i = 1; name == "pile" && i < arguments.piles; ++i) {
      runs.push_back(usual);
      runs.back().what = fmt::format("seed {}", arguments.options.seed + static_cast<std::uint64_t>(i));
      runs.back().options.seed += static_cast<std::uint64_t>(i);
    }
  }
  return runs;
}

void read(int argc, char** argv, Arguments& to, CLI::App& app) {
  app.add_option("scenes", to.scenes, "names of scenes, or `all`");
  app.add_flag("--list", to.is_list, "print what would be run, or all scenes, and stop");
  app.add_flag("--vary", to.has_variations, "each scene also with other iterations, time steps, distances, speeds");
  app.add_option("--vertices", to.options.vertices, "about so many in all")->check(CLI::Range(16, 10'000'000));
  app.add_option("--iterations", to.options.settings.iterations, "in each step")->check(CLI::Range(1, 1'000'000));
  app.add_option("--time-step", to.options.settings.time_step, "h [s]")->check(CLI::PositiveNumber);
  app.add_option("--substeps", to.options.settings.substeps, "of each step")->check(CLI::Range(1, 1'000'000));
  app.add_option("--threads", to.options.settings.threads, "at most; 0: as many as pay")->check(CLI::Range(0, 1024));
  app.add_option("--damping", to.options.settings.damping, "of vibrations [1/s]")->check(CLI::NonNegativeNumber);
  app.add_option("--integrator", to.integrator, "how a step is made")->check(CLI::IsMember({"implicit_euler", "bdf2"}));
  app.add_option("--friction", to.options.contact.friction, "of all surfaces")->check(CLI::NonNegativeNumber);
  app.add_option("--distance-scale", to.options.distance_scale, "times the usual distance")->check(CLI::PositiveNumber);
  app.add_option("--drag", to.options.drag, "of a vertex of the last body that goes round in a circle [N/m]; 0: none");
  app.add_option("--speed", to.options.speed, "downward at the start [m/s]");
  app.add_option("--frames", to.frames, "steps; 0: what the scene takes")->check(CLI::Range(0, 100'000'000));
  app.add_option("--every", to.every, "print how bodies stand each so many steps; 0: not")
      ->check(CLI::Range(0, 100'000'000));
  app.add_option("--turn", to.options.turn, "in which a figure turns once about itself [s]")
      ->check(CLI::PositiveNumber);
  app.add_option("--write", to.folder, "a folder for the bodies as OBJ files, of the steps of --every");
  app.add_option("--seed", to.options.seed, "of what is drawn by chance");
  app.add_option("--piles", to.piles, "so many piles, each of another seed")->check(CLI::Range(1, 1'000'000));
  app.add_option("--share", to.share, "i/n: the i-th of n parts of the runs");
  app.parse(argc, argv);
  if (to.integrator == "bdf2") to.options.settings.integrator = Integrator::bdf2;
}

/// Leaves every n-th run, from the i-th on.
std::vector<Run> share_of(const std::vector<Run>& runs, const std::string& share) {
  unsigned part = 0, parts = 0;
  char rest = 0;
  if (std::sscanf(share.c_str(), "%u/%u%c", &part, &parts, &rest) != 2 || part < 1 || part > parts) {
    throw CLI::ValidationError("--share", "'" + share + "' is no share; give i/n with 1 <= i <= n, such as 2/4");
  }
  std::vector<Run> mine;
  for (std::size_t i = part - 1; i < runs.size(); i += parts) mine.push_back(runs[i]);
  return mine;
}

int run_program(const Arguments& arguments) {
  for (const std::string& name : arguments.scenes) {
    if (name != "all") static_cast<void>(make_pair_scene(name, {.vertices = 16}));  // throws on an unknown name
  }
  if (arguments.scenes.empty()) {
    for (const PairSceneEntry& entry : pair_scenes()) fmt::print("{:18}{}\n", entry.name, entry.about);
    return 0;
  }
  bool is_clean = true;
  for (const Run& each : share_of(runs_of(arguments), arguments.share)) {
    if (arguments.is_list) {
      fmt::print("{}{}{}\n", each.scene, each.what.empty() ? "" : ", ", each.what);
    } else {
      is_clean &= run(each, arguments.frames, arguments.every, arguments.folder);
    }
  }
  return is_clean ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Scenes of contact between surfaces, with crossings counted after every step.");
  Arguments arguments;
  try {
    read(argc, argv, arguments, app);
    return run_program(arguments);
  } catch (const CLI::ParseError& error) {
    return app.exit(error);
  } catch (const std::exception& error) {
    fmt::print(stderr, "contact_scenes: {}\n", error.what());
    return 2;
  }
}
