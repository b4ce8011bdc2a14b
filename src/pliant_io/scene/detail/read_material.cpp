#include "pliant_io/scene/detail/read_material.h"

#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/nearest_names.h"

namespace pliant {
namespace {

const Material& named_material(const Node& node, const OwnMaterials& own) {
  std::string name;
  read(node, name);
  if (const auto found = own.find(name); found != own.end()) return found->second;
  if (const Material* found = find_builtin_material(name)) return *found;
  std::vector<std::string_view> names;
  for (const auto& [known, material] : own) names.push_back(known);
  for (const Material& material : builtin_materials()) names.push_back(material.name);
  node.fail(fmt::format("unknown material '{}'; {}", printable(name), suggestion_text(name, names)));
}

template <class Options>
void add_keys(std::vector<std::string_view>& keys) {
  const Options options;
  Options::visit(options, [&](const OptionInfo& info, const auto&) { keys.push_back(info.name); });
}

/// Takes the numbers that the object has into the material. Other keys than theirs and these are refused.
void read_numbers(const Node& node, std::vector<std::string_view> keys, Material& material) {
  const auto read_of = [&]<class Properties>(Properties& properties) {
    add_keys<Properties>(keys);
    add_keys<SurfaceMaterial>(keys);
    node.check_keys(keys);
    Properties::visit(properties, OptionReader{node});
  };
  std::visit(read_of, material.of);
  SurfaceMaterial::visit(material.surface, OptionReader{node});
}

/// A material with no more than its kind, which must have a mass and a stiffness then.
Material new_material(const Node& node) {
  Material material;
  const Node kind = node.require("kind");
  std::string name;
  read(kind, name);
  const auto require = [&](std::initializer_list<std::string_view> keys) {
    for (const std::string_view key : keys) node.require(key);
  };
  if (name == "sheet") {
    material.of = SheetMaterial{};
    require({"area_density", "stretch_warp", "stretch_weft", "shear", "bending"});
  } else if (name == "solid") {
    material.of = SolidMaterial{};
    require({"density", "young_modulus", "poisson"});
  } else {
    kind.fail(fmt::format("unknown kind '{}'; give \"sheet\" or \"solid\"", printable(name)));
  }
  return material;
}

}  // namespace

OwnMaterials read_materials(const Node& node) {
  node.require_object();
  OwnMaterials own;
  for (const std::string_view name : node.keys()) {
    const Node entry = node.require(name);
    entry.require_object();
    const auto like = entry.find("like");
    if (like && entry.has("kind")) entry.require_one_of({"like", "kind"});
    Material material = like ? named_material(*like, own) : new_material(entry);
    read_numbers(entry, {"like", "kind", "description", "source"}, material);
    material.name = name;
    read_optional(entry, "description", material.description);
    read_optional(entry, "source", material.source);
    if (name.empty()) entry.fail("an empty name cannot be referred to; give one");
    own.insert_or_assign(material.name, material);
  }
  return own;
}

BodyMaterial read_body_material(const Node& node, const OwnMaterials& own) {
  if (node.is_text()) return {named_material(node, own), {}};
  if (!node.is_object()) node.fail_type("the name of a material, or an object with its 'name'");
  BodyMaterial made{named_material(node.require("name"), own), {}};
  std::vector<std::string_view> keys = {"name"};
  add_keys<MaterialPlacement>(keys);
  read_numbers(node, keys, made.material);
  MaterialPlacement::visit(made.placement, OptionReader{node});
  return made;
}

}  // namespace pliant
