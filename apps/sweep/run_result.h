#pragma once
// What a run of a sweep came to: its outcome, and what its measurements say in a few figures.
#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "system/child_process.h"

namespace pliant_sweep {

/// waiting: it has not ended, or has not begun.
enum class RunOutcome { waiting, ok, diverged, failed };
constexpr std::array<std::string_view, 4> choice_names(RunOutcome) {
  return {"waiting", "ok", "diverged", "failed"};
}

/// A number that says something of a whole run.
struct FigureInfo {
  std::string name;   ///< the column of sweep.csv: "total_end"
  std::string label;  ///< with its unit: "total energy at the end [J]"
};

/// All figures in the order of their columns. Of kinetic, elastic (of all groups), gravitational, other potential and
/// total energy, speed_sum, momentum, residual, objective and iterations, and of contacts, deepest, backtracks and
/// refactorizations, which only runs with contact have, and of pairs, active, shortened, momentum_lost, energy_taken,
/// lag and let_go, which only those have in which surfaces touch: `_end` of the last record, `_mean` and `_max` of all.
/// Then smallest_gap_min of the latter; speed_sum_late, the mean over the last third of the time; time_end, the
/// simulated time; the means of the times; the seconds of the whole run. The record of the start counts for the state
/// alone, and not for what a step does: residual, objective, iterations, contact, times.
std::span<const FigureInfo> figure_infos();

/// The place of a figure in figure_infos(). @throws std::logic_error for an unknown name
std::size_t figure_index(std::string_view name);

struct RunResult {
  RunOutcome outcome = RunOutcome::waiting;
  std::int64_t steps_done = 0;
  std::string message{};  ///< why it did not end well
  int exit_code = 0;
  std::vector<std::optional<double>> figures{};  ///< of figure_infos(); empty, or none each, where nothing was measured

  bool has_ended_by_itself() const { return outcome == RunOutcome::ok || outcome == RunOutcome::diverged; }
  std::optional<double> figure(std::size_t index) const {
    return index < figures.size() ? figures[index] : std::nullopt;
  }
};

/// What stands in the folder of a run: ok or diverged when its files say so and are whole, else waiting. Does not
/// throw.
RunResult read_run_result(const std::filesystem::path& folder);

/// Makes a run whose run.json says that it has ended by itself one that was interrupted, so that its result does not
/// count. @throws pliant::Error (output)
void forget_run_result(const std::filesystem::path& folder);
/// The same where its files are not whole.
void forget_cut_result(const std::filesystem::path& folder);

/// What came of a run that has just ended; one that did not reach its end by itself has failed, and its output says
/// why.
RunResult result_of_ended_run(const std::filesystem::path& folder, const pliant_system::ProcessEnd& end,
                              const std::filesystem::path& output);

/// Adds "exit code N" to the output of a run, as a shell has it, unless that is 0. Does not throw.
void note_end(const std::filesystem::path& output, const pliant_system::ProcessEnd& end);

/// What note_end(), or the command line of a run, has noted; 0: nothing.
int noted_exit_code(const std::filesystem::path& output);

/// What came of a run whose end was noted. Waiting: none was, or it was interrupted.
RunResult result_of_noted_end(const std::filesystem::path& folder, const std::filesystem::path& output);

}  // namespace pliant_sweep
