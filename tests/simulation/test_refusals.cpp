// What a simulation does not take, it refuses by name.
#include <doctest/doctest.h>

#include "../mesh/meshes.h"
#include "pliant/constraints/builtin.h"
#include "pliant/mesh/shapes.h"
#include "run.h"

namespace test_refusals {

using namespace pliant;
using namespace pliant_tests;

namespace {

constexpr Real not_a_number = std::numeric_limits<Real>::quiet_NaN();
constexpr Real infinite = std::numeric_limits<Real>::infinity();

std::string refusal(Mesh mesh, const Mass& mass = Mass::per_vertex(1), const BodyOptions& options = {}) {
  Simulation simulation;
  return error_of([&] { simulation.add_body(std::move(mesh), mass, options); });
}

/// What a sheet of 3 × 3 vertices and 8 triangles says to a constraint.
template <class Constraint>
std::string refusal_of(const Constraint& options) {
  Simulation simulation;
  const BodyId body = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::total(1), {.name = "sheet"});
  const std::string message = error_of([&] { simulation.add(body, options); });
  CHECK(simulation.groups().empty());
  CHECK_NOTHROW(simulation.step());
  return message;
}

std::string refusal_of(const SolverSettings& settings) {
  Simulation simulation;
  const SolverSettings before = simulation.settings();
  const std::string message = error_of([&] { simulation.set_settings(settings); });
  CHECK(error_of([&] { Simulation{settings}; }) == message);
  CHECK(simulation.settings().time_step == before.time_step);
  return message;
}

const Mesh triangle = mesh_of({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});

}  // namespace

TEST_CASE("meshes and masses that are refused") {
  CHECK(contains(refusal({}), "no vertices"));
  Mesh mesh = triangle;
  mesh.vertices(1, 2) = not_a_number;
  CHECK(contains(refusal(mesh), "body 0: vertex 1 is not finite"));
  mesh = triangle;
  mesh.triangles.push_back({0, 1, 3});
  CHECK(contains(refusal(mesh), "triangle 1 (vertices 0, 1, 3) refers to vertex 3"));
  mesh = triangle;
  mesh.vertices.row(2) << 2, 0, 0;
  CHECK(contains(refusal(mesh), "triangle 0 (vertices 0, 1, 2) has zero area"));
  mesh = mesh_of({{1, 1, 1}, {1, 1, 1}});
  mesh.edges = {{0, 1}};
  CHECK(contains(refusal(mesh), "edge 0 (vertices 0, 1) has zero length"));
  for (const Real mass : {0.0, -2.0, not_a_number, infinite}) {
    CHECK(contains(refusal(triangle, Mass::each({1, 2, mass})), "vertex 2 has mass"));
    CHECK(contains(refusal(triangle, Mass::total(mass)), "the mass is"));
  }
  CHECK(contains(refusal(triangle, Mass::each({1, 2})), "2 masses for 3 vertices"));
  CHECK(contains(refusal(triangle, Mass::total(1), {.start = Positions::Zero(2, 3)}), "2 rows for 3 vertices"));
  const Positions bad = Positions::Constant(3, 3, not_a_number);
  CHECK(contains(refusal(triangle, Mass::total(1), {.name = "x", .start = bad}), "body 'x': start positions[0]"));
  CHECK(contains(refusal(triangle, Mass::total(1), {.velocities = bad}), "velocities[0] is not finite"));
}

TEST_CASE("settings that are refused") {
  for (const Real time_step : {0.0, -1.0, not_a_number, infinite}) {
    CHECK(contains(refusal_of(SolverSettings{.time_step = time_step}), "settings: time_step"));
  }
  for (const Index iterations : {0, -2}) {
    CHECK(contains(refusal_of(SolverSettings{.iterations = iterations}), "settings: iterations"));
  }
  CHECK(contains(refusal_of(SolverSettings{.tolerance = -1e-3}), "settings: tolerance"));
  CHECK(contains(refusal_of(SolverSettings{.threads = -1}), "settings: threads"));
}

TEST_CASE_TEMPLATE("stiffnesses that are refused", Type, Position, EdgeSpring, EdgeStrain, Bending, HingeBending,
                   TriangleStrain, TetrahedronStrain, TriangleNeoHookean, TetrahedronStvk) {
  for (const Real stiffness : {0.0, -1.0, not_a_number, infinite}) {
    Type options;
    options.stiffness = stiffness;
    const std::string message = refusal_of(options);
    CHECK(contains(message, std::string(Type::info.name) + ": stiffness"));
    options.stiffness = std::vector<Real>{1, stiffness};
    CHECK(contains(refusal_of(options), std::string(Type::info.name) + ": stiffness[1]"));
  }
  Type options;
  options.stiffness = std::vector<Real>(99, 1);
  CHECK(contains(refusal_of(options), "stiffness has 99 entries for"));
}

TEST_CASE("a stiffness that is left empty is refused") {
  CHECK(contains(refusal_of(EdgeSpring{.stiffness = Values()}), "stiffness: empty; give one"));
  CHECK(contains(refusal_of(TriangleStrain{.max_stretch = Values()}), "max_stretch: empty; give one"));
}

