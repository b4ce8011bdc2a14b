#pragma once
// How scenes and runs are shown: what the sub-commands that draw have in common.
#include "scene_options.h"

namespace pliant_cli {

/// `scene` may be the folder of a run as well.
struct AppearanceArguments : SceneArguments {
  std::string size;
  std::optional<pliant::ColorBy> color;
  std::optional<pliant::Shading> shading;
  bool wireframe = false;
};
void add_appearance_options(CLI::App& command, AppearanceArguments& arguments);

/// Puts what was given in the place of the scene's own. @throws pliant::Error (input): a size that is none
void apply_appearance(const AppearanceArguments& arguments, pliant::ViewSettings& appearance);

/// Of the scene that a run was made from, as its checkpoint has it, with what was given in its place.
/// @throws pliant::Error (input): options that a run cannot follow
pliant::ViewSettings appearance_of_run(const AppearanceArguments& arguments);

}  // namespace pliant_cli
