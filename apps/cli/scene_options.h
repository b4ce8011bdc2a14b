#pragma once
// What the sub-commands that take a scene have in common.
#include <string>

#include <CLI/CLI.hpp>

#include "choice_option.h"
#include "number_option.h"
#include "pliant_io/mesh/mesh_file.h"
#include "pliant_io/scene/scene.h"

namespace pliant_cli {

/// A scene and the values that take the place of its own.
struct SceneArguments {
  std::string scene;                  ///< a file, a built-in scene or a mesh
  pliant::SceneOverrides overrides;   ///< what takes the place of the scene's own
  pliant::ImportOptions import = {};  ///< where the scene is a mesh
};

inline constexpr const char* scene_help = "A scene file, a mesh file, or the name of a built-in scene";
inline constexpr const char* scene_or_run_help =
    "A scene file, a mesh file, the name of a built-in scene, or the folder of a run";

/// Adds the scene and `--set` to a sub-command.
void add_scene_arguments(CLI::App& command, SceneArguments& arguments, const std::string& help = scene_help);

/// Adds the options that take the place of the scene's settings.
void add_setting_options(CLI::App& command, SceneArguments& arguments);

/// Refuses --scale, --up and --drop-loose without a mesh, whatever else the scene is.
void check_import(const SceneArguments& arguments);

/// Whether the scene is a mesh file, to be simulated by itself.
bool is_mesh(const SceneArguments& arguments);

/// Whether it is a session that the window has recorded.
bool is_session(const SceneArguments& arguments);
bool is_session(const std::filesystem::path& file);
/// @throws pliant::Error (input): options that a session cannot follow
void check_session(const SceneArguments& arguments);

/// Whether the scene is a checkpoint, to go on from.
bool is_checkpoint(const SceneArguments& arguments);

/// Refuses --set and the settings for a checkpoint, which goes on as it was; `remedy` says where they can be changed.
void check_checkpoint(const SceneArguments& arguments, const std::string& remedy);

/// A file where there is one of that name, a mesh among them (make_mesh_scene), else a built-in scene; a folder hides
/// none.
pliant::Scene open_scene(const SceneArguments& arguments);

/// What was assumed about the mesh of such a scene, one line each; "" where the scene is none.
std::string assumptions_text(const SceneArguments& arguments, const pliant::Scene& scene);
/// The same in two lines for a window, which changes the rest itself.
std::string short_assumptions_text(const SceneArguments& arguments, const pliant::Scene& scene);

/// Prints a line for each of the scene's warnings: keys that have an old name, loose vertices.
void print_warnings(const pliant::Scene& scene);

}  // namespace pliant_cli
