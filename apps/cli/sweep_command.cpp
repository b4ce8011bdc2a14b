// pliant sweep: the product of settings, each a run of its own.
#include <filesystem>
#include <memory>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "commands.h"
#include "import_options.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"
#include "progress.h"
#include "scene_options.h"
#include "sweep/sweep.h"
#include "sweep/sweep_commands.h"
#include "sweep/sweep_report.h"
#include "system/child_process.h"
#include "system/folder_lock.h"
#include "system/interrupts.h"
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
  bool list = false;                 ///< print a command for each run, and run nothing
  bool collect = false;              ///< run nothing; table and plots of what such commands have left
  bool restart = false;              ///< remove the runs of an earlier sweep in that folder
  bool quiet = false;                ///< print warnings and errors only
};

constexpr int most_told = 10;

void print_warning(std::string_view text) {
  print_to_stderr("warning: " + pliant::printable_place(text, message_limit) + "\n");
}

/// "run 0003 (steps=5) failed: the disk is full"
std::string failure_text(const SweepPlan& plan, const SweepRun& run) {
  return fmt::format("run {} ({}) {}: {}", run.name, combination_text(plan.setup.variations, run.values),
                     choice_names(run.result.outcome)[static_cast<std::size_t>(run.result.outcome)],
                     run.result.message);
}

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
    if (run.result.outcome != RunOutcome::failed || told_ > most_told) return;
    clear();
    print_warning(++told_ > most_told ? "more runs failed; sweep.csv has their messages" : failure_text(plan, run));
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
  return check_sweep(options, open, [] { return !pliant_system::was_interrupted(); });
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
    hooks.stop = pliant_system::was_interrupted;
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

/// For --list: prints a command for each run.
int list_in_folder(const SweepArguments& arguments, SweepSetup setup, Earlier earlier) {
  make_folder(arguments.out);
  const pliant_system::FolderLock lock(arguments.out);
  const SweepPlan plan = plan_sweep(arguments.out, std::move(setup), earlier);
  const std::int64_t threads =
      varies_threads(plan.setup.variations) ? -1 : std::int64_t{arguments.overrides.threads.value_or(1)};
  const CommandFrame frame{pliant_system::own_program_file(), fs::current_path(), arguments.out, threads};
  const std::vector<std::string> lines = run_commands(frame, plan);
  begin_sweep(arguments.out, plan);
  forget_cut_runs(arguments.out, plan);
  for (const std::string& line : lines) fmt::print("{}\n", line);
  return 0;
}

/// Names the runs of an outcome, the first ones with what is to be told of each.
void tell_runs(const SweepPlan& plan, RunOutcome outcome) {
  int told = 0;
  for (const SweepRun& run : plan.runs) {
    if (run.result.outcome != outcome) continue;
    if (++told > most_told) {
      const auto name = choice_names(outcome)[static_cast<std::size_t>(outcome)];
      return print_warning(
          fmt::format("{} more runs: {}; sweep.csv has them", count_of(plan, outcome) - most_told, name));
    }
    print_warning(outcome == RunOutcome::waiting ? fmt::format("run {} ({}) has not begun or has not ended", run.name,
                                                               combination_text(plan.setup.variations, run.values))
                                                 : failure_text(plan, run));
  }
}

/// For --collect: the table and the plots, from what the commands of --list have left.
int collect_in_folder(const SweepArguments& arguments, SweepSetup setup) {
  if (!has_sweep(arguments.out)) {
    pliant::fail_input(fmt::format("{}: there is no sweep to collect; run the commands first that --list prints",
                                   pliant::printable_place(arguments.out.string())));
  }
  const pliant_system::FolderLock lock(arguments.out);
  SweepPlan plan = plan_sweep(arguments.out, std::move(setup), Earlier::keep);
  begin_sweep(arguments.out, plan);
  forget_cut_runs(arguments.out, plan);
  collect_results(arguments.out, plan);
  pliant::write_file_atomically(arguments.out / "sweep.csv", sweep_csv(plan));
  write_sweep_report(arguments.out, plan);
  for (const RunOutcome outcome : {RunOutcome::waiting, RunOutcome::failed, RunOutcome::diverged}) {
    tell_runs(plan, outcome);
  }
  print_summary(arguments, plan, 0);
  if (count_of(plan, RunOutcome::waiting) == 0) return exit_code_of(plan.runs);
  print_to_stderr("not all runs have ended: start the commands of --list again, and collect anew\n");
  return exit_interrupted;
}

/// What --list and --collect have no use for.
void refuse_useless_options(const SweepArguments& arguments) {
  const auto refuse = [](bool is_given, std::string_view mode, std::string_view option, std::string_view why) {
    if (is_given) pliant::fail_input(fmt::format("{}: {} {}; leave out one of the two", mode, option, why));
  };
  const std::string_view starts = "is for runs that this program starts itself";
  refuse(arguments.list && arguments.collect, "--list", "--collect", "comes after the commands that it prints");
  refuse(arguments.list && arguments.dry_run, "--list", "--dry-run", "lists the runs in another way");
  refuse(arguments.list && arguments.jobs, "--list", "--jobs", starts);
  refuse(arguments.list && arguments.quiet, "--list", "--quiet", "would leave nothing to print");
  refuse(arguments.collect && arguments.dry_run, "--collect", "--dry-run", "writes no table");
  refuse(arguments.collect && arguments.jobs, "--collect", "--jobs", starts);
  refuse(arguments.collect && arguments.restart, "--collect", "--restart", "would remove what is to be collected");
}

int sweep(const SweepArguments& arguments) {
  refuse_useless_options(arguments);
  pliant_system::catch_interrupts();
  const Earlier earlier = arguments.restart ? Earlier::remove : Earlier::keep;
  try {
    SweepSetup setup = check(arguments);
    if (arguments.list) return list_in_folder(arguments, std::move(setup), earlier);
    if (arguments.collect) return collect_in_folder(arguments, std::move(setup));
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
  command->add_flag("--list", arguments->list,
                    "Run nothing; print a command for each run, one a line, for other programs to start on one machine "
                    "or many");
  command->add_flag("--collect", arguments->collect,
                    "Run nothing; make the table and the plots of what the commands of --list have left");
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
