#pragma once
// The parts of a scene file that add to a simulation: bodies with their constraints, forces, colliders, events.
#include <map>
#include <optional>
#include <string>

#include "pliant/timeline/timeline.h"
#include "pliant_io/scene/detail/collider_options.h"
#include "pliant_io/scene/detail/constraint_options.h"
#include "pliant_io/scene/detail/force_options.h"
#include "pliant_io/scene/detail/read_material.h"
#include "pliant_io/scene/scene.h"

namespace pliant {

/// A group as it stands at the place that is being read: at the start or, when it comes to events, at the time of the
/// event. Its name is that of the simulation's group.
struct GroupEntry {
  BodyId body{};
  ConstraintOptions options;
};

/// What has been read so far, for what refers to it by name.
struct SceneReader {
  SceneReader(Simulation& made, Timeline& motions) : simulation(made), timeline(motions) {}

  Simulation& simulation;
  Timeline& timeline;
  std::vector<Positions> untransformed = {};    ///< rest positions of each body, or of a solid's
                                                ///< surface, before its transform; empty: it has none
  OwnMaterials materials = {};                  ///< of the scene
  std::map<BodyId, Material> material_of = {};  ///< of the bodies that have one
  std::map<BodyId, BodyAppearance> appearance_of = {};
  std::map<std::string, ColliderAppearance, std::less<>> collider_appearances = {};  ///< see Scene
  std::map<std::string, BodyId, std::less<>> bodies = {};
  std::map<const Origin*, std::vector<BodyId>> bodies_of = {};  ///< by the text that they stand in
  std::map<std::string, GroupEntry, std::less<>> groups = {};
  std::map<std::string, ForceEntry, std::less<>> forces = {};
  std::map<std::string, ColliderOptions, std::less<>> colliders = {};
  std::vector<std::string> later_groups = {};            ///< names of groups that events add, each time
  std::vector<std::string> later_colliders = {};         ///< of colliders
  std::map<std::string, std::string> later_places = {};  ///< by the name of what events add, see Scene
  bool has_later_surfaces = false;                       ///< an event lets surfaces touch
  std::string warning_without_surfaces = {};             ///< if these never touch; empty: none
  std::vector<std::string> warnings = {};          ///< of what is read otherwise than one might expect, with its place
  std::string entry = {};                          ///< of a list at the top, which is being read: "forces[2]"
  std::map<std::string, std::string> places = {};  ///< see Scene::places
  mutable std::vector<std::pair<std::string, std::string>> implied_bodies = {};  ///< see Scene::implied_bodies
  std::map<std::string, DisabledPart> disabled = {};                             ///< see Scene::disabled
  std::vector<Index> idle_events = {};                                           ///< see Scene::idle_events
  std::map<std::string, const char*, std::less<>> off = {};  ///< of the disabled ones, at the place that is being
                                                             ///< read: "group", "force" or "collider"

  SceneBody body(BodyId id) const {
    const Mesh& mesh = simulation.body(id).mesh;
    const Positions& before = untransformed[static_cast<std::size_t>(id)];
    return {mesh, before.size() == 0 ? mesh.vertices : before, indices_[id]};
  }

  std::vector<std::pair<Index, std::string>>* left_out = nullptr;  ///< of events; null: none is left out

  void read_body(const Node& node);
  /// Its value; nothing: the default.
  void read_gravity(const std::optional<Node>& node);
  void read_force(const Node& node);
  void read_contact(const Node& node);
  /// What its object says of its contact, if that is there: after all bodies, of which it may name others.
  void read_body_contact(const Node& body, BodyId id);
  /// The bodies that a body's contact ignores.
  std::vector<BodyId> read_ignored(const Node& names, BodyId id) const;
  void read_collider(const Node& node);
  /// What the object of a collider says of how it looks. An event may add another collider of a name that was removed
  /// before: they look alike, as the last one with an appearance says.
  void read_collider_appearance(const Node& collider, const std::string& name);
  /// An entry of the list of attachments, after all bodies.
  GroupEntry read_attachment(const Node& node, std::vector<std::string_view> more_keys = {}) const;
  void add_attachment(const Node& node);
  /// What an event adds: an attachment, or a constraint with its body beside it.
  GroupEntry read_added_group(const Node& node) const;
  /// The lists "moves" and "events". They are read in the order in which they act, each as what its predecessors leave,
  /// and tried out; the simulation is as before then. `root`: the scene.
  void read_events(const Node& root);

  /// The body that the object's key "body" names; without the key, the only one that stands in the same text, or the
  /// only one there is.
  BodyId read_body_name(const Node& node) const;
  /// The body of that name; refuses a name that there is not.
  BodyId named_body(const Node& name) const;

  /// The group of a name; refuses a name that there is not.
  GroupEntry& group(const Node& name);

  /// Makes a group of what has been read, with the name in the object's key or one of its own. `place` as in places.
  void add_groups(const Node& list, BodyId body);
  void add_group(const Node& node, BodyId body, ConstraintOptions options, std::string place);
  /// Notes a part that is switched off.
  void disable_group(const Node& node, BodyId body, const ConstraintOptions& options, const std::string& name);
  void disable_force(std::string_view type, const std::string& name);
  void disable_collider(std::string_view type, const std::string& name);
  /// The name given, which must be new; else the type, with the body in front, and a number behind where that is taken.
  std::string group_name(const Node& node, BodyId body, std::string_view type);
  /// The same without a body, for a force or a collider.
  std::string own_name(const Node& node, std::string_view type);

 private:
  /// The groups of a body's material.
  /// Returns the stiffness of those groups of tetrahedra that are switched off [Pa].
  Real add_material(const Node& node, BodyId body, const BodyMaterial& given, const Node& of_body);
  BodyView view(BodyId body) const;
  /// Holds all vertices of a body, and lets them go along the path, if there is one.
  void add_animation(const Node& node, BodyId body, std::shared_ptr<Path> path);
  bool is_taken(std::string_view name) const { return owner_of(name) != nullptr; }
  /// What has that name: "group", "force", "collider"; null: nothing.
  const char* owner_of(std::string_view name) const;
  std::string read_new_name(const Node& node) const;
  std::string free_name(const std::string& base);

  mutable std::map<BodyId, std::optional<NearestVertex>> indices_ = {};
  std::map<std::string, int, std::less<>> last_numbers_ = {};  ///< behind a base, of those given so far
};

/// The value of "enabled" in an entry; without the key it is true.
bool is_enabled(const Node& entry);
/// Refuses a group without constraints; `node` is where it was read.
void check_constraints(const Node& node, const ConstraintSet& set);

}  // namespace pliant
