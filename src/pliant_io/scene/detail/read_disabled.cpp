// What a scene has switched off: read and checked as everything else, and left out of the simulation.
#include "pliant/materials/change_material.h"
#include "pliant/simulation/held.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/scene_reader.h"

namespace pliant {

bool is_enabled(const Node& entry) {
  bool enabled = true;
  read_optional(entry, "enabled", enabled);
  return enabled;
}

void check_constraints(const Node& node, const ConstraintSet& set) {
  if (set.count == 0 && set.skipped == 0) {
    node.fail(
        "makes no constraint, since the mesh has none of its stencils in the selection; select more, or remove it");
  }
}

BodyView SceneReader::view(BodyId id) const {
  const Body& body = simulation.body(id);
  const State& state = simulation.state();
  return {body.mesh, state.positions.middleRows(body.first_vertex, body.mesh.vertex_count()), body.first_vertex,
          body.name, state.time};
}

void SceneReader::disable_group(const Node& node, BodyId id, const ConstraintOptions& options,
                                const std::string& name) {
  const auto see = [this](BodyId body) { return view(body); };
  const Group group = node.locate(
      [&] { return std::visit([&](const auto& of_type) { return group_of(id, of_type, name, see); }, options); });
  check_constraints(node, group.set);
  DisabledPart part{.type = group.type, .body = id, .goes_with_material = goes_with_material(group)};
  if (group.type == Position::info.name) part.pinned = vertices_of_pins(group);
  disabled.emplace(name, std::move(part));
  off.emplace(name, "group");
}

void SceneReader::disable_force(std::string_view type, const std::string& name) {
  disabled.emplace(name, DisabledPart{.type = std::string(type)});
  off.emplace(name, "force");
}

void SceneReader::disable_collider(std::string_view type, const std::string& name) {
  disabled.emplace(name, DisabledPart{.type = std::string(type), .is_collider = true});
  off.emplace(name, "collider");
}

}  // namespace pliant
