#include "experiment_context.h"

#include <algorithm>
#include <random>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "pliant/core/error.h"
#include "pliant/simulation/held.h"
#include "render/clip.h"
#include "render/picture_maker.h"
#include "support/scenes.h"

namespace pliant_experiments {
namespace {

using nlohmann::json;
using pliant_render::Image;

std::string_view text_of(std::span<const pliant::BuiltinScene> scenes, std::string_view name) {
  const auto found = std::ranges::find(scenes, name, &pliant::BuiltinScene::name);
  if (found == scenes.end()) pliant::fail_input(fmt::format("there is no scene '{}' among the experiments", name));
  return found->text;
}

pliant::Scene scene_of(std::string_view text, std::string_view name, const Sets& sets) {
  pliant::SceneOverrides overrides;
  overrides.set = sets;
  return pliant::parse_scene(text, {}, name, overrides);
}

/// Takes the entries from a list whose `key` is one of these, and returns their names.
std::vector<std::string> take_out(json& scene, const char* list, const char* key,
                                  const std::vector<std::string>& values) {
  std::vector<std::string> taken;
  json kept = json::array();
  for (const json& entry : scene.value(list, json::array())) {
    if (std::ranges::find(values, entry.value(key, "")) == values.end()) {
      kept.push_back(entry);
    } else {
      taken.push_back(entry.value("name", entry.value("type", "")));
    }
  }
  scene[list] = std::move(kept);
  return taken;
}

}  // namespace

pliant::Scene ExperimentContext::scene(std::string_view name, const Sets& sets) const {
  return scene_of(text_of(experiment_scenes(), name), name, sets);
}

pliant::Scene ExperimentContext::builtin_scene(std::string_view name, const Sets& sets) const {
  return scene_of(text_of(pliant::builtin_scenes(), name), name, sets);
}

pliant::Scene ExperimentContext::builtin_scene_without_contact(std::string_view name, Winds winds,
                                                               const Sets& sets) const {
  json scene = json::parse(text_of(pliant::builtin_scenes(), name));
  std::vector<std::string> colliders;
  for (const json& collider : scene.value("colliders", json::array())) colliders.push_back(collider.value("name", ""));
  scene["colliders"] = json::array();
  scene["contact"] = {{"surfaces", false}};
  take_out(scene, "moves", "group", colliders);
  take_out(scene, "events", "move", colliders);
  if (winds == Winds::left_out) take_out(scene, "events", "change", take_out(scene, "forces", "type", {"wind"}));
  json settings = scene.value("settings", json::object());
  settings.emplace("iterations", 10);
  scene["settings"] = std::move(settings);
  return scene_of(scene.dump(), name, sets);
}

pliant::StepReport ExperimentContext::step(pliant::Scene& scene) const {
  if (options_.stop()) throw pliant::Error(pliant::ErrorKind::interrupted, "the experiments were ended");
  return scene.step();
}

void ExperimentContext::disturb(pliant::Scene& scene, unsigned repeat) const {
  if (seed() == 0 && repeat == 0) return;
  constexpr double most = 1e-6;  // [m]
  std::seed_seq seeds{seed(), repeat};
  std::mt19937 random(seeds);
  const std::vector<char> held = pliant::held_vertices(scene.simulation);
  const pliant::State& state = scene.simulation.state();
  pliant::Positions positions = state.positions;
  const pliant::Positions velocities = state.velocities;
  for (std::size_t i = 0; i < held.size(); ++i) {
    for (Eigen::Index axis = 0; axis < 3 && held[i] == 0; ++axis) {
      positions(static_cast<Eigen::Index>(i), axis) += most * (static_cast<double>(random()) / 2147483648.0 - 1);
    }
  }
  scene.simulation.set_state(positions, velocities);
}

bool ExperimentContext::try_steps(pliant::Scene& scene, std::int64_t count) const {
  try {
    step(scene, count);
  } catch (const pliant::Error& error) {
    if (error.kind() != pliant::ErrorKind::diverged) throw;
    return false;
  }
  return true;
}

Image ExperimentContext::picture(const pliant::Scene& scene) const {
  if (!options_.draws) return {};
  pliant_render::Clip clip{pliant_render::make_render_mesh(scene.simulation), scene.view, {}};
  clip.frames.push_back(pliant_render::capture_frame(scene.simulation, clip.render_mesh, scene.view.color));
  pliant_render::PictureOptions options;
  options.appearance = scene.view;
  options.bounds = bounds_of(clip);
  options.ground_height = ground_height(clip, options.bounds);
  options.range = color_range(clip);
  pliant_render::PictureMaker maker(clip.render_mesh, options);
  return maker.draw(clip.frames[0].content, clip.frames[0].wind);
}

void ExperimentContext::show(pliant_report::Chapter& chapter, const std::vector<Image>& pictures, int columns,
                             std::string caption) const {
  if (!options_.draws || pictures.empty()) return;
  constexpr int gap = 6;
  constexpr std::array<std::uint8_t, 3> background = {255, 255, 255};
  const Image image = pictures.size() == 1 ? pictures[0] : contact_sheet(pictures, columns, gap, background);
  chapter.blocks.emplace_back(pliant_report::Picture{std::move(caption), encode_png(image), image.width, image.height});
}

}  // namespace pliant_experiments
