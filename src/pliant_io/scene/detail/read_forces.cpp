#include "pliant_io/scene/detail/force_options.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/scene_reader.h"

namespace pliant {
namespace {

/// Whether all keys that a force must have are wanted, or only those that change.
enum class Reading { all, changes };

/// "vertices" as any selection, or "vertex" for one.
void read_force_vertices(const Node& node, const SceneBody& body, Selection& vertices) {
  if (node.require_one_of({"vertex", "vertices"}) == "vertices") return;  // read with the other options
  vertices = Selection({read_vertex(node.require("vertex"), body.mesh.vertex_count())});
}

template <class Options>
void read_entry(const Node& node, std::vector<std::string_view> keys, const SceneReader& scene, Reading reading,
                std::optional<BodyId>& body, Options& options) {
  constexpr bool has_vertices = requires {
    options.vertices;
  };
  const bool is_new = reading == Reading::all;
  keys.push_back("body");
  if constexpr (has_vertices) keys.push_back("vertex");
  if (node.has("body") || (is_new && Options::info.reach == ForceReach::body)) body = scene.read_body_name(node);
  std::optional<SceneBody> place;
  if (body) place.emplace(scene.body(*body));
  read_options(node, options, std::move(keys), place ? &*place : nullptr);
  if constexpr (has_vertices) {
    if (is_new || node.has("body") || node.has("vertex") || node.has("vertices")) {
      read_force_vertices(node, *place, options.vertices);
    }
  }
  if (is_new && !Options::info.required.empty()) node.require(Options::info.required);
}

/// Calls f with default options of each type that may stand in the list of forces.
template <class... Options>
void for_each_listed(std::tuple<Options...>*, auto&& f) {
  const auto call = [&]<class O>(O options) {
    if constexpr (is_listed_force<O>) f(std::move(options));
  };
  (call(Options{}), ...);
}

void for_each_listed(auto&& f) {
  for_each_listed(static_cast<BuiltinForces*>(nullptr), f);
}

}  // namespace

bool is_force_type(std::string_view type) {
  bool found = false;
  for_each_listed([&](const auto& options) { found = found || options.info.name == type; });
  return found;
}

ForceEntry read_force_options(const Node& node, std::vector<std::string_view> more_keys, const SceneReader& scene) {
  const Node type = node.require("type");
  std::string name;
  read(type, name);
  more_keys.insert(more_keys.end(), {"type", "name"});
  std::optional<ForceEntry> entry;
  std::vector<std::string_view> names;
  for_each_listed([&](auto options) {
    names.push_back(options.info.name);
    if (options.info.name != name) return;
    std::optional<BodyId> body;
    read_entry(node, more_keys, scene, Reading::all, body, options);
    entry = ForceEntry{body, std::move(options)};
  });
  if (entry) return *std::move(entry);
  type.fail(fmt::format("unknown force '{}'; {}; gravity has its own key at the top", printable(name),
                        suggestion_text(name, names)));
}

void read_changed_force(const Node& node, std::vector<std::string_view> more_keys, const SceneReader& scene,
                        ForceEntry& entry) {
  const auto change = [&]<class Options>(Options& options) {
    if constexpr (is_listed_force<Options>) {
      read_entry(node, std::move(more_keys), scene, Reading::changes, entry.body, options);
    } else {
      node.fail("gravity has an event of its own; write {\"gravity\": [x, y, z]}");
    }
  };
  std::visit(change, entry.options);
}

std::string_view type_of(const ForceEntry& entry) {
  return std::visit([](const auto& options) { return options.info.name; }, entry.options);
}

ForceId add(Simulation& simulation, const ForceEntry& entry, const std::string& name) {
  return std::visit([&](const auto& options) { return simulation.add(entry.body, options, name); }, entry.options);
}

void replace(Simulation& simulation, ForceId force, const ForceEntry& entry) {
  std::visit([&](const auto& options) { simulation.replace(force, entry.body, options); }, entry.options);
}

void SceneReader::read_gravity(const std::optional<Node>& node) {
  Gravity gravity;
  if (node && node->is_null()) return;
  const bool is_object = node && node->is_object();
  if (is_object) {
    read_options(*node, gravity, {"enabled"});
  } else if (node) {
    read(*node, gravity.acceleration);
  }
  const std::string name(Gravity::info.name);
  places.emplace(name, "gravity");
  if (is_object && !is_enabled(*node)) return disable_force(name, name);
  simulation.add(gravity, name);
  forces.emplace(name, ForceEntry{std::nullopt, gravity});
}

void SceneReader::read_force(const Node& node) {
  ForceEntry force = read_force_options(node, {"enabled"}, *this);
  const std::string name = own_name(node, type_of(force));
  places.emplace(name, entry);
  if (!is_enabled(node)) return disable_force(type_of(force), name);
  node.locate([&] { add(simulation, force, name); });
  forces.emplace(name, std::move(force));
}

}  // namespace pliant
