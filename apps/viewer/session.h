#pragma once
// A scene that a user interacts with: what mouse and sliders do to it, without a window.
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "pliant_io/scene/scene.h"
#include "viewer/body_materials.h"
#include "viewer/picking.h"
#include "viewer/sliders.h"

namespace pliant_viewer {

using MakeScene = std::function<pliant::Scene()>;

/// The spring between the mouse and a point of a body.
struct Pull {
  SurfacePoint point;
  Vec3f target = {0, 0, 0};  ///< [m]
  Real stiffness = 1;        ///< [N/m]
};

class Session {
 public:
  /// Calls `make` now and at each restart. @throws whatever `make` throws.
  explicit Session(MakeScene make);

  const pliant::Simulation& simulation() const { return scene_.simulation; }
  const pliant::Scene& scene() const { return scene_; }
  /// For a scene that does not set it; see SolverSettings::threads.
  void set_threads(Index threads);
  /// `stop` is asked whether to abandon a step, see Simulation::set_stop.
  void set_stop(std::function<bool()> stop);
  /// Takes a step. Events that are due but can no longer act, because the user removed what they act on, are skipped.
  /// @throws pliant::Error as Scene::step does.
  pliant::StepReport step();

  /// Makes the scene again, without a pull. `keep_values`: materials and values that were set are set again, where the
  /// scene still has such a body or parameter; otherwise they are forgotten. If this throws, nothing has changed.
  void restart(bool keep_values);

  /// Attaches a spring to a point, replacing an earlier one. It is implicit, hence stable at any stiffness.
  void grab(const Pull& pull);
  /// Moves the end of the spring; does nothing without one, as do the next two.
  void pull_to(const Vec3f& target);
  void set_pull_stiffness(Real stiffness);
  void let_go();
  const std::optional<Pull>& pull() const { return pull_; }
  /// A note on the last step for the user; empty for none.
  const std::string& note() const { return note_; }

  /// Pins a vertex, by its index in the simulation, where it is now; does nothing if it is pinned already.
  void pin(Index vertex);
  /// Releases the vertex, whichever group its pin belongs to.
  void unpin(Index vertex);
  bool is_pinned(Index vertex) const { return find_pin(vertex).has_value(); }
  /// Moves a pin to `target` [m]; motions of the scene no longer move it.
  void move_pin(Index vertex, const Vec3f& target);

  /// Takes a collider there in the steps to come, no faster than three times the size of the bodies in a second, and
  /// leaves it at rest. It is the user's until the scene starts over: velocities of its own end, and motions of the
  /// scene no longer move it. Does nothing with a collider that has no end.
  void move_collider(pliant::ColliderId collider, const Vec3f& position);

  /// Of the scene's settings, groups, forces and colliders, and of contact and its bodies; the pull and pins that were
  /// set by hand have none.
  std::vector<Slider> sliders() const;
  /// Sets a parameter by the key of its slider; does nothing where there is none. @throws pliant::Error (input): a
  /// value out of range.
  void set(const std::string& key, const pliant::Vec3& value);

  /// What the bodies are made of, for the panel.
  std::vector<BodyMaterial> materials() const { return list_materials(scene_); }
  /// Makes the body of that name of another material, where it is. Values that were set of the groups that go are
  /// forgotten. @throws pliant::Error (input): no such body or material, or one that the body cannot be made of.
  void set_material(const std::string& body, const std::string& material);

 private:
  /// Where a vertex is pinned: the group, and which of its targets that is.
  struct Pin {
    pliant::GroupId group{};
    Index target = 0;
  };
  std::optional<Pin> find_pin(Index vertex) const;
  pliant::BodyId body_of(Index vertex) const;
  void steer_colliders();

  MakeScene make_;
  pliant::Scene scene_;
  std::function<bool()> stop_;
  std::map<std::string, pliant::Vec3> values_;                   // from set()
  std::map<std::string, std::string> materials_;                 // from set_material(), by body
  std::map<std::string, pliant::MaterialPlacement> placements_;  // of these bodies, as the scene has them
  std::optional<Pull> pull_;
  std::optional<pliant::GroupId> pull_group_;
  std::map<pliant::ColliderId, pliant::Vec3> collider_goals_;  // of those that are on their way [m]
  Real collider_speed_ = 1;                                    // the most by which they go there [m/s]
  std::string note_;
};

/// A stiffness [N/m] with which the mouse can lift the scene's bodies while the spring stretches little.
Real suggest_pull_stiffness(const pliant::Simulation& simulation);

}  // namespace pliant_viewer
