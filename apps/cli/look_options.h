#pragma once
// How scenes and runs are shown: what the sub-commands that draw have in common.
#include "scene_options.h"

namespace pliant_cli {

/// `scene` may be the folder of a run as well.
struct LookArguments : SceneArguments {
  std::string size;
  std::optional<pliant::ColorBy> color;
  std::optional<pliant::Shading> shading;
  bool wireframe = false;
};
void add_look_options(CLI::App& command, LookArguments& arguments);

/// Puts what was given in the place of the scene's own. @throws pliant::Error (input): a size that is none
void apply_look(const LookArguments& arguments, pliant::ViewSettings& look);

/// Of the scene that a run was made from, as its checkpoint has it, with what was given in its place.
/// @throws pliant::Error (input): options that a run cannot follow
pliant::ViewSettings look_of_run(const LookArguments& arguments);

}  // namespace pliant_cli
