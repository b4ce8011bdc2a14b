#include "tests/pairs/builtin_pair_scenes.h"

#include <algorithm>
#include <memory>

#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/simulation/held.h"
#include "pliant_io/scene/builtin_scenes.h"
#include "pliant_io/scene/scene.h"
#include "tests/pairs/parts.h"

namespace pliant_tests {

using namespace pliant;

namespace {

Scene load(std::string_view name, const PairOptions& options) {
  const auto found = std::ranges::find(builtin_scenes(), name, &BuiltinScene::name);
  if (found == builtin_scenes().end()) fail_input("no built-in scene '" + std::string(name) + "'");
  const SolverSettings usual = PairOptions().settings;
  const SolverSettings& asked = options.settings;
  SceneOverrides overrides;
  overrides.threads = asked.threads;
  if (asked.iterations != usual.iterations) overrides.iterations = asked.iterations;
  if (asked.time_step != usual.time_step) overrides.time_step = asked.time_step;
  if (asked.substeps != usual.substeps) overrides.set.push_back(fmt::format("settings.substeps={}", asked.substeps));
  if (asked.integrator == Integrator::bdf2) overrides.set.push_back("settings.integrator=bdf2");
  return parse_scene(found->text, "", found->name, overrides);
}

void scale_distances(Simulation& simulation, Real scale) {
  const auto count = simulation.bodies().size();
  for (std::size_t i = 0; i < count; ++i) {
    const auto id = static_cast<BodyId>(i);
    BodyContact contact = simulation.bodies()[i].contact;
    contact.distance = scale * simulation.contact_distance(id);
    simulation.set_contact(id, contact);
  }
}

bool has_pins(const Body& body, const std::vector<char>& held) {
  const auto first = held.begin() + body.first_vertex;
  return std::any_of(first, first + body.mesh.vertex_count(), [](char each) { return each != 0; });
}

void throw_bodies(Simulation& simulation, const Vec3& velocity) {
  const std::vector<char> held = held_vertices(simulation);
  Positions velocities = simulation.state().velocities;
  bool is_any = false;
  for (const Body& body : simulation.bodies()) {
    if (has_pins(body, held)) continue;
    velocities.middleRows(body.first_vertex, body.mesh.vertex_count()).rowwise() += velocity.transpose();
    is_any = true;
  }
  if (!is_any) fail_input("no body moves freely");
  simulation.set_state(simulation.state().positions, velocities);
}

std::size_t last_free_body(const Simulation& simulation) {
  const std::vector<char> held = held_vertices(simulation);
  for (std::size_t i = simulation.bodies().size(); i > 0; --i) {
    if (!is_held(simulation.bodies()[i - 1], held)) return i - 1;
  }
  fail_input("no body moves freely");
}

}  // namespace

std::vector<std::string> builtin_pair_scenes() {
  std::vector<std::string> names;
  for (const BuiltinScene& each : builtin_scenes()) {
    if (parse_scene(each.text, "", each.name).has_surfaces) names.emplace_back(each.name);
  }
  return names;
}

PairScene make_builtin_pair_scene(std::string_view name, const PairOptions& options) {
  Scene scene = load(name, options);
  PairScene made{std::move(scene.simulation)};
  made.duration = static_cast<Real>(scene.steps) * made.simulation.settings().time_step;
  const auto timeline = std::make_shared<Timeline>(std::move(scene.timeline));
  made.take = [timeline](Simulation& simulation) { return timeline->step(simulation); };
  if (options.distance_scale != 1) scale_distances(made.simulation, options.distance_scale);
  if (options.speed > 0) throw_bodies(made.simulation, falling(options));
  if (options.drag > 0) add_drag(made, last_free_body(made.simulation), options.drag);
  return made;
}

}  // namespace pliant_tests
