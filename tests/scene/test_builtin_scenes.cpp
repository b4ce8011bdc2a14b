// The built-in scenes run and say what they are.
#include <doctest/doctest.h>

#include "pliant/scene/builtin_scenes.h"
#include "pliant/scene/nearest_names.h"
#include "pliant/scene/scene.h"

namespace {

TEST_CASE("every built-in scene runs") {
  CHECK(pliant::builtin_scenes().size() >= 7);
  for (const pliant::BuiltinScene& builtin : pliant::builtin_scenes()) {
    CAPTURE(builtin.name);
    pliant::Scene scene = pliant::parse_scene(builtin.text, {}, builtin.name);
    CHECK(scene.name == builtin.name);
    CHECK(scene.description.size() > 20);
    CHECK(scene.description.find('\n') == std::string::npos);
    CHECK(scene.description == pliant::scene_description(builtin.text, builtin.name));
    const pliant::Positions start = scene.simulation.state().positions;
    for (int i = 0; i < 5; ++i) scene.step();
    CHECK(scene.simulation.state().step == 5);
    CHECK(scene.simulation.state().positions.allFinite());
    CHECK(scene.simulation.state().velocities.allFinite());
    if (builtin.name != "torus") CHECK((scene.simulation.state().positions - start).cwiseAbs().maxCoeff() > 1e-3);
  }
}

TEST_CASE("the objective rises in no iteration of any built-in scene") {
  for (const pliant::BuiltinScene& builtin : pliant::builtin_scenes()) {
    CAPTURE(builtin.name);
    pliant::Scene scene = pliant::parse_scene(builtin.text, {}, builtin.name);
    for (int i = 0; i < 30; ++i) {
      scene.step();
      pliant::Real before = scene.simulation.objective_history().front();
      for (const pliant::Real objective : scene.simulation.objective_history()) {
        CHECK(objective <= before * (1 + 1e-12));
        before = objective;
      }
      CHECK(scene.simulation.evaluate().objective() <= before * (1 + 1e-12));
    }
  }
}

TEST_CASE("a scene's steps are the same from run to run") {
  const pliant::BuiltinScene& builtin = pliant::builtin_scenes().front();
  pliant::Scene a = pliant::parse_scene(builtin.text, {}, builtin.name);
  pliant::Scene b = pliant::parse_scene(builtin.text, {}, builtin.name);
  for (int i = 0; i < 3; ++i) {
    a.step();
    b.step();
  }
  CHECK(a.simulation.state().positions == b.simulation.state().positions);
}

TEST_CASE("nearest names") {
  using Names = std::vector<std::string_view>;
  CHECK(pliant::nearest_names("flg", {"bar", "chain", "flag"}) == Names{"flag", "bar", "chain"});
  CHECK(pliant::nearest_names("", {"abc", "a", "b"}) == Names{"a", "b", "abc"});
  CHECK(pliant::nearest_names("edge", {"line", "edge_strain"}) == Names{"edge_strain", "line"});
  CHECK(pliant::nearest_names_text("x", {}).empty());
}

}  // namespace
