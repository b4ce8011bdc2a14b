// The key "solid" of a body: from its surface to tetrahedra that carry it, in a scene.
#include <algorithm>
#include <cmath>
#include <numeric>

#include <doctest/doctest.h>

#include "pliant/core/error.h"
#include "pliant/simulation/carried_surface.h"
#include "pliant_io/recorder/measurements.h"
#include "pliant_io/scene/scene.h"

namespace test_solid_scenes {

using namespace pliant;

namespace {

/// A ball of radius 0.1 m; `body`: more keys of it, `top`: more of the scene.
Scene ball_scene(const std::string& body, const std::string& top = "") {
  return parse_scene(R"({"pliant": 1, "settings": {"threads": 1}, "bodies": [{"name": "ball",
    "mesh": {"shape": "sphere", "radius": 0.1, "subdivisions": 2}, )" +
                         body + "}]" + top + "}",
                     ".", "scene.json");
}

std::string refusal(const std::string& body, const std::string& top = "") {
  try {
    ball_scene(body, top);
  } catch (const Error& error) {
    return error.what();
  }
  return "nothing";
}

bool says(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

constexpr const char* silicone = R"("solid": {"spacing": 0.06}, "material": "silicone")";

Vec3 momentum(const State& state) {
  Vec3 sum = Vec3::Zero();
  for (Index v = 0; v < state.vertex_count(); ++v) sum += state.masses[at(v)] * row(state.velocities, v);
  return sum;
}

Vec3 center(const State& state) {
  Vec3 sum = Vec3::Zero();
  for (Index v = 0; v < state.vertex_count(); ++v) sum += state.masses[at(v)] * row(state.positions, v);
  return sum / std::accumulate(state.masses.begin(), state.masses.end(), Real{0});
}

/// Of the solid and its volume, as a share of what the strain of a body twice as large has.
Real share_of_energy(Simulation& simulation) {
  const std::vector<Real>& volumes = simulation.body(BodyId{0}).mesh.embedding.volumes;
  const Real volume = std::accumulate(volumes.begin(), volumes.end(), Real{0});
  simulation.evaluate();
  const GroupId solid = *simulation.find_group("ball.solid");
  const Real energy =
      simulation.elastic_energy(solid) + simulation.elastic_energy(*simulation.find_group("ball.volume"));
  return energy / (1.5 * *simulation.stiffness(solid) * volume);
}

}  // namespace

TEST_CASE("a spacing and a material are enough") {
  const Scene scene = ball_scene(silicone);
  CHECK(scene.simulation.group_names() == std::vector<std::string>{"ball.solid", "ball.volume", "ball.surface"});
  const Body& body = scene.simulation.body(BodyId{0});
  CHECK(body.mesh.embedding.carried_count() == 162);
  CHECK(body.mesh.vertex_count() > 162);
  const std::vector<Real>& masses = scene.simulation.state().masses;
  CHECK(std::accumulate(masses.begin(), masses.end(), Real{0}) ==
        doctest::Approx(1070 * 4.0 / 3 * 3.14159265 * 1e-3).epsilon(0.06));  // of the polyhedron
  CHECK(largest_departure(scene.simulation, BodyId{0}) < 1e-15);
}

TEST_CASE("constraints of its own act on the lattice by the share inside") {
  Scene scene = ball_scene(R"("solid": {"spacing": 0.06}, "mass": {"density": 1000}, "constraints": [
    {"type": "tetrahedron_strain", "stiffness": 3e4}, {"type": "tetrahedron_volume", "stiffness": 2e4}])");
  CHECK(tetrahedron_stiffness(scene.simulation, BodyId{0}) == 5e4);
  // Twice as large all over: the energy of strain is k/2 V ‖I‖² = 3/2 k V, with V that of the body.
  Simulation& simulation = scene.simulation;
  simulation.set_state(2 * simulation.state().positions, simulation.state().velocities);
  const auto energy = [&](const char* name) {
    simulation.evaluate();
    return simulation.elastic_energy(*simulation.find_group(name));
  };
  const std::vector<Real>& volumes = simulation.body(BodyId{0}).mesh.embedding.volumes;
  const Real volume = std::accumulate(volumes.begin(), volumes.end(), Real{0});
  CHECK(energy("ball.tetrahedron_strain") == doctest::Approx(1.5 * 3e4 * volume).epsilon(2e-3));
  CHECK(energy("ball.surface") < 1e-15);
}

