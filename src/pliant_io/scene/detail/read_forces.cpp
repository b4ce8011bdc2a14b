#include <algorithm>

#include "pliant/forces/gravity.h"
#include "pliant_io/scene/detail/force_options.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/scene_reader.h"

namespace pliant {
namespace {

/// The body that a force is on: named, or the one it was on, or the only one there is.
BodyId read_body_of_force(const Node& node, const SceneReader& scene, Reading reading, BodyId before) {
  return reading == Reading::changes && !node.has("body") ? before : scene.read_body_name(node);
}

std::vector<Index> read_force_vertices(const Node& node, const SceneReader& scene, BodyId id) {
  const SceneBody body = scene.body(id);
  std::vector<Index> vertices;
  const std::string_view key = node.require_one_of({"vertex", "vertices"});
  if (key == "vertex") {
    vertices.push_back(read_vertex(node.require(key), body.mesh.vertex_count()));
  } else {
    const Selection selection = read_selection(node.require(key), body);
    vertices = selection.vertices;
    for (Index i = 0; selection.everything && i < body.mesh.vertex_count(); ++i) vertices.push_back(i);
  }
  for (Index& vertex : vertices) vertex = scene.simulation.vertex(id, vertex);
  return vertices;
}

std::vector<std::string_view> with(std::vector<std::string_view> keys,
                                   std::initializer_list<std::string_view> more_keys) {
  keys.insert(keys.end(), more_keys.begin(), more_keys.end());
  return keys;
}

}  // namespace

std::unique_ptr<Force> GravityEntry::make(const Simulation&) const {
  return std::make_unique<Gravity>(acceleration);
}

void WindEntry::read(const Node& node, std::vector<std::string_view> keys, const SceneReader& scene, Reading) {
  read_options(node, options, with(std::move(keys), {"body"}));
  if (node.has("body")) body = scene.read_body_name(node);
  const auto has_triangles = [](const Body& sail) { return !sail.mesh.triangles.empty(); };
  if (body ? !has_triangles(scene.simulation.body(*body))
           : std::ranges::none_of(scene.simulation.bodies(), has_triangles)) {
    node.fail("there are no triangles for the wind to blow on; give the body some, or remove the wind");
  }
}

std::unique_ptr<Force> WindEntry::make(const Simulation& simulation) const {
  return body ? simulation.make_wind(*body, options) : simulation.make_wind(options);
}

void TestForceEntry::read(const Node& node, std::vector<std::string_view> keys, const SceneReader& scene,
                          Reading reading) {
  node.check_keys(with(std::move(keys), {"body", "vertex", "vertices", "force", "frames"}));
  body = read_body_of_force(node, scene, reading, body);
  if (reading == Reading::all || node.has("body") || node.has("vertex") || node.has("vertices")) {
    vertices = read_force_vertices(node, scene, body);
  }
  if (reading == Reading::all) node.require("force");
  read_optional(node, "force", force);
  read_optional(node, "frames", frames);
}

std::unique_ptr<Force> TestForceEntry::make(const Simulation&) const {
  return std::make_unique<TestForce>(vertices, force, frames[0], frames[1]);
}

void MouseSpringEntry::read(const Node& node, std::vector<std::string_view> keys, const SceneReader& scene,
                            Reading reading) {
  read_options(node, options, with(std::move(keys), {"body", "vertex"}));
  if (reading == Reading::all) node.require("anchor");
  body = read_body_of_force(node, scene, reading, body);
  if (reading == Reading::changes && !node.has("body") && !node.has("vertex")) return;
  const Index vertex_count = scene.body(body).mesh.vertex_count();
  vertex = scene.simulation.vertex(body, read_vertex(node.require("vertex"), vertex_count));
}

std::unique_ptr<Force> MouseSpringEntry::make(const Simulation&) const {
  return std::make_unique<MouseSpring>(vertex, options);
}

void PressureEntry::read(const Node& node, std::vector<std::string_view> keys, const SceneReader& scene,
                         Reading reading) {
  body = read_body_of_force(node, scene, reading, body);
  const SceneBody surface = scene.body(body);
  read_options(node, options, with(std::move(keys), {"body"}), &surface);
}

std::unique_ptr<Force> PressureEntry::make(const Simulation& simulation) const {
  const Body& surface = simulation.body(body);
  return std::make_unique<Pressure>(surface.mesh, surface.first_vertex, options);
}

namespace {

template <class Entry>
constexpr bool has_type = requires(Entry entry, const Node& node, const SceneReader& scene) {
  entry.read(node, {}, scene, Reading::all);
};

/// Calls f with a default entry of each type that may stand in the list of forces.
template <class... Entry>
void for_each_entry(std::variant<Entry...>*, auto&& f) {
  const auto call = [&]<class E>(E entry) {
    if constexpr (has_type<E>) f(std::move(entry));
  };
  (call(Entry{}), ...);
}

void for_each_entry(auto&& f) {
  for_each_entry(static_cast<ForceOptions*>(nullptr), f);
}

}  // namespace

bool is_force_type(std::string_view type) {
  bool found = false;
  for_each_entry([&](const auto& entry) { found = found || entry.type == type; });
  return found;
}

ForceOptions read_force_options(const Node& node, std::vector<std::string_view> more_keys, const SceneReader& scene) {
  const Node type = node.require("type");
  std::string name;
  read(type, name);
  more_keys.insert(more_keys.end(), {"type", "name"});
  std::optional<ForceOptions> options;
  std::vector<std::string_view> names;
  for_each_entry([&](auto entry) {
    names.push_back(entry.type);
    if (entry.type != name) return;
    entry.read(node, more_keys, scene, Reading::all);
    options = std::move(entry);
  });
  if (options) return *std::move(options);
  type.fail(fmt::format("'{}' is no force; known, the nearest first: {}; gravity has its own key at the top",
                        printable(name), nearest_names_text(name, names)));
}

void read_changed_force(const Node& node, std::vector<std::string_view> more_keys, const SceneReader& scene,
                        ForceOptions& options) {
  const auto change = [&]<class Entry>(Entry& entry) {
    if constexpr (has_type<Entry>) {
      entry.read(node, std::move(more_keys), scene, Reading::changes);
    } else {
      node.fail("gravity has an event of its own; write {\"gravity\": [x, y, z]}");
    }
  };
  std::visit(change, options);
}

std::string_view type_of(const ForceOptions& options) {
  return std::visit([](const auto& entry) { return entry.type; }, options);
}

std::unique_ptr<Force> make(const ForceOptions& options, const Simulation& simulation) {
  return std::visit([&](const auto& entry) { return entry.make(simulation); }, options);
}

void SceneReader::read_gravity(const std::optional<Node>& node) {
  GravityEntry gravity;
  if (node && node->is_null()) return;
  if (node) read(*node, gravity.acceleration);
  const std::string name(GravityEntry::type);
  simulation.add_force(gravity.make(simulation), name);
  forces.emplace(name, gravity);
}

void SceneReader::read_force(const Node& node) {
  ForceOptions options = read_force_options(node, {}, *this);
  const std::string name = force_name(node, type_of(options));
  node.locate([&] { simulation.add_force(make(options, simulation), name); });
  forces.emplace(name, std::move(options));
}

}  // namespace pliant
