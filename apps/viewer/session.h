#pragma once
// A scene that is played with: what a hand and the sliders do to it, without a window.
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "pliant_io/scene/scene.h"
#include "viewer/parameters.h"
#include "viewer/picking.h"

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
  /// Makes the scene, now and at each restart. Throws what `make` throws.
  explicit Session(MakeScene make);

  const pliant::Simulation& simulation() const { return scene_.simulation; }
  const pliant::Scene& scene() const { return scene_; }
  /// For a scene that leaves it open; see SolverSettings::threads.
  void set_threads(Index threads);
  /// Asked whether a step is to be given up, see Simulation::set_stop.
  void set_stop(std::function<bool()> stop);
  /// Takes a step. Where a hand has changed the scene so that an event of it can no longer act, those that are due are
  /// left out. @throws pliant::Error as Scene::step does.
  pliant::StepReport step();

  /// Makes the scene anew, with no pull. `keep_values`: what was set by set() is set again, else it is forgotten. When
  /// this throws, nothing has changed.
  void restart(bool keep_values);

  /// Lets a spring draw at a point, in place of an earlier one: implicit, hence stable at any stiffness.
  void grab(const Pull& pull);
  /// Moves the end of the spring; without one nothing happens, as for the others.
  void pull_to(const Vec3f& target);
  void set_pull_stiffness(Real stiffness);
  void let_go();
  const std::optional<Pull>& pull() const { return pull_; }
  /// What a user should know of the last step; empty for nothing.
  const std::string& note() const { return note_; }

  /// Holds a vertex, by its index in the simulation, where it is now; nothing happens to one that is pinned.
  void pin(Index vertex);
  /// Lets it go, of whichever group the pin is.
  void unpin(Index vertex);
  bool is_pinned(Index vertex) const { return find_pin(vertex).has_value(); }
  /// Moves a pin; what moved it before no longer does.
  void move_pin(Index vertex, const Vec3f& target);

  std::vector<Parameter> parameters() const { return list_parameters(simulation(), pull_group_); }
  /// Sets a parameter by its key (Parameter::key). Throws Error(input) on a value out of its range.
  void set(const std::string& key, const pliant::Vec3& value);

 private:
  /// Where a vertex is pinned: the group, and which of its targets that is.
  struct Pin {
    pliant::GroupId group{};
    Index target = 0;
  };
  std::optional<Pin> find_pin(Index vertex) const;
  pliant::BodyId body_of(Index vertex) const;

  MakeScene make_;
  pliant::Scene scene_;
  std::function<bool()> stop_;
  std::map<std::string, pliant::Vec3> values_;  // as set by set()
  std::optional<Pull> pull_;
  std::optional<pliant::GroupId> pull_group_;
  std::string note_;
};

/// A stiffness that lifts the scene's bodies without much stretch of the spring [N/m].
Real suggest_pull_stiffness(const pliant::Simulation& simulation);

}  // namespace pliant_viewer
