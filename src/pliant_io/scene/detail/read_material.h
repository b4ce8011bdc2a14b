#pragma once
// Materials of a scene: those of its key "materials", and what a body's key "material" says.
#include <map>
#include <string>

#include "pliant/materials/material_groups.h"
#include "pliant_io/scene/detail/json_node.h"

namespace pliant {

/// By name; they hide those of the library.
using OwnMaterials = std::map<std::string, Material, std::less<>>;

/// The object of the key "materials": each by itself (`kind`), or `like` another that stands before it or in the
/// library, with some of its numbers changed.
OwnMaterials read_materials(const Node& node);

/// What a body is made of, and how it lies.
struct BodyMaterial {
  Material material;
  MaterialPlacement placement;
};

/// A name, or an object with the name, numbers that differ, and how the material lies.
BodyMaterial read_body_material(const Node& node, const OwnMaterials& own);

}  // namespace pliant
