#include "scene_run.h"

#include <chrono>

#include "pliant_io/checkpoint/checkpoint.h"
#include "pliant_io/recorder/recorder.h"
#include "pliant_io/recorder/run_files.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/mesh_scene.h"

namespace pliant_python {
namespace {

namespace fs = std::filesystem;
using pliant::Outcome;
using pliant::Scene;

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

Outcome outcome_of(const std::exception& error) {
  const auto* known = dynamic_cast<const pliant::Error*>(&error);
  if (known == nullptr) return Outcome::failed;
  if (known->kind() == pliant::ErrorKind::diverged) return Outcome::diverged;
  return known->kind() == pliant::ErrorKind::interrupted ? Outcome::interrupted : Outcome::failed;
}

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

void record(Scene& scene, const fs::path& folder, std::int64_t steps, pliant::RunInfo& info) {
  const auto begin = std::chrono::steady_clock::now();
  pliant::Recorder recorder(folder, make_frame_writer(scene, folder), scene.output.every, scene.group_names, 0,
                            {scene.collider_names, scene.has_surfaces});
  const auto count = [&] {
    info.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    info.frames = recorder.frame_count();
    info.last_frame = recorder.last_frame_checksum();
  };
  try {
    recorder.record(scene.simulation, {});
    for (std::int64_t i = 0; i < steps; ++i) recorder.record(scene.simulation, scene.step());
  } catch (...) {
    count();
    throw;
  }
  count();
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
  pliant::make_run_folder(folder);
  pliant::begin_run(folder, info, scene.simulation);
  try {
    record(scene, folder, steps, info);
    pliant::write_checkpoint(folder / pliant::checkpoint_name, scene);
  } catch (const std::exception& error) {
    info.outcome = outcome_of(error);
    if (info.outcome != Outcome::interrupted) info.error = error.what();
    try {
      if (info.outcome != Outcome::failed) pliant::write_checkpoint(folder / pliant::checkpoint_name, scene);
      pliant::end_run(folder, info, scene.simulation);
    } catch (const pliant::Error&) {  // the first error is the one to tell
    }
    throw;
  }
  info.outcome = Outcome::ok;
  pliant::end_run(folder, info, scene.simulation);
}

}  // namespace pliant_python
