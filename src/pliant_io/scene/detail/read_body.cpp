#include "pliant/mesh/geometry.h"
#include "pliant/simulation/carried_surface.h"
#include "pliant/timeline/animated_body.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/read_animation.h"
#include "pliant_io/scene/detail/read_factors.h"
#include "pliant_io/scene/detail/read_mesh.h"
#include "pliant_io/scene/detail/read_solid.h"
#include "pliant_io/scene/detail/scene_files.h"
#include "pliant_io/scene/detail/scene_reader.h"
#include "pliant_io/scene/texture_file.h"

namespace pliant {
namespace {

Positions read_velocities(const Node& node, const Mesh& mesh) {
  if (node.has("velocity") && node.has("velocities")) node.require_one_of({"velocity", "velocities"});
  Positions velocities;
  read_optional(node, "velocities", velocities);
  if (const auto common = node.find("velocity")) {
    Vec3 velocity;
    read(*common, velocity);
    return velocity.transpose().replicate(mesh.vertex_count(), 1);
  }
  if (mesh.embedding.is_empty()) return velocities;
  return completed_rows(mesh, std::move(velocities), Positions::Zero(mesh.vertex_count(), 3));
}

/// Refuses a list of other than one row a vertex, which the simulation would take for "not given" when empty. Of a
/// solid made from its surface there may be as many as that has.
void check_rows(const Node& node, std::string_view key, const Mesh& mesh) {
  const auto rows = node.find(key);
  if (!rows || (rows->is_list() && !rows->empty() && count_of(*rows) == mesh.embedding.carried_count())) return;
  rows->require_list(static_cast<std::size_t>(mesh.vertex_count()), "(one a vertex)");
}

/// What is animated goes where it is told, whatever it weighs: without a mass it has a kilogram.
/// What has a material weighs what that does.
Mass read_body_mass(const Node& body, const Mesh& mesh, const std::string& name,
                    const std::optional<BodyMaterial>& material, std::vector<std::string>& warnings) {
  const bool by_material = material && !body.has("mass");
  if (!by_material && !body.has("mass") && body.has("animation")) {
    return Mass::per_vertex(Real{1} / mesh.vertex_count());
  }
  const Node node = body.require(by_material ? "material" : "mass");
  Mass mass = by_material ? mass_of(material->material) : read_mass(node, mesh);
  mass = with_loose_vertices(std::move(mass), node, mesh, warnings);
  node.locate([&] { vertex_masses(mesh, mass, printable(name)); });
  return mass;
}

/// The texture's path is from the root from here on. One that cannot be read moves nothing otherwise, so it is told and
/// no more.
BodyAppearance read_appearance(const Node& node, std::vector<std::string>& warnings) {
  BodyAppearance appearance;
  read_options(node, appearance);
  if (appearance.texture.empty()) return appearance;
  const Node texture = node.require("texture");
  const std::filesystem::path path = read_path(texture);
  try {
    check_texture_file(path);
  } catch (const Error& error) {
    if (error.kind() != ErrorKind::input) throw;
    warnings.push_back(texture.at(fmt::format("{}; the body has its plain color", error.what())));
  }
  appearance.texture = absolute_path(path).string();
  return appearance;
}

/// Names of groups of the body's material that are switched off.
std::vector<std::string> read_disabled_groups(const Node& body) {
  std::vector<std::string> names;
  const auto list = body.find("disabled_groups");
  if (!list) return names;
  list->require_list();
  for (std::size_t i = 0; i < list->size(); ++i) read((*list)[i], names.emplace_back());
  return names;
}

/// Refuses names that are no groups of the material.
void check_disabled_groups(const Node& body, BodyId id, const SceneReader& scene) {
  const std::vector<std::string> names = read_disabled_groups(body);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Node node = body.require("disabled_groups")[i];
    if (scene.places.contains(names[i])) {
      node.fail(fmt::format("'{}' has an entry of its own; write \"enabled\": false there", printable(names[i])));
    }
    const auto off = scene.disabled.find(names[i]);
    if (off == scene.disabled.end() || off->second.body != id) {
      node.fail(fmt::format("'{}' is no group of the body's material; leave it out", printable(names[i])));
    }
  }
}

}  // namespace

