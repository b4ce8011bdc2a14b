#include "sweep/sweep_commands.h"

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"

namespace pliant_sweep {
namespace {

namespace fs = std::filesystem;

/// Whether a shell takes the text as it stands. A '=' does no harm in options.
bool is_plain_word(std::string_view text) {
  constexpr std::string_view plain = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789_-+./:,=";
  if (text.empty() || text.find_first_not_of(plain) != text.npos) return false;
  return text.starts_with("--") || text.find('=') == text.npos;
}

/// What `grep -E` finds in the run.json of a run that has ended by itself: a line of its own there.
constexpr std::string_view ended_pattern = R"x('^  "outcome": "(ok|diverged)"')x";

}  // namespace

std::string shell_word(std::string_view text) {
  if (text.find_first_of(std::string_view("\n\r\0", 3)) != text.npos) {
    pliant::fail_input(
        fmt::format("--list: '{}' has a line break, which a command of one line cannot hold; write it as \\n "
                    "in JSON, or leave out --list",
                    pliant::printable(text, 100)));
  }
  if (is_plain_word(text)) return std::string(text);
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

// Who has started a run may have been killed, and the run be at work still: flock waits for its FolderLock. The check
// comes before the log is made anew: that of a run that has ended stays. The log is removed rather than emptied, since
// a link may have its name.
std::string run_command(const CommandFrame& frame, const SweepSetup& setup, const SweepRun& run) {
  const fs::path folder = frame.directory / frame.folder;
  const std::string place = shell_word(run_folder(folder, run.name).string());
  const std::string info = shell_word((run_folder(folder, run.name) / "run.json").string());
  const std::string log = shell_word(run_log(folder, run.name).string());
  std::string words = shell_word(frame.program);
  for (const std::string& word : run_arguments(setup, run.values, run_folder(frame.folder, run.name), frame.threads)) {
    words += ' ' + shell_word(word);
  }
  return fmt::format(
      "test ! -d {} || flock {} true 2>/dev/null || true; grep -Eqs {} {} || "
      "(rm -f {}; cd {} && {} >{} 2>&1 || (code=$?; echo \"exit code $code\" >>{}; exit $code))",
      place, place, ended_pattern, info, log, shell_word(frame.directory.string()), words, log, log);
}

std::vector<std::string> run_commands(const CommandFrame& frame, const SweepPlan& plan) {
  std::vector<std::string> lines;
  lines.reserve(plan.runs.size());
  for (const SweepRun& run : plan.runs) lines.push_back(run_command(frame, plan.setup, run));
  return lines;
}

void forget_cut_runs(const fs::path& folder, const SweepPlan& plan) {
  for (const SweepRun& run : plan.runs) {
    if (!run.result.has_ended_by_itself()) forget_cut_result(run_folder(folder, run.name));
  }
}

void collect_results(const fs::path& folder, SweepPlan& plan) {
  for (SweepRun& run : plan.runs) {
    const fs::path log = run_log(folder, run.name);
    if (!run.result.has_ended_by_itself()) {
      run.result = result_of_noted_end(run_folder(folder, run.name), log);
      continue;
    }
    const int noted = noted_exit_code(log);
    std::error_code ignored;
    const bool is_empty = run.result.exit_code == 0 && fs::file_size(log, ignored) == 0;  // else it is to come
    if (is_empty || (noted != 0 && noted != run.result.exit_code)) fs::remove(log, ignored);
  }
}

}  // namespace pliant_sweep