TEST_CASE("it rests on the ground by its own surface, which stays on the lattice") {
  Scene scene = ball_scene(std::string(silicone) + R"(, "transform": {"translate": [0, 0, 0.105]})",
                           R"(, "colliders": [{"type": "plane"}])");
  for (int i = 0; i < 90; ++i) scene.step();
  const Simulation& simulation = scene.simulation;
  const Real lowest = simulation.state().positions.topRows(162).col(2).minCoeff();
  CHECK(lowest > 0);
  CHECK(lowest < simulation.contact_distance(BodyId{0}));
  CHECK(simulation.state().positions.col(2).minCoeff() < 0);  // the lattice sticks out, and touches nothing
  CHECK(largest_departure(simulation, BodyId{0}) < 2e-3 * 0.06);
}

TEST_CASE("ties keep momentum, and free fall is that of one body") {
  Scene scene = ball_scene(std::string(silicone) + R"(, "velocity": [1, 0.5, 0])", R"(, "gravity": null)");
  Simulation& simulation = scene.simulation;
  const Vec3 before = momentum(simulation.state()), begin = center(simulation.state());
  Positions moved = simulation.state().positions;
  moved.row(5) *= 1.3;  // so that there is something to do
  simulation.set_state(moved, simulation.state().velocities);
  const Vec3 start = center(simulation.state());
  CHECK((start - begin).norm() < 0.01);
  for (int i = 0; i < 20; ++i) scene.step();
  CHECK((momentum(simulation.state()) - before).norm() < 1e-9 * before.norm());
  const Vec3 way = center(simulation.state()) - start;
  CHECK((way - Vec3(1, 0.5, 0) * simulation.state().time).norm() < 1e-9);
}

TEST_CASE("a solid that falls stays on its lattice and comes up lower than it fell from, with the settings it has") {
  for (const char* material : {"silicone", "foam"}) {
    CAPTURE(std::string(material));
    Scene scene = ball_scene(R"("solid": {"spacing": 0.06}, "transform": {"translate": [0, 0, 0.6]}, "material": ")" +
                                 std::string(material) + '"',
                             R"(, "colliders": [{"type": "plane"}])");
    Simulation& simulation = scene.simulation;
    CHECK(simulation.settings().integrator == Integrator::bdf2);
    CHECK(simulation.settings().substeps == 1);
    const Real energy = measure(simulation, {}).total;
    Real highest = 0, departure = 0;
    for (int i = 0; i < 90; ++i) {
      scene.step();
      CHECK(measure(simulation, {}).total < 1.001 * energy);
      if (i >= 30) highest = std::max(highest, simulation.state().positions.topRows(162).col(2).mean());
      departure = std::max(departure, largest_departure(simulation, BodyId{0}));
    }
    CHECK(highest < 0.45);
    CHECK(departure < 0.2 * 0.06);
  }
}

TEST_CASE("an inverted, a flattened, a collapsed and a shuffled solid come back to rest") {
  for (const char* material : {"silicone", "foam"}) {
    for (const int kind : {0, 1, 2, 3}) {
      CAPTURE(std::string(material));
      CAPTURE(kind);
      Scene scene = ball_scene(R"("solid": {"spacing": 0.06}, "material": ")" + std::string(material) + '"',
                               R"(, "gravity": null)");
      Simulation& simulation = scene.simulation;
      Positions x = simulation.state().positions;
      if (kind == 0) x.col(2) *= -1;
      if (kind == 1) x.col(2) *= 0;
      if (kind == 2) x *= 1e-3;
      if (kind == 3) {  // each vertex up to a spacing away from its place along each axis
        Real number = 0.5;
        for (Real& coordinate : x.reshaped()) {
          number = std::fmod(number + 0.6180339887, 1);
          coordinate += 0.06 * (2 * number - 1);
        }
      }
      simulation.set_state(x, simulation.state().velocities);
      for (int i = 0; i < 600; ++i) scene.step();
      CHECK(share_of_energy(simulation) < 1e-4);
      CHECK(largest_departure(simulation, BodyId{0}) < 2e-3 * 0.06);
    }
  }
}

