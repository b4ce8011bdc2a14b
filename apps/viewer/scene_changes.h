#pragma once
// What a user has changed of a scene, as a scene file has it: what a restart does again, undo takes back, and a saved
// scene is written from.
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pliant/materials/material_groups.h"
#include "pliant/simulation/parameters.h"
#include "pliant_io/scene/body_appearance.h"
#include "pliant_io/scene/scene_document.h"

namespace pliant_viewer {

using pliant::Index;
using pliant::Real;

struct ChangedValue {
  pliant::Parameter parameter;  ///< as it was when it was first changed
  pliant::Vec3 value = pliant::Vec3::Zero();

  bool operator==(const ChangedValue& other) const { return value == other.value; }
};

struct ChangedMaterial {
  std::string name;
  pliant::MaterialPlacement placement{};

  bool operator==(const ChangedMaterial& other) const { return name == other.name; }
};

/// Of a vertex that the scene pins: the groups that have let it go, or where one of them begins to hold it. One that
/// was pinned again by hand is among the pins as well, and is that group's again in a scene with the changes.
struct ReleasedPin {
  std::vector<std::string> groups;
  Index number = 0;  ///< among the targets of the first one
  bool operator==(const ReleasedPin&) const = default;
};
struct MovedPin {
  std::string group;
  Index number = 0;  ///< among the targets of the group
  pliant::Vec3 target = pliant::Vec3::Zero();
  bool operator==(const MovedPin&) const = default;
};

/// A group of constraints, a force or a collider that is switched off.
struct SwitchedOff {
  std::string type;
  std::string body{};  ///< of a group; else empty
  bool is_collider = false;
  std::vector<Index> pinned{};      ///< vertices that it held
  bool goes_with_material = false;  ///< another material takes its place
  bool operator==(const SwitchedOff&) const = default;
};

/// A force or a collider that was added.
struct AddedPart {
  std::string list;   ///< of a scene file that has it: "forces" or "colliders"
  std::string entry;  ///< of that list, JSON, as it was added
  bool operator==(const AddedPart&) const = default;
};

/// Factors of the stiffness of a group, by vertex of its body; none where the group has gone.
struct PaintedStiffness {
  std::string body;
  std::vector<Real> factors;
  bool operator==(const PaintedStiffness&) const = default;
};

/// Vertices have their indices in the simulation.
struct SceneChanges {
  std::map<std::string, ChangedValue> values;                 ///< by the key of the slider
  std::map<std::string, ChangedMaterial> materials;           ///< by body
  std::map<Index, std::optional<pliant::Vec3>> pins;          ///< set by hand, with the target where it was moved [m]
  std::map<Index, ReleasedPin> released;                      ///< of the scene's
  std::map<Index, MovedPin> moved;                            ///< of the scene's, before the first step
  std::map<std::string, pliant::Pose> collider_poses;         ///< where they begin
  std::map<std::string, pliant::BodyAppearance> appearances;  ///< by body
  std::map<std::string, PaintedStiffness> painted;            ///< by group
  std::map<std::string, AddedPart> added;                     ///< by name
  std::map<std::string, SwitchedOff> switched_off;            ///< by the name of what is off
  std::set<std::string> switched_on;                          ///< of what the scene's text has switched off

  bool operator==(const SceneChanges&) const = default;
  bool is_empty() const { return *this == SceneChanges{}; }
};

/// What of a scene as it was read its changes refer to.
class UnchangedScene {
 public:
  explicit UnchangedScene(const pliant::Scene& scene);

  /// Whether all of it was read. What a program has made, if only in part, has no text: apply() changes it.
  bool has_text() const { return has_text_; }
  /// Makes the changes of such a scene as it was made, at its start.
  /// @throws pliant::Error (input) where one does not fit.
  void apply(const SceneChanges& changes, pliant::Scene& scene) const;

