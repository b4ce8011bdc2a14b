// A scene to the files of a run, from its start or from where it was left.
#include "recording.h"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "commands.h"
#include "number_option.h"
#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/recorder/recorder.h"
#include "pliant_io/recorder/run_files.h"
#include "progress.h"
#include "step_looks.h"
#include "system/interrupts.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;
using pliant::Outcome;
using pliant::Scene;

/// Prints each warning once, when it has come.
class Warnings {
 public:
  void print(const pliant::Simulation& simulation, Progress& progress) {
    for (; printed_ < simulation.warnings().size(); ++printed_) {
      progress.clear();
      print_to_stderr("warning: " + pliant::printable_place(simulation.warnings()[printed_], message_limit) + "\n");
    }
  }

 private:
  std::size_t printed_ = 0;
};

/// None when the step took too long after an interrupt. A step that fails leaves its start to be taken up.
std::optional<pliant::StepReport> step_unless_given_up(Scene& scene, const fs::path& checkpoint) {
  try {
    return scene.step();
  } catch (const pliant::Error& error) {
    if (error.kind() == pliant::ErrorKind::interrupted) return std::nullopt;
    try {
      pliant::write_checkpoint(checkpoint, scene);
    } catch (const pliant::Error&) {  // the first error is the one to tell
    }
    throw;
  }
}

void count_missed(const pliant::StepReport& report, double tolerance, pliant::MissedTolerance& missed) {
  if (tolerance == 0 || report.reached_tolerance) return;
  ++missed.steps;
  missed.worst_residual = std::max(missed.worst_residual, report.residual);
}

void print_missed(const pliant::MissedTolerance& missed) {
  if (missed.steps == 0) return;
  print_to_stderr(
      fmt::format("warning: settings.tolerance: missed in {} steps, with up to {:.3g} N left on a vertex; give more "
                  "`iterations` or a larger tolerance\n",
                  missed.steps, missed.worst_residual));
}

/// What a run needs to tell of itself at its end.
struct RunEnd {
  pliant::RunInfo& info;
  StepLooks looks;
  double contact_seconds = 0;
};

/// False when it was given up after an interrupt.
bool look_at_step(Scene& scene, StepLooks& looks) {
  try {
    looks.look(scene.simulation);
  } catch (const pliant::Error& given_up) {
    if (given_up.kind() == pliant::ErrorKind::interrupted) return false;
    throw;
  }
  return true;
}

void end_looks(RunEnd& end, const Scene& scene) {
  end.looks.end();
  const std::optional<StepLook>& worst = end.looks.worst();
  if (!worst) return;
  const pliant::StepError& error = worst->error;
  end.info.worst_step = {worst->step, scene.simulation.body(error.body).name, error.distance, error.share};
}

void simulate(Scene& scene, pliant::Recorder& recorder, const fs::path& checkpoint, const RecordingOptions& options,
              RunEnd& end) {
  std::int64_t step = scene.simulation.state().step;
  Progress progress(step, scene.steps, options.quiet ? Progress::Show::never : Progress::Show::on_terminal);
  Warnings warnings;
  warnings.print(scene.simulation, progress);
  const std::int64_t every = options.checkpoint_every;
  scene.simulation.set_stop(pliant_system::waits_no_longer);
  while (step < scene.steps && !pliant_system::was_interrupted()) {
    const std::optional<pliant::StepReport> report = step_unless_given_up(scene, checkpoint);
    if (!report) break;
    count_missed(*report, scene.simulation.settings().tolerance, end.info.missed_tolerance);
    end.contact_seconds += report->contact.seconds;
    recorder.record(scene.simulation, *report);
    ++step;
    if (every > 0 && step % every == 0 && step < scene.steps) pliant::write_checkpoint(checkpoint, scene);
    warnings.print(scene.simulation, progress);
    progress.update(step, recorder.residual());
    if (end.looks.is_due(scene.simulation.state()) && !look_at_step(scene, end.looks)) break;
  }
  pliant::write_checkpoint(checkpoint, scene);
}

std::string size_text(std::uintmax_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1000 * 1000) return fmt::format("{:.1f} kB", static_cast<double>(bytes) * 1e-3);
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) * 1e-6);
}

/// Where contact takes much of the time, how to do without.
void print_cost_of_contact(const Scene& scene, const RunEnd& end) {
  constexpr double much = 0.3;
  const double share = end.contact_seconds / std::max(end.info.wall_seconds, 1e-9);
  if (!scene.simulation.contact().surfaces || share < much) return;
  fmt::print("  contact took {:.0f} % of the time; with --set contact.surfaces=false bodies pass through each other\n",
             100 * share);
}

