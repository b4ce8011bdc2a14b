// pliant sweep: the product of settings, each a run of its own.
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "commands.h"
#include "import_options.h"
#include "interrupts.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "progress.h"
#include "scene_options.h"
#include "sweep/sweep.h"
#include "sweep/sweep_report.h"
#include "system/child_process.h"
#include "system/folder_lock.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;
using namespace pliant_sweep;

struct SweepArguments : SceneArguments {
  std::vector<std::string> vary;     ///< "path=a,b,c" each
  fs::path out;                      ///< folder of the sweep
  std::optional<std::int64_t> jobs;  ///< runs at a time, 1 to 256; none: as many as the processors can take
  bool dry_run = false;              ///< check and list the runs only
  bool restart = false;              ///< remove the runs of an earlier sweep in that folder
  bool quiet = false;                ///< print warnings and errors only
};

/// One line on a terminal, written anew; elsewhere one at each tenth of the runs.
class SweepProgress {
 public:
  explicit SweepProgress(const SweepArguments& arguments)
      : is_quiet_(arguments.quiet), has_terminal_(has_error_terminal()) {}
  ~SweepProgress() { clear(); }
  SweepProgress(const SweepProgress&) = delete;
  SweepProgress& operator=(const SweepProgress&) = delete;

  void show(const SweepState& state) {
    const std::size_t tenth = 10 * state.ended / state.total;
    if (is_quiet_ || (!has_terminal_ && tenth == last_tenth_.value_or(tenth))) {
      last_tenth_ = tenth;
      return;
    }
    last_tenth_ = tenth;
    std::string line = fmt::format("{} of {} runs have ended, {} running", state.ended, state.total, state.running);
    if (state.diverged > 0) line += fmt::format(", {} diverged", state.diverged);
    if (state.failed > 0) line += fmt::format(", {} failed", state.failed);
    if (state.seconds_left && state.ended < state.total)
      line += fmt::format("; {} left", duration_text(*state.seconds_left));
    print_to_stderr(has_terminal_ ? "\r\x1b[K" + line : line + "\n");
    is_shown_ = has_terminal_;
  }

  /// A run that failed is told at once, the first ones.
  void tell(const SweepPlan& plan, const SweepRun& run) {
    constexpr int most = 10;
    if (run.result.outcome != RunOutcome::failed || told_ > most) return;
    clear();
    const std::string text = ++told_ > most
                                 ? "more runs failed; sweep.csv has their messages"
                                 : fmt::format("run {} ({}) failed: {}", run.name,
                                               combination_text(plan.setup.variations, run.values), run.result.message);
    print_to_stderr("warning: " + pliant::printable_place(text, message_limit) + "\n");
  }

  void clear() {
    if (is_shown_) print_to_stderr("\r\x1b[K");
    is_shown_ = false;
  }

 private:
  bool is_quiet_;
  bool has_terminal_;
  bool is_shown_ = false;
  int told_ = 0;
  std::optional<std::size_t> last_tenth_;
};

/// The setup of the sweep; all slips of paths and values are known behind it.
SweepSetup check(const SweepArguments& arguments) {
  SweepOptions options;
  options.scene = arguments.scene;
  options.overrides = arguments.overrides;
  options.overrides.format = arguments.overrides.format.value_or(pliant::FrameFormat::none);
  for (const std::string& text : arguments.vary) options.variations.push_back(read_variation(text));
  options.import = import_arguments(arguments.import);
  const auto open = [&](const pliant::SceneOverrides& overrides) {
    return open_scene(SceneArguments{arguments.scene, overrides, arguments.import});
  };
  return check_sweep(options, open, [] { return !was_interrupted(); });
}

Sharing share(const SweepArguments& arguments, const SweepPlan& plan) {
  const std::optional<pliant::Index> threads = arguments.overrides.threads;
  return share_processors(std::thread::hardware_concurrency(), plan, arguments.jobs,
                          threads ? std::optional<std::int64_t>(*threads) : std::nullopt);
}

void print_runs(const SweepArguments& arguments, const SweepPlan& plan) {
  for (const SweepRun& run : plan.runs) {
    const auto outcome = choice_names(run.result.outcome)[static_cast<std::size_t>(run.result.outcome)];
    fmt::print("{}  {:8}  {}\n", run.name, outcome, combination_text(plan.setup.variations, run.values));
  }
  const Sharing sharing = share(arguments, plan);
  fmt::print("{} runs, {} of them to be run, {} at a time", plan.runs.size(), count_of(plan, RunOutcome::waiting),
             sharing.jobs);
  fmt::print("{}\n", sharing.threads > 0 ? fmt::format("; threads of each: {}", sharing.threads) : std::string());
}

