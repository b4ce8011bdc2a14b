// pliant run: a scene to files.
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "choice_option.h"
#include "commands.h"
#include "pliant/core/printable.h"
#include "pliant/recorder/recorder.h"
#include "pliant/recorder/run_files.h"
#include "pliant/scene/scene.h"
#include "progress.h"
#include "scene_options.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;
using pliant::Outcome;
using pliant::Scene;

struct RunOptions : SceneArguments {
  fs::path out;
  bool quiet = false;
};

std::unique_ptr<pliant::FrameWriter> make_frame_writer(const Scene& scene, const fs::path& folder) {
  switch (scene.output.format) {
    case pliant::FrameFormat::npy:
      return pliant::make_npy_writer(folder, scene.simulation.state().vertex_count());
    case pliant::FrameFormat::pc2:
      return pliant::make_pc2_writer(folder, scene.simulation.state().vertex_count());
    case pliant::FrameFormat::obj:
      return pliant::make_obj_writer(folder, scene.simulation.bodies());
    case pliant::FrameFormat::ply:
      return pliant::make_ply_writer(folder, scene.simulation.bodies());
    case pliant::FrameFormat::none:
      break;
  }
  return nullptr;
}

/// Prints each warning once, when it has come.
class Warnings {
 public:
  void print(const pliant::Simulation& simulation, Progress& progress) {
    for (; printed_ < simulation.warnings().size(); ++printed_) {
      progress.clear();
      print_to_stderr("warning: " + pliant::printable(simulation.warnings()[printed_], message_limit) + "\n");
    }
  }

 private:
  std::size_t printed_ = 0;
};

void simulate(Scene& scene, pliant::Recorder& recorder, const RunOptions& options) {
  Progress progress(scene.steps, options.quiet ? Progress::Show::never : Progress::Show::on_terminal);
  Warnings warnings;
  warnings.print(scene.simulation, progress);
  recorder.record(scene.simulation, {});
  for (std::int64_t step = 0; step < scene.steps && !was_interrupted(); ++step) {
    const pliant::StepReport report = scene.step();
    recorder.record(scene.simulation, report);
    warnings.print(scene.simulation, progress);
    progress.update(step + 1, recorder.residual());
  }
}

std::string size_text(std::uintmax_t bytes) {
  if (bytes < 1000) return fmt::format("{} B", bytes);
  if (bytes < 1000 * 1000) return fmt::format("{:.1f} kB", static_cast<double>(bytes) * 1e-3);
  return fmt::format("{:.1f} MB", static_cast<double>(bytes) * 1e-6);
}

void print_summary(const Scene& scene, const pliant::RunInfo& info, const fs::path& folder) {
  const std::int64_t steps = scene.simulation.state().step;
  fmt::print("{}: {} of {} steps, {:.3g} s simulated in {:.3g} s", pliant::printable(scene.name), steps, scene.steps,
             scene.simulation.state().time, info.wall_seconds);
  if (steps > 0) fmt::print(", {:.3g} ms a step", 1e3 * info.wall_seconds / static_cast<double>(steps));
  fmt::print(" ({}, threads: {})\n", scene.simulation.backend(), scene.simulation.thread_count());
  for (const std::string& name : pliant::run_files(info.frame_format)) {
    const fs::path file = folder / name;
    std::error_code ignored;
    const bool is_one_file = fs::exists(file, ignored);
    fmt::print("  {}  {}\n", pliant::printable(file.string()),
               is_one_file ? size_text(fs::file_size(file, ignored)) : fmt::format("{} files", info.frames));
  }
}

/// The files of a run must not take the place of the scene that they come from.
void refuse_to_replace(const fs::path& scene, const fs::path& folder, std::string_view format) {
  for (const std::string& name : pliant::run_files(format)) {
    std::error_code ignored;
    if (!fs::equivalent(scene, folder / name, ignored)) continue;
    pliant::fail_input(fmt::format("{}: the run would replace this scene by its own {}; give another folder by --out",
                                   scene.string(), name));
  }
}

/// Simulates and records; what was recorded is whole however it ends.
void record_run(Scene& scene, const fs::path& folder, const RunOptions& options, pliant::RunInfo& info) {
  pliant::Recorder recorder(folder, make_frame_writer(scene, folder), scene.output.every, scene.simulation,
                            scene.later_groups);
  const auto begin = std::chrono::steady_clock::now();
  const auto count = [&] {
    info.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    info.frames = recorder.frame_count();
  };
  try {
    simulate(scene, recorder, options);
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

/// Runs a scene; run.json says how it ended, whichever way that was.
int run_scene(const RunOptions& options) {
  Scene scene = open_scene(options);
  const fs::path folder = options.out.empty() ? fs::path("out") / fs::path(options.scene).stem() : options.out;
  catch_interrupts();

  pliant::RunInfo info;
  info.scene = scene.name;
  info.source = options.scene;
  info.wanted_steps = scene.steps;
  info.every = scene.output.every;
  info.frame_format = choice_names(scene.output.format)[static_cast<std::size_t>(scene.output.format)];
  refuse_to_replace(options.scene, folder, info.frame_format);
  pliant::begin_run(folder, info, scene.simulation);
  try {
    record_run(scene, folder, options, info);
  } catch (const std::exception& error) {
    const auto* known = dynamic_cast<const pliant::Error*>(&error);
    const bool is_diverged = known != nullptr && known->kind() == pliant::ErrorKind::diverged;
    info.outcome = is_diverged ? Outcome::diverged : Outcome::failed;
    info.error = error.what();
    end_failed_run(folder, info, scene.simulation);
    throw;
  }
  const bool interrupted = was_interrupted() && scene.simulation.state().step < scene.steps;
  info.outcome = interrupted ? Outcome::interrupted : Outcome::ok;
  pliant::end_run(folder, info, scene.simulation);
  if (!options.quiet) print_summary(scene, info, folder);
  return interrupted ? exit_interrupted : 0;
}

}  // namespace

void add_run_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand("run", "Simulate a scene; write frames, measurements.csv and run.json");
  const auto options = std::make_shared<RunOptions>();
  pliant::SceneOverrides& overrides = options->overrides;
  add_scene_arguments(*command, *options);
  command->add_option("--out", options->out,
                      "Folder for the files, default out/SCENE; what an earlier run left there is replaced");
  add_setting_options(*command, *options);
  add_choice(*command, "--format", overrides.format, "Of the frames: npy, pc2, obj, ply or none");
  add_number(*command, "--every", overrides.every, "Record the start and every n-th step");
  command->add_flag("--quiet", options->quiet, "Print warnings and errors only");
  command->footer("Example:\n  pliant run curtain_wind --out out/curtain --steps 120 --format obj");
  command->callback([options, &exit_code] { exit_code = run_scene(*options); });
}

}  // namespace pliant_cli
