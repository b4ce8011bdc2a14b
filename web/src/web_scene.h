#pragma once
// A scene as a web page has it: read from a text, stepped, pulled, pinned, changed. Vertices have the indices of the
// simulation. What a user does wrong throws pliant::Error, with the scene as it was.
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pliant/simulation/parameters.h"
#include "pliant_io/scene/scene.h"

namespace pliant_web {

using pliant::Index;
using pliant::Real;
using pliant::Vec3;

class WebScene {
 public:
  /// `text`: JSON, as in a scene file; it can include built-in scenes, but no files. `name`: what messages call it.
  WebScene(const std::string& text, const std::string& name);

  const pliant::Scene& scene() const { return scene_; }
  const pliant::Positions& positions() const { return scene_.simulation.state().positions; }
  /// The surfaces of all bodies.
  std::vector<pliant::Triangle> triangles() const;

  void step() { scene_.step(); }

  /// Draws a vertex to `target` [m] by a spring [N/m], in place of an earlier one; stable at any stiffness.
  void grab(Index vertex, Real stiffness, const Vec3& target);
  /// Moves the end of that spring; does nothing without one, as does the next.
  void pull_to(const Vec3& target);
  void let_go();

  /// Holds a vertex where it is now; moves the pin of one that was pinned so; lets go of it.
  void pin(Index vertex);
  void move_pin(Index vertex, const Vec3& target);
  void unpin(Index vertex);

  std::vector<pliant::Parameter> parameters() const { return list_parameters(scene_.simulation); }
  /// Sets an option of the settings (`owner` empty), or of the group, force, collider or body of that name.
  void set(const std::string& owner, const std::string& option, const Vec3& value);

 private:
  pliant::BodyId body_of(Index vertex) const;

  pliant::Scene scene_;
  std::optional<pliant::GroupId> spring_;
  std::map<Index, pliant::GroupId> pins_;
};

}  // namespace pliant_web
