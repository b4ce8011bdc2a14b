// Options of groups, forces and settings as parameters: listed, read and changed while a simulation runs.
#include <cmath>
#include <map>

#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "everything.h"
#include "pliant/collision/colliders/builtin.h"
#include "pliant/core/error.h"
#include "pliant/simulation/parameters.h"
#include "pliant/simulation/transaction.h"
#include "run.h"

namespace test_parameters {

using namespace pliant;
using namespace pliant_tests;

namespace {

using Names = std::vector<std::string>;

/// Without the explicit spring, beside which nothing can be BDF2, and with a gas and elastic materials.
Simulation make() {
  Simulation simulation = everything({.iterations = 3, .threads = 1}, 6);
  simulation.remove(simulation.find_force("mouse_spring").value());
  simulation.add(BodyId{0}, TriangleNeoHookean{.on = {0, 1, 6, 7}, .stiffness = 20});
  simulation.add(BodyId{0}, TriangleStvk{.on = {0, 1, 6, 7}, .stiffness = 20});
  simulation.add(BodyId{1}, TetrahedronNeoHookean{.stiffness = 1e3});
  simulation.add(BodyId{1}, TetrahedronStvk{.stiffness = 1e3});
  simulation.add(BodyId{2}, Pressure{.model = PressureModel::gas, .pressure = 10});
  return simulation;
}

Names options_of(const Simulation& simulation, const ParameterOwner& owner) {
  Names names;
  for (const Parameter& each : list_parameters(simulation, owner)) names.push_back(each.handle.option);
  return names;
}

bool takes(Simulation& simulation, const Parameter& parameter, const Vec3& value) {
  try {
    set_parameter(simulation, parameter.handle, value);
    return true;
  } catch (const Error&) {
    return false;
  }
}

/// Another value that it takes, if there is one.
std::optional<Vec3> set_to_another(Simulation& simulation, const Parameter& parameter) {
  std::vector<Vec3> others;
  const Real now = parameter.value[0];
  switch (parameter.kind) {
    case ParameterKind::choice:
      for (std::size_t i = 0; i < parameter.choices.size(); ++i) others.emplace_back(static_cast<Real>(i), 0, 0);
      break;
    case ParameterKind::integer:
      others = {{now + 1, 0, 0}};
      break;
    case ParameterKind::real:
      others = {{0.97 * now, 0, 0}, {1.03 * now, 0, 0}, {0.5, 0, 0}};
      break;
    case ParameterKind::flag:
      others = {{1 - now, 0, 0}};
      break;
    case ParameterKind::vector:
      others = {parameter.value + Vec3(0.1, -0.2, 0.3)};
      break;
  }
  for (const Vec3& other : others) {
    if (other != parameter.value && takes(simulation, parameter, other)) return other;
  }
  return std::nullopt;
}

void check_same_steps(Simulation& a, Simulation& b, int count) {
  for (int i = 0; i < count; ++i) {
    a.step();
    b.step();
    CHECK(a.state().positions == b.state().positions);
    CHECK(a.state().velocities == b.state().velocities);
  }
}

}  // namespace

TEST_CASE("a stiffness has the unit that its group has") {
  Simulation simulation;
  const BodyId sheet = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::total(1));
  const auto unit = [&](GroupId id) { return parameter(simulation, {id, "stiffness"}).unit; };
  CHECK(unit(simulation.add(sheet, EdgeStrain{.measure = FibreMeasure::rope})) == "N");
  const GroupId threads = simulation.add(sheet, EdgeStrain{.measure = FibreMeasure::cloth});
  CHECK(unit(threads) == "N/m");
  set_parameter(simulation, {threads, "measure"}, {0, 0, 0});
  CHECK(unit(threads) == "N");
  const GroupId ties = simulation.add(sheet, Attachment{.on = {0}, .to = sheet, .to_on = {8}});
  CHECK(unit(ties) == "N/m");
  const Attachment seam{.on = {0, 1, 2}, .to = sheet, .to_on = {6, 7, 8}, .mode = AttachmentMode::seam};
  CHECK(unit(simulation.add(sheet, seam)) == "N/m²");
  CHECK(unit(simulation.add(sheet, EdgeStrain{.on = {0, 1, 2}, .stiffness = std::vector<Real>{5, 6}})).empty());
}

