#include "pliant_io/scene/scene.h"

#include <algorithm>
#include <set>

#include "pliant/core/printable.h"
#include "pliant/materials/material_groups.h"
#include "pliant_io/files/read_file.h"
#include "pliant_io/scene/detail/foreign_file.h"
#include "pliant_io/scene/detail/option_reader.h"
#include "pliant_io/scene/detail/resolve_scene.h"
#include "pliant_io/scene/detail/scene_files.h"
#include "pliant_io/scene/detail/scene_reader.h"

namespace pliant {

/// For the options of a camera, which read_options finds by its arguments.
static void read(const Node& node, std::vector<CameraKeyframe>& keyframes) {
  node.require_list();
  keyframes.assign(node.size(), {});
  for (std::size_t i = 0; i < keyframes.size(); ++i) read_options(node[i], keyframes[i]);
}

namespace {

const std::vector<std::string_view> top_keys = {
    "pliant",  "name",      "description", "settings", "steps",  "gravity", "bodies",  "attachments", "forces",
    "contact", "colliders", "moves",       "events",   "output", "view",    "include", "$schema",     "materials"};

/// The names there are, and behind them those that come later, each once.
std::vector<std::string> all_names(std::vector<std::string> names, std::vector<std::string> later) {
  std::set<std::string> known(names.begin(), names.end());
  for (std::string& name : later) {
    if (known.insert(name).second) names.push_back(std::move(name));
  }
  return names;
}

/// Refuses a camera that looks nowhere, or has what is up before or behind it.
void check_direction(const Node& node, const Vec3& position, const Vec3& target, const Vec3& up) {
  const Vec3 direction = target - position;
  if (!(direction.stableNorm() > 0)) node.fail("the camera stands at its target; move one of the two");
  if (!(direction.stableNormalized().cross(up.stableNormalized()).norm() > 1e-9)) {
    node.fail("the camera looks along its up direction; give another");
  }
}

/// Pictures are drawn in single precision.
void refuse_far(const Node& node, const Vec3& point) {
  if (!(point.cwiseAbs().maxCoeff() <= 1e9)) node.fail("more than 1e9 m away; give a place nearer to the scene");
}

void check_keyframes(const Node& node, const Camera& camera) {
  for (std::size_t i = 0; i < camera.keyframes.size(); ++i) {
    const CameraKeyframe& each = camera.keyframes[i];
    const Node entry = node[i];
    const Node time = entry.require("time");
    if (i > 0 && !(each.time > camera.keyframes[i - 1].time)) {
      time.fail(fmt::format("{} s is not later than the keyframe before, {} s; give them in order of time", each.time,
                            camera.keyframes[i - 1].time));
    }
    if (i > 0 && !(each.time - camera.keyframes[i - 1].time > 1e-6)) {
      time.fail("less than a microsecond after the keyframe before; leave one of the two out");
    }
    refuse_far(entry.require("position"), each.position);
    if (each.target) refuse_far(entry.require("target"), *each.target);
    const std::optional<Vec3> target = each.target ? each.target : camera.target;
    if (target) check_direction(entry, each.position, *target, camera.up);
  }
}

void check_camera(const Node& node, const Camera& camera) {
  const auto refuse_beside = [&node](std::string_view given, std::initializer_list<std::string_view> others) {
    for (const std::string_view other : others) {
      if (const auto found = node.find(other)) {
        found->fail(fmt::format(
            "'{}' says already where the camera is; keep one of the two, or replace the whole 'camera'", given));
      }
    }
  };
  if (camera.target) refuse_far(node.require("target"), *camera.target);
  if (camera.position) {
    refuse_far(node.require("position"), *camera.position);
    refuse_beside("position", {"azimuth", "elevation"});
    if (camera.target) check_direction(node, *camera.position, *camera.target, camera.up);
  }
  if (!camera.keyframes.empty()) {
    refuse_beside("keyframes", {"position", "azimuth", "elevation", "turn_rate"});
    check_keyframes(node.require("keyframes"), camera);
  }
}

/// What no option can tell by itself.
void check_view(const Node& node, const ViewSettings& view) {
  const auto refuse_zero = [](const Node& parent, std::string_view key, const Vec3& direction) {
    if (direction.stableNorm() > 0) return;
    parent.find(key).value_or(parent).fail("the direction has length 0; give another");
  };
  const std::optional<Node> camera = node.find("camera");
  refuse_zero(camera.value_or(node), "up", view.camera.up);
  refuse_zero(node, "light", view.light);
  if (camera) check_camera(*camera, view.camera);
  if (view.color_range && !((*view.color_range)[0] < (*view.color_range)[1])) {
    node.require("color_range").fail("the first value is not below the second; give [low, high]");
  }
}

/// Options of an object that need not be there.
void read_group_of_options(const Node& root, std::string_view key, auto& options) {
  if (const auto node = root.find(key)) read_options(*node, options);
}

void read_run(const Node& root, Scene& scene) {
  read_optional(root, "name", scene.name);
  read_optional(root, "description", scene.description);
  if (const auto steps = root.find("steps")) {
    read(*steps, scene.steps);
    if (scene.steps < 0 || scene.steps > max_steps) {
      steps->fail(fmt::format("{} is out of range; give a number from 0 to {}", scene.steps, max_steps));
    }
  }
  read_group_of_options(root, "output", scene.output);
  read_group_of_options(root, "view", scene.view);
  if (const auto view = root.find("view")) check_view(*view, scene.view);
}

/// Calls f for each entry of a list that need not be there.
void for_each_entry(const Node& root, std::string_view key, auto&& f) {
  const auto list = root.find(key);
  if (!list) return;
  list->require_list();
  for (std::size_t i = 0; i < list->size(); ++i) f((*list)[i]);
}

/// The same for a reader, which knows where it is.
void read_entries(const Node& root, std::string_view key, SceneReader& reader, void (SceneReader::*read)(const Node&)) {
  std::size_t i = 0;
  for_each_entry(root, key, [&](const Node& node) {
    reader.entry = fmt::format("{}[{}]", key, i++);
    (reader.*read)(node);
  });
}

/// What a scene of materials leaves open is as they look right, unless a force refuses it.
void choose_open_settings(const Node& root, std::optional<Real> damping, Simulation& simulation) {
  const auto is_explicit = [](const auto& entry) { return entry.second->is_explicit_spring(); };
  const auto given = root.find("settings");
  const auto is_open = [&](const char* key) { return !given || !given->has(key); };
  const SolverSettings good = settings_for_materials();
  SolverSettings settings = simulation.settings();
  if (damping) {
    if (is_open("damping")) settings.damping = *damping;
    const bool takes_bdf2 = std::ranges::none_of(simulation.forces(), is_explicit);
    if (is_open("integrator") && takes_bdf2) settings.integrator = good.integrator;
    if (is_open("acceleration")) settings.acceleration = good.acceleration;
    if (is_open("iterations")) settings.iterations = good.iterations;
    if (is_open("start")) settings.start = good.start;
  }
  if (settings != simulation.settings()) simulation.set_settings(settings);
}

void read_simulation(const Node& root, bool leaves_out_events, Scene& scene) {
  SolverSettings settings;
  read_group_of_options(root, "settings", settings);
  scene.simulation = root.find("settings").value_or(root).locate([&] { return Simulation(settings); });
  if (const Node bodies = root.require("bodies"); bodies.is_list() && bodies.empty()) {
    bodies.fail("there is no body; add one");
  }
  SceneReader reader(scene.simulation, scene.timeline);
  if (const auto materials = root.find("materials")) reader.materials = read_materials(*materials);
  read_entries(root, "bodies", reader, &SceneReader::read_body);
  for (const auto& [name, material] : reader.materials) scene.own_materials.push_back(material);
  Index body = 0;
  for_each_entry(root, "bodies", [&](const Node& node) { reader.read_body_contact(node, BodyId{body++}); });
  read_entries(root, "attachments", reader, &SceneReader::add_attachment);
  reader.read_gravity(root.find("gravity"));
  read_entries(root, "forces", reader, &SceneReader::read_force);
  if (const auto contact = root.find("contact")) reader.read_contact(*contact);
  read_entries(root, "colliders", reader, &SceneReader::read_collider);
  choose_open_settings(root, mean_damping(scene.simulation, reader.material_of), scene.simulation);
  reader.left_out = leaves_out_events ? &scene.left_out : nullptr;
  reader.read_events(root);
  scene.materials = std::move(reader.material_of);
  scene.appearances = std::move(reader.appearance_of);
  scene.collider_appearances = std::move(reader.collider_appearances);
  scene.places = std::move(reader.places);
  scene.implied_bodies = std::move(reader.implied_bodies);
  scene.disabled = std::move(reader.disabled);
  scene.idle_events = std::move(reader.idle_events);
  scene.has_surfaces = scene.simulation.contact().surfaces || reader.has_later_surfaces;
  std::ranges::move(reader.warnings, std::back_inserter(scene.warnings));
  if (!scene.has_surfaces && !reader.warning_without_surfaces.empty()) {
    scene.warnings.push_back(std::move(reader.warning_without_surfaces));
  }
  scene.group_names = all_names(scene.simulation.group_names(), std::move(reader.later_groups));
  std::vector<std::string> colliders;
  for (const auto& [id, collider] : scene.simulation.colliders()) colliders.push_back(collider.name);
  scene.later_places = std::move(reader.later_places);
  scene.collider_names = all_names(std::move(colliders), std::move(reader.later_colliders));
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
  const std::string& name = source.texts[0].name;
  scene.name = std::filesystem::path(std::u8string(name.begin(), name.end())).stem().string();
  {
    ResolvedScene resolved = resolve_scene(source, files);
    scene.warnings = std::move(resolved.warnings);
    const Node root(resolved.document);
    check_scene_version(root);
    root.check_keys(top_keys);
    read_run(root, scene);
    read_simulation(root, source.leaves_out_events, scene);
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
  std::error_code ignored;  // read_file tells
  const std::uintmax_t bytes = std::filesystem::is_regular_file(file, ignored) ? file_size(file, ignored) : 0;
  if (!ignored) check_json_size(bytes, file.string());  // before it is read
  SceneSource source;
  source.texts.push_back({file.string(), file.parent_path(), read_file(file), absolute_path(file)});
  refuse_foreign_file(file, source.texts.back().text);
  source.overrides = overrides;
  return parse_scene(std::move(source));
}

std::string scene_description(std::string_view text, std::string_view name) {
  const Origin origin{std::string(name)};
  const Document document(parse_json(text, name), {&origin});
  const Node root(document);
  root.require_object();
  std::string description;
  read_optional(root, "description", description);
  return description;
}

}  // namespace pliant
