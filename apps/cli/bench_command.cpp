// pliant bench: how fast this machine runs the standard workloads, part by part, and other libraries beside them.
#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "bench/bench.h"
#include "bench/report.h"
#include "bench/solves.h"
#include "choice_option.h"
#include "commands.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"
#include "pliant_io/scene/nearest_names.h"
#include "scene_options.h"
#include "system/interrupts.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

using namespace pliant_bench;
using pliant::Index;

struct BenchArguments {
  std::vector<std::string> workloads;  ///< names; empty: all
  std::optional<Index> size;  ///< vertices along a side of a curtain, cells across a bar; none: as each workload has it
  MeshOrder order = MeshOrder::rows;             ///< of the vertices in memory
  std::optional<Index> repeats;                  ///< of everything, 1 to 100,000; none: about 3 s a workload
  std::vector<std::string> threads;              ///< numbers, in turn; empty: 1 and 2
  std::vector<std::string> baselines = {"all"};  ///< names of other libraries, "all" or "none"
  std::vector<std::string> time_to_error;        ///< names of cases and scenes, or "all"
  std::optional<std::int64_t> steps;             ///< of a scene before the one that is measured, ≥ 0
  std::string json;                              ///< file for the results, "-" for the standard output; empty: none
  std::string csv;                               ///< as json
  BenchOptions options;                          ///< what the above make
};

std::vector<BaselineKind> all_baselines() {
  std::vector<BaselineKind> kinds = {BaselineKind::eigen, BaselineKind::textbook, BaselineKind::thesis};
  if (!cholmod_version().empty()) kinds.insert(kinds.begin() + 1, BaselineKind::cholmod);
  return kinds;
}

/// `all`, `none`, or names.
std::vector<BaselineKind> choose_baselines(const std::vector<std::string>& words) {
  constexpr auto names = choice_names(BaselineKind{});
  if (words.size() == 1 && words[0] == "all") return all_baselines();
  if (words.size() == 1 && words[0] == "none") return {};
  std::vector<BaselineKind> kinds;
  for (const std::string& word : words) {
    const auto found = std::ranges::find(names, std::string_view(word));
    if (found == names.end()) {
      std::vector<std::string_view> known(names.begin(), names.end());
      pliant::fail_input(fmt::format("--baselines: unknown baseline '{}'{} (known: all, none, or some of {})",
                                     pliant::printable(word), pliant::did_you_mean(word, known),
                                     fmt::join(known, ", ")));
    }
    kinds.push_back(static_cast<BaselineKind>(found - names.begin()));
  }
  return kinds;
}

/// Whole numbers from 1.
std::vector<int> choose_threads(const std::vector<std::string>& words) {
  constexpr int most = 1024;
  std::vector<int> threads;
  for (const std::string& word : words) {
    int count = 0;
    for (const char c : word) count = c >= '0' && c <= '9' && count <= most ? 10 * count + (c - '0') : most + 1;
    if (word.empty() || count < 1 || count > most) {
      pliant::fail_input(fmt::format("--threads: '{}' is not a number of threads; give some from 1 to {}, as in 1,2",
                                     pliant::printable(word), most));
    }
    threads.push_back(count);
  }
  return threads;
}

BenchOptions check(const BenchArguments& arguments) {
  constexpr Index most_repeats = 100'000;
  constexpr std::int64_t most_steps = 1'000'000;
  BenchOptions options = arguments.options;
  options.workloads = choose_workloads(arguments.workloads, arguments.size);
  options.baselines = choose_baselines(arguments.baselines);
  if (!arguments.time_to_error.empty()) {
    if (arguments.steps && (*arguments.steps < 0 || *arguments.steps > most_steps)) {
      pliant::fail_input(fmt::format("--steps: {} is out of range; give 0 to {}", *arguments.steps, most_steps));
    }
    options.cases = choose_cases(arguments.time_to_error, arguments.size, arguments.steps);
    if (arguments.workloads.empty()) options.workloads.clear();
  }
  if (arguments.steps && arguments.time_to_error.empty()) {
    pliant::fail_input("--steps: it is of --time-to-error; give that as well, or leave it out");
  }
  if (!options.cases.empty() || !options.against.empty()) {  // these alone
    options.phases = false;
    options.projections = Projections::without;
    options.bandwidth = Bandwidth::without;
  }
  if (!arguments.threads.empty()) options.threads = choose_threads(arguments.threads);
  if (arguments.repeats && (*arguments.repeats < 1 || *arguments.repeats > most_repeats)) {
    pliant::fail_input(fmt::format("--repeats: {} is out of range; give 1 to {}", *arguments.repeats, most_repeats));
  }
  if (arguments.repeats) options.repeats = *arguments.repeats;
  for (Workload& workload : options.workloads) {
    workload.order = arguments.order;
    if (workload.order == MeshOrder::shuffled) workload.name += "-shuffled";
  }
  if (arguments.json == "-" && arguments.csv == "-") {
    pliant::fail_input("--json and --csv cannot both go to the standard output; give one of them a file");
  }
  return options;
}