TEST_CASE("every number, choice and vector of every type is a parameter") {
  const std::map<std::string, Names> expected = {
      {"line", {"stiffness", "direction"}},
      {"plane", {"stiffness", "normal"}},
      {"half_space", {"stiffness", "normal"}},
      {"edge_spring", {"stiffness", "reduction"}},
      {"edge_strain", {"measure", "stiffness", "min_stretch", "max_stretch"}},
      {"bending", {"stiffness", "orientation"}},
      {"hinge", {"stiffness", "orientation"}},
      {"triangle_bending", {"stiffness", "orientation"}},
      {"triangle_strain", {"stiffness", "min_stretch", "max_stretch"}},
      {"fibre_strain",
       {"grain", "angle", "stiffness", "min_stretch", "max_stretch", "taut_factor", "slack_factor", "taut_stretch"}},
      {"triangle_area", {"stiffness", "min_area", "max_area"}},
      {"tetrahedron_strain", {"stiffness", "min_stretch", "max_stretch"}},
      {"tetrahedron_volume", {"stiffness", "min_volume", "max_volume"}},
      {"triangle_neo_hookean", {"stiffness", "poisson_ratio"}},
      {"triangle_stvk", {"stiffness", "poisson_ratio"}},
      {"tetrahedron_neo_hookean", {"stiffness", "poisson_ratio"}},
      {"tetrahedron_stvk", {"stiffness", "poisson_ratio"}},
      {"drag", {"stiffness", "targets"}},
      {"wind", {"velocity", "model", "area", "drag", "gust_strength", "gust_period"}},
      {"test_force", {"force"}},
      {"pressure", {"model", "pressure", "ambient"}},
      {"gravity", {"acceleration"}},
  };
  const Simulation simulation = make();
  std::size_t count = options_of(simulation, {}).size();
  CHECK(count == 15);
  for (const auto& [id, group] : simulation.groups()) {
    const std::string& group_type = group.type;  // a lambda of clang 14 captures no structured binding
    CAPTURE(group_type);
    const Names names = options_of(simulation, id);
    count += names.size();
    if (group.type == "position") {  // hard pins have no stiffness
      CHECK(names == (simulation.stiffness(id) ? Names{"hold", "stiffness"} : Names{"hold"}));
    } else {
      CHECK(names == expected.at(group.type));
    }
  }
  for (const auto& [id, force] : simulation.forces()) {
    const std::string type(force->type());
    CAPTURE(type);
    CHECK(options_of(simulation, id) == expected.at(type));
    count += expected.at(type).size();
  }
  CHECK(options_of(simulation, ContactOwner{}) == Names{"distance", "friction", "surfaces"});
  CHECK(list_parameters(simulation).size() == count + 3);
}

TEST_CASE("how each body touches is a parameter where anything is touched") {
  Simulation simulation = make();
  const auto count_of_bodies = [&] {
    return std::ranges::count_if(list_parameters(simulation), [](const Parameter& each) {
      return std::holds_alternative<BodyId>(each.handle.owner);
    });
  };
  CHECK(count_of_bodies() == 0);
  set_parameter(simulation, {ContactOwner{}, "surfaces"}, {1, 0, 0});
  CHECK(simulation.contact() == ContactSettings{});
  CHECK(count_of_bodies() == 3 * static_cast<std::ptrdiff_t>(simulation.bodies().size()));
  const BodyId body{1};
  CHECK(options_of(simulation, body) == Names{"distance", "friction", "self"});
  CHECK(parameter(simulation, {body, "self"}).kind == ParameterKind::flag);
  CHECK(parameter(simulation, {body, "friction"}).value[0] == simulation.contact().friction);
  CHECK(parameter(simulation, {body, "friction"}).name == simulation.body(body).name);
  CHECK(simulation.contact(body) == BodyContact{});
  set_parameter(simulation, {body, "friction"}, {0.7, 0, 0});
  set_parameter(simulation, {body, "self"}, {0, 0, 0});
  set_parameter(simulation, {body, "distance"}, {0.004, 0, 0});
  CHECK(simulation.contact(body) == BodyContact{.distance = 0.004, .friction = 0.7, .self = false});
  CHECK(simulation.contact(BodyId{0}) == BodyContact{});
  CHECK(contains(error_of([&] { set_parameter(simulation, {body, "self"}, {0.5, 0, 0}); }), "whole number"));
  CHECK(contains(error_of([&] { set_parameter(simulation, {body, "friction"}, {-1, 0, 0}); }), "friction: -1 is out"));
  set_parameter(simulation, {ContactOwner{}, "surfaces"}, {0, 0, 0});
  CHECK(count_of_bodies() == 0);
  simulation.add(PlaneCollider{.position = {0, 0, -9}});
  CHECK(count_of_bodies() > 0);
}