  /// The scene with the changes in it. Those of what it does not have are left out; the keys of values that a text
  /// cannot have are added to `unwritten`.
  pliant::SceneDocument with(const SceneChanges& changes, std::vector<std::string>* unwritten = nullptr) const;
  /// The same as a text in place of the scene's first one, to be read again and given its factors().
  pliant::SceneText text_with(const SceneChanges& changes) const;
  /// What a text has otherwise, by key: the common factor of stiffnesses, which it has multiplied into them, and what
  /// only the simulation has a name for.
  std::map<std::string, pliant::Vec3> factors(const SceneChanges& changes) const;
  /// Takes out events that were left out when the document was read.
  static void remove_events(const std::vector<std::pair<Index, std::string>>& left_out,
                            pliant::SceneDocument& document);
  /// The number of its own events; those of changes stand behind them.
  std::size_t event_count() const { return event_count_; }
  /// A name for something new: that one, or with the first free number behind it.
  std::string free_name(const std::string& base, const SceneChanges& changes = {}) const;
  /// Shows bodies as they were changed, or else as they were read.
  void set_appearances(const SceneChanges& changes, pliant::Scene& scene) const;
  /// By what the stiffness of a group is multiplied, and of all groups of a body that have factors, or had some.
  std::vector<Real> factors_of(const std::string& group, const SceneChanges& changes) const;
  std::map<std::string, std::vector<Real>> painted_of(const std::string& body, const SceneChanges& changes) const;
  /// Whether a scene with the changes begins with a group of that name.
  bool begins_with(const std::string& group, const SceneChanges& changes) const {
    return groups_.contains(group) || off_.contains(group) || (!has_text_ && !changes.materials.empty()) ||
           is_of_material(group, changes);
  }
  /// All that is off: what the text has switched off, unless it was switched on, and what was switched off.
  std::map<std::string, SwitchedOff> switched_off(const SceneChanges& changes) const;
  /// Of what is switched off the groups that have no place in a text, and are not of a material.
  std::set<std::string> removed_by_events(const SceneChanges& changes) const;
  /// Whether a scene can do without what has that name.
  bool can_switch_off(const std::string& name, const SceneChanges& changes) const;
  /// Whether a group of that name holds pins that were set by hand, now, or before the scene was saved.
  bool is_of_hand(const std::string& group) const;

 private:
  struct BodyPart {
    std::string name;
    Index first_vertex = 0;
    Index vertex_count = 0;
    std::vector<std::string> replaced;  ///< places of the constraints that a material takes the place of
    std::string pins;                   ///< name of the group of pins that were set by hand
    std::string moved_pins;             ///< of those that were moved
  };
  bool has_number(const std::string& group, Index number) const;
  std::optional<std::size_t> find_body(const std::string& name) const;

  void write_names(const SceneChanges& changes, pliant::SceneDocument& document) const;
  bool is_replaced(const std::string& place, const SceneChanges& changes) const;
  bool is_of_material(const std::string& group, const SceneChanges& changes) const;
  void write_values(const SceneChanges& changes, pliant::SceneDocument& document,
                    std::vector<std::string>* unwritten) const;
  std::optional<std::string> path_of(const pliant::Parameter& parameter, const SceneChanges& changes) const;
  void write_materials(const SceneChanges& changes, pliant::SceneDocument& document) const;
  void write_pins(const SceneChanges& changes, pliant::SceneDocument& document) const;
  void write_colliders(const SceneChanges& changes, pliant::SceneDocument& document) const;
  void write_added(const SceneChanges& changes, pliant::SceneDocument& document) const;
  void write_appearances(const SceneChanges& changes, pliant::SceneDocument& document) const;
  void write_factors(const SceneChanges& changes, pliant::SceneDocument& document) const;
  void write_switches(const SceneChanges& changes, pliant::SceneDocument& document) const;
  void remove_entries(const SceneChanges& changes, pliant::SceneDocument& document) const;
  void read_disabled(const pliant::Scene& scene);

  pliant::Scene as_read_;  // its texts alone
  mutable std::optional<pliant::SceneDocument> document_;
  std::vector<BodyPart> bodies_;
  std::set<std::string> groups_;                        // there at the start
  std::map<std::string, std::set<Index>> pin_numbers_;  // of them, by group: what a move can name
  std::set<std::string> ties_;                          // of them, those of carried surfaces
  std::map<std::string, PaintedStiffness> factors_;     // that groups have from the start
  std::map<std::string, SwitchedOff> off_;              // that the text has switched off
  std::map<pliant::BodyId, pliant::BodyAppearance> appearances_;
  bool has_text_ = false;
  bool has_surfaces_ = false;
  std::size_t event_count_ = 0;
};

}  // namespace pliant_viewer
