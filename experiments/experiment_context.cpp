#include "experiment_context.h"

#include <algorithm>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "render/clip.h"
#include "render/picture_maker.h"
#include "support/scenes.h"

namespace pliant_experiments {
namespace {

using pliant_render::Image;

pliant::Scene scene_of(std::span<const pliant::BuiltinScene> scenes, std::string_view name, const Sets& sets) {
  const auto found = std::ranges::find(scenes, name, &pliant::BuiltinScene::name);
  if (found == scenes.end()) pliant::fail_input(fmt::format("there is no scene '{}' among the experiments", name));
  pliant::SceneOverrides overrides;
  overrides.set = sets;
  return pliant::parse_scene(found->text, {}, name, overrides);
}

}  // namespace

pliant::Scene ExperimentContext::scene(std::string_view name, const Sets& sets) const {
  return scene_of(experiment_scenes(), name, sets);
}

pliant::Scene ExperimentContext::builtin_scene(std::string_view name, const Sets& sets) const {
  return scene_of(pliant::builtin_scenes(), name, sets);
}

pliant::StepReport ExperimentContext::step(pliant::Scene& scene) const {
  if (options_.stop()) throw pliant::Error(pliant::ErrorKind::interrupted, "the experiments were ended");
  return scene.step();
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
  options.ground_height = ground_height(clip);
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
