#include <doctest/doctest.h>

#include "pliant/mesh/shapes.h"
#include "render/capture.h"
#include "viewer/measure_selection.h"

namespace test_measure_selection {

using namespace pliant_viewer;
using Vertices = std::vector<std::uint32_t>;

struct Bodies {
  pliant_render::RenderMesh render_mesh;
  std::vector<Vec3f> positions;

  /// Two sheets of 1 m and a rope of 1 m, all 10 % longer along x than at rest.
  Bodies() {
    pliant::Simulation simulation;
    const pliant::Mesh sheet = pliant::grid({.columns = 5, .rows = 5});
    simulation.add_body(sheet, pliant::Mass::total(1));
    simulation.add_body(sheet, pliant::Mass::total(1));
    simulation.add_body(pliant::chain({.links = 4, .direction = {1, 0, 0}}), pliant::Mass::total(1));
    render_mesh = pliant_render::make_render_mesh(simulation.bodies());
    positions = pliant_render::to_floats(simulation.state().positions);
    for (Vec3f& x : positions) x.x() *= 1.1F;
  }
};

TEST_CASE("one vertex has a place and the stretch of its edges, two a distance") {
  const Bodies bodies;
  const auto one = measure_selection(Vertices{12}, bodies.render_mesh, bodies.positions);
  REQUIRE(one.position.has_value());
  CHECK((*one.position - bodies.positions[12]).norm() == 0);
  CHECK_FALSE(one.between.has_value());
  REQUIRE(one.stretch.has_value());
  CHECK((*one.stretch)[0] == doctest::Approx(1));    // along z
  CHECK((*one.stretch)[1] == doctest::Approx(1.1));  // along x

  const auto two = measure_selection(Vertices{10, 12}, bodies.render_mesh, bodies.positions);
  CHECK_FALSE(two.position.has_value());
  REQUIRE(two.between.has_value());
  CHECK(two.between->norm() == doctest::Approx(0.55));
  CHECK(two.between->x() == doctest::Approx(0.55));
  CHECK_FALSE(two.stretch.has_value());  // no edge joins them

  const auto edge = measure_selection(Vertices{11, 12}, bodies.render_mesh, bodies.positions);
  CHECK(edge.between->norm() == doctest::Approx(0.275));
  CHECK((*edge.stretch)[0] == doctest::Approx(1.1));
  CHECK((*edge.stretch)[1] == doctest::Approx(1.1));

  const auto column = measure_selection(Vertices{2, 7, 12, 17}, bodies.render_mesh, bodies.positions);
  CHECK_FALSE(column.between.has_value());
  CHECK((*column.stretch)[1] == doctest::Approx(1));
  const auto rope = measure_selection(Vertices{50, 51, 52}, bodies.render_mesh, bodies.positions);
  CHECK((*rope.stretch)[0] == doctest::Approx(1.1));
  const auto none = measure_selection({}, bodies.render_mesh, bodies.positions);
  CHECK_FALSE((none.position || none.between || none.stretch));
}

TEST_CASE("selected vertices are written as a scene file has them") {
  const Bodies bodies;
  const std::vector<std::string> names = {"left", "ri\"ght", "rope"};
  CHECK(scene_text_of(Vertices{3, 4, 24}, bodies.render_mesh, names) == "[3, 4, 24]");
  CHECK(scene_text_of(Vertices{25, 49}, bodies.render_mesh, names) == "[0, 24]");
  CHECK(scene_text_of(Vertices{54}, bodies.render_mesh, names) == "[4]");
  CHECK(scene_text_of(Vertices{3, 26, 27, 50}, bodies.render_mesh, names) == "left: [3]\nri\"ght: [1, 2]\nrope: [0]\n");
  CHECK(name_of(49, bodies.render_mesh).body == 1);
  CHECK(name_of(49, bodies.render_mesh).number == 24);
}

}  // namespace test_measure_selection
