#pragma once
// How scenes and runs are shown: what the sub-commands that draw have in common.
#include "render/clip.h"
#include "scene_options.h"

namespace pliant_cli {

/// `scene` may be the folder of a run as well.
struct AppearanceArguments : SceneArguments {
  std::string size;                        ///< "1280x720" [pixels]; empty: as the scene has it
  std::optional<pliant::ColorBy> color;    ///< what colors mean; none: as the scene's view has it
  std::optional<pliant::Shading> shading;  ///< smooth or flat; none: as the view has it
  bool wireframe = false;                  ///< draw the edges of the elements too
};
void add_appearance_options(CLI::App& command, AppearanceArguments& arguments);

/// Puts what was given in the place of the scene's own. @throws pliant::Error (input): a size that is none
void apply_appearance(const AppearanceArguments& arguments, pliant::ViewSettings& appearance);

/// A run that is shown: the scene that it was made from, as it was at the start, where its checkpoint has it.
struct ShownRun {
  pliant::ViewSettings appearance;  ///< of the scene, with what was given in its place
  std::optional<pliant::Scene> scene;
};
/// @throws pliant::Error (input): options that a run cannot follow
ShownRun shown_run(const AppearanceArguments& arguments);

/// Pins, wind and colliders at the times of the run's frames; none, with a note, where the scene does not tell them.
pliant_render::RunAnnotations annotations_of(ShownRun& run, const pliant::Animation& animation);

}  // namespace pliant_cli
