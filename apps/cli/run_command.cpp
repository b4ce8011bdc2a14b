// pliant run: a scene to files.
#include <cstdio>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "commands.h"
#include "import_options.h"
#include "pliant/core/error.h"
#include "pliant/core/printable.h"
#include "pliant_io/recorder/recorder.h"
#include "pliant_io/recorder/run_files.h"
#include "recording.h"
#include "scene_options.h"
#include "system/folder_lock.h"
#include "system/interrupts.h"

namespace pliant_cli {
namespace {

namespace fs = std::filesystem;

struct RunOptions : SceneArguments {
  fs::path out;                ///< folder of the run; empty: out/SCENE
  RecordingOptions recording;  ///< what is told and kept on the way
};

/// The scene or mesh itself, what it includes, its meshes, maps and point caches.
std::vector<fs::path> files_read_by(const pliant::Scene& scene, const fs::path& given) {
  std::vector<fs::path> files = {given};
  for (const pliant::SceneText& text : scene.source.texts) {
    if (!text.file.empty()) files.push_back(text.file);  // a built-in scene has none
  }
  for (const pliant::SceneFile& file : scene.files) files.emplace_back(file.path);
  return files;
}

/// The files of a run must not take the place of what they come from, under whatever name.
void refuse_to_replace(const std::vector<fs::path>& inputs, const fs::path& folder, std::string_view format) {
  for (const fs::path& replaced : pliant::replaced_files(folder, format)) {
    for (const fs::path& input : inputs) {
      std::error_code ignored;
      if (!fs::equivalent(input, replaced, ignored)) continue;
      pliant::fail_input(fmt::format(
          "{}: the run would replace this file, which its scene reads, by its own {}; give another folder by --out",
          pliant::printable_place(input.string()), replaced.filename().string()));
    }
  }
}

int run_scene(const RunOptions& options) {
  pliant::Scene scene = open_scene(options);
  print_warnings(scene);
  const fs::path folder = options.out.empty() ? fs::path("out") / fs::path(options.scene).stem() : options.out;
  pliant_system::catch_interrupts();
  const pliant::RunInfo info = run_info(scene, options.scene);
  refuse_to_replace(files_read_by(scene, options.scene), folder, info.frame_format);
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
  add_simulated_import_options(*command, options->import);
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
