// pliant check: reads a scene as a run would, and says what is in it.
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "crossing_texts.h"
#include "import_options.h"
#include "motion_advice.h"
#include "pliant/core/printable.h"
#include "pliant/materials/material_groups.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/lattice.h"
#include "pliant/solver/integration/integrator.h"
#include "pliant_io/recorder/run_info.h"
#include "resting.h"
#include "scene_options.h"
#include "stiffness_text.h"
#include "system/memory.h"
#include "terminal.h"

namespace pliant_cli {
namespace {

using Json = nlohmann::ordered_json;
using pliant::Body;
using pliant::Index;
using pliant::Real;
using pliant::Scene;
using pliant::Simulation;
using pliant::SystemInfo;

struct CheckOptions : SceneArguments {
  bool as_json = false;   ///< print one JSON object in place of the text
  bool is_still = false;  ///< take no steps
  bool as_scene = false;  ///< print the scene file made for a mesh, and nothing else
};

Real mass_of(const Body& body, const Simulation& simulation) {
  const auto masses = simulation.state().masses.begin() + body.first_vertex;
  return std::accumulate(masses, masses + body.mesh.vertex_count(), Real(0));
}

/// The share of its swing that a vibration of this frequency [rad/s] loses in a step to the integrator.
Real loss_per_step(Real frequency, const pliant::SolverSettings& settings) {
  const auto substeps = static_cast<Real>(settings.substeps);
  const Real kept = amplification(settings.integrator, frequency * settings.time_step / substeps);
  return 1 - std::pow(kept, substeps);
}

/// The frequency [Hz] at which the integrator takes half of the swing in a second.
Real half_life_frequency(const pliant::SolverSettings& settings) {
  const Real h = settings.time_step / static_cast<Real>(settings.substeps);
  const Real kept = std::exp2(-h);  // in a substep
  Real low = 1e-12;                 // h ω
  Real high = 1e12;
  for (int i = 0; i < 100; ++i) {
    const Real middle = std::sqrt(low * high);
    (amplification(settings.integrator, middle) > kept ? low : high) = middle;
  }
  return low / h / (2 * std::numbers::pi);
}

/// How to damp less, where that is allowed.
std::string less_damping_text(const Simulation& simulation) {
  pliant::SolverSettings settings = simulation.settings();
  const auto is_explicit = [](const auto& entry) { return entry.second->is_explicit_spring(); };
  if (settings.integrator != pliant::Integrator::implicit_euler ||
      std::ranges::any_of(simulation.forces(), is_explicit)) {
    return "";
  }
  settings.integrator = pliant::Integrator::bdf2;
  return fmt::format(", with `integrator` `bdf2` {:.2g} Hz", half_life_frequency(settings));
}

std::string frequency_text(const SystemInfo& info, const Simulation& simulation) {
  const pliant::SolverSettings& settings = simulation.settings();
  const Real product = info.fastest_frequency * settings.time_step;
  const Real fastest_hz = info.fastest_frequency / (2 * std::numbers::pi);
  std::string text = fmt::format("{:.3g} rad/s = {:.3g} Hz; times the time step of {:.3g} s: {:.3g}\n",
                                 info.fastest_frequency, fastest_hz, settings.time_step, product);
  if (!(info.fastest_frequency > 0)) return text + "  nothing vibrates: no constraint moves a free vertex";
  text += fmt::format("  the fastest vibration loses {:.0f} % of its swing in each step",
                      100 * loss_per_step(info.fastest_frequency, settings));
  if (product > static_cast<Real>(settings.substeps)) text += ", so it is not seen; it is stable all the same";
  // A second must have some steps for a decay in a second to mean anything.
  constexpr Real largest_step = 0.1;
  if (settings.time_step <= largest_step && half_life_frequency(settings) < fastest_hz) {
    text += fmt::format("\n  what swings faster than {:.2g} Hz loses half of it in a second{}",
                        half_life_frequency(settings), less_damping_text(simulation));
  }
  if (settings.energy_projection > 0) {
    text += fmt::format(
        "\n  `energy_projection` gives back {:.3g} % of what steps take, of what swings slower than {:.2g} Hz",
        100 * settings.energy_projection,
        static_cast<Real>(settings.substeps) / settings.time_step / (2 * std::numbers::pi));
  }
  if (settings.damping > 0) {
    text += fmt::format("\n  `damping` takes half of every vibration in {:.2g} s besides",
                        std::numbers::ln2 / settings.damping);
  }
  return text;
}

/// What neither constraints nor, below it, colliders and pinned surfaces hold.
std::vector<std::string> warnings_of_free_components(const Simulation& simulation, const SystemInfo& info) {
  constexpr std::size_t shown = 20;
  std::vector<std::string> warnings;
  std::size_t others = 0;
  for (const pliant::FreeComponent& component : info.free_components) {
    if (is_caught(simulation, component.vertices)) continue;
    if (warnings.size() == shown) {
      ++others;
      continue;
    }
    const Body* owner = &simulation.bodies().front();
    for (const Body& body : simulation.bodies()) {
      if (body.first_vertex <= component.first_vertex) owner = &body;
    }
    const Index first = component.first_vertex - owner->first_vertex;
    warnings.push_back(
        component.vertex_count == 1
            ? fmt::format("nothing holds vertex {} of '{}': it will move freely", first, owner->name)
            : fmt::format("nothing holds the {} vertices from vertex {} of '{}' on: they will move freely",
                          component.vertex_count, first, owner->name));
  }
  if (others > 0) warnings.push_back(fmt::format("and {} more components that nothing holds", others));
  return warnings;
}

/// What a run would not refuse, but is seldom meant.
std::vector<std::string> warnings_of(const pliant::Scene& scene, const SystemInfo& info) {
  const Simulation& simulation = scene.simulation;
  std::vector<std::string> warnings = simulation.warnings();
  for (const auto& [id, material] : scene.materials) {
    const pliant::Body& body = simulation.body(id);
    const std::string coarse = coarseness(material, body.mesh);
    if (!coarse.empty()) warnings.push_back(fmt::format("body '{}': {}", pliant::printable(body.name), coarse));
  }
  for (std::string& warning : warnings_of_free_components(simulation, info)) warnings.push_back(std::move(warning));
  for (std::string& warning : crossing_warnings(simulation)) warnings.push_back(std::move(warning));
  return warnings;
}

Json describe_bodies(const Scene& scene) {
  const Simulation& simulation = scene.simulation;
  Json bodies = Json::array();
  for (Index id = 0; const Body& body : simulation.bodies()) {
    const Index carried = body.mesh.embedding.carried_count();  // what the lattice sticks out by is not the body
    const pliant::BoundingBox box =
        pliant::bounding_box(body.mesh.vertices.topRows(carried > 0 ? carried : body.mesh.vertex_count()));
    const pliant::Vec3 size = box.max - box.min;
    bodies.push_back({{"name", body.name},
                      {"vertices", body.mesh.vertex_count()},
                      {"edges", body.mesh.edges.size()},
                      {"triangles", body.mesh.triangles.size()},
                      {"tetrahedra", body.mesh.tetrahedra.size()},
                      {"mass", mass_of(body, simulation)},
                      {"size", {size[0], size[1], size[2]}}});
    if (const pliant::Embedding& lattice = body.mesh.embedding; !lattice.is_empty()) {
      bodies.back()["lattice"] = {{"spacing", lattice.spacing},
                                  {"surface_vertices", lattice.carried_count()},
                                  {"filled", pliant::filled_share(body.mesh)}};
    }
    const auto material = scene.materials.find(pliant::BodyId{id++});
    if (material != scene.materials.end()) bodies.back()["material"] = material->second.name;
  }
  return bodies;
}

Json describe_groups(const Simulation& simulation) {
  Json groups = Json::array();
  for (const auto& [id, group] : simulation.groups()) {
    Json& json = groups.emplace_back(Json::object());
    pliant::describe_group(simulation, group, [&](const char* key, const auto& value) { json[key] = value; });
    if (const std::optional<pliant::StiffnessRange> range = stiffness_range(simulation, id)) {
      json["stiffness"] = {{"least", range->least},
                           {"most", range->most},
                           {"unit", range->unit},
                           {"taut_factor", range->taut_factor},
                           {"text", stiffness_text(*range)}};
    }
  }
  return groups;
}

Json describe_colliders(const Simulation& simulation) {
  Json colliders = Json::array();
  for (const auto& [id, collider] : simulation.colliders()) {
    colliders.push_back({{"name", collider.name},
                         {"type", collider.shape->type()},
                         {"friction", collider.motion.friction.value_or(simulation.contact().friction)}});
  }
  return colliders;
}

/// Who touches what, and how; empty where nothing touches.
Json describe_contact(const Simulation& simulation) {
  const pliant::ContactSettings& contact = simulation.contact();
  if (!contact.surfaces && simulation.colliders().empty()) return Json::object();
  Json bodies = Json::array();
  for (std::size_t i = 0; i < simulation.bodies().size(); ++i) {
    const Body& body = simulation.bodies()[i];
    Json& json = bodies.emplace_back(
        Json{{"name", body.name}, {"distance", simulation.contact_distance(pliant::BodyId{static_cast<Index>(i)})}});
    if (body.contact.friction) json["friction"] = *body.contact.friction;
    json["self"] = contact.surfaces && body.contact.self;
    Json names = Json::array();
    for (const pliant::BodyId other : body.contact.ignores) names.push_back(simulation.body(other).name);
    json["ignores"] = std::move(names);
  }
  return {{"surfaces", contact.surfaces}, {"friction", contact.friction}, {"bodies", std::move(bodies)}};
}

/// What the scene has switched off.
Json describe_disabled(const Scene& scene) {
  Json parts = Json::array();
  for (const auto& [name, part] : scene.disabled) {
    Json& json = parts.emplace_back(Json{{"name", name}, {"type", part.type}});
    if (part.body) json["body"] = scene.simulation.body(*part.body).name;
  }
  return parts;
}

Json describe(Scene& scene) {
  Simulation& simulation = scene.simulation;
  const SystemInfo info = pliant::at_place(scene.place(), [&] { return simulation.system_info(); });
  const pliant::SolverSettings& settings = simulation.settings();
  const Real time_step = settings.time_step;
  const bool is_automatic = settings.iterations == pliant::automatic_iterations;
  Json forces = Json::array();
  for (const auto& [id, force] : simulation.forces()) forces.push_back(force->type());
  Json files = Json::array();
  for (const pliant::SceneFile& file : scene.files) files.push_back({{"path", file.path}, {"bytes", file.size}});
  const Index vertices = simulation.state().vertex_count();
  return {
      {"scene", scene.name},
      {"description", scene.description},
      {"steps", scene.steps},
      {"seconds", static_cast<Real>(scene.steps) * time_step},
      {"time_step", time_step},
      {"integrator", choice_names(settings.integrator)[static_cast<std::size_t>(settings.integrator)]},
      {"substeps", settings.substeps},
      {"step_text", steps_text(settings)},
      {"iterations", is_automatic ? Json("automatic") : Json(settings.iterations)},
      {"backend", simulation.backend()},
      {"bodies", describe_bodies(scene)},
      {"constraints", pliant::count_constraints(simulation)},
      {"groups", describe_groups(simulation)},
      {"forces", std::move(forces)},
      {"colliders", describe_colliders(simulation)},
      {"contact", describe_contact(simulation)},
      {"events", scene.timeline.event_count()},
      {"disabled", describe_disabled(scene)},
      {"idle_events", scene.idle_events.size()},
      {"files", std::move(files)},
      {"vertices", {{"all", vertices}, {"pinned", info.pinned_vertices}, {"free", vertices - info.pinned_vertices}}},
      {"free_components", info.free_components.size()},
      {"system",
       {{"matrix_entries", info.matrix_entries},
        {"factor_entries", info.factor_entries},
        {"precision", choice_names(info.precision)[static_cast<std::size_t>(info.precision)]},
        {"contraction", info.contraction},
        {"bytes", info.bytes},
        {"peak_memory", pliant_system::peak_memory_bytes()}}},
      {"fastest_frequency",
       {{"rad_per_s", info.fastest_frequency},
        {"hz", info.fastest_frequency / (2 * std::numbers::pi)},
        {"times_time_step", info.fastest_frequency * time_step},
        {"loss_per_step", loss_per_step(info.fastest_frequency, settings)},
        {"half_life_hz", half_life_frequency(settings)},
        {"text", frequency_text(info, simulation)}}},
      {"warnings", warnings_of(scene, info)}};
}

/// A value of the description, for the terminal.
std::string text_of(const Json& value) {
  return pliant::printable(value.get<std::string>(), 1000);
}

void print_bodies(const Json& json) {
  for (const Json& body : json["bodies"]) {
    fmt::print("body {}: {} vertices", text_of(body["name"]), body["vertices"].get<Index>());
    for (const char* elements : {"edges", "triangles", "tetrahedra"}) {
      if (body[elements] != 0) fmt::print(", {} {}", body[elements].get<std::size_t>(), elements);
    }
    if (body.contains("material")) fmt::print(" of {}", text_of(body["material"]));
    const Json& size = body["size"];
    fmt::print("; {:.4g} kg; {:.3g} x {:.3g} x {:.3g} m\n", body["mass"].get<Real>(), size[0].get<Real>(),
               size[1].get<Real>(), size[2].get<Real>());
    if (body.contains("lattice")) {
      const Json& lattice = body["lattice"];
      fmt::print("  lattice: spacing {:.4g} m, {:.0f} % of it inside the surface, whose {} vertices it carries\n",
                 lattice["spacing"].get<Real>(), 100 * lattice["filled"].get<Real>(),
                 lattice["surface_vertices"].get<Index>());
    }
    for (const Json& group : json["groups"]) {
      if (group["body"] != body["name"]) continue;
      fmt::print("  {}: {} ", text_of(group["name"]), group["constraints"].get<Index>());
      const bool is_tied = group.contains("other");
      fmt::print("{}", is_tied ? "ties to " + text_of(group["other"]) : text_of(group["type"]));
      if (group["skipped"] != 0) fmt::print(", {} left out", group["skipped"].get<Index>());
      if (group.contains("stiffness")) fmt::print(", {}", text_of(group["stiffness"]["text"]));
      fmt::print("\n");
    }
  }
}

void print_colliders(const Json& colliders) {
  if (colliders.empty()) return;
  fmt::print("colliders:");
  for (const Json& each : colliders) {
    fmt::print("{} {} ({}, friction {:.4g})", &each == &colliders.front() ? "" : ",", text_of(each["name"]),
               text_of(each["type"]), each["friction"].get<Real>());
  }
  fmt::print("\n");
}

void print_disabled(const Json& disabled, std::size_t idle_events) {
  if (disabled.empty()) return;
  fmt::print("off:");
  for (const Json& each : disabled) {
    fmt::print("{} {} ({}", &each == &disabled.front() ? "" : ",", text_of(each["name"]), text_of(each["type"]));
    fmt::print("{})", each.contains("body") ? " on " + text_of(each["body"]) : "");
  }
  if (idle_events > 0) fmt::print("; {} of the events act on these, and do nothing", idle_events);
  fmt::print("\n");
}

void print_contact(const Json& contact, bool has_colliders) {
  if (contact.empty()) {
    fmt::print("contact: none; bodies pass through each other and through themselves\n");
    return;
  }
  const bool surfaces = contact["surfaces"].get<bool>();
  const char* touched = !surfaces ? "bodies touch colliders alone, and pass through each other and through themselves"
                        : has_colliders ? "bodies touch each other, themselves and colliders"
                                        : "bodies touch each other and themselves";
  fmt::print("contact: {}; friction {:.4g}\n", touched, contact["friction"].get<Real>());
  for (const Json& body : contact["bodies"]) {
    fmt::print("  {}: distance {:.3g} m", text_of(body["name"]), body["distance"].get<Real>());
    if (body.contains("friction")) fmt::print(", friction {:.4g}", body["friction"].get<Real>());
    if (surfaces && !body["self"].get<bool>()) fmt::print(", does not touch itself");
    for (const Json& other : body["ignores"]) {
      if (!surfaces) break;
      fmt::print("{} {}", &other == &body["ignores"].front() ? ", ignores" : ",", text_of(other));
    }
    fmt::print("\n");
  }
}

void print_motion(const Json& motion) {
  if (motion.is_null()) return;
  fmt::print("its first {} steps, taken to see:\n", motion["steps"].get<std::int64_t>());
  for (const Json& line : motion["text"]) fmt::print("  {}\n", line.get<std::string>());
}

void print_text(const Json& json) {
  const auto megabytes = [](const Json& bytes) { return bytes.get<Real>() * 1e-6; };
  fmt::print("{}: {}\n", text_of(json["scene"]), text_of(json["description"]));
  fmt::print("{} steps of {:.4g} s = {:.4g} s, {}\n", json["steps"].get<std::int64_t>(), json["time_step"].get<Real>(),
             json["seconds"].get<Real>(), text_of(json["step_text"]));
  print_bodies(json);
  print_motion(json["motion"]);
  fmt::print("forces:");
  for (const Json& force : json["forces"]) fmt::print(" {}", text_of(force));
  fmt::print("{}; events: {}\n", json["forces"].empty() ? " none" : "", json["events"].get<std::size_t>());
  print_disabled(json["disabled"], json["idle_events"].get<std::size_t>());
  print_colliders(json["colliders"]);
  print_contact(json["contact"], !json["colliders"].empty());
  const Json& vertices = json["vertices"];
  fmt::print("vertices: {}, of which {} free and {} pinned\n", vertices["all"].get<Index>(),
             vertices["free"].get<Index>(), vertices["pinned"].get<Index>());
  const Json& system = json["system"];
  fmt::print("system: {} non-zeros in the matrix, {} in the factor ({}, {}), {:.1f} MB; {:.0f} MB in all\n",
             system["matrix_entries"].get<std::int64_t>(), system["factor_entries"].get<std::int64_t>(),
             text_of(json["backend"]), text_of(system["precision"]), megabytes(system["bytes"]),
             megabytes(system["peak_memory"]));
  fmt::print("fastest vibration: {}\n", json["fastest_frequency"]["text"].get<std::string>());
  for (const Json& warning : json["warnings"]) {
    fmt::print("{} {}\n", in_tone(Tone::warning, "warning:"), text_of(warning));
  }
  fmt::print("{}\n", in_tone(Tone::good, "The scene is sound."));
}

void check_scene(const CheckOptions& options) {
  Scene scene = open_scene(options);
  print_warnings(scene);
  if (options.as_scene) return fmt::print("{}\n", scene.source.texts.front().text);
  const std::string assumptions = assumptions_text(options, scene);
  Json json = describe(scene);
  json["motion"] = options.is_still ? Json() : describe_motion(scene);
  if (const std::string warning = json["motion"].is_null() ? "" : json["motion"].value("warning", "");
      !warning.empty()) {
    json["warnings"].push_back(warning);
  }
  if (options.as_json) {
    fmt::print("{}\n", json.dump(2, ' ', false, Json::error_handler_t::replace));
  } else {
    fmt::print("{}{}", assumptions, assumptions.empty() ? "" : "\n");
    print_text(json);
  }
}

}  // namespace

void add_check_command(CLI::App& program) {
  CLI::App* command =
      program.add_subcommand("check", "Say what is in a scene or a mesh to be simulated, and what is wrong with it");
  const auto options = std::make_shared<CheckOptions>();
  add_scene_arguments(*command, *options);
  add_setting_options(*command, *options);
  add_simulated_import_options(*command, options->import);
  command->add_flag("--json", options->as_json, "As JSON, for programs");
  command->add_flag("--scene", options->as_scene,
                    "Print the scene file alone: of a built-in scene, or the one made for a mesh");
  command->add_flag("--still", options->is_still, "Take no steps to see how it moves");
  command->footer(
      "Examples:\n"
      "  pliant check my_scene.json --set settings.time_step=0.002\n"
      "  pliant check shirt.obj --scene > shirt.json");
  command->callback([options] { check_scene(*options); });
}

}  // namespace pliant_cli
