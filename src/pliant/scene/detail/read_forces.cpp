#include <algorithm>
#include <cmath>

#include "pliant/forces/mouse_spring.h"
#include "pliant/forces/pressure.h"
#include "pliant/forces/test_force.h"
#include "pliant/scene/detail/option_reader.h"
#include "pliant/scene/detail/scene_reader.h"

namespace pliant {
namespace {

void read_wind(const Node& node, SceneReader& scene) {
  WindOptions options;
  read_options(node, options, {"type", "body"});
  Simulation& simulation = scene.simulation;
  const bool one_body = node.has("body");
  const auto has_triangles = [](const Body& body) { return !body.mesh.triangles.empty(); };
  if (one_body ? !has_triangles(simulation.body(scene.read_body_name(node)))
               : std::ranges::none_of(simulation.bodies(), has_triangles)) {
    node.fail("there are no triangles for the wind to blow on; give the body some, or remove the wind");
  }
  node.locate([&] {
    return one_body ? simulation.add_wind(scene.read_body_name(node), options) : simulation.add_wind(options);
  });
}

void read_test_force(const Node& node, SceneReader& scene) {
  node.check_keys({"type", "body", "vertex", "vertices", "force", "frames"});
  const BodyId id = scene.read_body_name(node);
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

  Points force;
  read(node.require("force"), force);
  std::array<std::int64_t, 2> frames = {0, TestForce::forever};
  read_optional(node, "frames", frames);
  node.locate([&] {
    return scene.simulation.add_force(std::make_unique<TestForce>(std::move(vertices), force, frames[0], frames[1]));
  });
}

void read_mouse_spring(const Node& node, SceneReader& scene) {
  MouseSpringOptions options;
  read_options(node, options, {"type", "body", "vertex"});
  node.require("anchor");
  const BodyId id = scene.read_body_name(node);
  const Index vertex = read_vertex(node.require("vertex"), scene.body(id).mesh.vertex_count());
  node.locate([&] {
    return scene.simulation.add_force(std::make_unique<MouseSpring>(scene.simulation.vertex(id, vertex), options));
  });
}

void read_pressure(const Node& node, SceneReader& scene) {
  const BodyId id = scene.read_body_name(node);
  const SceneBody body = scene.body(id);
  PressureOptions options;
  read_options(node, options, {"type", "body"}, &body);
  const Index first_vertex = scene.simulation.body(id).first_vertex;
  node.locate([&] { return scene.simulation.add_force(std::make_unique<Pressure>(body.mesh, first_vertex, options)); });
}

struct ForceType {
  std::string_view name;
  void (*read)(const Node&, SceneReader&);
};
constexpr std::array force_types = {ForceType{"wind", read_wind}, ForceType{"test_force", read_test_force},
                                    ForceType{"mouse_spring", read_mouse_spring}, ForceType{"pressure", read_pressure}};

}  // namespace

void SceneReader::read_force(const Node& node) {
  const Node type = node.require("type");
  std::string name;
  read(type, name);
  const auto found = std::ranges::find(force_types, std::string_view(name), &ForceType::name);
  if (found != force_types.end()) return found->read(node, *this);
  std::vector<std::string_view> names;
  for (const ForceType& known : force_types) names.push_back(known.name);
  type.fail(fmt::format("'{}' is no force; known, the nearest first: {}; gravity has its own key at the top",
                        printable(name), nearest_names_text(name, names)));
}

namespace {

/// The first step that begins at the time or after it.
std::int64_t step_at(const Node& node, Real time_step) {
  Real time = 0;
  read(node, time);
  const Real step = std::ceil(time / time_step - 1e-9);
  if (step < 0) node.fail(fmt::format("{} s is before the start; times count from 0", time));
  if (step > 1e15) node.fail(fmt::format("{} s is more than 1e15 steps away; give an earlier time", time));
  return static_cast<std::int64_t>(step);
}

}  // namespace

void SceneReader::read_move(const Node& node, Timeline& timeline) {
  node.check_keys({"group", "step", "time", "index", "target", "offset", "over"});
  const Node group = node.require("group");
  std::string name;
  read(group, name);
  const auto found = groups.find(name);
  if (found == groups.end()) {
    std::vector<std::string_view> names;
    for (const auto& [known, id] : groups) names.push_back(known);
    group.fail(fmt::format("there is no group '{}'; known, the nearest first: {}", printable(name),
                           nearest_names_text(name, names)));
  }
  Move move;
  move.group = found->second;
  if (const auto index = node.find("index")) read(*index, move.index.emplace());
  const std::string_view when = node.require_one_of({"step", "time"});
  if (when == "time") {
    move.step = step_at(node.require(when), simulation.settings().time_step);
  } else {
    read(node.require(when), move.step);
  }
  const std::string_view kind = node.require_one_of({"target", "offset"});
  move.kind = kind == "target" ? MoveKind::target : MoveKind::offset;
  read(node.require(kind), move.to);
  read_optional(node, "over", move.duration);
  node.locate([&] { timeline.add(simulation, std::move(move)); });
}

}  // namespace pliant
