#pragma once
// A scene that a user interacts with: what mouse and sliders do to it, without a window.
#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pliant_io/scene/scene.h"
#include "viewer/body_materials.h"
#include "viewer/collider_goals.h"
#include "viewer/edit.h"
#include "viewer/history.h"
#include "viewer/program_hooks.h"
#include "viewer/scene_changes.h"
#include "viewer/session_log.h"
#include "viewer/session_record.h"
#include "viewer/sliders.h"

namespace pliant_viewer {

using MakeScene = std::function<pliant::Scene()>;

class Session {
 public:
  /// Calls `make` now and at each restart; only the first scene may stand elsewhere than at its start, being of a
  /// checkpoint. @throws whatever `make` throws.
  explicit Session(MakeScene make);

  const pliant::Simulation& simulation() const { return scene_.simulation; }
  const pliant::Scene& scene() const { return scene_; }
  void set_threads(Index threads);            ///< for a scene that does not set it; see SolverSettings::threads
  void set_stop(std::function<bool()> stop);  ///< asked whether to abandon a step, see Simulation::set_stop
  void set_hooks(ProgramHooks hooks) { hooks_.set(std::move(hooks)); }
  /// Takes a step. Events that are due but can no longer act, because the user removed what they act on, are skipped.
  /// @throws pliant::Error as Scene::step does, and what before_step throws.
  pliant::StepReport step();
  pliant::Scene& measured_scene() { return scene_; }  ///< to be measured, for plots; nothing of it is changed
  pliant::Scene close();                              ///< hands the scene out, without a pull: the end of this session

  /// Makes the scene again, without a pull. `keep_changes`: values, materials, pins, and what was moved before the
  /// first step, are as they were changed, where the scene still has such a parameter, body or vertex; otherwise they
  /// are forgotten, and there is nothing to undo. If this throws, nothing has changed.
  void restart(bool keep_changes);