void SceneReader::read_body(const Node& node) {
  node.check_keys({"name", "mesh", "transform", "mass", "start_positions", "velocity", "velocities", "constraints",
                   "contact", "animation", "material", "solid", "appearance", "stiffness_factors", "disabled_groups"});
  BodyOptions options;
  options.name = fmt::format("body {}", bodies.size());
  read_optional(node, "name", options.name);
  if (bodies.contains(options.name)) {
    node.find("name").value_or(node).fail(
        fmt::format("the name '{}' is another body's; choose another", printable(options.name)));
  }

  const Node mesh_node = node.require("mesh");
  Mesh mesh = read_mesh(mesh_node, warnings);
  mesh_node.locate([&] { check_mesh(mesh, printable(options.name)); });
  untransformed.emplace_back();
  if (const auto transform = node.find("transform")) {
    untransformed.back() = mesh.vertices;
    apply_transform(*transform, mesh.vertices);
    transform->locate([&] { check_mesh(mesh, printable(options.name)); });
  }
  if (const auto solid = node.find("solid")) {
    if (untransformed.back().size() == 0) untransformed.back() = mesh.vertices;  // those of the lattice are no corners
    read_solid(*solid, node, options.name, mesh, warnings);
  }
  const Index vertex_count = mesh.vertex_count();
  const auto animation_node = node.find("animation");
  const auto material_node = node.find("material");
  std::optional<BodyMaterial> material;
  if (material_node) {
    material = read_body_material(*material_node, materials);
    const std::string reason = misfit(material->material, mesh);
    if (!reason.empty()) material_node->fail(reason);
  }
  const Mass mass = read_body_mass(node, mesh, options.name, material, warnings);
  check_rows(node, "start_positions", mesh);
  check_rows(node, "velocities", mesh);
  read_optional(node, "start_positions", options.start);
  options.start = completed_rows(mesh, std::move(options.start), mesh.vertices);
  options.velocities = read_velocities(node, mesh);
  BodyAnimation animation;
  if (animation_node) animation = read_animation(*animation_node, node, vertex_count);
  if (animation.begin) options.start = *std::move(animation.begin);

  const std::string name = options.name;
  const BodyId id = node.locate([&] { return simulation.add_body(std::move(mesh), mass, std::move(options)); });
  bodies.emplace(name, id);
  bodies_of[&node.origin()].push_back(id);
  if (const auto appearance = node.find("appearance")) appearance_of[id] = read_appearance(*appearance, warnings);
  if (animation_node) add_animation(*animation_node, id, std::move(animation.path));
  Real stiffness_off = 0;
  if (material) stiffness_off = add_material(*material_node, id, *material, node);
  if (const auto constraints = node.find("constraints")) add_groups(*constraints, id);
  // Ties are as stiff as the whole material asks for, so that a switch does not change them.
  const Real all = stiffness_off + tetrahedron_stiffness(simulation, id);
  const Real ties = stiffness_off > 0 ? tie_ratio * all : 0;
  if (node.has("solid")) carry_surface(simulation, id, ties, free_name(name + ".surface"));
  if (const auto factors = node.find("stiffness_factors")) {
    read_stiffness_factors(*factors, id, disabled, simulation);
  }
  check_disabled_groups(node, id, *this);
}

Real SceneReader::add_material(const Node& node, BodyId id, const BodyMaterial& given, const Node& of_body) {
  const std::vector<std::string> without = read_disabled_groups(of_body);
  Real stiffness_off = 0;
  for (const MaterialGroup& group : material_groups(given.material, given.placement)) {
    const std::string name = free_name(fmt::format("{}.{}", simulation.body(id).name, group.name));
    ConstraintOptions options = std::visit([](const auto& of) { return ConstraintOptions(of); }, group.options);
    if (std::ranges::find(without, name) != without.end()) {
      if (!simulation.body(id).mesh.tetrahedra.empty()) stiffness_off += stiffness_of(options)[0];
      disable_group(node, id, options, name);
      continue;
    }
    node.locate([&] { add(simulation, id, options, name); });
    groups.emplace(name, GroupEntry{id, std::move(options)});
  }
  simulation.set_contact(id, {.friction = given.material.surface.friction});
  material_of.emplace(id, given.material);
  return stiffness_off;
}

