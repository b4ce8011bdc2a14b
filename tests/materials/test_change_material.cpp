// A body that is made of another material while it moves is the same, from then on, as one that was made of it at
// first.
#include <algorithm>
#include <numeric>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/forces/gravity.h"
#include "pliant/materials/change_material.h"
#include "pliant/mesh/lattice.h"
#include "pliant/mesh/shapes.h"
#include "pliant/simulation/carried_surface.h"
#include "pliant/simulation/transaction.h"

namespace test_change_material {

using namespace pliant;

namespace {

struct Hung {
  Simulation simulation{settings_for_materials()};
  BodyId sheet;

  explicit Hung(const std::string& material, Mesh mesh = grid({.columns = 9, .rows = 9, .plane = Plane::xz})) {
    const Material& of = builtin_material(material);
    sheet = simulation.add_body(std::move(mesh), mass_of(of), {.name = "sheet"});
    add_material(simulation, sheet, of, {.direction = Vec3(0, 0, 1), .angle = 30});
    simulation.add(sheet, Position{.on = {72, 80}}, "hooks");
    simulation.add(Gravity{});
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) simulation.step();
  }
  Real mass() const {
    const std::vector<Real>& masses = simulation.state().masses;
    return std::accumulate(masses.begin(), masses.end(), Real{0});
  }
};

std::vector<std::string> sorted_names(const Simulation& simulation) {
  std::vector<std::string> names = simulation.group_names();
  std::ranges::sort(names);
  return names;
}

}  // namespace

TEST_CASE("a change of material takes the place of every elastic type that has the whole body") {
  const auto check = [](const Mesh& mesh, const char* material, const auto& options) {
    Simulation changed, fresh;
    const BodyId body = changed.add_body(mesh, Mass::total(1), {.name = "body"});
    changed.add(body, options, "own");
    change_material(changed, body, builtin_material(material));
    add_material(fresh, fresh.add_body(mesh, Mass::total(1), {.name = "body"}), builtin_material(material));
    CHECK(sorted_names(changed) == sorted_names(fresh));
  };
  const Mesh sheet = grid({.columns = 4, .rows = 4}), block = bar({.cells = {2, 1, 1}});
  check(sheet, "cotton", TriangleStrain{});
  check(sheet, "cotton", TriangleNeoHookean{});
  check(sheet, "cotton", TriangleStvk{});
  check(block, "silicone", TetrahedronStrain{});
  check(block, "silicone", TetrahedronNeoHookean{});
  check(block, "silicone", TetrahedronStvk{});
}

TEST_CASE("from a change on a sheet moves as one that was made of that material") {
  // Steel is a plate without threads: other groups than those of silk.
  for (const auto& [from, to] : {std::pair{"cotton", "silk"}, std::pair{"steel_sheet", "silk"}}) {
    Hung changed(from), fresh(to);
    change_material(changed.simulation, changed.sheet, builtin_material(to),
                    {{.direction = Vec3(0, 0, 1), .angle = 30}});
    CHECK(changed.mass() == fresh.mass());
    CHECK(sorted_names(changed.simulation) == sorted_names(fresh.simulation));
    CHECK(changed.simulation.body(changed.sheet).contact.friction ==
          fresh.simulation.body(fresh.sheet).contact.friction);
    const auto apart = [&] {
      return (changed.simulation.state().positions - fresh.simulation.state().positions).cwiseAbs().maxCoeff();
    };
    changed.steps(5);
    fresh.steps(5);
    CHECK(apart() < 1e-9);  // groups are summed in the order in which they came
    changed.steps(15);
    fresh.steps(15);
    CHECK(apart() < 1e-6);
  }
}

TEST_CASE("a change of material leaves threads as slack as they were") {
  for (const Real slack : {0.0, 0.004, MaterialPlacement{}.slack, 0.1}) {
    Simulation simulation;
    const BodyId body = simulation.add_body(grid({.columns = 3, .rows = 3}), Mass::total(1), {.name = "sheet"});
    add_material(simulation, body, builtin_material("cotton"), {.slack = slack});
    change_material(simulation, body, builtin_material("silk"));
    CHECK(present_placement(simulation, body).slack == slack);
  }
}

TEST_CASE("a change while it moves leaves places, speeds, pins and the run of threads, and costs no energy of motion") {
  Hung hung("cotton");
  hung.steps(15);
  const State before = hung.simulation.state();
  const GroupId warp = *hung.simulation.find_group("sheet.warp");
  const std::vector<GroupId> groups = change_material(hung.simulation, hung.sheet, builtin_material("denim"));
  CHECK(hung.simulation.state().positions == before.positions);
  CHECK(hung.simulation.state().velocities == before.velocities);
  CHECK(hung.simulation.find_group("hooks").has_value());
  CHECK(std::ranges::find(groups, warp) != groups.end());
  CHECK(present_placement(hung.simulation, hung.sheet).angle == 30);
  const Real ratio = std::get<SheetMaterial>(builtin_material("denim").of).area_density /
                     std::get<SheetMaterial>(builtin_material("cotton").of).area_density;
  CHECK(hung.simulation.state().masses[5] == doctest::Approx(ratio * before.masses[5]));
  hung.steps(120);
  CHECK(hung.simulation.state().velocities.allFinite());
  CHECK(hung.simulation.state().velocities.cwiseAbs().maxCoeff() < 20);
}

