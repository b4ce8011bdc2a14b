#include "pliant_io/scene/detail/collider_options.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/scene_reader.h"

namespace pliant {
namespace {

/// Calls f with default options of each type of collider.
template <class... Options>
void for_each_collider(std::tuple<Options...>*, auto&& f) {
  (f(Options{}), ...);
}

void for_each_collider(auto&& f) {
  for_each_collider(static_cast<BuiltinColliders*>(nullptr), f);
}

template <class Options>
void read_collider_entry(const Node& node, std::vector<std::string_view> more_keys, Options& options) {
  read_options(node, options, std::move(more_keys));
  if (options.friction.each()) {
    node.require("friction").fail("a collider has one friction for all of its surface; give a number");
  }
}

}  // namespace

bool is_collider_type(std::string_view type) {
  bool found = false;
  for_each_collider([&](const auto& options) { found = found || options.info.name == type; });
  return found;
}

ColliderOptions read_collider_options(const Node& node, std::vector<std::string_view> more_keys) {
  more_keys.insert(more_keys.end(), {"type", "name", "appearance"});
  const Node type = node.require("type");
  std::string name;
  read(type, name);
  std::optional<ColliderOptions> found;
  std::vector<std::string_view> names;
  for_each_collider([&](auto options) {
    names.push_back(options.info.name);
    if (options.info.name != name) return;
    read_collider_entry(node, more_keys, options);
    found = std::move(options);
  });
  if (found) return *std::move(found);
  if (name == "mesh") type.fail("a mesh that others meet is a body with the key 'animation'; move it to 'bodies'");
  type.fail(fmt::format("unknown collider '{}'; {}", printable(name), suggestion_text(name, names)));
}

void read_changed_collider(const Node& node, std::vector<std::string_view> more_keys, ColliderOptions& options) {
  std::visit([&](auto& of_type) { read_collider_entry(node, std::move(more_keys), of_type); }, options);
}

std::string_view type_of(const ColliderOptions& options) {
  return std::visit([](const auto& of_type) { return of_type.info.name; }, options);
}

ColliderId add(Simulation& simulation, const ColliderOptions& options, const std::string& name) {
  return std::visit([&](const auto& of_type) { return simulation.add(of_type, name); }, options);
}

void replace(Simulation& simulation, ColliderId collider, const ColliderOptions& options) {
  std::visit([&](const auto& of_type) { simulation.replace(collider, of_type); }, options);
}

void SceneReader::read_contact(const Node& node) {
  ContactSettings settings;
  read_options(node, settings);
  node.locate([&] { simulation.set_contact(settings); });
}

void SceneReader::read_body_contact(const Node& body, BodyId id) {
  const auto node = body.find("contact");
  if (!node) return;
  BodyContact contact = simulation.body(id).contact;  // of its material
  read_options(*node, contact, {"ignores"});
  if (const auto names = node->find("ignores")) contact.ignores = read_ignored(*names, id);
  node->locate([&] { simulation.set_contact(id, contact); });
}

std::vector<BodyId> SceneReader::read_ignored(const Node& names, BodyId id) const {
  names.require_list();
  std::vector<BodyId> ignored;
  for (std::size_t i = 0; i < names.size(); ++i) {
    const BodyId other = named_body(names[i]);
    if (other == id) names[i].fail("this is the body itself; give \"self\": false to let it not touch itself");
    ignored.push_back(other);
  }
  return ignored;
}

void SceneReader::read_collider(const Node& node) {
  ColliderOptions options = read_collider_options(node, {"enabled"});
  const std::string name = own_name(node, type_of(options));
  read_collider_appearance(node, name);
  places.emplace(name, entry);
  if (!is_enabled(node)) return disable_collider(type_of(options), name);
  node.locate([&] { add(simulation, options, name); });
  colliders.emplace(name, std::move(options));
}

void SceneReader::read_collider_appearance(const Node& collider, const std::string& name) {
  const auto node = collider.find("appearance");
  if (!node) return;
  ColliderAppearance appearance;
  read_options(*node, appearance);
  collider_appearances.insert_or_assign(name, appearance);
}

}  // namespace pliant
