// pliant run: a scene to files.
#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "commands.h"
#include "import_options.h"
#include "pliant_io/recorder/recorder.h"
#include "pliant_io/recorder/run_files.h"
#include "recording.h"
#include "scene_options.h"
#include "system/folder_lock.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;

struct RunOptions : SceneArguments {
  fs::path out;
  RecordingOptions recording;
};

/// The files of a run must not take the place of the scene that they come from.
void refuse_to_replace(const fs::path& scene, const fs::path& folder, std::string_view format) {
  for (const std::string& name : pliant::run_files(format)) {
    std::error_code ignored;
    if (!fs::equivalent(scene, folder / name, ignored)) continue;
    pliant::fail_input(fmt::format("{}: the run would replace this scene by its own {}; give another folder by --out",
                                   scene.string(), name));
  }
}

int run_scene(const RunOptions& options) {
  pliant::Scene scene = open_scene(options);
  const fs::path folder = options.out.empty() ? fs::path("out") / fs::path(options.scene).stem() : options.out;
  catch_interrupts();
  const pliant::RunInfo info = run_info(scene, options.scene);
  refuse_to_replace(options.scene, folder, info.frame_format);
  pliant::make_run_folder(folder);
  const pliant_system::FolderLock lock(folder);
  if (!options.recording.quiet) {
    fmt::print("{}", assumptions_text(options, scene));
    std::fflush(stdout);  // before it takes its time
  }
  pliant::begin_run(folder, info, scene.simulation);
  return record_scene(scene, folder, info, options.recording);
}

}  // namespace

void add_run_command(CLI::App& program, int& exit_code) {
  CLI::App* command =
      program.add_subcommand("run", "Simulate a scene or a mesh; write frames, measurements and a checkpoint");
  const auto options = std::make_shared<RunOptions>();
  pliant::SceneOverrides& overrides = options->overrides;
  add_scene_arguments(*command, *options);
  command
      ->add_option("--out", options->out,
                   "Folder for the files, default out/SCENE; files of an earlier run there are replaced")
      ->type_name("FOLDER");
  add_setting_options(*command, *options);
  add_import_options(*command, options->import);
  add_choice(*command, "--format", overrides.format, "Format of the frames: npy, pc2, obj, ply or none");
  add_number(*command, "--every", overrides.every, "Record the start and every n-th step");
  add_recording_options(*command, options->recording);
  command->footer(
      "A mesh file is simulated by itself, as cloth, a skin, a solid or ropes; what was assumed is printed.\n"
      "Examples:\n"
      "  pliant run curtain_wind --out out/curtain --steps 120 --format obj\n"
      "  pliant run shirt.obj --scale 0.01 --up y --set bodies[0].mass.total=0.2");
  command->callback([options, &exit_code] { exit_code = run_scene(*options); });
}

}  // namespace pliant_cli
