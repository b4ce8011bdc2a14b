#pragma once
// The parts of a scene file that add to a simulation: bodies with their constraints, forces, moves.
#include <map>
#include <set>
#include <string>

#include "pliant/scene/detail/json_node.h"
#include "pliant/scene/detail/selection.h"
#include "pliant/scene/timeline.h"

namespace pliant {

/// What has been read so far, for what refers to it by name.
struct SceneReader {
  Simulation& simulation;
  std::vector<Positions> untransformed = {};  ///< rest positions of each body before its transform; empty: it has none
  std::map<std::string, BodyId, std::less<>> bodies = {};
  std::map<const Origin*, std::vector<BodyId>> bodies_of = {};  ///< by the text that they stand in
  std::map<std::string, GroupId, std::less<>> groups = {};

  SceneBody body(BodyId id) const {
    const Mesh& mesh = simulation.body(id).mesh;
    const Positions& before = untransformed[static_cast<std::size_t>(id)];
    return {mesh, before.size() == 0 ? mesh.vertices : before};
  }

  void read_body(const Node& node);
  void read_force(const Node& node);
  void read_move(const Node& node, Timeline& timeline);

  /// The body that the object's key "body" names; without the key, the only one that stands in the same text, or the
  /// only one there is.
  BodyId read_body_name(const Node& node) const;

 private:
  void read_constraint(const Node& node, BodyId body);
  std::string group_name(const Node& node, BodyId body, std::string_view type) const;
};

}  // namespace pliant