  /// Attaches a spring, implicit and so stable at any stiffness, to a point, replacing an earlier one.
  void grab(const Pull& pull);
  void pull_to(const Vec3f& target);  ///< moves the end of the spring; without one does nothing, as the next two
  void set_pull_stiffness(Real stiffness);
  void let_go();
  const std::optional<Pull>& pull() const { return pull_; }
  const std::string& note() const { return note_; }  ///< on the last step for the user; empty: none
  /// Pins a vertex, by its index in the simulation, where it is now; does nothing if it is pinned already. After a
  /// restart it is pinned where it begins.
  void pin(Index vertex);
  void unpin(Index vertex);  ///< whichever group its pin belongs to
  /// The same with many, as one change for undo(). @throws pliant::Error (input): there is no such vertex.
  void pin(const std::vector<Index>& vertices);
  void unpin(const std::vector<Index>& vertices);
  bool is_pinned(Index vertex) const { return find_pin(vertex).has_value(); }
  std::vector<PinnedVertex> pinned_vertices() const;  ///< by vertex, each once, but for figures
  /// Of each body, whether the scene's own hard pins hold all of it. Such pins are not the user's.
  std::vector<char> figures() const;
  /// Moves a pin to `target` [m]; motions of the scene that are under way no longer move it.
  void move_pin(Index vertex, const Vec3f& target);
  /// Takes the pins of these vertices in hand, to be moved together; vertices that are not pinned are left out.
  void hold_pins(const std::vector<Index>& vertices);
  /// Moves them from where they were then; the last motion counts. Does nothing without such pins.
  void move_held(const RigidMotion& motion);
  /// Takes a collider there [m] in the steps to come, no faster than three times the size of the bodies in a second, a
  /// plane along its normal, and leaves it at rest. It is the user's until the scene starts over: its velocities end,
  /// and motions of the scene no longer move it. Does nothing with others without an end.
  void move_collider(pliant::ColliderId collider, const Vec3f& position);
  /// The same with its rotation, axis times angle [rad], about its position; by half a turn in a second at most.
  void turn_collider(pliant::ColliderId collider, const pliant::Vec3& rotation);
  std::map<pliant::ColliderId, MovableCollider> movable_colliders() const;
  /// What is moved has been let go. Before the first step the scene begins with it there from now on; later that is
  /// one of the things that happened, which a restart forgets.
  void drop_pin(Index vertex);
  void drop_held();
  void drop_collider(pliant::ColliderId collider);
  /// Of settings, groups, forces, colliders, contact and its bodies; the pull and pins that were set by hand have none.
  std::vector<Slider> sliders() const;
  /// Sets a parameter by the key of its slider; does nothing where there is none. `goes_on`: with the change before it
  /// this is one for undo(). @throws pliant::Error (input): a value out of range.
  void set(const std::string& key, const pliant::Vec3& value, bool goes_on = false);
  std::vector<BodyMaterial> materials() const { return list_materials(scene_, figures()); }
  /// Makes the body of that name of another material, where it is. Values that were set of the groups that go are
  /// forgotten. @throws pliant::Error (input): no such body or material, or one that the body cannot be made of.
  void set_material(const std::string& body, const std::string& material);
  /// What the body of that name looks like. `goes_on`: as of set(). @throws pliant::Error (input): no such body.
  void set_appearance(const std::string& body, const pliant::BodyAppearance& appearance, bool goes_on = false);
  /// Takes a group of constraints, a force or a collider away, or brings it back as the scene begins with it and as its
  /// values were changed. @throws pliant::Error (input): no such name, or the scene cannot do without it.
  void switch_on(const std::string& name, bool on);
  std::map<std::string, bool> switches() const;  ///< of all that can be switched off, whether they are on
  std::map<std::string, SwitchedOff> switched_off() const { return unchanged_.switched_off(changes_); }
  /// Adds a force or a collider, by the name of its type (added_parts.h), on a body where it needs one.
  /// @throws pliant::Error (input): no such type or body, one that refuses it, or the scene has no text.
  void add(const std::string& type, const std::string& body = {});
  /// Adds a test force on vertices, of each body one, which holds up its weight. @throws pliant::Error as of add().
  void push(const std::vector<Index>& vertices);
  std::vector<PaintableGroup> paintable() const;  ///< groups whose stiffness can be painted
  void paint(const std::string& group, const PaintDab& dab, bool goes_on = false);  ///< Error(input) on others
  bool has_text() const { return unchanged_.has_text(); }                           ///< see UnchangedScene
  /// What undo() and redo() would take back and do again, "pin"; empty: nothing.
  std::string undone_next() const { return done_.empty() ? "" : done_.back().what; }
  std::string redone_next() const { return undone_.empty() ? "" : undone_.back().what; }
  std::uint64_t edit_count() const { return edit_count_; }  ///< of all changes so far, those taken back too
  /// Take back the last change, and do it again, where all is now. Nothing has changed when these throw.
  void undo();
  void redo();

  /// Writes a scene that has the changes in it and is shown like that, and beside it, unless it stands at its start, a
  /// checkpoint of now, from which `pliant resume` goes on; returns the names of the files. The session goes on with
  /// the bits that both have. @throws pliant::Error where a file cannot be written, or the changes do not fit the
  /// events of the scene; nothing has changed then but for the files.
  std::vector<std::filesystem::path> save(const std::filesystem::path& file, const pliant::ViewSettings& view);
  /// The text of the scene that save() writes to `file`, from where paths in it start; writes nothing.
  std::string text(const std::filesystem::path& file, const pliant::ViewSettings& view) const;
  bool has_unsaved_changes() const { return !(changes_ == saved_changes_); }  ///< since it was saved, or read
  std::uint64_t rebuilds() const { return rebuilds_; }  ///< with other changes, so far: groups have other ids then
  std::uint64_t restarts() const { return restarts_; }  ///< so far
  std::uint64_t look_changes() const { return look_changes_; }  ///< of bodies, so far
  const SceneChanges& changes() const { return changes_; }

