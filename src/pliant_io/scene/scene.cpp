#include "pliant_io/scene/scene.h"

#include <algorithm>
#include <set>

#include "pliant/core/printable.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/scene_documents.h"
#include "pliant_io/scene/detail/scene_files.h"
#include "pliant_io/scene/detail/scene_reader.h"

namespace pliant {
namespace {

constexpr std::int64_t format_version = 1;
const std::vector<std::string_view> top_keys = {"pliant",  "name",   "description", "settings", "steps",
                                                "gravity", "bodies", "forces",      "moves",    "events",
                                                "output",  "view",   "include",     "$schema"};

void check_version(const Node& root) {
  const Node version = root.require("pliant");
  if (!version.is_integer() || version.integer() != format_version) {
    version.fail(fmt::format("this program reads scenes of version {} alone; write \"pliant\": {}", format_version,
                             format_version));
  }
}

/// Calls f for the value of a key in each layer that has it.
void for_each_value(std::span<SceneLayer* const> layers, std::string_view key, auto&& f) {
  for (const SceneLayer* layer : layers) {
    if (const auto value = layer->root().find(key)) f(*value);
  }
}

/// Options that may be spread over the layers, the later ones in front.
void read_merged(std::span<SceneLayer* const> layers, std::string_view key, auto& options) {
  for_each_value(layers, key, [&](const Node& node) { read_options(node, options); });
}

/// The value of the last layer that has the key.
std::optional<Node> find_last(std::span<SceneLayer* const> layers, std::string_view key) {
  std::optional<Node> last;
  for_each_value(layers, key, [&](const Node& node) { last = node; });
  return last;
}

void read_last(std::span<SceneLayer* const> layers, std::string_view key, auto& value) {
  if (const auto node = find_last(layers, key)) read(*node, value);
}

/// What no option can tell by itself.
void check_view(const Node& node, const ViewSettings& view) {
  const auto refuse_zero = [](const Node& parent, std::string_view key, const Vec3& direction) {
    if (direction.stableNorm() > 0) return;
    parent.find(key).value_or(parent).fail("a direction of length 0 is none; give another");
  };
  const Camera& camera = view.camera;
  const Node camera_node = node.find("camera").value_or(node);
  refuse_zero(camera_node, "up", camera.up);
  refuse_zero(node, "light", view.light);
  if (camera.position && camera.target) {
    const Vec3 direction = *camera.target - *camera.position;
    if (!(direction.stableNorm() > 0)) camera_node.fail("the camera stands at its target; move one of the two");
    if (!(direction.stableNormalized().cross(camera.up.stableNormalized()).norm() > 1e-9)) {
      camera_node.fail("the camera looks along its up direction; give another");
    }
  }
  if (view.color_range && !((*view.color_range)[0] < (*view.color_range)[1])) {
    node.require("color_range").fail("the first value is not below the second; give [low, high]");
  }
}

void read_run(std::span<SceneLayer* const> layers, Scene& scene) {
  read_last(layers, "name", scene.name);
  read_last(layers, "description", scene.description);
  if (const auto steps = find_last(layers, "steps")) {
    read(*steps, scene.steps);
    if (scene.steps < 0 || scene.steps > max_steps) {
      steps->fail(fmt::format("{} is out of range; give a number from 0 to {}", scene.steps, max_steps));
    }
  }
  read_merged(layers, "output", scene.output);
  read_merged(layers, "view", scene.view);
  if (const auto view = find_last(layers, "view")) check_view(*view, scene.view);
}

/// Calls f for each entry of the lists of all layers.
void for_each_entry(std::span<SceneLayer* const> layers, std::string_view key, auto&& f) {
  for_each_value(layers, key, [&](const Node& list) {
    list.require_list();
    for (std::size_t i = 0; i < list.size(); ++i) f(list[i]);
  });
}

void require_bodies(std::span<SceneLayer* const> layers) {
  std::size_t count = 0;
  for_each_entry(layers, "bodies", [&](const Node&) { ++count; });
  if (count == 0) layers.back()->root().require("bodies").fail("there is no body; add one");
}

void read_simulation(std::span<SceneLayer* const> layers, Scene& scene) {
  SolverSettings settings;
  read_merged(layers, "settings", settings);
  const Node root = layers.back()->root();
  const Node settings_node = find_last(layers, "settings").value_or(root);
  scene.simulation = settings_node.locate([&] { return Simulation(settings); });
  require_bodies(layers);
  SceneReader reader(scene.simulation);
  for_each_entry(layers, "bodies", [&](const Node& node) { reader.read_body(node); });
  reader.read_gravity(find_last(layers, "gravity"));
  for_each_entry(layers, "forces", [&](const Node& node) { reader.read_force(node); });
  std::vector<Node> roots;
  for (const SceneLayer* layer : layers) roots.push_back(layer->root());
  reader.read_events(roots, scene.timeline);
  scene.group_names = scene.simulation.group_names();
  std::set<std::string> names(scene.group_names.begin(), scene.group_names.end());
  for (std::string& name : reader.later_groups) {
    if (names.insert(name).second) scene.group_names.push_back(std::move(name));
  }
}

}  // namespace

std::string Scene::place() const {
  return printable_place(source.texts.empty() ? name : source.texts[0].name);
}

StepReport Scene::step() {
  return at_place(place(), [&] { return timeline.step(simulation); });
}

Scene parse_scene(SceneSource source) {
  if (source.texts.empty()) fail_input("the scene has no text; give one");
  SceneFiles files;
  Scene scene;
  scene.name = std::filesystem::path(source.texts[0].name).stem().string();
  {
    const SceneDocuments documents(source, files);
    for (const SceneLayer* layer : documents.layers()) {
      check_version(layer->root());
      layer->root().check_keys(top_keys);
    }
    read_run(documents.layers(), scene);
    read_simulation(documents.layers(), scene);
  }
  source.is_complete = true;
  scene.source = std::move(source);
  scene.files = files.files();
  return scene;
}

Scene parse_scene(std::string_view text, const std::filesystem::path& folder, std::string_view name,
                  const SceneOverrides& overrides) {
  SceneSource source;
  source.texts.push_back({std::string(name), folder, std::string(text)});
  source.overrides = overrides;
  return parse_scene(std::move(source));
}

Scene load_scene(const std::filesystem::path& file, const SceneOverrides& overrides) {
  SceneSource source;
  source.texts.push_back({file.string(), file.parent_path(), read_file(file), absolute_path(file)});
  source.overrides = overrides;
  return parse_scene(std::move(source));
}

std::string scene_description(std::string_view text, std::string_view name) {
  const Document document = parse_json(text, name);
  const Origin origin{std::string(name)};
  const Node root(document, origin);
  root.require_object();
  std::string description;
  read_optional(root, "description", description);
  return description;
}

}  // namespace pliant
