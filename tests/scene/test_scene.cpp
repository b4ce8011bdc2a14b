// What scene files can say reaches the simulation.
#include <cmath>
#include <string>

#include <doctest/doctest.h>

#include "pliant_io/scene/scene.h"

namespace test_scene {

namespace {

using namespace pliant;

/// A scene of one body with the given members.
Scene body_scene(const std::string& body, const std::string& more = "", const SceneOverrides& overrides = {}) {
  return parse_scene("{\"pliant\": 1, \"gravity\": null, \"bodies\": [{" + body + "}]" + more + "}", {}, "s.json",
                     overrides);
}

const std::string grid = R"("mesh": {"shape": "grid", "columns": 3, "rows": 3, "size": [2, 2], "plane": "xy"}, )";
const std::string mass = R"("mass": {"per_vertex": 1})";

/// The vertices that a selection means on a grid of 3 × 3 that was moved by (10, 0, 0).
std::vector<Index> selected(const std::string& on) {
  const Scene scene = body_scene(grid + mass + R"(, "transform": {"translate": [10, 0, 0]},
    "constraints": [{"type": "position", "on": )" +
                                 on + "}]");
  const std::span<const Index> held = scene.simulation.groups().begin()->second.set.batches[0]->pinned_vertices();
  return {held.begin(), held.end()};
}

TEST_CASE("selections") {
  CHECK(selected("[4, 1]") == std::vector<Index>{1, 4});
  CHECK(selected("\"all\"").size() == 9);
  CHECK(selected("\"boundary\"") == std::vector<Index>{0, 1, 2, 3, 5, 6, 7, 8});
  CHECK(selected("\"corners\"") == std::vector<Index>{0, 2, 6, 8});
  CHECK(selected(R"({"box": {"min": [10, 1, 0], "max": [11, 2, 0]}})") == std::vector<Index>{3, 4, 6, 7});
  CHECK(selected(R"({"half_space": {"point": [11, 1, 0], "normal": [3, 0, 0]}})") ==
        std::vector<Index>{1, 2, 4, 5, 7, 8});
  CHECK(selected(R"({"nearest": [11.1, 0.9, 5]})") == std::vector<Index>{4});
  CHECK(selected(R"({"nearest": [[11.1, 0.9, 5], [0, 0, 0]]})") == std::vector<Index>{0, 4});
}

TEST_CASE("one line of the boundary, by its number or the nearest") {
  CHECK(selected(R"({"boundary_loop": 0})") == std::vector<Index>{0, 1, 2, 3, 5, 6, 7, 8});
  CHECK(selected(R"({"boundary_loop": {"nearest": [0, 0, 0]}})").size() == 8);
  const auto selected_of = [](const std::string& mesh, const std::string& loop) {
    const Scene scene = body_scene("\"mesh\": " + mesh + ", " + mass + R"(, "transform": {"translate": [0, 0, 5]},
      "constraints": [{"type": "position", "on": {"boundary_loop": )" +
                                   loop + "}}]");
    const std::span<const Index> held = scene.simulation.groups().begin()->second.set.batches[0]->pinned_vertices();
    return std::vector<Index>(held.begin(), held.end());
  };
  // Three triangles by themselves: the loops go by their first vertex.
  const std::string three = R"({"vertices": [[0,0,0],[1,0,0],[0,1,0], [9,0,0],[8,0,0],[9,1,0], [4,0,0],[5,0,0],[4,1,0]],
    "triangles": [[6,7,8], [3,4,5], [0,1,2]]})";
  CHECK(selected_of(three, "0") == std::vector<Index>{0, 1, 2});
  CHECK(selected_of(three, "1") == std::vector<Index>{3, 4, 5});
  CHECK(selected_of(three, "2") == std::vector<Index>{6, 7, 8});
  CHECK(selected_of(three, R"({"nearest": [4.4, 0, 0]})") == std::vector<Index>{6, 7, 8});
  CHECK(selected_of(three, R"({"nearest": [20, 0, 0]})") == std::vector<Index>{3, 4, 5});
  // Two triangles that meet in a vertex: the walk turns there into the lower edge.
  const std::string bow =
      R"({"vertices": [[0,0,0],[-1,0,0],[-1,1,0],[1,0,0],[1,1,0]], "triangles": [[0,1,2], [0,3,4]]})";
  CHECK(selected_of(bow, "0").size() == 5);

  const auto refusal = [&](const std::string& mesh, const std::string& loop) -> std::string {
    try {
      selected_of(mesh, loop);
    } catch (const Error& error) {
      return std::string(error.what()).substr(std::string("s.json: bodies[0].constraints[0].on.boundary_loop").size());
    }
    return "(no error)";
  };
  CHECK(refusal(three, "3") == ": there is no boundary loop 3; the body has loops 0 to 2, as `pliant info` lists them");
  CHECK(refusal(three, "-1").starts_with(": there is no boundary loop -1;"));
  CHECK(refusal(three, "9223372036854775807").starts_with(": there is no boundary loop 9223372036854775807;"));
  CHECK(refusal(three, "1e30").starts_with(": found 1e+30; give a whole number"));
  CHECK(refusal(three, "0.5").starts_with(": found 0.5; give a whole number"));
  CHECK(refusal(three, "\"first\"") == ": found a string; give the number of a loop, or {\"nearest\": [x, y, z]}");
  CHECK(refusal(three, "[0, 1]").starts_with(": found a list; give the number of a loop"));
  CHECK(refusal(three, "null").starts_with(": found null; give the number of a loop"));
  CHECK(refusal(three, "{}") == ": the key 'nearest' is missing; add it");
  CHECK(refusal(three, R"({"nearest": [0, 0]})").starts_with(".nearest: the list has 2 entries"));
  CHECK(refusal(three, R"({"nearest": [0, 0, 1e200]})").starts_with(".nearest[2]: 1e+200 is out of range"));
  CHECK(refusal(three, R"({"nearst": [0, 0, 0]})").starts_with(".nearst: unknown key; did you mean 'nearest'?"));
  CHECK(refusal(R"({"shape": "chain", "links": 3})", "0").starts_with(": the triangles of the body have no boundary;"));
  CHECK(refusal(R"({"shape": "sphere"})", "0").starts_with(": the triangles of the body have no boundary;"));
}

TEST_CASE("corners are those before the transform") {
  const Scene scene = body_scene(grid + mass + R"(, "transform": {"rotate": {"axis": [0, 0, 1], "degrees": 30}},
    "constraints": [{"type": "position", "on": "corners"}])");
  CHECK(scene.simulation.groups().begin()->second.set.count == 4);
}

TEST_CASE("a transform scales, then turns, then moves the rest positions") {
  const Scene scene = body_scene(R"("mesh": {"vertices": [[1, 2, 3], [0, 0, 0]]}, )" + mass +
                                 R"(, "transform": {"scale": [2, 1, 1], "rotate": {"axis": [0, 0, 5], "degrees": 90},
                                 "translate": [10, 20, 30]})");
  const Positions& rest = scene.simulation.bodies()[0].mesh.vertices;
  CHECK((row(rest, 0) - Vec3(8, 22, 33)).norm() < 1e-14);
  CHECK((row(rest, 1) - Vec3(10, 20, 30)).norm() < 1e-14);
}

TEST_CASE("start positions, velocities and every way to say a mass") {
  const std::string rod = R"("mesh": {"vertices": [[0, 0, 0], [2, 0, 0]], "edges": [[0, 1]]}, )";
  const Scene scene = body_scene(rod + R"("mass": {"each": [1, 3]}, "start_positions": [[0, 0, 1], [0, 0, 2]],
                                 "velocities": [[1, 0, 0], [0, 1, 0]])");
  CHECK(scene.simulation.state().positions.row(1) == Eigen::RowVector3d(0, 0, 2));
  CHECK(scene.simulation.bodies()[0].mesh.vertices.row(1) == Eigen::RowVector3d(2, 0, 0));
  CHECK(scene.simulation.state().velocities.row(1) == Eigen::RowVector3d(0, 1, 0));
  CHECK(scene.simulation.state().masses == std::vector<Real>{1, 3});

  const auto first_mass = [](const std::string& mesh, const std::string& how) {
    return body_scene(mesh + "\"mass\": {" + how + "}").simulation.state().masses[0];
  };
  CHECK(first_mass(rod, "\"line_density\": 5") == 5);
  CHECK(first_mass(rod, "\"total\": 5") == 2.5);
  CHECK(first_mass(rod, "\"per_vertex\": 5") == 5);
  const std::string triangle = R"("mesh": {"vertices": [[0,0,0],[2,0,0],[0,3,0]], "triangles": [[0,1,2]]}, )";
  CHECK(first_mass(triangle, "\"area_density\": 2") == doctest::Approx(2));
  const std::string tetrahedron =
      R"("mesh": {"vertices": [[0,0,0],[1,0,0],[0,1,0],[0,0,1]], "tetrahedra": [[0,1,2,3]]}, )";
  CHECK(first_mass(tetrahedron, "\"density\": 24") == doctest::Approx(1));
  const Scene moving = body_scene(grid + mass + R"(, "velocity": [1, 2, 3])");
  CHECK(moving.simulation.state().velocities.row(8) == Eigen::RowVector3d(1, 2, 3));
}

TEST_CASE("options of constraints: explicit arrays, one value each, names") {
  const Scene scene = body_scene(grid + mass + R"(, "constraints": [
    {"type": "edge_spring", "stencils": [[0, 1], [8, 0]], "stiffness": [2, 4], "rest_length": 3},
    {"type": "edge_spring", "stencils": [[0, 1]]},
    {"type": "position", "name": "pins", "hold": "soft", "stencils": [3, [1]], "targets": [[0, 0, 1], [0, 0, 2]]},
    {"type": "drag", "stencils": [[0, 1, 4]], "weights": [[0.5, 0.25, 0.25]], "targets": [7, 8, 9]}])");
  std::vector<std::string> names;
  std::vector<GroupId> ids;
  for (const auto& [id, group] : scene.simulation.groups()) {
    names.push_back(group.name);
    ids.push_back(id);
  }
  CHECK(names == std::vector<std::string>{"body 0.edge_spring", "body 0.edge_spring 2", "pins", "body 0.drag"});
  const auto& springs = *scene.simulation.groups().at(ids[0]).set.batches[0];
  CHECK(std::vector<Index>(springs.stencil().begin(), springs.stencil().end()) == std::vector<Index>{0, 1, 8, 0});
  CHECK(std::vector<Real>(springs.rest_measure().begin(), springs.rest_measure().end()) == std::vector<Real>{2, 4});
  const auto& pins = *scene.simulation.groups().at(ids[2]).set.batches[0];
  CHECK(pins.type() == "position");
  CHECK(std::vector<Index>(pins.stencil().begin(), pins.stencil().end()) == std::vector<Index>{3, 1});
}

TEST_CASE("gravity: the usual, none, or any") {
  const auto speed = [](const std::string& gravity) {
    Scene scene = parse_scene(
        "{\"pliant\": 1, \"settings\": {\"time_step\": 0.5}, \"bodies\": [{" + grid + mass + "}]" + gravity + "}", {},
        "s.json");
    scene.step();
    return row(scene.simulation.state().velocities, 0);
  };
  CHECK((speed("") - Vec3(0, 0, -4.905)).norm() < 1e-14);
  CHECK(speed(", \"gravity\": null") == Vec3::Zero());
  CHECK((speed(", \"gravity\": [2, 0, 0]") - Vec3(1, 0, 0)).norm() < 1e-14);
}

TEST_CASE("a test force acts on its frames alone") {
  Scene scene = body_scene(grid + mass, R"(, "settings": {"time_step": 0.5}, "forces": [
    {"type": "test_force", "vertices": [0, 3], "force": [[2, 0, 0], [4, 0, 0]], "frames": [1, 3]}])");
  std::vector<Real> speeds;
  for (int i = 0; i < 4; ++i) {
    scene.step();
    speeds.push_back(scene.simulation.state().velocities(0, 0));
  }
  CHECK(speeds == std::vector<Real>{0, 1, 2, 2});
  CHECK(scene.simulation.state().velocities(3, 0) == 4);
}