  /// All that was done since the scene was opened, or restarted without changes, to be replayed; shown like that.
  /// `file`: where it will be. @throws pliant::Error (input): the scene was made by a program, or its files were
  /// changed while it was open.
  SessionRecord record(const std::filesystem::path& file, const pliant::ViewSettings& view) const;
  /// From now on does with every step what was done then; of a session that was just made by scene_maker_of(). Whatever
  /// else is done ends it, as does an action that fails: its error comes from here, or from step().
  void replay(SessionRecord record);
  bool is_replaying() const { return replay_.has_value(); }
  const ReplayReport& replayed() const { return replayed_; }  ///< the last one, or the one under way

 private:
  SessionLog::Scope note(Action action);
  void do_again(const Action& action);
  void do_what_is_due();
  void check_replay();
  void begin_record(const pliant::Scene& scene);
  WrittenScene prepare_save(const std::filesystem::path& file, const pliant::ViewSettings& view) const;
  void go_on_as(WrittenScene written);
  WrittenScene write_text(const std::filesystem::path& file, const pliant::ViewSettings& view) const;
  std::optional<Pin> find_pin(Index vertex) const;
  std::map<Index, std::vector<Pin>> find_pins(const std::vector<Index>& vertices) const;
  void stop_motions(const std::map<Index, std::vector<Pin>>& pinned);
  void note_moved(Index vertex, const Pin& pin);
  pliant::Vec3 target_of(const Pin& pin) const { return scene_.simulation.target(pin.group, pin.target); }
  pliant::BodyId body_of(Index vertex) const;
  pliant::BodyId find_body(const std::string& name) const;
  void take_collider(pliant::ColliderId collider);
  void note_release(Index vertex, const pliant::Group& group, const Pin& pin);
  bool is_hidden(pliant::GroupId group) const;
  bool was_of_hand(const pliant::Group& group) const;
  SwitchedOff what_is_switched_off(const std::string& name) const;
  void change_parts(SceneChanges changes, std::string what);
  void remember(Edit edit);
  void take_old_values_of(const std::vector<Slider>& at_start);
  void go(const Edit& edit, const SceneChanges& from, const SceneChanges& to);
  pliant::Scene read_changed(pliant::SceneText text) const;
  pliant::Scene make_with(const SceneChanges& changes, const UnchangedScene& unchanged) const;
  void carry_into(pliant::Scene& next, const SceneChanges& to, const std::set<std::string>& but = {}) const;
  void settle(pliant::Scene next);
  void renumber_colliders(const pliant::Simulation& next);
  void take(pliant::Scene next);
  void set_looks(const SceneChanges& changes);
  void set_painted(const SceneChanges& from, const SceneChanges& to);
  void keep_paint_of(const std::string& body, const std::set<std::string>& removed);

  MakeScene make_;
  pliant::Scene scene_;
  std::function<bool()> stop_;
  HookCaller hooks_;
  UnchangedScene unchanged_;
  SceneChanges changes_, saved_changes_;
  std::vector<Edit> done_, undone_;
  std::map<std::string, pliant::MaterialPlacement> placements_;  // of the bodies whose material changed, as they had it
  std::set<pliant::ColliderId> left_alone_;                      // moved by hand while time went on
  std::set<pliant::GroupId> of_hand_;                            // groups of pins that were set by hand
  std::uint64_t rebuilds_ = 0, restarts_ = 0, edit_count_ = 0, look_changes_ = 0;
  OpenedScene opened_;
  SessionLog log_;
  std::optional<Replay> replay_;
  ReplayReport replayed_;
  bool is_doing_again_ = false, have_held_moved_ = false;
  PaintStroke stroke_;
  std::optional<Pull> pull_;
  std::optional<pliant::GroupId> pull_group_;
  std::map<Index, pliant::Vec3> held_pins_;  // that are moved together, and where they were when they were taken [m]
  ColliderGoals goals_;
  std::string note_;
};

}  // namespace pliant_viewer
