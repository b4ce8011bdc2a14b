#include "sweep/sweep.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory>
#include <system_error>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/files/atomic_file.h"
#include "system/child_process.h"

namespace pliant_sweep {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

using pliant_system::ChildProcess;
using pliant_system::ProcessEnd;

/// A run under way.
struct Job {
  SweepRun* run;
  std::unique_ptr<ChildProcess> process;
};

class Runner {
 public:
  Runner(const fs::path& folder, const std::string& program, const Sharing& sharing, SweepPlan& plan,
         const SweepHooks& hooks)
      : folder_(folder), program_(program), sharing_(sharing), plan_(plan), hooks_(hooks) {
    for (SweepRun& run : plan.runs) {
      if (!run.result.has_ended_by_itself()) waiting_.push_back(&run);
    }
  }

  /// However it ends, the table tells of all runs that have.
  void run() {
    write_table();
    try {
      run_all();
    } catch (...) {
      jobs_.clear();
      try {
        write_table();
      } catch (const pliant::Error&) {  // the first error is the one to tell
      }
      throw;
    }
    write_table();
  }

 private:
  void run_all() {
    const std::size_t jobs = static_cast<std::size_t>(std::max<std::int64_t>(1, sharing_.jobs));
    while (next_ < waiting_.size() || !jobs_.empty()) {
      stop_if_asked();
      while (next_ < waiting_.size() && jobs_.size() < jobs) start(*waiting_[next_++]);
      wait();
      collect();
      if (hooks_.show) hooks_.show(state());
    }
  }

  /// Runs under way may have read what has changed: none of them counts, not even one that has just ended.
  void check_inputs() {
    try {
      check_unchanged(plan_.setup);
    } catch (const pliant::Error&) {
      for (Job& job : jobs_) {
        job.process.reset();
        job.run->result = {};
        forget_run_result(run_folder(folder_, job.run->name));
      }
      throw;
    }
  }

  void start(SweepRun& run) {
    check_inputs();
    run.result = {};
    const auto arguments = run_arguments(plan_.setup, run.values, run_folder(folder_, run.name), sharing_.threads);
    jobs_.push_back({&run, start_run({program_, arguments, run_log(folder_, run.name)})});
  }

  /// A process that reads nothing.
  std::unique_ptr<ChildProcess> start_run(const pliant_system::ChildOptions& options) const {
    try {
      auto process = std::make_unique<ChildProcess>(options);
      process->end_input();
      return process;
    } catch (const std::system_error& error) {
      const int number = error.code().value();
      const bool is_program = number == ENOENT || number == EACCES || number == ENOEXEC;
      throw pliant::Error(is_program ? pliant::ErrorKind::input : pliant::ErrorKind::output,
                          is_program ? fmt::format("{}: cannot be started: {}; give the path of this program",
                                                   pliant::printable_place(program_), error.code().message())
                                     : fmt::format("{}: no run can be started: {}; give fewer --jobs",
                                                   pliant::printable_place(folder_.string()), error.code().message()));
    }
  }

  void stop_if_asked() {
    if (stopped_ || !hooks_.stop || !hooks_.stop()) return;
    stopped_ = Clock::now();
    next_ = waiting_.size();
    for (const Job& job : jobs_) job.process->interrupt();
  }

  void wait() const {
    std::vector<const ChildProcess*> processes;
    for (const Job& job : jobs_) processes.push_back(job.process.get());
    pliant_system::wait_for_any(processes, 100ms);
    constexpr auto patience = 5s;  // a run needs at most two, but where it is set up or factorizes
    if (!stopped_ || Clock::now() - *stopped_ < patience) return;
    for (const ChildProcess* process : processes) process->kill();
  }

  void collect() {
    bool has_news = false;
    for (auto job = jobs_.begin(); job != jobs_.end();) {
      const std::optional<ProcessEnd> end = job->process->end();
      if (!end) {
        ++job;
        continue;
      }
      has_news = true;
      take_result(*job->run, *end);
      job = jobs_.erase(job);
    }
    if (has_news && Clock::now() - written_ >= 1s) write_table();
  }

