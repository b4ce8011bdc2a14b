// The key "material" of a body, and "materials" of a scene.
#include <numeric>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant_io/scene/scene.h"

namespace test_material_scenes {

using namespace pliant;

namespace {

/// A scene with one sheet; `body`: more keys of it, `top`: more of the scene.
Scene sheet_scene(const std::string& body, const std::string& top = "") {
  return parse_scene(R"({"pliant": 1, "gravity": null, "bodies": [{"name": "sheet", "mesh": {"shape": "grid",
    "columns": 5, "rows": 4}, )" +
                         body + "}]" + top + "}",
                     ".", "scene.json");
}

std::string refusal(const std::string& body, const std::string& top = "") {
  try {
    sheet_scene(body, top);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

Real stiffness(const Scene& scene, std::string_view name) {
  for (const auto& [id, group] : scene.simulation.groups()) {
    if (group.name == name) return group.set.batches[0]->stiffness();
  }
  return -1;
}

Real mass(const Scene& scene) {
  const std::vector<Real>& masses = scene.simulation.state().masses;
  return std::accumulate(masses.begin(), masses.end(), Real{0});
}

std::optional<Real> friction(const Scene& scene) {
  return scene.simulation.body(BodyId{0}).contact.friction;
}

}  // namespace

TEST_CASE("a name is enough: mass, constraints, friction and damping follow") {
  const Scene scene = sheet_scene(R"("material": "cotton")");
  CHECK(scene.simulation.group_names() ==
        std::vector<std::string>{"sheet.warp", "sheet.weft", "sheet.shear", "sheet.bend"});
  CHECK(mass(scene) == doctest::Approx(0.1238));
  CHECK(stiffness(scene, "sheet.shear") == 112);
  CHECK(stiffness(scene, "sheet.warp") == doctest::Approx(0.1238 * 9.81 / 1e-3 - 112));
  CHECK(stiffness(scene, "sheet.bend") == 1.16e-5);
  CHECK(friction(scene) == 0.5);
  CHECK(scene.simulation.settings().damping == doctest::Approx(2.1).epsilon(1e-12));
}

TEST_CASE("a scene of materials moves as they look right, but for what it says itself") {
  const SolverSettings all = sheet_scene(R"("material": "cotton")").simulation.settings();
  CHECK(all.integrator == Integrator::bdf2);
  CHECK(all.acceleration == Acceleration::lbfgs);
  CHECK(all.iterations == 20);
  CHECK(all.start == Start::adaptive);
  const Scene own = sheet_scene(R"("material": "cotton")", R"(, "settings": {"integrator": "implicit_euler"})");
  CHECK(own.simulation.settings().integrator == Integrator::implicit_euler);
  CHECK(own.simulation.settings().iterations == 20);
  const Scene few = sheet_scene(R"("material": "cotton")", R"(, "settings": {"iterations": 3, "damping": 0})");
  CHECK(few.simulation.settings().iterations == 3);
  CHECK(few.simulation.settings().damping == 0);
  CHECK(few.simulation.settings().integrator == Integrator::bdf2);
  const Scene late = sheet_scene(R"("material": "cotton")", R"(, "settings": {"start": "prediction"})");
  CHECK(late.simulation.settings().start == Start::prediction);
  const SolverSettings plain = sheet_scene(R"("mass": {"total": 1})").simulation.settings();
  CHECK(plain == SolverSettings{});
}

TEST_CASE("an explicit spring keeps a scene of materials with implicit Euler, which it needs") {
  const Scene scene = sheet_scene(R"("material": "cotton")",
                                  R"(, "forces": [{"type": "mouse_spring", "body": "sheet", "vertex": 0,
                                      "anchor": [0, 0, 1], "stiffness": 10}])");
  CHECK(scene.simulation.settings().integrator == Integrator::implicit_euler);
  CHECK(scene.simulation.settings().acceleration == Acceleration::lbfgs);
}

TEST_CASE("what the scene says itself stays") {
  const Scene scene = sheet_scene(R"("material": "cotton", "mass": {"total": 2}, "contact": {"friction": 0.1},
    "constraints": [{"type": "position", "on": [0]}])",
                                  R"(, "settings": {"damping": 0.25})");
  CHECK(mass(scene) == doctest::Approx(2));
  CHECK(friction(scene) == 0.1);
  CHECK(scene.simulation.settings().damping == 0.25);
  CHECK(friction(sheet_scene(R"("material": "cotton", "contact": {"self": false})")) == 0.5);
}

