// pliant experiment: the experiments of the thesis and the paper, as one report.
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "bench/bench.h"
#include "commands.h"
#include "experiments.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant/core/stopwatch.h"
#include "pliant/core/version.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/scene/nearest_names.h"
#include "render/offscreen_context.h"
#include "report/report.h"
#include "report_files.h"
#include "system/interrupts.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;
using pliant_experiments::Experiment;
using pliant_report::Report;
using pliant_report::Verdict;

struct ExperimentArguments {
  std::vector<std::string> names;  ///< of experiments, or "all"; empty: they are listed
  fs::path out = "report";         ///< folder of the report
  bool without_pictures = false;   ///< leave out what needs OpenGL
  unsigned seed = 0;               ///< of what is random
  bool quiet = false;              ///< print warnings and errors only
};

void list_experiments() {
  for (const Experiment& experiment : pliant_experiments::experiments()) {
    fmt::print("{:<16} {}\n", experiment.name, experiment.title);
  }
}

/// `all`, or names; in the order of the report.
std::vector<Experiment> choose(const std::vector<std::string>& names) {
  const std::span<const Experiment> all = pliant_experiments::experiments();
  std::vector<std::string_view> known = {"all"};
  for (const Experiment& experiment : all) known.push_back(experiment.name);
  for (const std::string& name : names) {
    if (std::ranges::find(known, std::string_view(name)) != known.end()) continue;
    pliant::fail_input(
        fmt::format("unknown experiment '{}'; {}", pliant::printable(name), pliant::suggestion_text(name, known)));
  }
  const auto is_asked = [&](std::string_view name) { return std::ranges::find(names, name) != names.end(); };
  std::vector<Experiment> chosen;
  for (const Experiment& experiment : all) {
    if (is_asked("all") || is_asked(experiment.name)) chosen.push_back(experiment);
  }
  return chosen;
}

/// That the report can be written is known before anything is measured.
void probe(const fs::path& folder) {
  if (folder.empty()) pliant::fail_input("--out: the name of the folder is empty; give one");
  std::error_code failed;
  if (fs::exists(folder / "index.html", failed) && !fs::exists(folder / "report.json", failed)) {
    throw pliant::Error(pliant::ErrorKind::output,
                        fmt::format("{}: no experiment wrote this page, so it stays; give another folder by --out",
                                    pliant::printable_place((folder / "index.html").string())));
  }
  fs::create_directories(folder, failed);
  const pliant::AtomicFile file(folder / "index.html");
}

bool can_draw(const ExperimentArguments& arguments) {
  if (arguments.without_pictures) return false;
  try {
    const pliant_render::OffscreenContext context;
    return true;
  } catch (const pliant::Error& error) {
    print_to_stderr(fmt::format("warning: pictures are left out: {}\n", error.what()));
    return false;
  }
}

std::vector<std::pair<std::string, std::string>> facts() {
  const pliant_bench::Machine machine = pliant_bench::this_machine();
  return {
      {"Pliant", std::string(pliant::version)},
      {"Processor", fmt::format("{}, {} threads, {}", machine.processor, machine.processors, machine.instruction_set)},
      {"Compiler", machine.compiler},
      {"Eigen", machine.eigen},
      {"CHOLMOD", machine.cholmod.empty() ? "not in this build" : machine.cholmod},
      {"Date", machine.date + " UTC"}};
}

void show(const ExperimentArguments& arguments, std::string_view what) {
  if (!arguments.quiet && has_error_terminal()) print_to_stderr(fmt::format("\r\x1b[K{}", what));
}

/// As wide as the longest.
std::string verdict_text(Verdict verdict) {
  if (verdict == Verdict::holds) return in_tone(Tone::good, "holds         ");
  if (verdict == Verdict::fails) return in_tone(Tone::bad, "DOES NOT HOLD ");
  return "reported      ";
}

void print_chapter(const pliant_report::Chapter& chapter) {
  fmt::print("{} ({:.1f} s)\n", chapter.title, chapter.seconds);
  for (const pliant_report::Claim& claim : chapter.claims) {
    fmt::print("  {} {}\n                 {}\n", verdict_text(claim.verdict), claim.text, claim.evidence);
  }
  std::fflush(stdout);
}

/// An experiment that diverges where it should not is a claim that does not hold; the others go on.
pliant_report::Chapter run_or_fail(const Experiment& experiment, const pliant_experiments::ExperimentContext& context) {
  try {
    return experiment.run(context);
  } catch (const pliant::Error& error) {
    if (error.kind() != pliant::ErrorKind::diverged) throw;
    pliant_report::Chapter chapter;
    chapter.claims.push_back({"The experiment comes to its end", "", Verdict::fails, error.what()});
    return chapter;
  }
}

