// pliant resume: a run goes on from its last checkpoint.
#include <filesystem>
#include <memory>
#include <optional>

#include <fmt/format.h>

#include "commands.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/recorder/recorder.h"
#include "pliant_io/recorder/run_files.h"
#include "recording.h"
#include "scene_options.h"
#include "system/folder_lock.h"
#include "system/interrupts.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;

struct ResumeArguments {
  fs::path folder;                ///< of the run
  pliant::ResumeOptions options;  ///< how far, and with how many threads
  RecordingOptions recording;     ///< what is told and kept on the way
};

int resume_scene(const ResumeArguments& arguments) {
  const fs::path checkpoint = arguments.folder / pliant::checkpoint_name;
  std::error_code ignored;
  std::optional<pliant_system::FolderLock> lock;  // before the first look: a run beside this one removes the checkpoint
  if (fs::is_directory(arguments.folder, ignored)) lock.emplace(arguments.folder);
  if (!fs::exists(checkpoint, ignored)) {
    pliant::fail_input(
        fmt::format("{}: no such file: no run left a checkpoint there; give the folder of a run, one that "
                    "may be killed with --checkpoint",
                    pliant::printable_place(checkpoint.string())));
  }
  pliant::Scene scene = pliant::read_checkpoint(checkpoint, arguments.options);
  pliant_system::catch_interrupts();
  pliant::RunInfo info = run_info(scene, scene.source.texts.front().name);
  pliant::refuse_links(arguments.folder, info.frame_format, pliant::RunStart::resumed);
  info.resumed_from = scene.simulation.state().step;
  return record_scene(scene, arguments.folder, info, arguments.recording);
}

}  // namespace

void add_resume_command(CLI::App& program, int& exit_code) {
  CLI::App* command = program.add_subcommand(
      "resume", "Go on with a run that was interrupted or killed, or add steps to one that ended");
  const auto arguments = std::make_shared<ResumeArguments>();
  command->add_option("folder", arguments->folder, "The folder of the run")->type_name("FOLDER")->required();
  add_number(*command, "--steps", arguments->options.steps,
             "Total number of steps, including those already taken, not more of them; default: as planned before");
  add_number(*command, "--threads", arguments->options.threads,
             "Number of threads at most, 0: one for each processor; results do not depend on it");
  add_recording_options(*command, arguments->recording);
  command->footer(
      "Frames and measurements after the checkpoint are computed anew; all have the bits of a run that never\n"
      "stopped.\nExample:\n  pliant resume out/curtain --steps 900");
  command->callback([arguments, &exit_code] { exit_code = resume_scene(*arguments); });
}

}  // namespace pliant_cli