void print_summary(const SweepArguments& arguments, const SweepPlan& plan, std::size_t there) {
  if (arguments.quiet) return;
  fmt::print("{}: {} runs: {}", pliant::printable(fs::path(plan.setup.scene).stem().string()), plan.runs.size(),
             outcomes_text(plan));
  fmt::print("{}\n", there > 0 ? fmt::format("; {} were there before", there) : std::string());
  for (const char* name : {"sweep.csv", "index.html"}) {
    fmt::print("  {}\n", pliant::printable_place((arguments.out / name).string()));
  }
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (!error) return;
  throw pliant::Error(pliant::ErrorKind::output,
                      fmt::format("{}: cannot be used for a sweep: {}; choose another folder",
                                  pliant::printable_place(folder.string()), error.message()));
}

int sweep_in_folder(const SweepArguments& arguments, SweepSetup setup, Earlier earlier) {
  make_folder(arguments.out);
  const pliant_system::FolderLock lock(arguments.out);
  SweepPlan plan = plan_sweep(arguments.out, std::move(setup), earlier);
  begin_sweep(arguments.out, plan);
  const std::size_t there = plan.runs.size() - count_of(plan, RunOutcome::waiting);
  {
    SweepProgress progress(arguments);
    SweepHooks hooks;
    hooks.stop = was_interrupted;
    hooks.show = [&progress](const SweepState& state) { progress.show(state); };
    hooks.tell_ended = [&progress, &plan](const SweepRun& run) { progress.tell(plan, run); };
    run_sweep(arguments.out, pliant_system::own_program(), share(arguments, plan), plan, hooks);
  }
  write_sweep_report(arguments.out, plan);
  print_summary(arguments, plan, there);
  if (count_of(plan, RunOutcome::waiting) == 0) return exit_code_of(plan.runs);
  print_to_stderr("interrupted: the same command goes on with the runs that wait\n");
  return exit_interrupted;
}

int sweep(const SweepArguments& arguments) {
  catch_interrupts();
  const Earlier earlier = arguments.restart ? Earlier::remove : Earlier::keep;
  try {
    SweepSetup setup = check(arguments);
    if (!arguments.dry_run) return sweep_in_folder(arguments, std::move(setup), earlier);
    print_runs(arguments, plan_sweep(arguments.out, std::move(setup), earlier));
    return 0;
  } catch (const pliant::Error& error) {
    if (error.kind() != pliant::ErrorKind::interrupted) throw;
    print_to_stderr(fmt::format("interrupted: {}\n", error.what()));
    return exit_interrupted;
  }
}

}  // namespace

void add_sweep_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("sweep", "Run a scene with all combinations of some values, and compare");
  const auto arguments = std::make_shared<SweepArguments>();
  pliant::SceneOverrides& overrides = arguments->overrides;
  add_scene_arguments(*command, *arguments);
  command
      ->add_option("--vary", arguments->vary,
                   "PATH=a,b,c: values for --set PATH; 1:9:5 is five evenly from 1 to 9, 1:9:5log by equal ratios; "
                   "given several times, all combinations")
      ->type_name("PATH=VALUES")
      ->expected(1)
      ->take_all()
      ->required();
  command->add_option("--out", arguments->out, "Folder for the runs, the table and the plots")
      ->type_name("FOLDER")
      ->required();
  add_setting_options(*command, *arguments);
  add_simulated_import_options(*command, arguments->import);
  add_choice(*command, "--format", overrides.format, "Format of the frames: npy, pc2, obj, ply or none; default: none");
  add_number(*command, "--every", overrides.every, "Record the start and every n-th step");
  add_number(*command, "--jobs", arguments->jobs, {1, 256},
             "Number of runs at a time; default: as many as the processors can take");
  command->add_flag("--dry-run", arguments->dry_run, "Check and list the runs only");
  command->add_flag("--restart", arguments->restart, "Remove the runs of an earlier sweep in that folder");
  command->add_flag("--quiet", arguments->quiet, "Print warnings and errors only");
  command->footer(
      "What has ended is not run again: the same command goes on, and values may be added.\n"
      "Example:\n"
      "  pliant sweep curtain --vary settings.iterations=2,5,10,20 --vary settings.time_step=0.01,0.02 --out "
      "out/sweep");
  command->callback([arguments, &exit_code] { exit_code = sweep(*arguments); });
}

}  // namespace pliant_cli
