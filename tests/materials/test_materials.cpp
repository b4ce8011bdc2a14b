// Materials are expressed by constraints of the stiffness that their moduli say, and the page has the numbers there
// are.
#include <set>

#include <doctest/doctest.h>
#include <fmt/format.h>

#include "pliant/core/error.h"
#include "pliant/materials/material_groups.h"
#include "pliant/mesh/geometry.h"
#include "pliant/mesh/shapes.h"
#include "tests/constraints/elastic.h"
#include "tests/support/temporary_folder.h"

namespace test_materials {

using namespace pliant;
using pliant_tests::Elastic;
using pliant_tests::TemporaryFolder;

namespace {

const MaterialPlacement as_measured{.direction = Vec3(0, 1, 0), .least_stretch = 0, .slack = 0};

/// The elastic energy of a mesh of this material, deformed by A, over the square of a small number and its measure.
Real energy_density(const Material& material, const Mesh& mesh, Real measure, const Mat3& strain) {
  constexpr Real small = 1e-5;
  const Mat3 A = Mat3::Identity() + small * strain;
  Real energy = 0;
  for (const MaterialGroup& group : material_groups(material, as_measured)) {
    energy +=
        std::visit([&](const auto& options) { return Elastic(mesh, options).energy(mesh.vertices * A.transpose()); },
                   group.options);
  }
  return energy / (small * small * measure);
}

Real sheet_energy(const Material& material, const Mat3& strain) {
  static const Mesh mesh = grid({.columns = 4, .rows = 5, .size = {2, 3}, .plane = Plane::xy});
  return energy_density(material, mesh, 6, strain);
}

Real solid_energy(const Material& material, const Mat3& strain) {
  static const Mesh mesh = bar({.cells = {2, 2, 2}, .size = {1, 2, 3}});
  return energy_density(material, mesh, 6, strain);
}

Mat3 diagonal(Real x, Real y, Real z) {
  return Vec3(x, y, z).asDiagonal();
}

Mat3 shear() {
  Mat3 strain = Mat3::Zero();
  strain(0, 1) = strain(1, 0) = 0.5;
  return strain;
}

doctest::Approx nearly(Real x) {
  return doctest::Approx(x).epsilon(1e-3);
}

std::string refusal(const Mesh& mesh, const Material& material) {
  try {
    Simulation simulation;
    const BodyId body = simulation.add_body(mesh, Mass::per_vertex(1), {.name = "thing"});
    add_material(simulation, body, material);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

}  // namespace

TEST_CASE("a sheet has the moduli of its material") {
  for (const Material& material : builtin_materials()) {
    if (!material.is_sheet()) continue;
    CAPTURE(material.name);
    const auto& sheet = std::get<SheetMaterial>(material.of);
    const bool is_plate = sheet.poisson > 0;
    const Real nu = sheet.poisson;
    if (is_plate) {
      // Plane stress: alone along one axis, with the other held and free.
      CHECK(sheet_energy(material, diagonal(1, 0, 0)) == nearly(sheet.stretch_warp / (1 - nu * nu) / 2));
      CHECK(sheet_energy(material, diagonal(1, -nu, 0)) == nearly(sheet.stretch_warp / 2));
      CHECK(sheet_energy(material, shear()) == nearly(sheet.stretch_warp / (1 + nu) / 4));
      CHECK(sheet.shear == doctest::Approx(sheet.stretch_warp / (1 + nu) / 2).epsilon(0.03));
    } else {
      CHECK(sheet_energy(material, diagonal(0, 1, 0)) == nearly(sheet.stretch_warp / 2));
      CHECK(sheet_energy(material, diagonal(1, 0, 0)) == nearly(sheet.stretch_weft / 2));
      const Real stiffest = std::min(sheet.stretch_warp, sheet.stretch_weft) / 2;  // of paper, whose shear is more
      CHECK(sheet_energy(material, shear()) == nearly(std::min(sheet.shear, stiffest) / 2));
    }
  }
}

TEST_CASE("a solid has Young's modulus and Poisson's ratio of its material") {
  for (const Material& material : builtin_materials()) {
    if (material.is_sheet()) continue;
    CAPTURE(material.name);
    const auto& solid = std::get<SolidMaterial>(material.of);
    const Real nu = solid.poisson, E = solid.young_modulus;
    CHECK(solid_energy(material, diagonal(1, -nu, -nu)) == nearly(E / 2));
    CHECK(solid_energy(material, diagonal(1, 1, 1)) == nearly(3 * E / (1 - 2 * nu) / 2));
    CHECK(solid_energy(material, shear()) == nearly(E / (1 + nu) / 4));
  }
}

TEST_CASE("no modulus is higher than what the least stretch allows") {
  const Material steel = builtin_material("steel_sheet");
  const auto stiffest = [&](Real least_stretch) {
    Real most = 0;
    for (const MaterialGroup& group : material_groups(steel, {.least_stretch = least_stretch})) {
      if (const auto* strain = std::get_if<TriangleStrain>(&group.options)) most = strain->stiffness[0];
      if (const auto* bend = std::get_if<TriangleBending>(&group.options)) CHECK(bend->stiffness[0] == 2.4);
    }
    return most;
  };
  CHECK(stiffest(0) == doctest::Approx(1.05e8 / 1.3));
  CHECK(stiffest(1e-3) == doctest::Approx(3.925 * 9.81 / 1e-3 / 1.3));
  CHECK(stiffest(1e-12) == stiffest(0));
}

TEST_CASE(
    "threads that are softer than measured have what was measured once they are taut, up to five times their own") {
  const auto warp_of = [](const char* name, Real least_stretch) {
    for (const MaterialGroup& group :
         material_groups(builtin_material(name), {.least_stretch = least_stretch, .slack = 0})) {
      if (group.name == "warp") return std::get<FibreStrain>(group.options);
    }
    FAIL("no warp");
    return FibreStrain{};
  };
  CHECK(warp_of("cotton", 0).taut_factor == 1);
  const Real measured = std::get<SheetMaterial>(builtin_material("cotton").of).stretch_warp;
  const Real softened = 9.81 * std::get<SheetMaterial>(builtin_material("cotton").of).area_density / 2e-3;
  REQUIRE(measured > 10 * softened);
  CHECK(warp_of("cotton", 2e-3).taut_factor == 5);
  CHECK(warp_of("cotton", 1e-3).taut_stretch == 1.005);
  CHECK(warp_of("cotton", 2e-3).taut_stretch == 1.01);
  const FibreStrain thrice = warp_of("cotton", 2e-3 * softened / (measured / 3));
  const Real shear = 2 * std::get<SheetMaterial>(builtin_material("cotton").of).shear;
  CHECK(thrice.stiffness[0] + shear == doctest::Approx(measured / 3));
  CHECK(thrice.taut_factor * thrice.stiffness[0] + shear == doctest::Approx(measured));
}

TEST_CASE("threads do not push, give way at first, and get as taut as others") {
  Material cotton = builtin_material("cotton");
  SheetMaterial& sheet = std::get<SheetMaterial>(cotton.of);
  const auto warp_of = [&](const MaterialPlacement& placement) {
    const std::vector<MaterialGroup> groups = material_groups(cotton, placement);
    REQUIRE(groups.front().name == "warp");
    return std::get<FibreStrain>(groups.front().options);
  };
  const Real allowed = 9.81 * sheet.area_density / 1e-3;
  const FibreStrain slack = warp_of({.slack = 0.004});
  CHECK(slack.stiffness[0] + 2 * sheet.shear == doctest::Approx(allowed));
  CHECK(slack.slack_factor == 0.005);
  CHECK(slack.min_stretch[0] == 0);
  CHECK(slack.taut_onset == 1);
  CHECK(slack.taut_stretch == 1.008);
  CHECK(slack.taut_factor == 5);
  const FibreStrain measured = warp_of({.least_stretch = 0, .slack = 0.004});
  CHECK(measured.taut_factor * measured.stiffness[0] + 2 * sheet.shear == doctest::Approx(sheet.stretch_warp));
  CHECK(warp_of({}).taut_stretch == 1.01);
  const FibreStrain none = warp_of({.slack = 0});
  CHECK(none.min_stretch[0] == 1);
  CHECK(none.slack_factor == 1);
  CHECK_FALSE(none.taut_onset.has_value());
  CHECK(none.stiffness[0] == slack.stiffness[0]);
  CHECK(none.taut_factor == slack.taut_factor);
  CHECK(warp_of({.least_stretch = 0.01, .slack = 0.004}).taut_stretch == 1.05);  // soft threads rise farther
  sheet.stretch_warp = 2.01 * sheet.shear;                                       // shear has nearly all of it
  CHECK(warp_of({.slack = 0.004}).taut_factor == doctest::Approx(1));            // as measured
}

TEST_CASE("names are unique, and every number has a source") {
  std::set<std::string> names;
  for (const Material& material : builtin_materials()) {
    CHECK(names.insert(material.name).second);
    CHECK(material.source.size() > 40);
    CHECK(material.description.size() > 10);
    CHECK(&builtin_material(material.name) == &material);
    std::visit([&](const auto& of) { check_options(material.name, of); }, material.of);
    check_options(material.name, material.surface);
  }
  for (const char* name : {"cotton", "silk", "denim", "wool", "felt", "leather", "paper", "rubber_sheet", "steel_sheet",
                           "foam", "silicone", "muscle"}) {
    CHECK(names.contains(name));
  }
  CHECK(find_builtin_material("velvet") == nullptr);
  CHECK_THROWS_WITH_AS(builtin_material("velvet"), doctest::Contains("unknown material 'velvet'; known: cotton, denim"),
                       Error);
}

TEST_CASE("a body of a material weighs what that does and has its friction") {
  const Material& wool = builtin_material("wool");
  Simulation simulation;
  const BodyId body = simulation.add_body(grid({.size = {2, 3}}), mass_of(wool), {.name = "coat"});
  const std::vector<GroupId> groups = add_material(simulation, body, wool);
  CHECK(groups.size() == 4);
  CHECK(simulation.group_names() == std::vector<std::string>{"coat.warp", "coat.weft", "coat.shear", "coat.bend"});
  const std::vector<Real>& masses = simulation.state().masses;
  CHECK(std::accumulate(masses.begin(), masses.end(), Real{0}) == doctest::Approx(6 * 0.1629));
  CHECK(simulation.body(body).contact.friction == 0.4);
  const BodyId other = simulation.add_body(grid({}), mass_of(wool));
  simulation.set_contact(other, {.friction = 0.1});
  add_material(simulation, other, wool);
  CHECK(simulation.body(other).contact.friction == 0.1);
}

TEST_CASE("what does not fit is refused") {
  CHECK(refusal(grid({}), builtin_material("foam")) ==
        "body 'thing': 'foam' is a solid, and the mesh has no tetrahedra; give a sheet, such as 'cotton'");
  Mesh block = bar({});
  block.triangles.clear();
  CHECK(refusal(block, builtin_material("silk")) ==
        "body 'thing': 'silk' is a sheet, and the mesh has no triangles; give a solid, such as 'foam'");
  Material wrong = builtin_material("silk");
  std::get<SheetMaterial>(wrong.of).shear = -1;
  CHECK(refusal(grid({}), wrong).find("material 'silk': shear") == 0);
}

TEST_CASE("the page has the materials that there are") {
  const std::string page = TemporaryFolder::read(std::string(PLIANT_SOURCE_DIR) + "/docs/materials.md");
  for (const Material& material : builtin_materials()) {
    std::string row = fmt::format("| `{}` |", material.name);
    const auto add = [&](const OptionInfo&, Real number) { row += fmt::format(" {:.6g} |", number); };
    std::visit([&](const auto& of) { of.visit(of, add); }, material.of);
    material.surface.visit(material.surface, add);
    CAPTURE(row);
    CHECK(page.find(row) != std::string::npos);
  }
}

}  // namespace test_materials
