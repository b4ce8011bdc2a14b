#include "scene_run.h"

#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/recorder/run_files.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/mesh_scene.h"
#include "recording.h"

namespace pliant_python {
namespace {

namespace fs = std::filesystem;
using pliant::Scene;

void refuse_to_replace(const Scene& scene, const fs::path& folder, std::string_view format) {
  std::vector<fs::path> inputs;
  for (const pliant::SceneText& text : scene.source.texts) {
    if (!text.file.empty()) inputs.push_back(text.file);
  }
  for (const pliant::SceneFile& file : scene.files) inputs.emplace_back(file.path);
  for (const fs::path& replaced : pliant::replaced_files(folder, format)) {
    for (const fs::path& input : inputs) {
      std::error_code ignored;
      if (!fs::equivalent(input, replaced, ignored)) continue;
      pliant::fail_input(input.string() +
                         ": the run would replace this file, which its scene reads; give another folder");
    }
  }
}

}  // namespace

Scene open_scene(const std::string& name, const pliant::SceneOverrides& overrides) {
  std::error_code ignored;
  const bool is_file = fs::exists(name, ignored) && !fs::is_directory(name, ignored);
  if (is_file && pliant::mesh_format(name)) return pliant::make_mesh_scene(name, {}, overrides);
  if (is_file) return pliant::load_scene(name, overrides);
  std::vector<std::string_view> names;
  for (const pliant::BuiltinScene& each : pliant::builtin_scenes()) {
    if (each.name == name) return pliant::parse_scene(each.text, {}, each.name, overrides);
    names.push_back(each.name);
  }
  const std::string suggestion = pliant::did_you_mean(name, names);
  pliant::fail_input("unknown scene '" + name + "': neither a file nor a built-in scene" +
                     (suggestion.empty() ? "; scene_names() lists those" : suggestion));
}

void run_scene(Scene& scene, const fs::path& folder, std::int64_t steps) {
  if (folder.empty()) {
    for (std::int64_t i = 0; i < steps; ++i) scene.step();
    return;
  }
  pliant::RunInfo info;
  info.scene = scene.name;
  info.source = scene.place();
  info.wanted_steps = scene.simulation.state().step + steps;
  info.every = scene.output.every;
  info.frame_format = choice_names(scene.output.format)[static_cast<std::size_t>(scene.output.format)];
  refuse_to_replace(scene, folder, info.frame_format);
  Recording recording(folder, info, scene.simulation, scene.group_names, {scene.collider_names, scene.has_surfaces});
  const auto save = [&] { pliant::write_checkpoint(folder / pliant::checkpoint_name, scene); };
  try {
    for (std::int64_t i = 0; i < steps; ++i) recording.record(scene.simulation, scene.step());
    save();
  } catch (const std::exception& error) {
    recording.end(scene.simulation, error, save);
    throw;
  }
  recording.end(scene.simulation, pliant::Outcome::ok);
}

}  // namespace pliant_python
