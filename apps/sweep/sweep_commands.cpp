#include "sweep/sweep_commands.h"

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant_sweep {
namespace {

namespace fs = std::filesystem;

/// Whether a shell takes the text as it stands, wherever in a command it does.
bool is_plain_word(std::string_view text) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+./:,@%";
  return !text.empty() && text.find_first_not_of(plain) == text.npos;
}

/// Whether it is an option and a value of one, whose '=' no shell minds behind the first word.
bool is_plain_option(std::string_view text) {
  const std::size_t equals = text.find('=');
  return text.starts_with("--") && equals != text.npos && is_plain_word(text.substr(0, equals)) &&
         is_plain_word(text.substr(equals + 1));
}

/// The text of a run.json that has ended by itself; grep -E finds it in the line of its own that it has there.
constexpr std::string_view ended_pattern = R"x('^  "outcome": "(ok|diverged)"')x";

}  // namespace

std::string shell_word(std::string_view text) {
  if (text.find_first_of(std::string_view("\n\r\0", 3)) != text.npos) {
    pliant::fail_input(
        fmt::format("--list: '{}' has a line break, which a command of one line cannot hold; write it without, in JSON "
                    "as \\n, or leave out --list",
                    pliant::printable(text, 100)));
  }
  if (is_plain_word(text) || is_plain_option(text)) return std::string(text);
  std::string word = "'";
  for (const char c : text) {
    if (c == '\'') {
      word += R"('\'')";
    } else {
      word += c;
    }
  }
  return word + '\'';
}

// The check comes before the log is made anew: that of a run that has ended stays. The log is removed rather than
// emptied, since a link may have its name.
std::string run_command(const CommandFrame& frame, const SweepSetup& setup, const SweepRun& run) {
  const fs::path place = frame.directory / frame.folder;
  const std::string info = shell_word((run_folder(place, run.name) / "run.json").string());
  const std::string log = shell_word(run_log(place, run.name).string());
  std::string words = shell_word(frame.program);
  for (const std::string& word : run_arguments(setup, run.values, run_folder(frame.folder, run.name), frame.threads)) {
    words += ' ' + shell_word(word);
  }
  return fmt::format(
      "grep -Eqs {} {} || (rm -f {}; cd {} && {} >{} 2>&1 || (code=$?; echo \"exit code $code\" >>{}; exit $code))",
      ended_pattern, info, log, shell_word(frame.directory.string()), words, log, log);
}

std::vector<std::string> run_commands(const CommandFrame& frame, const SweepPlan& plan) {
  std::vector<std::string> lines;
  lines.reserve(plan.runs.size());
  for (const SweepRun& run : plan.runs) lines.push_back(run_command(frame, plan.setup, run));
  return lines;
}

void forget_cut_runs(const fs::path& folder, const SweepPlan& plan) {
  for (const SweepRun& run : plan.runs) {
    if (!run.result.has_ended_by_itself()) forget_run_result(run_folder(folder, run.name));
  }
}

void collect_results(const fs::path& folder, SweepPlan& plan) {
  for (SweepRun& run : plan.runs) {
    const fs::path log = run_log(folder, run.name);
    const int noted = noted_exit_code(log);
    if (!run.result.has_ended_by_itself()) {
      run.result = result_of_noted_end(run_folder(folder, run.name), log);
      continue;
    }
    std::error_code ignored;
    if (fs::file_size(log, ignored) == 0 || (noted != 0 && noted != run.result.exit_code)) fs::remove(log, ignored);
  }
}

}  // namespace pliant_sweep