TEST_CASE("every parameter takes another value, tells it, and the simulation goes on") {
  const Simulation first = make();
  int refused = 0;
  for (const Parameter& parameter : list_parameters(first)) {
    CAPTURE(parameter.type);
    CAPTURE(parameter.handle.option);
    Simulation simulation = make();
    simulation.step();
    const std::optional<Vec3> value = set_to_another(simulation, parameter);
    if (!value) {  // the fibres of a solid have no area beside them
      CHECK(parameter.handle.option == "measure");
      ++refused;
      continue;
    }
    CHECK(pliant::parameter(simulation, parameter.handle).value == *value);
    for (const Parameter& other : list_parameters(first)) {
      if (other.handle == parameter.handle) continue;
      if (parameter.handle.option == "hold") continue;  // brings the stiffness
      CHECK(pliant::parameter(simulation, other.handle).value == other.value);
    }
    advance(simulation, 2);
    CHECK(simulation.state().positions.allFinite());
  }
  CHECK(refused == 1);
}

TEST_CASE("a value out of range is refused by name and range, and leaves no trace") {
  Simulation simulation = make();
  Simulation twin = make();
  check_same_steps(simulation, twin, 2);
  for (const Parameter& parameter : list_parameters(simulation)) {
    CAPTURE(parameter.type);
    CAPTURE(parameter.handle.option);
    const auto message_of = [&](Real bad) {
      return error_of([&] { set_parameter(simulation, parameter.handle, Vec3::Constant(bad)); });
    };
    CHECK(contains(message_of(NAN), parameter.handle.option + ": nan is out of range; give a finite number"));
    if (parameter.kind == ParameterKind::vector || parameter.range.min < -1e300) continue;
    const std::string message = message_of(parameter.range.min - 1);
    CHECK(contains(message, parameter.handle.option + ": "));
    CHECK(contains(message, "is out of range; give a finite number"));
    CHECK(contains(message, parameter.range.excludes_min ? " above 0" : " from "));
  }
  const GroupId skin = simulation.find_group("triangle_strain").value();
  CHECK(contains(error_of([&] { set_parameter(simulation, {skin, "min_stretch"}, {2, 0, 0}); }), "min_stretch"));
  CHECK(contains(error_of([&] { set_parameter(simulation, {{}, "iterations"}, {2.5, 0, 0}); }), "whole number"));
  CHECK(contains(error_of([&] {
                   set_parameter(simulation, {skin, "min_strech"}, {1, 0, 0});
                 }),
                 "unknown parameter 'min_strech'; known: stiffness, min_stretch, max_stretch"));
  CHECK(contains(error_of([&] {
                   set_parameter(simulation, {GroupId{99}, "stiffness"}, {1, 0, 0});
                 }),
                 "group 99 does not exist"));
  CHECK(contains(error_of([&] {
                   set_parameter(simulation, {ForceId{99}, "drag"}, {1, 0, 0});
                 }),
                 "force 99 does not exist"));
  check_same_steps(simulation, twin, 3);
}

TEST_CASE("an option that is changed before the first step is as one that was given") {
  const auto made = [](const TriangleStrain& skin, const Line& rail, const Wind& wind, Index iterations) {
    Simulation simulation({.iterations = iterations, .threads = 1});
    const BodyId cloth = simulation.add_body(grid({.columns = 6, .rows = 6}), Mass::area_density(0.3));
    simulation.add(cloth, skin, "skin");
    simulation.add(cloth, HingeBending{}, "bend");
    simulation.add(cloth, rail, "rail");
    simulation.add(cloth, wind, "wind");
    add_gravity(simulation);
    return simulation;
  };
  const Line rail{.on = {0, 5}, .direction = Vec3(1, 0, 0)};
  Simulation changed = made({.stiffness = 50}, rail, {}, 4);
  const GroupId skin = changed.find_group("skin").value();
  set_parameter(changed, {skin, "min_stretch"}, {0.8, 0, 0});
  set_parameter(changed, {skin, "stiffness"}, {70, 0, 0});
  set_parameter(changed, {changed.find_group("rail").value(), "direction"}, {1, 2, 0});
  set_parameter(changed, {changed.find_force("wind").value(), "drag"}, {3, 0, 0});
  set_parameter(changed, {{}, "iterations"}, {7, 0, 0});
  Line turned = rail;
  turned.direction = Vec3(1, 2, 0);
  Simulation given = made({.stiffness = 70, .min_stretch = 0.8}, turned, {.drag = 3}, 7);
  check_same_steps(changed, given, 10);
}

TEST_CASE("a stiffness costs a numeric factorization and no new layout") {
  Simulation simulation = make();
  advance(simulation, 2);
  const GroupId skin = simulation.find_group("triangle_strain").value();
  set_parameter(simulation, {skin, "stiffness"}, {60, 0, 0});
  const SetUpTimes of_stiffness = simulation.step().set_up;
  CHECK(of_stiffness.numeric > 0);
  CHECK(of_stiffness.layout == 0);
  set_parameter(simulation, {skin, "min_stretch"}, {0.5, 0, 0});
  CHECK(simulation.step().set_up.layout > 0);
  set_parameter(simulation, {simulation.find_force("gravity").value(), "acceleration"}, {0, 0, -1});
  const SetUpTimes of_gravity = simulation.step().set_up;
  CHECK(of_gravity.numeric == 0);
  CHECK(of_gravity.layout == 0);
}