void print_summary(const Scene& scene, const RunEnd& end, const fs::path& folder) {
  const pliant::RunInfo& info = end.info;
  const std::int64_t steps = scene.simulation.state().step;
  fmt::print("{}: {} of {} steps", pliant::printable(scene.name), steps, scene.steps);
  if (info.resumed_from) fmt::print(", from step {} on", *info.resumed_from);
  fmt::print(", {:.3g} s simulated in {:.3g} s", scene.simulation.state().time, info.wall_seconds);
  const std::int64_t taken = steps - info.resumed_from.value_or(0);
  if (taken > 0) fmt::print(", {:.3g} ms a step", 1e3 * info.wall_seconds / static_cast<double>(taken));
  fmt::print(" ({}, threads: {})\n", scene.simulation.backend(), scene.simulation.thread_count());
  print_cost_of_contact(scene, end);
  for (const std::string& name : pliant::run_files(info.frame_format)) {
    const fs::path file = folder / name;
    std::error_code ignored;
    const bool is_one_file = fs::exists(file, ignored);
    fmt::print("  {}  {}\n", pliant::printable(file.string()),
               is_one_file ? size_text(fs::file_size(file, ignored)) : fmt::format("{} files", info.frames));
  }
}

/// Simulates and records; what was recorded is whole however it ends.
void record_run(Scene& scene, pliant::Recorder& recorder, const fs::path& folder, const RecordingOptions& options,
                RunEnd& end) {
  pliant::RunInfo& info = end.info;
  if (!info.resumed_from) recorder.record(scene.simulation, {});
  const auto begin = std::chrono::steady_clock::now();
  const auto count = [&] {
    info.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    info.frames = recorder.frame_count();
    info.last_frame = recorder.last_frame_checksum();
    end_looks(end, scene);
  };
  try {
    simulate(scene, recorder, folder / pliant::checkpoint_name, options, end);
  } catch (...) {
    count();
    throw;
  }
  count();
}

/// run.json may meet the same full disk; then it stays as it was at the start, and the first error is the one to tell.
void end_failed_run(const fs::path& folder, const pliant::RunInfo& info, const pliant::Simulation& simulation) {
  try {
    pliant::end_run(folder, info, simulation);
  } catch (const pliant::Error&) {
  }
}

}  // namespace

void add_recording_options(CLI::App& command, RecordingOptions& options) {
  add_count(command, "--checkpoint", options.checkpoint_every,
            "Steps from checkpoint to checkpoint, from which `pliant resume` goes on; default: one at the end");
  command.add_flag("--quiet", options.quiet, "Print warnings and errors only");
}

pliant::RunInfo run_info(const Scene& scene, std::string source) {
  pliant::RunInfo info;
  info.scene = scene.name;
  info.source = std::move(source);
  info.wanted_steps = scene.steps;
  info.every = scene.output.every;
  info.frame_format = choice_names(scene.output.format)[static_cast<std::size_t>(scene.output.format)];
  return info;
}

int record_scene(Scene& scene, const fs::path& folder, pliant::RunInfo info, const RecordingOptions& options) {
  std::optional<pliant::Recorder> recorder;
  const auto open = [&] {
    const std::int64_t kept = info.resumed_from ? *info.resumed_from / scene.output.every + 1 : 0;
    recorder.emplace(folder, pliant::make_frame_writer(info.frame_format, folder, scene.simulation, kept),
                     scene.output.every, scene.group_names, kept,
                     pliant::ContactColumns{scene.collider_names, scene.has_surfaces});
    info.frames = recorder->frame_count();
  };
  if (info.resumed_from) {
    open();  // what is no run to go on with stays as it is
    pliant::resume_run(folder, info, scene.simulation);
  }
  RunEnd end{info, StepLooks(scene.simulation.state(), scene.steps)};
  try {
    if (!recorder) open();
    record_run(scene, *recorder, folder, options, end);
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const pliant::Error*>(&error);
    const bool is_diverged = known != nullptr && known->kind() == pliant::ErrorKind::diverged;
    info.outcome = is_diverged ? Outcome::diverged : Outcome::failed;
    info.error = error.what();
    end_failed_run(folder, info, scene.simulation);
    throw;
  }
  const bool interrupted = pliant_system::was_interrupted() && scene.simulation.state().step < scene.steps;
  info.outcome = interrupted ? Outcome::interrupted : Outcome::ok;
  pliant::end_run(folder, info, scene.simulation);
  if (!options.quiet) print_summary(scene, end, folder);
  print_missed(info.missed_tolerance);
  if (const std::optional<StepLook>& worst = end.looks.worst(); worst && !worst->warning.empty()) {
    print_to_stderr("warning: " + worst->warning + "\n");
  }
  return interrupted ? exit_interrupted : 0;
}

}  // namespace pliant_cli