  void take_result(SweepRun& run, const ProcessEnd& end) {
    const fs::path log = run_log(folder_, run.name);
    run.result = result_of_ended_run(run_folder(folder_, run.name), end, log);
    // After a stop, what did not reach its end was kept from it: the terminal's interrupt reaches a run by itself.
    stop_if_asked();
    if (stopped_ && run.result.outcome == RunOutcome::failed) run.result = {};
    if (run.result.outcome != RunOutcome::waiting) note_end(log, end);
    std::error_code ignored;
    if (fs::file_size(log, ignored) == 0) fs::remove(log, ignored);
    if (run.result.outcome == RunOutcome::waiting) return;
    check_inputs();
    ++ended_;
    if (hooks_.tell_ended) hooks_.tell_ended(run);
  }

  SweepState state() const {
    SweepState state;
    state.total = plan_.runs.size();
    state.running = jobs_.size();
    for (const SweepRun& run : plan_.runs) {
      state.ended += run.result.outcome != RunOutcome::waiting ? 1 : 0;
      state.failed += run.result.outcome == RunOutcome::failed ? 1 : 0;
      state.diverged += run.result.outcome == RunOutcome::diverged ? 1 : 0;
    }
    if (ended_ > 0) {
      const double seconds = std::chrono::duration<double>(Clock::now() - begin_).count();
      state.seconds_left = seconds / static_cast<double>(ended_) * static_cast<double>(state.total - state.ended);
    }
    return state;
  }

  void write_table() {
    pliant::write_file_atomically(folder_ / "sweep.csv", sweep_csv(plan_));
    written_ = Clock::now();
  }

  const fs::path& folder_;
  const std::string& program_;
  Sharing sharing_;
  SweepPlan& plan_;
  const SweepHooks& hooks_;
  std::vector<SweepRun*> waiting_;
  std::size_t next_ = 0;
  std::vector<Job> jobs_;
  std::size_t ended_ = 0;  // in this start
  std::optional<Clock::time_point> stopped_;
  Clock::time_point begin_ = Clock::now();
  Clock::time_point written_ = begin_;
};

}  // namespace

Sharing share_processors(std::int64_t processors, const SweepPlan& plan, std::optional<std::int64_t> jobs,
                         std::optional<std::int64_t> threads) {
  processors = std::max<std::int64_t>(1, processors);
  const auto waiting =
      std::ranges::count_if(plan.runs, [](const SweepRun& run) { return !run.result.has_ended_by_itself(); });
  const std::int64_t most = std::max<std::int64_t>(1, waiting);
  if (varies_threads(plan.setup.variations)) return {std::min<std::int64_t>(jobs.value_or(1), most), -1};
  if (!jobs && threads) jobs = *threads > 0 ? std::max<std::int64_t>(1, processors / *threads) : 1;
  const std::int64_t used = std::min(jobs.value_or(processors), most);
  return {used, threads.value_or(std::max<std::int64_t>(1, processors / used))};
}

void run_sweep(const fs::path& folder, const std::string& program, const Sharing& sharing, SweepPlan& plan,
               const SweepHooks& hooks) {
  Runner(folder, program, sharing, plan, hooks).run();
}

int exit_code_of(std::span<const SweepRun> runs) {
  const auto any = [&runs](auto&& condition) {
    return std::ranges::any_of(runs, [&](const SweepRun& run) { return condition(run.result); });
  };
  const auto has_failed = [](const RunResult& result) { return result.outcome == RunOutcome::failed; };
  constexpr int output = static_cast<int>(pliant::ErrorKind::output);
  if (any([&](const RunResult& result) { return has_failed(result) && result.exit_code == output; })) return output;
  if (any(has_failed)) return static_cast<int>(pliant::ErrorKind::input);
  if (any([](const RunResult& result) { return result.outcome == RunOutcome::diverged; })) {
    return static_cast<int>(pliant::ErrorKind::diverged);
  }
  return 0;
}

}  // namespace pliant_sweep
