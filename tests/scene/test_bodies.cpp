// Bodies in scene files: parts and their weld, copies, masses that add up, files with a source, pressure.
#include <algorithm>
#include <string>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/mesh/topology.h"
#include "pliant_io/scene/scene.h"
#include "tests/mesh/meshes.h"
#include "tests/support/temporary_folder.h"

namespace test_bodies {

namespace {

using namespace pliant;

Scene scene_of(const std::string& mesh, const std::string& mass = R"({"per_vertex": 1})",
               const std::string& forces = "[]") {
  return parse_scene(
      R"({"pliant": 1, "bodies": [{"mesh": )" + mesh + R"(, "mass": )" + mass + R"(}], "forces": )" + forces + "}", {},
      "s.json");
}

const Mesh& mesh_of(const Scene& scene) {
  return scene.simulation.body(BodyId{0}).mesh;
}

std::string refusal(const std::string& mesh, const std::string& mass = R"({"per_vertex": 1})",
                    const std::string& forces = "[]") {
  try {
    scene_of(mesh, mass, forces);
  } catch (const Error& error) {
    CHECK(error.kind() == ErrorKind::input);
    CHECK(std::string(error.what()).find('\n') == std::string::npos);
    return error.what();
  }
  return "(no error)";
}

bool starts(const std::string& text, std::string_view start) {
  CAPTURE(text);
  CHECK(text.starts_with(start));
  return text.starts_with(start);
}

TEST_CASE("parts make one body: placed, copied, welded, named") {
  const Scene scene = scene_of(R"({"parts": [
      {"name": "rope", "shape": "chain", "links": 4, "length": 4, "direction": [1, 0, 0]},
      {"name": "tags", "shape": "grid", "columns": 2, "rows": 2, "size": [0.5, 0.5],
       "transform": {"translate": [1, 0, -0.5]}, "copies": {"count": 3, "offset": [1, 0, 0]}},
      {"parts": [{"name": "inner", "vertices": [[9, 9, 9]]}]}
    ], "weld": 1e-9})");
  const Mesh& mesh = mesh_of(scene);
  CHECK(mesh.vertex_count() == 5 + 3 * 3 + 1);
  CHECK(mesh.edges.size() == 4);
  CHECK(mesh.triangles.size() == 6);
  REQUIRE(mesh.vertex_groups.size() == 3);
  CHECK(mesh.vertex_groups[0].name == "rope");
  CHECK(mesh.vertex_groups[1].name == "tags");
  CHECK(mesh.vertex_groups[1].vertices.size() == 12);
  CHECK(mesh.vertex_groups[2].name == "inner");
  CHECK(mesh.vertex_groups[2].vertices == std::vector<Index>{14});
  CHECK(std::ranges::max(components(mesh)) == 1);
}

TEST_CASE("a loose vertex gets a thousandth of the mean mass, with a warning, or is left out") {
  const std::string inner = R"({"vertices": [[0, 0, 0], [9, 9, 9], [1, 0, 0], [0, 0, 1]], "triangles": [[0, 2, 3]]})";
  const Scene shared = scene_of(inner, R"({"total": 3})");
  CHECK(shared.simulation.state().masses == std::vector<Real>{1, 1e-3, 1, 1});
  REQUIRE(shared.warnings.size() == 1);
  CHECK(shared.warnings[0].starts_with("s.json: bodies[0].mass: 1 vertex in no element (1): each gets a thousandth"));
  CHECK(scene_of(inner, R"({"area_density": 6})").simulation.state().masses == std::vector<Real>{1, 1e-3, 1, 1});
  CHECK(scene_of(inner, R"({"per_vertex": 1})").warnings.empty());
  CHECK(scene_of(inner, R"({"each": [1, 2, 3, 4]})").warnings.empty());
  starts(refusal(inner, R"({"density": 1})"), "s.json: bodies[0].mass: mass: the mass is given as a density, but");
  const Scene points = scene_of(R"({"vertices": [[0, 0, 0], [1, 0, 0]]})", R"({"total": 3})");
  CHECK(points.simulation.state().masses == std::vector<Real>{1.5, 1.5});
  CHECK(points.warnings.empty());

  const pliant_tests::TemporaryFolder folder;
  const std::string file = folder.write("a.obj", "v 0 0 0\nv 9 9 9\nv 1 0 0\nv 0 0 1\nf 1 3 4\n").generic_string();
  const Scene dropped = scene_of(R"({"file": ")" + file + R"(", "drop_loose": true})", R"({"total": 3})");
  CHECK(mesh_of(dropped).vertex_count() == 3);
  CHECK(dropped.simulation.state().masses == std::vector<Real>{1, 1, 1});
  REQUIRE(dropped.warnings.size() == 1);
  CHECK(dropped.warnings[0] ==
        "s.json: bodies[0].mesh.file: left out 1 vertex that no element has; the other 3 are numbered anew");
}