TEST_CASE("other options of a group leave its stiffness, targets and origins as they are by now") {
  Simulation simulation = make();
  const GroupId drag = simulation.find_group("drag").value();
  simulation.set_target(drag, 0, {3, 2, 1});
  simulation.set_target(drag, 1, {1, 2, 3});
  simulation.set_stiffness(drag, 7);
  CHECK(parameter(simulation, {drag, "targets"}).value == Vec3(3, 2, 1));  // where the first of them is
  const auto options = simulation.options<Drag>(drag);
  REQUIRE(options.has_value());
  CHECK(options->stiffness[0] == 7);
  CHECK_FALSE(simulation.options<Position>(drag).has_value());
  set_parameter(simulation, {drag, "targets"}, {5, 5, 5});
  CHECK(simulation.target(drag, 1) == Vec3(5, 5, 5));
  CHECK(simulation.stiffness(drag) == 7);

  const GroupId line = simulation.find_group("line").value();
  const auto origin = [&] { return simulation.groups().at(line).set.batches[0]->anchor(0)[2]; };
  const Real begin = origin();
  advance(simulation, 5);
  set_parameter(simulation, {line, "direction"}, {1, 0, 0});
  CHECK(origin() == begin);
}

TEST_CASE("stiffnesses of each constraint keep their ratios; their factor is the parameter") {
  Simulation simulation;
  const BodyId rope = simulation.add_body(chain({.links = 3}), Mass::total(1));
  const GroupId springs = simulation.add(rope, EdgeSpring{.stiffness = std::vector<Real>{1, 2, 3}});
  CHECK(parameter(simulation, {springs, "stiffness"}).value[0] == 1);
  CHECK(parameter(simulation, {springs, "stiffness"}).unit.empty());
  set_parameter(simulation, {springs, "stiffness"}, {10, 0, 0});
  CHECK(simulation.options<EdgeSpring>(springs)->stiffness.list() == std::vector<Real>{10, 20, 30});
  CHECK(options_of(simulation, springs) == Names{"stiffness", "reduction"});  // no rest length was given
}

TEST_CASE("released vertices stay released when an option changes, and come back with a transaction") {
  Simulation simulation;
  const BodyId sheet = simulation.add_body(grid({.columns = 4, .rows = 4}), Mass::total(1));
  const GroupId pins = simulation.add(sheet, Position{.on = {3, 1, 2},
                                                      .hold = Hold::soft,
                                                      .stiffness = std::vector<Real>{10, 20, 30},
                                                      .targets = std::vector<Vec3>{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}});
  {
    const Transaction transaction(simulation);
    simulation.release(pins, std::vector<Index>{2});
    const auto rest = simulation.options<Position>(pins);
    REQUIRE(rest.has_value());
    CHECK(rest->stiffness.list() == std::vector<Real>{10, 30});
    CHECK(rest->targets.list() == std::vector<Vec3>{{1, 0, 0}, {3, 0, 0}});
    set_parameter(simulation, {pins, "hold"}, {0, 0, 0});
    REQUIRE(simulation.target_count(pins) == 2);
    CHECK(simulation.target(pins, 1) == Vec3(3, 0, 0));
    CHECK(simulation.groups().at(pins).points == std::vector<Index>{0, 2});
    simulation.release(pins, std::vector<Index>{1, 3});
    set_parameter(simulation, {pins, "hold"}, {1, 0, 0});
    CHECK(simulation.target_count(pins) == 0);
  }
  CHECK(simulation.target_count(pins) == 3);
  CHECK(simulation.options<Position>(pins)->stiffness.list() == std::vector<Real>{10, 20, 30});
  CHECK(simulation.options<Position>(pins)->on.vertices == std::vector<Index>{3, 1, 2});
}

TEST_CASE("of constraints made elsewhere the stiffness is the parameter") {
  Simulation simulation;
  const BodyId sheet = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::total(1));
  const Body& body = simulation.body(sheet);
  ConstraintSet set = build(BodyView{body.mesh, body.mesh.vertices, 0, "sheet"}, EdgeSpring{.stiffness = 5});
  const GroupId mine = simulation.add_set(sheet, std::move(set), "my_springs");
  CHECK(options_of(simulation, mine) == Names{"stiffness"});
  CHECK_FALSE(simulation.options<EdgeSpring>(mine).has_value());
  set_parameter(simulation, {mine, "stiffness"}, {8, 0, 0});
  CHECK(simulation.stiffness(mine) == 8);
  CHECK(parameter(simulation, {mine, "stiffness"}).value[0] == 8);
}

}  // namespace test_parameters