TEST_CASE("forces on one of several bodies") {
  const std::string two = R"("name": "a", )" + grid + mass + R"(}, {"name": "b", )" + grid + mass;
  Scene scene = body_scene(two, R"(, "forces": [{"type": "wind", "body": "b", "velocity": [0, 0, 1]},
    {"type": "mouse_spring", "body": "a", "vertex": 4, "anchor": [1, 1, 5], "stiffness": 10}])");
  scene.step();
  const Positions& v = scene.simulation.state().velocities;
  CHECK(v.topRows(4).norm() == 0);
  CHECK(v(4, 2) > 0);
  CHECK(v.bottomRows(9).col(2).minCoeff() > 0);
  CHECK_THROWS_WITH(body_scene(two, R"(, "forces": [{"type": "test_force", "vertex": 0, "force": [0, 0, 1]}])"),
                    doctest::Contains("forces[0]: there are several bodies"));
}

TEST_CASE("overrides take the place of the scene's values") {
  SceneOverrides overrides;
  overrides.steps = 7;
  overrides.time_step = 0.25;
  overrides.iterations = 4;
  overrides.tolerance = 0.5;
  overrides.threads = 2;
  overrides.backend = Backend::eigen;
  overrides.format = FrameFormat::obj;
  overrides.every = 3;
  const Scene scene = body_scene(grid + mass, R"(, "steps": 1, "settings": {"start": "positions", "iterations": 1},
    "output": {"format": "none", "every": 2})",
                                 overrides);
  CHECK(scene.steps == 7);
  CHECK(scene.output.format == FrameFormat::obj);
  CHECK(scene.output.every == 3);
  const SolverSettings& settings = scene.simulation.settings();
  CHECK(settings.time_step == 0.25);
  CHECK(settings.iterations == 4);
  CHECK(settings.tolerance == 0.5);
  CHECK(settings.threads == 2);
  CHECK(settings.backend == Backend::eigen);
  CHECK(settings.start == Start::positions);
  CHECK_THROWS_WITH(body_scene(grid + mass, "", {.iterations = 0}),
                    doctest::Contains("settings.iterations=0: 0 is out of range"));
}

}  // namespace

}  // namespace test_scene