TEST_CASE("constraints of a user's own make room, and those on a selection stay") {
  Simulation simulation;
  const Mesh mesh = grid({.columns = 5, .rows = 5});
  const BodyId sheet = simulation.add_body(mesh, Mass::total(1), {.name = "sheet"});
  simulation.add(sheet, EdgeSpring{}, "springs");
  simulation.add(sheet, HingeBending{}, "fold");
  simulation.add(sheet, EdgeSpring{.on = {0, 1, 2, 3, 4}}, "hem");
  simulation.add(sheet, Position{.on = {24}}, "pin");
  const BodyId other = simulation.add_body(mesh, Mass::total(1), {.name = "other"});
  simulation.add(other, EdgeSpring{}, "springs of the other");
  change_material(simulation, sheet, builtin_material("wool"));
  CHECK(sorted_names(simulation) == std::vector<std::string>{"hem", "pin", "sheet.bend", "sheet.shear", "sheet.warp",
                                                             "sheet.weft", "springs of the other"});
}

TEST_CASE("a vertex without an element keeps its mass") {
  Mesh mesh = grid({.columns = 3, .rows = 3});
  mesh.vertices.conservativeResize(10, 3);
  mesh.vertices.row(9) << 0, 0, 5;
  Simulation simulation;
  const BodyId sheet = simulation.add_body(mesh, Mass::each(std::vector<Real>(10, 0.25)));
  change_material(simulation, sheet, builtin_material("wool"));
  CHECK(simulation.state().masses[9] == 0.25);
  const std::vector<Real>& masses = simulation.state().masses;
  CHECK(std::accumulate(masses.begin(), masses.end() - 1, Real{0}) == doctest::Approx(0.1629));
}

TEST_CASE("what cannot be is refused, with everything as it was") {
  Hung hung("cotton");
  hung.steps(2);
  const std::vector<std::string> names = hung.simulation.group_names();
  const State before = hung.simulation.state();
  CHECK_THROWS_WITH_AS(change_material(hung.simulation, hung.sheet, builtin_material("foam")),
                       doctest::Contains("'foam' is a solid"), Error);
  // The direction lies across every triangle: refused when some groups have gone already.
  CHECK_THROWS_AS(
      change_material(hung.simulation, hung.sheet, builtin_material("silk"), {{.direction = Vec3(0, 1, 0)}}), Error);
  CHECK(hung.simulation.group_names() == names);
  CHECK(hung.simulation.state().masses == before.masses);
  Hung same("cotton");
  same.steps(4);
  hung.steps(2);
  CHECK(same.simulation.state().positions == hung.simulation.state().positions);
}

TEST_CASE("other masses act from the next step on, and may be taken back") {
  Simulation simulation({.iterations = 1});
  const BodyId chain_body = simulation.add_body(chain({.links = 2}), Mass::per_vertex(1));
  simulation.add(chain_body, EdgeSpring{.stiffness = 100});
  simulation.step();
  {
    Transaction transaction(simulation);
    simulation.set_mass(chain_body, Mass::each({1, 2, 3}));
    CHECK(simulation.state().masses == std::vector<Real>{1, 2, 3});
  }
  CHECK(simulation.state().masses == std::vector<Real>{1, 1, 1});
  CHECK_THROWS_WITH_AS(simulation.set_mass(chain_body, Mass::each({1, 0, 3})), doctest::Contains("0"), Error);
  // Pulled apart by a given stretch, the middle of mass stays, whatever the masses.
  simulation.set_mass(chain_body, Mass::each({1, 2, 3}));
  Positions x = simulation.state().positions;
  x.row(2) += Vec3(0.1, 0.2, 0.3).transpose();
  simulation.set_state(x, Positions::Zero(3, 3));
  const Vec3 middle = (x.row(0) + 2 * x.row(1) + 3 * x.row(2)).transpose();
  for (int i = 0; i < 5; ++i) simulation.step();
  const Positions& y = simulation.state().positions;
  CHECK(((y.row(0) + 2 * y.row(1) + 3 * y.row(2)).transpose() - middle).norm() < 1e-12);
  CHECK((y - x).cwiseAbs().maxCoeff() > 1e-3);
}

TEST_CASE("ties of a carried surface stay as many times stiffer than the solid") {
  const Mesh ball = sphere({.subdivisions = 2, .radius = 0.1});
  Simulation simulation;
  const BodyId body = simulation.add_body(lattice_solid(ball, {.spacing = 0.05}, "ball"),
                                          mass_of(builtin_material("foam")), {.name = "ball"});
  add_material(simulation, body, builtin_material("foam"));
  const GroupId ties = carry_surface(simulation, body);
  const Real before = *simulation.stiffness(ties) / tetrahedron_stiffness(simulation, body);
  change_material(simulation, body, builtin_material("silicone"));
  CHECK(*simulation.stiffness(ties) / tetrahedron_stiffness(simulation, body) == doctest::Approx(before));
  CHECK(before == doctest::Approx(tie_ratio));
}

}  // namespace test_change_material