void SceneReader::add_animation(const Node& node, BodyId id, std::shared_ptr<Path> path) {
  const std::string name = group_name(node, id, "animation");
  node.locate([&] { animate(simulation, timeline, id, std::move(path), name); });
  groups.emplace(name, GroupEntry{id, Position{}});
  if (!warning_without_surfaces.empty()) return;
  warning_without_surfaces = node.at("nothing meets an animated body; set \"contact\": {\"surfaces\": true}");
}

void SceneReader::add_groups(const Node& list, BodyId id) {
  list.require_list();
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Node constraint = list[i];
    constraint.require_object();
    add_group(constraint, id, read_constraint_options(constraint, {"name", "enabled"}, body(id)),
              fmt::format("{}.constraints[{}]", entry, i));
  }
}

void SceneReader::add_group(const Node& node, BodyId id, ConstraintOptions options, std::string place) {
  const std::string name = group_name(node, id, type_of(options));
  places.emplace(name, std::move(place));
  if (!is_enabled(node)) return disable_group(node, id, options, name);
  const GroupId group = node.locate([&] { return add(simulation, id, options, name); });
  check_constraints(node, simulation.groups().at(group).set);
  groups.emplace(name, GroupEntry{id, std::move(options)});
}

std::string SceneReader::read_new_name(const Node& node) const {
  std::string name;
  read(node, name);
  if (name.empty()) node.fail("an empty name cannot be referred to; give one, or leave out the key");
  if (name == Gravity::info.name) node.fail("the name 'gravity' is that of the force at the top; choose another");
  if (const char* owner = owner_of(name)) {
    node.fail(fmt::format("the name '{}' is another {}'s; choose another", printable(name), owner));
  }
  return name;
}

const char* SceneReader::owner_of(std::string_view name) const {
  if (groups.contains(name)) return "group";
  if (forces.contains(name)) return "force";
  if (colliders.contains(name)) return "collider";
  const auto found = off.find(name);
  return found == off.end() ? nullptr : found->second;
}

std::string SceneReader::free_name(const std::string& base) {
  int& last_number = last_numbers_[base];  // thousands may have no name of their own
  std::string name = base;
  if (last_number == 0) last_number = 1;
  while (is_taken(name)) name = fmt::format("{} {}", base, ++last_number);
  return name;
}

std::string SceneReader::group_name(const Node& node, BodyId id, std::string_view type) {
  const auto given = node.find("name");
  return given ? read_new_name(*given) : free_name(fmt::format("{}.{}", simulation.body(id).name, type));
}

std::string SceneReader::own_name(const Node& node, std::string_view type) {
  const auto given = node.find("name");
  return given ? read_new_name(*given) : free_name(std::string(type));
}

GroupEntry& SceneReader::group(const Node& node) {
  std::string name;
  read(node, name);
  const auto found = groups.find(name);
  if (found != groups.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& [known, meant] : groups) names.push_back(known);
  node.fail(fmt::format("unknown group '{}'; {}", printable(name), suggestion_text(name, names)));
}

BodyId SceneReader::read_body_name(const Node& node) const {
  const auto given = node.find("body");
  if (!given) {
    if (bodies.size() == 1) return bodies.begin()->second;
    const auto own = bodies_of.find(&node.origin());
    if (own != bodies_of.end() && own->second.size() == 1) {
      implied_bodies.emplace_back(entry, simulation.body(own->second.front()).name);
      return own->second.front();
    }
  }
  if (!given) node.fail("there are several bodies; name one with the key 'body'");
  return named_body(*given);
}

BodyId SceneReader::named_body(const Node& node) const {
  std::string name;
  read(node, name);
  const auto found = bodies.find(name);
  if (found != bodies.end()) return found->second;
  std::vector<std::string_view> names;
  for (const auto& [known, id] : bodies) names.push_back(known);
  node.fail(fmt::format("unknown body '{}'; {}", printable(name), suggestion_text(name, names)));
}

}  // namespace pliant
