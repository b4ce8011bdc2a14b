// Runs the scenes by which contact between surfaces is judged, and counts crossings after every step.
//
//     contact_scenes --list
//     contact_scenes twist fold builtin/dress --vertices 1600 --iterations 3
//     contact_scenes all --vary --share 2/4
//     contact_scenes tower arch --vertices 1300 --friction 0.6 --every 600
//     contact_scenes everything --share 1/8 --log out/contact.log
//     contact_scenes all --vertices 1600 --bits --frames 60 --drag 1e4
//
// `everything` is what must hold before a release: scripts/check_contact.sh runs it. With --log a run whose line is
// there already is not done again, so what was broken off goes on.
//
// Exits with 1 when anything crossed, or with --bits when anything has other bits.
#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <map>
#include <ranges>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "pliant/core/error.h"
#include "tests/pairs/bits.h"
#include "tests/pairs/builtin_pair_scenes.h"
#include "tests/pairs/masonry_scenes.h"
#include "tests/pairs/pair_scene.h"

namespace {

using namespace pliant;
using namespace pliant_tests;

/// What names of built-in scenes begin with.
constexpr std::string_view builtin = "builtin/";

/// A scene with what is other than usual about it.
struct Run {
  std::string scene;
  std::string what;
  PairOptions options;
  Index frames = 0;  // 0: what the scene takes