/// Where people watch, one line that says what is under way.
void show(std::string_view what) {
  if (has_error_terminal()) print_to_stderr(fmt::format("\r\x1b[Kmeasuring {} ...", what));
}

void end_show() {
  if (has_error_terminal()) print_to_stderr("\r\x1b[K");
}

void run(const BenchArguments& arguments) {
  pliant_system::end_at_interrupts();
  const BenchResult result = run_bench(check(arguments), show);
  end_show();
  const auto give = [](const std::string& file, const std::string& text) {
    if (file == "-") {
      fmt::print("{}", text);
    } else if (!file.empty()) {
      pliant::write_file_atomically(file, text);
    }
  };
  // First, so that what took minutes is not lost with a file that cannot be written.
  if (arguments.json != "-" && arguments.csv != "-") fmt::print("{}", text_report(result));
  give(arguments.json, json_report(result));
  give(arguments.csv, csv_report(result));
}

}  // namespace

void add_bench_command(CLI::App& program) {
  CLI::App* command = program.add_subcommand("bench", "Measure the speed of this machine, part by part");
  auto arguments = std::make_shared<BenchArguments>();
  command
      ->add_option("--workloads", arguments->workloads,
                   "W1, W1b, W2, W2b, W3, W3b (curtains; b: with bending), W4 (bar), W5, W6 (cloth of triangles and "
                   "hinges), W7a, W7b (that cloth falls onto a sphere: steps with contact); or, with --size, curtain, "
                   "curtain-b, cloth, bar, falling")
      ->delimiter(',');
  add_number(*command, "--size", arguments->size,
             "Vertices along a side of a square curtain, cells across a bar that is four times as long");
  add_choice(*command, "--order", arguments->order, "Vertices and elements numbered row by row, or at random");
  add_number(*command, "--repeats", arguments->repeats,
             "Of everything; default: 5 to 200, about 3 s a workload; 3 of W7");
  command->add_option("--threads", arguments->threads, "Default: 1,2; the phases are those of the first")
      ->delimiter(',');
  command
      ->add_option("--baselines", arguments->baselines,
                   "all (default), none, or some of eigen, cholmod, textbook, thesis")
      ->delimiter(',');
  add_choice(*command, "--backend", arguments->options.settings.backend, "Library that factorizes");
  add_choice(*command, "--ordering", arguments->options.settings.ordering, "Of the elimination, with cholmod");
  add_choice(*command, "--precision", arguments->options.settings.precision, "Of the factor");
  add_choice(*command, "--projections", arguments->options.projections,
             "Measure the constraint types by themselves: with the workloads, not, or alone");
  add_choice(*command, "--bandwidth", arguments->options.bandwidth, "Measure how fast one thread reads memory");
  command
      ->add_option("--time-to-error", arguments->time_to_error,
                   "How many iterations and how long until a step is within 1e-2, 1e-4, 1e-6 of its end: plain, with "
                   "each acceleration, and without contact with XPBD; all, or some of hanging, swinging, falling, "
                   "dress, bar; or other built-in scenes and scene files. Measured alone; takes minutes")
      ->delimiter(',');
  add_number(*command, "--steps", arguments->steps,
             "Of a scene of --time-to-error before the one that is measured, taken by L-BFGS; default: 60");
  command
      ->add_option("--against", arguments->options.against,
                   "Another build of this program, timed in turns with this one by whole runs of the workloads and "
                   "scenes, nine rounds by default. Measured without the phases")
      ->type_name("PROGRAM");
  command->add_option("--json", arguments->json, "Write the results as JSON; -: to the standard output")
      ->type_name("FILE");
  command->add_option("--csv", arguments->csv, "Write the results as CSV; -: to the standard output")
      ->type_name("FILE");
  command->footer(
      "Examples:\n"
      "  pliant bench                                        all workloads, about two minutes\n"
      "  pliant bench --workloads W2,W4 --json bench.json    two of them, with a file for programs\n"
      "  pliant bench --size 200                             curtains of 200 x 200 vertices\n"
      "  pliant bench --time-to-error hanging,falling        how soon steps converge\n"
      "  pliant bench --time-to-error flag.json --steps 100  the same of a scene of one's own\n"
      "  pliant bench --workloads W5 --against old/pliant    this build beside another");
  command->callback([arguments] { run(*arguments); });
}

}  // namespace pliant_cli
