#pragma once
// Scene files: JSON that says what to simulate. docs/scenes.md describes the format.
//
//     Scene scene = load_scene("curtain.json");
//     for (std::int64_t i = 0; i < scene.steps; ++i) scene.step();
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "pliant/materials/material.h"
#include "pliant/simulation/simulation.h"
#include "pliant/timeline/timeline.h"
#include "pliant_io/scene/scene_source.h"
#include "pliant_io/scene/view_settings.h"

namespace pliant {

struct OutputSettings {
  FrameFormat format = FrameFormat::npy;  ///< what the frames are written as
  std::int64_t every = 1;                 ///< record the start and every n-th step, ≥ 1

  template <class Self, class Visitor>
  static void visit(Self& self, Visitor&& field) {
    field(OptionInfo{"format", "", "of the frames: `npy`, `pc2`, `obj`, `ply` or `none`"}, self.format);
    field(OptionInfo{"every", "", "record the start and every n-th step", Range{1, 1e15}}, self.every);
  }
};

/// More steps than anyone takes; what counts them, and their frames, does not overflow.
inline constexpr std::int64_t max_steps = std::int64_t{1} << 53;

/// A group of constraints, a force or a collider that the scene has switched off: `"enabled": false`.
struct DisabledPart {
  std::string type;                 ///< "position"
  std::optional<BodyId> body{};     ///< of a group; else none
  bool is_collider = false;         ///< else a group or a force
  bool goes_with_material = false;  ///< another material would take its place
  std::vector<Index> pinned{};      ///< vertices that a group of positions would hold, as the simulation counts them
  std::vector<Real> factors{};      ///< of its stiffness, by vertex of the body; empty: none
};

/// A simulation made ready to run, with what the scene says about the run.
struct Scene {
  std::string name;  ///< default: the file's, without its extension
  std::string description;
  std::int64_t steps = 300;  ///< ≥ 0
  OutputSettings output;
  ViewSettings view;
  Simulation simulation;
  Timeline timeline;
  SceneSource source;                            ///< what it was read from, for parse_scene
  std::vector<SceneFile> files;                  ///< of its meshes and maps, each once
  std::map<BodyId, Material> materials;          ///< of the bodies that are made of one
  std::map<BodyId, BodyAppearance> appearances;  ///< of the bodies that have one of their own
  /// By their names, of the colliders that have one of their own, at the start or once an event has added them.
  std::map<std::string, ColliderAppearance, std::less<>> collider_appearances;
  std::vector<Material> own_materials;      ///< those that the scene itself has, by name
  std::vector<std::string> group_names;     ///< of the groups there are, and behind them those that events add
  std::vector<std::string> collider_names;  ///< the same of colliders
  bool has_surfaces = false;                ///< whether surfaces touch at the start, or once an event has acted

  /// Where in the scene as one document (scene_document.h) a group, a force or a collider of that name stands, and
  /// gravity: "bodies[0].constraints[1]". Those of materials and what events add have no such place.
  std::map<std::string, std::string> places;
  /// The same of what events add, by name: "events[2].add"; of those that set gravity "events[2]".
  std::map<std::string, std::string> later_places;
  /// Entries that name no body and mean the only one of an included text: their places, and the body.
  std::vector<std::pair<std::string, std::string>> implied_bodies;
  /// Events that were left out, as their source asked for: their numbers, ascending, among "moves" and then "events",
  /// and why.
  std::vector<std::pair<Index, std::string>> left_out;
  /// By name, what is switched off: it is read like everything else, and not in the simulation.
  std::map<std::string, DisabledPart> disabled;
  /// Events that act on what is switched off, and so on nothing: their numbers, as of left_out, ascending.
  std::vector<Index> idle_events;

  std::vector<std::string> warnings;  ///< with their places: keys whose names are old, loose vertices

  /// What messages call it: its file.
  std::string place() const;
  /// Lets the events act that are due and takes one step. When this throws, nothing has changed.
  StepReport step();
};

/// Reads a scene file; paths in it start at its folder.
/// @throws Error (input), one line: `file:line:column: what` for a slip of syntax, else `file: path.to.key[3]: what;
///   remedy` with the place in the JSON.
Scene load_scene(const std::filesystem::path& file, const SceneOverrides& overrides = {});

/// The same for a text. `name` is what messages call it, and the scene's name unless it has one; paths in the text
/// start at `folder`.
Scene parse_scene(std::string_view text, const std::filesystem::path& folder, std::string_view name,
                  const SceneOverrides& overrides = {});

/// The same once more, of a source that is complete: no file of a text is read then, only those of meshes and maps.
Scene parse_scene(SceneSource source);

/// The "description" of a scene, "" when it has none, without making its simulation. Throws as parse_scene does.
std::string scene_description(std::string_view text, std::string_view name);

}  // namespace pliant