  /// A drag may hold up pins of the same body, which are let go then.
  bool may_let_go() const { return is_builtin() && options.drag > 0; }
  bool is_builtin() const { return scene.starts_with(builtin); }
  std::string title() const {
    const std::string size = is_builtin() ? "" : fmt::format(" {}", options.vertices);
    return scene + size + (what.empty() ? "" : ", " + what);
  }
  PairScene make() const {
    if (is_builtin()) return make_builtin_pair_scene(scene.substr(builtin.size()), options);
    return make_pair_scene(scene, options);
  }
};

struct Arguments {
  std::vector<std::string> scenes;
  std::string integrator = "implicit_euler";
  std::string share = "1/1";
  std::string log;
  Index frames = 0;
  Index every = 0;
  double slow = 0;  // [s]
  Index piles = 1;
  bool is_list = false;
  bool has_variations = false;
  bool is_bits = false;
  PairOptions options;
};

/// What a run ended with.
struct Figures {
  Index frames = 0;
  std::int64_t crossings = 0;
  Index frames_crossed = 0;
  std::int64_t unknown = 0;  // crossings of what was not let go
  Index frames_let_go = 0;
  Real lag = 0;  // the largest [m]
  Real smallest_gap = std::numeric_limits<Real>::infinity();
  std::int64_t shortened = 0;
  Index pairs = 0;              // most of a step
  Real momentum_lost = 0;       // sum over all steps [N s]
  Real energy_taken = 0;        // sum over all steps [J]
  Real energy = 0;              // kinetic, elastic and potential at the end, less that of the start [J]
  Real most_energy = 0;         // of a step
  std::vector<double> seconds;  // of the processor
};

/// How its bodies stand after so many frames, and what the last of them has done.
void print_standing(const Simulation& simulation, Index frames, Real energy, const StepReport& report) {
  const Standing now = standing(simulation);
  fmt::print(
      "  frame {:5} highest {:.5f} m sag {:.5f} m sideways {:.6f} m fastest {:.1e} m/s rms {:.1e} m/s energy {:+.2e} J "
      "lost {:.1e} N s taken {:.1e} J active {:4} shortened {:4} backtracks {:2} factors {} residual {:.1e} N\n",
      frames, now.highest, now.sag, now.sideways, now.fastest, rms_speed(simulation), energy,
      report.contact.momentum_lost.norm(), report.contact.energy_taken, report.contact.active, report.contact.shortened,
      report.backtracks, report.contact.refactorizations, report.residual);
  std::fflush(stdout);
}

void print_slow(Index frame, double seconds, const StepReport& report) {
  const ContactReport& contact = report.contact;
  fmt::print(
      "  frame {:5} took {:.2f} s: pairs {} active {} shortened {} backtracks {} factors {} lag {:.1e} m let go {}\n",
      frame, seconds, contact.pairs, contact.active, contact.shortened, report.backtracks, contact.refactorizations,
      contact.lag, contact.let_go);
  std::fflush(stdout);
}

Figures measure(PairScene& scene, Index frames, Index every, double slow) {
  Figures figures;
  const Real energy = total_energy(scene.simulation);
  for (Index i = 0; i < frames; ++i) {
    const std::clock_t begin = std::clock();
    const StepReport report = scene.step();
    const ContactReport& contact = report.contact;
    figures.seconds.push_back(static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC);
    if (slow > 0 && figures.seconds.back() > slow) print_slow(i + 1, figures.seconds.back(), report);
    ++figures.frames;
    const std::int64_t crossings = count_crossings(scene.simulation);
    figures.crossings += crossings;
    figures.frames_crossed += crossings > 0 ? 1 : 0;
    if (crossings > 0) figures.unknown += count_unknown_crossings(scene.simulation);
    figures.smallest_gap = std::min(figures.smallest_gap, contact.smallest_gap);
    figures.shortened += contact.shortened;
    figures.frames_let_go += contact.let_go > 0 ? 1 : 0;
    figures.lag = std::max(figures.lag, contact.lag);
    figures.pairs = std::max(figures.pairs, contact.pairs);
    figures.energy = total_energy(scene.simulation) - energy;
    figures.most_energy = std::max(figures.most_energy, figures.energy);
    figures.momentum_lost += contact.momentum_lost.norm();
    figures.energy_taken += contact.energy_taken;
    if (every > 0 && (i + 1) % every == 0) print_standing(scene.simulation, i + 1, figures.energy, report);
  }
  return figures;
}

double median(std::vector<double> values) {
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Of a run, its line.
struct Outcome {
  std::string line;
  bool is_clean = false;
};

/// How many frames of the scene are asked for.
Index frames_of(const Run& run, const PairScene& scene, const Arguments& arguments) {
  const Index asked = run.frames > 0 ? run.frames : arguments.frames;
  return asked > 0 ? asked : scene.frames();
}

Outcome run(const Run& each, const Arguments& arguments) {
  try {
    PairScene scene = each.make();
    const bool begins_apart = count_crossings(scene.simulation) == 0;
    const Figures figures = measure(scene, frames_of(each, scene, arguments), arguments.every, arguments.slow);
    const double longest = *std::max_element(figures.seconds.begin(), figures.seconds.end());
    return {fmt::format("{:42} {:6} vertices {:5} frames {:6} crossings in {:4}, unknown {}, let go in {:4} gap "
                        "{:8.2e} m lag {:7.1e} "
                        "m shortened {:8} pairs {:7} {:8.2f} ms, longest {:8.1f} rms {:.1e} m/s lost {:.1e} N s "
                        "energy {:+.1e} J, at most {:+.1e} J taken {:.1e} J{}",
                        each.title(), scene.simulation.state().vertex_count(), figures.frames, figures.crossings,
                        figures.frames_crossed, figures.unknown, figures.frames_let_go, figures.smallest_gap,
                        figures.lag, figures.shortened, figures.pairs, 1e3 * median(figures.seconds), 1e3 * longest,
                        rms_speed(scene.simulation), figures.momentum_lost, figures.energy, figures.most_energy,
                        figures.energy_taken, begins_apart ? "" : " BEGINS CROSSED"),
            begins_apart && (figures.crossings == 0 || (each.may_let_go() && figures.unknown == 0))};
  } catch (const std::exception& error) {
    return {fmt::format("{:42} FAILED: {}", each.title(), error.what()), false};
  }
}

/// Whether it has the same bits with other numbers of threads, and where its state is restored in the middle into a
/// scene that was made anew. What built-in scenes do over time is no part of the state: `pliant resume` has it.
Outcome compare_bits(Run each, const Arguments& arguments) {
  Index most_threads = 1;
  const auto bits_with = [&](Index threads, bool is_restored) {
    each.options.settings.threads = threads;
    PairScene scene = each.make();
    const Index frames = frames_of(each, scene, arguments);
    for (Index i = 0; i < frames; ++i) {
      if (is_restored && i == frames / 2) {
        const State state = scene.simulation.state();
        scene = each.make();
        scene.simulation.restore(state);
      }
      scene.step();
    }
    most_threads = std::max(most_threads, scene.simulation.thread_count());
    return bits_of(scene.simulation);
  };
  try {
    const std::vector<Real> bits = bits_with(1, false);
    std::string others;
    for (const Index threads : {2, 3, 8}) {
      if (!same_bits(bits_with(threads, false), bits)) others += fmt::format(" with {} threads", threads);
    }
    if (!each.is_builtin() && !same_bits(bits_with(1, true), bits)) others += " after it was restored";
    return {fmt::format(
                "{:42} {}", each.title(),
                others.empty() ? fmt::format("the same bits, up to {} threads", most_threads) : "OTHER BITS" + others),
            others.empty()};
  } catch (const std::exception& error) {
    return {fmt::format("{:42} FAILED: {}", each.title(), error.what()), false};
  }
}

/// Whether something in it is free.
bool can_be_thrown(Run run) {
  if (!run.is_builtin()) return run.scene != "twist";
  run.options.speed = 1;
  try {
    static_cast<void>(run.make());
    return true;
  } catch (const Error&) {
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
  if (can_be_thrown(usual)) {
    vary("thrown at 30 m/s", [](PairOptions& o) { o.speed = 30; });
  }
}

void add_piles(const Run& usual, Index piles, std::vector<Run>& runs) {
  for (Index i = 1; i < piles; ++i) {
    runs.push_back(usual);
    runs.back().options.seed += static_cast<std::uint64_t>(i);
    runs.back().what = fmt::format("seed {}", runs.back().options.seed);
  }
}

std::vector<std::string> names_of_all() {
  std::vector<std::string> names;
  for (const PairSceneEntry& entry : pair_scenes()) names.emplace_back(entry.name);
  for (const std::string& name : builtin_pair_scenes()) names.push_back(std::string(builtin) + name);
  return names;
}

/// All scenes with 1,600 vertices, or their own, and each of these varied; cloth with 10,000; a hundred piles.
std::vector<Run> everything(const PairOptions& options) {
  std::vector<Run> runs;
  Run usual{"", "", options};
  usual.options.vertices = 1600;
  for (const std::string& name : names_of_all()) {
    usual.scene = name;
    runs.push_back(usual);
    add_variations(usual, runs);
  }
  usual.scene = "pile";
  usual.frames = 300;
  add_piles(usual, 100, runs);
  usual.frames = 0;
  usual.options.vertices = 10'000;
  for (const char* name :
       {"drape", "rotating_sphere", "twist", "fold", "stack", "block", "fall", "two_sheets", "pile"}) {
    usual.scene = name;
    runs.push_back(usual);
  }
  return runs;
}

std::vector<Run> runs_of(const Arguments& arguments) {
  std::vector<Run> runs;
  const auto& asked = arguments.scenes;
  const auto is_asked = [&](const std::string& name) { return std::ranges::find(asked, name) != asked.end(); };
  if (is_asked("everything")) return everything(arguments.options);
  for (const std::string& name : names_of_all()) {
    if (!is_asked("all") && !is_asked(name)) continue;
    const Run usual{name, "", arguments.options};
    runs.push_back(usual);
    if (arguments.has_variations) add_variations(usual, runs);
    if (name == "pile") add_piles(usual, arguments.piles, runs);
  }
  return runs;
}

void read(int argc, char** argv, Arguments& to, CLI::App& app) {
  app.add_option("scenes", to.scenes, "names of scenes, `all`, or `everything`");
  app.add_flag("--list", to.is_list, "print what would be run, or all scenes, and stop");
  app.add_flag("--vary", to.has_variations, "each scene also with other iterations, time steps, distances, speeds");
  app.add_flag("--bits", to.is_bits, "compare bits: with 1, 2, 3 and 8 threads, and restored in the middle");
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
  app.add_option("--slow", to.slow, "print steps that take more processor time than that [s]; 0: none")
      ->check(CLI::NonNegativeNumber);
  app.add_option("--seed", to.options.seed, "of what is drawn by chance");
  app.add_option("--piles", to.piles, "so many piles, each of another seed")->check(CLI::Range(1, 1'000'000));
  app.add_option("--log", to.log, "a file to which lines are added; runs whose line is there are not done again")
      ->excludes("--bits");
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

/// The lines of a log, by the titles of their runs.
std::map<std::string, std::string> lines_of(const std::string& log) {
  std::map<std::string, std::string> lines;
  std::ifstream file(log);
  for (std::string line; std::getline(file, line);) {
    const std::size_t end = line.find('\t');
    if (end != std::string::npos) lines.emplace(line.substr(0, end), line.substr(end + 1));
  }
  return lines;
}

bool do_runs(const Arguments& arguments) {
  const auto done = lines_of(arguments.log);
  std::ofstream log;
  if (!arguments.log.empty()) {
    log.open(arguments.log, std::ios::app);
    if (!log) fail_input("cannot write " + arguments.log + "; choose a file in a folder that exists");
  }
  bool is_clean = true;
  for (const Run& each : share_of(runs_of(arguments), arguments.share)) {
    if (const auto found = done.find(each.title()); found != done.end()) {
      is_clean &= !found->second.starts_with("NOT ");
      continue;
    }
    const Outcome outcome = arguments.is_bits ? compare_bits(each, arguments) : run(each, arguments);
    is_clean &= outcome.is_clean;
    const std::string line = (outcome.is_clean ? "" : "NOT CLEAN: ") + outcome.line;
    fmt::print("{}\n", line);
    std::fflush(stdout);
    if (log.is_open()) log << each.title() << '\t' << line << std::endl;
  }
  return is_clean;
}

int run_program(const Arguments& arguments) {
  const std::vector<std::string> known = names_of_all();
  for (const std::string& name : arguments.scenes) {
    if (name == "all" || name == "everything" || std::ranges::find(known, name) != known.end()) continue;
    fail_input(fmt::format("no scene '{}'; choose `all`, `everything` or some of {}", name, fmt::join(known, ", ")));
  }
  if (arguments.scenes.empty()) {
    for (const PairSceneEntry& entry : pair_scenes()) fmt::print("{:18}{}\n", entry.name, entry.about);
    for (const std::string& name : builtin_pair_scenes()) fmt::print("{}{}\n", builtin, name);
    return 0;
  }
  if (!arguments.is_list) return do_runs(arguments) ? 0 : 1;
  for (const Run& each : share_of(runs_of(arguments), arguments.share)) fmt::print("{}\n", each.title());
  return 0;
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