TEST_CASE("numbers may differ from those of the name, and materials of a scene from those of the library") {
  const Scene changed = sheet_scene(R"("material": {"name": "denim", "bending": 1e-4, "least_stretch": 0})");
  CHECK(stiffness(changed, "sheet.bend") == 1e-4);
  CHECK(stiffness(changed, "sheet.warp") == 6700 - 220);
  const std::string own = R"(, "materials": {"canvas": {"like": "denim", "area_density": 0.5, "friction": 0.7},
    "waxed": {"like": "canvas", "damping": 3}, "silk": {"kind": "sheet", "area_density": 1, "stretch_warp": 9,
    "stretch_weft": 9, "shear": 4, "bending": 2, "source": "a guess"}})";
  const Scene waxed = sheet_scene(R"("material": "waxed")", own);
  CHECK(mass(waxed) == doctest::Approx(0.5));
  CHECK(friction(waxed) == 0.7);
  CHECK(waxed.simulation.settings().damping == doctest::Approx(3));
  const Scene silk = sheet_scene(R"("material": "silk")", own);  // the scene's, not the library's
  CHECK(stiffness(silk, "sheet.bend") == 2);
  CHECK(stiffness(silk, "sheet.shear") == 8);
}

TEST_CASE("the grain of a material is that of its fibres") {
  const auto reduction = [](const std::string& placement) {
    const Scene scene = sheet_scene(R"("material": {"name": "cotton")" + placement + "}");
    const auto numbers = scene.simulation.groups().begin()->second.set.batches[0]->reduction();
    return std::vector<Real>(numbers.begin(), numbers.end());
  };
  const Scene by_hand = sheet_scene(R"("mass": {"total": 1}, "constraints": [{"type": "fibre_strain",
    "direction": [1, 0, 0], "angle": 45}])");
  const auto expected = by_hand.simulation.groups().begin()->second.set.batches[0]->reduction();
  CHECK(reduction(R"(, "direction": [1, 0, 0], "angle": 45)") == std::vector<Real>(expected.begin(), expected.end()));
  CHECK(reduction("") != reduction(R"(, "angle": 45)"));
}

TEST_CASE("solids are made of tetrahedra, and damping is a mean by mass") {
  const Scene scene = parse_scene(R"({"pliant": 1, "bodies": [
    {"name": "a", "mesh": {"shape": "bar"}, "material": "foam"},
    {"name": "b", "mesh": {"shape": "bar"}, "material": {"name": "foam", "density": 90, "damping": 0}}]})",
                                  ".", "scene.json");
  CHECK(scene.simulation.group_names() == std::vector<std::string>{"a.solid", "a.volume", "b.solid", "b.volume"});
  CHECK(stiffness(scene, "a.solid") == doctest::Approx(1e5 / 1.3));
  CHECK(stiffness(scene, "a.volume") == doctest::Approx(3e5 / 1.3 * 0.3 / 0.4));
  CHECK(scene.simulation.settings().damping == doctest::Approx(0.63 / 4));
}

TEST_CASE("events find the groups of a material") {
  Scene scene =
      sheet_scene(R"("material": "wool")", R"(, "events": [{"step": 1, "change": "sheet.bend", "stiffness": 0.5}])");
  scene.step();
  scene.step();
  CHECK(stiffness(scene, "sheet.bend") == 0.5);
}

TEST_CASE("materials that there are not, or not so, are refused with their place") {
  const auto check = [](const std::string& message, std::string_view part) {
    CAPTURE(message);
    CHECK(message.find(part) != std::string::npos);
  };
  check(refusal(R"("material": "coton")"),
        "scene.json: bodies[0].material: unknown material 'coton'; did you mean 'cotton'?");
  check(refusal(R"("material": "foam")"), "bodies[0].material: 'foam' is a solid, and the mesh has no tetrahedra");
  check(refusal(R"("material": 3)"), "bodies[0].material: found a number; give the name of a material");
  check(refusal(R"("material": {"bending": 1})"), "bodies[0].material: the key 'name' is missing");
  check(refusal(R"("material": {"name": "silk", "density": 1})"), "bodies[0].material.density: unknown key");
  check(refusal(R"("material": {"name": "silk", "bending": 0})"), "bodies[0].material.bending: 0 is out of range");
  check(refusal(R"("material": {"name": "silk", "direction": [0, 1, 0]})"), "bodies[0].material: ");
  check(refusal(R"("material": "mine")", R"(, "materials": {"mine": {"bending": 1}})"),
        "materials.mine: the key 'kind' is missing");
  check(refusal(R"("material": "mine")", R"(, "materials": {"mine": {"kind": "gas"}})"), "unknown kind 'gas'");
  check(refusal(R"("material": "mine")", R"(, "materials": {"mine": {"kind": "sheet"}})"),
        "the key 'area_density' is missing");
  check(refusal(R"("material": "mine")", R"(, "materials": {"mine": {"like": "mine"}})"), "unknown material 'mine'");
  check(refusal(R"("material": "mine")", R"(, "materials": {"mine": {"like": "silk", "kind": "sheet"}})"),
        "materials.mine");
  check(refusal(R"("material": "mine")", R"(, "materials": [])"), "materials: ");
  check(refusal(R"("velocity": [0, 0, 0])"), "the key 'mass' is missing");
}

}  // namespace test_material_scenes