pliant_report::Chapter run_one(const Experiment& experiment, const ExperimentArguments& arguments, bool draws) {
  const pliant_experiments::ExperimentContext context(
      {draws, arguments.seed,
       [&](std::string_view what) { show(arguments, fmt::format("{}: {} ...", experiment.name, what)); },
       pliant_system::was_interrupted});
  const pliant::Stopwatch watch;
  pliant_report::Chapter chapter = run_or_fail(experiment, context);
  chapter.name = experiment.name;
  chapter.title = experiment.title;
  chapter.seconds = watch.seconds();
  show(arguments, "");
  if (!arguments.quiet) print_chapter(chapter);
  return chapter;
}

/// Says so to who waits, and to who reads the report.
void note_interrupt(Report& report, std::size_t asked, const fs::path& folder) {
  if (report.chapters.empty()) {
    print_to_stderr("interrupted: nothing was written\n");
    return;
  }
  const std::string what = fmt::format("{} of {} experiments are in the report", report.chapters.size(), asked);
  report.introduction += fmt::format(" This run was interrupted: {} that were asked for.", what);
  write_report(report, folder);
  print_to_stderr(fmt::format("interrupted: {}\n", what));
}

void print_summary(const Report& report, const fs::path& folder) {
  fmt::print("{} claims: {} hold, {} do not hold, {} reported\n{}\n",
             count(report, Verdict::holds) + count(report, Verdict::fails) + count(report, Verdict::reported),
             count(report, Verdict::holds), count(report, Verdict::fails), count(report, Verdict::reported),
             pliant::printable_place((folder / "index.html").string()));
}

int run_experiments(const ExperimentArguments& arguments) {
  if (arguments.names.empty()) {
    list_experiments();
    return 0;
  }
  const std::vector<Experiment> chosen = choose(arguments.names);
  probe(arguments.out);
  const bool draws = can_draw(arguments);
  pliant_system::catch_interrupts();
  Report report;
  report.title = "Projective Dynamics: the experiments";
  report.introduction =
      "The experiments of chapter 6 of T. Kenneweg's thesis (2014), the comparisons of Bouaziz et al. (2014), and what "
      "goes beyond both, as this machine has measured them. Each claim is followed by what was found; a claim that "
      "does "
      "not hold is said not to.\n\nEvery figure is a file in the folder figures as well: plots as SVG with their "
      "numbers "
      "as CSV, pictures as PNG. The second figure of the chapter on damping is figures/damping-2.";
  report.sources = pliant_experiments::sources();
  report.facts = facts();
  report.facts.emplace_back("Seed", std::to_string(arguments.seed));
  try {
    for (const Experiment& experiment : chosen) {
      report.chapters.push_back(run_one(experiment, arguments, draws));
      write_report(report, arguments.out);
    }
  } catch (const pliant::Error& error) {
    show(arguments, "");
    if (error.kind() != pliant::ErrorKind::interrupted) throw;
    note_interrupt(report, chosen.size(), arguments.out);
    return exit_interrupted;
  }
  write_pdfs(report, arguments.out);
  print_summary(report, arguments.out);
  return 0;
}

}  // namespace

std::vector<std::string> experiment_names() {
  std::vector<std::string> names;
  for (const Experiment& experiment : pliant_experiments::experiments()) names.emplace_back(experiment.name);
  return names;
}

void add_experiment_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "experiment", "Repeat the experiments of the thesis and the paper; write a report with figures and verdicts");
  const auto arguments = std::make_shared<ExperimentArguments>();
  command->add_option("experiments", arguments->names, "all, or some by name; without any, they are listed");
  command->add_option("--out", arguments->out, "Folder for index.html and report.json, default report")
      ->type_name("FOLDER");
  command
      ->add_option("--seed", arguments->seed,
                   "Other random jumps, and starts that are moved by a millionth of a meter: verdicts should not "
                   "change; default 0, none")
      ->type_name("NUMBER");
  command->add_flag("--no-pictures", arguments->without_pictures, "Leave out what needs OpenGL");
  command->add_flag("--quiet", arguments->quiet, "No progress and no verdicts, only the summary");
  command->footer(
      "Examples:\n"
      "  pliant experiment                          lists them\n"
      "  pliant experiment all --out report         all of them, a few minutes\n"
      "  pliant experiment damping wind --out two   two of them");
  command->callback([arguments, &exit_code] { exit_code = run_experiments(*arguments); });
}

}  // namespace pliant_cli