TEST_CASE("what parts refuse") {
  starts(refusal(R"({"parts": []})"), "s.json: bodies[0].mesh.parts: there is no part; add one");
  starts(refusal(R"({"parts": {}})"), "s.json: bodies[0].mesh.parts: found an object; give a list [...]");
  starts(refusal(R"({"parts": [{"shape": "chain", "welt": 1}]})"), "s.json: bodies[0].mesh.parts[0].welt: unknown key");
  starts(refusal(R"({"parts": [{"shape": "chain"}], "weld": -1})"), "s.json: bodies[0].mesh: weld: -1 is out of range");
  starts(refusal(R"({"shape": "chain", "name": "rope"})"), "s.json: bodies[0].mesh.name: unknown key");
  starts(refusal(R"({"parts": [{"shape": "chain", "copies": {"count": 0}}]})"),
         "s.json: bodies[0].mesh.parts[0].copies.count: 0 is out of range");
  starts(refusal(R"({"parts": [{"shape": "chain", "copies": {"count": 10001}}]})"),
         "s.json: bodies[0].mesh.parts[0].copies.count: 10001 is out of range; give a finite number from 1");
  starts(refusal(R"({"parts": [{"shape": "grid", "columns": 200, "rows": 200, "copies": {"count": 9999}}]})"),
         "s.json: bodies[0].mesh.parts[0].copies: copies ask for 4e+08 vertices; stay under 20000000");
  starts(refusal(R"({"parts": [{"shape": "grid", "columns": 3000, "rows": 3000},
                               {"shape": "grid", "columns": 3400, "rows": 3400}, {"shape": "chain"}]})"),
         "s.json: bodies[0].mesh.parts[1]: the parts up to this one ask for 2.06e+07 vertices; stay under 20000000");
  starts(refusal(R"({"parts": [{"shape": "chain", "name": 5}]})"),
         "s.json: bodies[0].mesh.parts[0].name: found a number; give a text");
  starts(refusal(R"({"parts": [{"vertices": [[0, 0, 0], [0, 0, 0]], "edges": [[0, 1]], "name": "knot"}]})"),
         "s.json: bodies[0].mesh: part 'knot': edge 0");
  starts(refusal(R"({"parts": [{"shape": "chain", "file": "a.obj"}]})"),
         "s.json: bodies[0].mesh.parts[0]: has both 'shape' and 'file'");
}

TEST_CASE("a group selects the vertices of a part, also of one without faces") {
  const std::string mesh = R"({"parts": [{"name": "rope", "shape": "chain", "links": 2},
                                         {"name": "plank", "shape": "bar", "cells": [1, 1, 1]}, {"shape": "chain"}]})";
  const auto held = [&](const std::string& name) {
    const Scene scene = parse_scene(R"({"pliant": 1, "bodies": [{"mesh": )" + mesh +
                                        R"(, "mass": {"per_vertex": 1}, "constraints": [
                                            {"type": "position", "on": {"group": ")" +
                                        name + R"("}}]}]})",
                                    {}, "s.json");
    const std::span<const Index> vertices = scene.simulation.groups().begin()->second.set.batches[0]->pinned_vertices();
    return std::vector<Index>(vertices.begin(), vertices.end());
  };
  CHECK(held("rope") == std::vector<Index>{0, 1, 2});
  CHECK(held("plank") == std::vector<Index>{3, 4, 5, 6, 7, 8, 9, 10});
  CHECK(
      pliant_tests::contains(pliant_tests::error_of([&] { held("plonk"); }),
                             "no group, object, material or part 'plonk'; did you mean 'plank'? (known: plank, rope)"));
}

TEST_CASE("densities add up, other masses stand alone") {
  const std::string mesh = R"({"parts": [{"shape": "chain", "links": 1, "length": 2},
                                         {"shape": "grid", "columns": 2, "rows": 2}]})";
  const Scene scene = scene_of(mesh, R"({"line_density": 3, "area_density": 6})");
  CHECK(scene.simulation.state().masses == std::vector<Real>{3, 3, 2, 1, 1, 2});
  starts(refusal(mesh, R"({"line_density": 3})"), "s.json: bodies[0].mass: body 0: vertex 2 has mass 0");
  starts(refusal(mesh, R"({"line_density": 3, "density": 1})"),
         "s.json: bodies[0].mass: body 0: the mass is given as a density");
  starts(refusal(mesh, R"({"line_density": 3, "total": 1})"), "s.json: bodies[0].mass: has both");
  starts(refusal(mesh, R"({"line_density": 3, "area_density": 6, "total": 1})"), "s.json: bodies[0].mass: has both");
}

TEST_CASE("a missing file's error has its source, a file that is there none") {
  starts(refusal(R"({"file": "no/such.obj", "source": "ask\nAda"})"),
         "s.json: bodies[0].mesh.file: no/such.obj: no such file; ask Ada");
  const pliant_tests::TemporaryFolder folder;
  const std::string file = folder.write("point.obj", "v 1 2 3\n").generic_string();
  CHECK(mesh_of(scene_of(R"({"file": ")" + file + R"(", "source": "here"})")).vertex_count() == 1);
  starts(refusal(R"({"file": ")" + folder.path().generic_string() + R"(", "source": "here"})"),
         "s.json: bodies[0].mesh.file: ");
}

TEST_CASE("pressure from a scene") {
  const std::string force = R"([{"type": "pressure", "model": "gas", "pressure": 10}])";
  const Scene scene = scene_of(R"({"shape": "pillow"})", R"({"area_density": 1})", force);
  CHECK(scene.simulation.forces().size() == 2);
  CHECK(scene.simulation.forces().begin()->second->type() == "gravity");
  CHECK(scene.simulation.forces().rbegin()->second->type() == "pressure");
  CHECK(starts(refusal(R"({"shape": "grid"})", R"({"total": 1})", force),
               "s.json: forces[0]: pressure: the surface is open: it has 40 boundary edges"));
  starts(refusal(R"({"shape": "pillow"})", R"({"total": 1})", R"([{"type": "pressure", "presure": 1}])"),
         "s.json: forces[0].presure: unknown key; did you mean 'pressure'? (known: ");
  starts(refusal(R"({"shape": "pillow"})", R"({"total": 1})", R"([{"type": "pressure", "on": [0, 1, 2]}])"),
         "s.json: forces[0]: pressure: ");
}

}  // namespace

}  // namespace test_bodies
