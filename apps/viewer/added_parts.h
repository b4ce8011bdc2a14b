#pragma once
// Forces and colliders that are added by hand.
#include <string>
#include <string_view>
#include <vector>

#include "pliant/mesh/geometry.h"
#include "viewer/scene_changes.h"

namespace pliant_viewer {

/// What a menu offers.
struct AddableType {
  std::string_view list;  ///< of a scene file that has it: "forces" or "colliders"
  std::string_view name;  ///< of the type: "wind"
  bool is_of_body;        ///< acts on one body, which is to be named
};

/// Of the built-in types all that act with their defaults, but for gravity, of which a scene has one.
std::vector<AddableType> addable_types();

/// Whether a pressure can be in a body: its surface has no border and encloses a volume.
bool can_hold_pressure(const pliant::Mesh& mesh);

/// The entry of a scene file for a force or a collider of that type; a collider stands beneath what is in `bodies` [m],
/// or above it where it would be under the floor. @throws pliant::Error (input): no such type, or no body for one of
/// a body.
AddedPart make_part(const std::string& type, const std::string& name, const std::string& body,
                    const pliant::BoundingBox& bodies, Real floor);

/// The same for a test force [N] on vertices of a body, by their numbers in it.
AddedPart make_push(const std::string& name, const std::string& body, const std::vector<Index>& vertices,
                    const pliant::Vec3& force);

}  // namespace pliant_viewer