TEST_CASE("the same bits for any number of threads") {
  Positions first;
  for (const int threads : {1, 2, 5}) {
    Scene scene = ball_scene(std::string(silicone) + R"(, "transform": {"translate": [0, 0, 0.105]})",
                             R"(, "colliders": [{"type": "plane"}], "contact": {"surfaces": true})");
    SolverSettings settings = scene.simulation.settings();
    settings.threads = threads;
    scene.simulation.set_settings(settings);
    for (int i = 0; i < 30; ++i) scene.step();
    if (threads == 1) first = scene.simulation.state().positions;
    CHECK(scene.simulation.state().positions == first);
  }
}

TEST_CASE("positions, pins and places are those of the surface") {
  std::string rows;
  for (int v = 0; v < 162; ++v) rows += std::string(v == 0 ? "" : ",") + "[0, 0, 2]";
  const Scene moving = ball_scene(std::string(silicone) + R"(, "velocities": [)" + rows + "]");
  CHECK((moving.simulation.state().velocities.col(2).array() == 2).all());
  Scene pinned = ball_scene(std::string(silicone) + R"(, "constraints": [{"type": "position",
    "on": {"nearest": [0.08, 0.08, 0.08]}}])");
  const Group& pin = pinned.simulation.groups().at(*pinned.simulation.find_group("ball.position"));
  CHECK(pin.set.batches[0]->pinned_vertices()[0] < 162);
  for (int i = 0; i < 60; ++i) pinned.step();
  const Index v = pin.set.batches[0]->pinned_vertices()[0];
  const Positions& rest = pinned.simulation.body(BodyId{0}).mesh.vertices;
  CHECK((pinned.simulation.state().positions.row(v) - rest.row(v)).norm() == 0);
  CHECK(largest_departure(pinned.simulation, BodyId{0}) < 0.08 * 0.06);
}

TEST_CASE("what cannot be made solid is refused at its place") {
  CHECK(says(refusal(R"("solid": {}, "material": "foam")"), "bodies[0].solid: the key 'spacing' is missing"));
  CHECK(says(refusal(R"("solid": {"spacing": 0}, "material": "foam")"), "bodies[0].solid.spacing: 0 is out of range"));
  CHECK(says(refusal(R"("solid": {"spacing": 1e-6}, "material": "foam")"), "bodies[0].solid: "));
  CHECK(says(refusal(R"("solid": {"spacing": 1e-6}, "material": "foam")"), "cubes of the lattice"));
  CHECK(says(refusal(R"("solid": {"spacing": 5}, "material": "foam")"), "largest side"));
  CHECK(says(refusal(R"("solid": {"spacing": 0.05, "size": 1}, "material": "foam")"), "unknown key"));
  CHECK(says(refusal(R"("solid": {"spacing": 0.05}, "mass": {"per_vertex": 1})"), "give its 'density' or 'total'"));
  CHECK(says(refusal(R"("solid": {"spacing": 0.05}, "mass": {"area_density": 1})"), "'density'"));
  CHECK(says(refusal(R"("solid": {"spacing": 0.05}, "animation": {})"), "animated body"));
  CHECK(says(refusal(R"("solid": {"spacing": 0.05}, "material": "foam", "start_positions": [[0, 0, 0]])"),
             "start_positions"));
  const Scene coarse = ball_scene(R"("solid": {"spacing": 0.01}, "material": "foam")");
  REQUIRE(coarse.warnings.size() == 1);
  CHECK(says(coarse.warnings[0], "give a finer surface"));
}

}  // namespace test_solid_scenes