TEST_CASE("indices that are refused") {
  for (const Index vertex : {-1, 9}) {
    const std::string name = std::to_string(vertex);
    CHECK(contains(refusal_of(Position{.on = {0, vertex}}), "selected vertex " + name + " is out of range"));
    CHECK(contains(refusal_of(EdgeSpring{.on = {vertex}}), "selected vertex " + name + " is out of range"));
    CHECK(contains(refusal_of(Bending{.on = {vertex}}), "selected vertex " + name + " is out of range"));
    CHECK(contains(refusal_of(EdgeSpring{.stencils = {{0, 1}, {2, vertex}}}), "stencil 1: vertex " + name));
    CHECK(contains(refusal_of(TriangleStrain{.stencils = {{0, 1, vertex}}}), "stencil 0: vertex " + name));
    CHECK(contains(refusal_of(Drag{.stencils = {{vertex}}}), "drag on body 'sheet': stencil 0: vertex " + name));
  }
  CHECK(contains(refusal_of(EdgeSpring{.stencils = {{4, 4}}}), "names vertex 4 twice"));
  CHECK(contains(refusal_of(TriangleStrain{.stencils = {{0, 1}}}), "stencil 0 has 2 vertices; it takes 3"));
}

TEST_CASE("rest data that is refused") {
  CHECK(contains(refusal_of(EdgeSpring{.rest_length = 0.0}), "rest_length"));
  CHECK(contains(refusal_of(EdgeSpring{.rest_length = std::vector<Real>{1, 2}}), "rest_length has 2 entries for 16"));
  CHECK(contains(refusal_of(TriangleStrain{.stencils = {{0, 1, 2}}}), "no positive rest area"));
  CHECK(contains(refusal_of(TetrahedronStrain{.stencils = {{0, 1, 3, 4}}}), "no positive rest volume"));
  CHECK(contains(refusal_of(HingeBending{.stencils = {{0, 1, 2, 4}}}), "no positive rest area"));
  CHECK(
      contains(refusal_of(EdgeStrain{.stencils = {{0, 5}}, .measure = FibreMeasure::cloth}), "belongs to no triangle"));
  CHECK(contains(refusal_of(TriangleStrain{.min_stretch = 1.2, .max_stretch = 1.1}), "min_stretch 1.2 is above"));
  CHECK(contains(refusal_of(EdgeStrain{.min_stretch = 1.2}), "min_stretch 1.2 is above max_stretch 1 "));
  CHECK(contains(refusal_of(TetrahedronStrain{.min_stretch = 0}), "tetrahedron_strain: min_stretch"));
  for (const Real ratio : {-0.1, 0.5, not_a_number}) {
    CHECK(
        contains(refusal_of(TetrahedronNeoHookean{.poisson_ratio = ratio}), "tetrahedron_neo_hookean: poisson_ratio"));
    CHECK(contains(refusal_of(TriangleStvk{.poisson_ratio = ratio}), "triangle_stvk: poisson_ratio"));
  }
  CHECK(contains(refusal_of(TriangleStrain{.max_stretch = infinite}), "triangle_strain: max_stretch"));
  CHECK(contains(refusal_of(Line{.direction = Vec3(0, 0, 0)}), "zero vector"));
  CHECK(contains(refusal_of(Line{}), "direction is missing"));
  CHECK(contains(refusal_of(OnPlane{}), "plane: normal is missing"));
  CHECK(contains(refusal_of(InHalfSpace{.normal = Vec3(0, 0, 0)}), "zero vector"));
  CHECK(contains(refusal_of(FibreStrain{.direction = Vec3(0, 0, 0)}), "direction 0 is the zero vector"));
  CHECK(contains(refusal_of(TriangleArea{.min_area = 2}), "triangle_area: min_area 2 is above max_area 1"));
  CHECK(contains(refusal_of(Line{.direction = Vec3(0, not_a_number, 0)}), "line: direction"));
  CHECK(contains(refusal_of(Position{.targets = std::vector<Vec3>{{0, 0, 0}}}), "targets has 1 entries for 9"));
  CHECK(contains(refusal_of(Bending{.stencils = {{4, 0, 1}}}), "cotangents"));
  CHECK(contains(refusal_of(Bending{.stencils = {{4, 0, 1}}, .cotangents = {{1}}, .areas = 1}), "1 cotangents"));
  CHECK(contains(refusal_of(Bending{.stencils = {{4, 0, 1}}, .cotangents = {{1, 1}}, .areas = -1}), "bending: areas"));
  CHECK(contains(refusal_of(Drag{}), "stencils are missing"));
  CHECK(contains(refusal_of(Drag{.stencils = {{0, 1}}, .weights = {{0.5, 0.6}}}), "2 weights with the sum 1.1"));
  CHECK(contains(refusal_of(Drag{.stencils = {{0, 1, 2, 3, 4}}}), "has 5 vertices; give the one to four"));
}

TEST_CASE("a simulation without a body, and a body that is not there") {
  Simulation simulation;
  CHECK(contains(error_of([&] { simulation.step(); }), "no body"));
  CHECK(contains(error_of([&] { simulation.add(BodyId{0}, EdgeSpring{}); }), "body 0 does not exist"));
}

}  // namespace test_refusals
